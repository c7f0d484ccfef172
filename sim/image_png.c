/* SPDX-License-Identifier: 0BSD */
/* PNG files, by libpng's simplified interface. Left out of the build with OW_SIM_NO_PNG. */
#include <png.h>

#include "image.h"
#include "image_optional.h"

static bool png_write(FILE *stream, const struct image *image, struct image_error *error)
{
    png_image png = {
        .version = PNG_IMAGE_VERSION,
        .width = image->width,
        .height = image->height,
        .format = PNG_FORMAT_RGB,
    };
    if (!png_image_write_to_stdio(&png, stream, 0, image->rgb, 0, NULL)) {
        image_fail(error, "cannot write the PNG: %s", png.message);
        png_image_free(&png);
        return false;
    }
    return true;
}

static bool png_read(FILE *stream, struct image *image, struct image_error *error)
{
    static const png_color black = { 0, 0, 0 };
    png_image png = { .version = PNG_IMAGE_VERSION };
    *image = (struct image){ 0 };
    bool good = png_image_begin_read_from_stdio(&png, stream) != 0;
    if (good) {
        png.format = PNG_FORMAT_RGB;
        if (!image_make(image, png.width, png.height, error)) {
            png_image_free(&png);
            return false;
        }
        good = png_image_finish_read(&png, &black, image->rgb, 0, NULL) != 0;
    }
    if (!good) {
        image_fail(error, "cannot read the PNG: %s", png.message);
        png_image_free(&png);
        image_free(image);
    }
    return good;
}

const struct image_format image_png = { "PNG", ".png", png_write, png_read };
