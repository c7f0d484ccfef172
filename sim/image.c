/* SPDX-License-Identifier: 0BSD */
/* Pictures in memory. */
#include "image.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

bool image_fail(struct image_error *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    /* cppcheck-suppress ctuuninitvar ; it is written, not read */
    vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    return false;
}

bool image_make(struct image *image, uint32_t width, uint32_t height, struct image_error *error)
{
    *image = (struct image){ 0 };
    if (width < 1 || height < 1 || width > IMAGE_SIZE_MAX || height > IMAGE_SIZE_MAX) {
        return image_fail(error, "a picture of %lux%lu is out of range", (unsigned long)width,
                          (unsigned long)height);
    }
    image->rgb = malloc((size_t)3 * width * height);
    if (image->rgb == NULL) {
        return image_fail(error, "not enough memory for a picture of %lux%lu", (unsigned long)width,
                          (unsigned long)height);
    }
    image->width = width;
    image->height = height;
    return true;
}

bool image_copy(struct image *to, const struct image *from, struct image_error *error)
{
    if (!image_make(to, from->width, from->height, error)) {
        return false;
    }
    memcpy(to->rgb, from->rgb, (size_t)3 * from->width * from->height);
    return true;
}

void image_free(struct image *image)
{
    free(image->rgb);
    *image = (struct image){ 0 };
}
