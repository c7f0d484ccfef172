/* SPDX-License-Identifier: 0BSD */
/* Backdrops: what fills the pixels that the model leaves unlit. */
#include "ow_dither.h"
#include "ow_draw.h"
#include "ow_shade.h"

static void fill_gradient(void *context, const struct ow_pixel_format *format, uint8_t *row,
                          uint32_t line, uint32_t first, uint32_t end)
{
    const struct ow_gradient_backdrop *gradient = context;
    uint32_t last = gradient->height > 1 ? gradient->height - 1u : 1;
    uint32_t rgb = ow_mix(gradient->top, gradient->bottom, line * 256 / last);
    if (gradient->dither && format->dither != NULL) {
        ow_dithering.fill(format, row, line, first, end, rgb);
    } else {
        format->fill(row, first, end, format->pack(rgb));
    }
}

struct ow_backdrop ow_backdrop_of_gradient(struct ow_gradient_backdrop *gradient)
{
    return (struct ow_backdrop){ fill_gradient, gradient };
}
