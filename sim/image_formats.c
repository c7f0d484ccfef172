/* SPDX-License-Identifier: 0BSD */
/* The picture formats that are built in: the one place that knows OW_SIM_NO_PNG. */
#include <string.h>

#include "image.h"
#ifndef OW_SIM_NO_PNG
#include "image_optional.h"
#endif

static const struct image_format *const formats[] = {
#ifndef OW_SIM_NO_PNG
    &image_png,
#endif
    &image_ppm,
};

const struct image_format *image_format_at(uint32_t i)
{
    return i < sizeof formats / sizeof formats[0] ? formats[i] : NULL;
}

const struct image_format *image_format_of(const char *file, struct image_error *error)
{
    const char *slash = strrchr(file, '/');
    const char *dot = strrchr(slash != NULL ? slash : file, '.');
    for (uint32_t i = 0; dot != NULL && image_format_at(i) != NULL; i++) {
        if (strcmp(dot, image_format_at(i)->extension) == 0) {
            return image_format_at(i);
        }
    }
    if (dot != NULL && strcmp(dot, ".png") == 0) {
        image_fail(error, "PNG is not built into this program, use .ppm");
    } else {
        image_fail(error, "the name must end in .ppm or .png");
    }
    return NULL;
}

bool image_has_gif(void)
{
#ifdef OW_SIM_NO_PNG
    return false;
#else
    return true;
#endif
}

bool image_write_gif(FILE *stream, const struct image *frames, uint32_t count, uint32_t delay_cs,
                     struct image_error *error)
{
#ifdef OW_SIM_NO_PNG
    (void)stream, (void)frames, (void)count, (void)delay_cs;
    return image_fail(error, "GIF is not built into this program");
#else
    return image_gif_write(stream, frames, count, delay_cs, error);
#endif
}
