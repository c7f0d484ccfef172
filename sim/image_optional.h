/* SPDX-License-Identifier: 0BSD */
/* What image_formats.c takes from the files that may be left out: image_png.c, image_gif.c. */
#ifndef OLDWELL_SIM_IMAGE_OPTIONAL_H
#define OLDWELL_SIM_IMAGE_OPTIONAL_H

#include "image.h"

extern const struct image_format image_png;

/* The contract is image_write_gif's. */
bool image_gif_write(FILE *stream, const struct image *frames, uint32_t count, uint32_t delay_cs,
                     struct image_error *error);

#endif
