/* SPDX-License-Identifier: 0BSD */
/* Dither: pixel by pixel, or for one colour as a pattern that repeats every 8 pixels. */
#include "ow_dither.h"

#include "ow_memory.h"

enum { PERIOD = 8, TILE_WORDS = PERIOD }; /* 8 pixels of up to 32 bits */

static void fill_each(const struct ow_pixel_format *format, uint8_t *row, uint32_t y,
                      uint32_t first, uint32_t end, uint32_t rgb)
{
    for (uint32_t x = first; x < end; x++) {
        format->fill(row, x, x + 1, format->dither(rgb, ow_dither_threshold(x, y)));
    }
}

static void fill(const struct ow_pixel_format *format, uint8_t *row, uint32_t y, uint32_t first,
                 uint32_t end, uint32_t rgb)
{
    uint32_t whole = (first + PERIOD - 1) / PERIOD; /* periods, as numbered from the left */
    uint32_t end_whole = end / PERIOD;
    if (format->keeps || whole + 1 >= end_whole) {
        fill_each(format, row, y, first, end, rgb);
        return;
    }
    uint32_t words[TILE_WORDS];
    uint8_t *tile = (uint8_t *)words;
    fill_each(format, tile, y, 0, PERIOD, rgb);
    fill_each(format, row, y, first, whole * PERIOD, rgb);
    uint32_t bytes = format->bits; /* of 8 pixels */
    for (uint32_t period = whole; period < end_whole; period++) {
        memcpy(row + period * bytes, tile, bytes);
    }
    fill_each(format, row, y, end_whole * PERIOD, end, rgb);
}

static void store(const struct ow_pixel_format *format, uint8_t *row, uint32_t y, uint32_t first,
                  uint32_t end, const uint32_t *rgb)
{
    for (uint32_t x = first; x < end; x++) {
        format->fill(row, x, x + 1, format->dither(*rgb++, ow_dither_threshold(x, y)));
    }
}

const struct ow_dithering ow_dithering = { fill, store };
