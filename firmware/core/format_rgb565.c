/* SPDX-License-Identifier: 0BSD */
/* Pixel format: 16-bit little-endian words RRRRRGGG GGGBBBBB. */
#include "ow_pixel.h"
#include "ow_rgb565.h"

static void fill(uint8_t *row, uint32_t first, uint32_t end, uint32_t value)
{
    ow_fill16(row, first, end, ow_little32(value << 16 | value));
}

static void store(uint8_t *row, uint32_t first, uint32_t end, const uint32_t *rgb)
{
    for (uint32_t x = first; x < end; x++) {
        uint32_t value = ow_rgb565_pack(*rgb++);
        row[2 * x] = (uint8_t)value;
        row[2 * x + 1] = (uint8_t)(value >> 8);
    }
}

static uint32_t get(const uint8_t *row, uint32_t x)
{
    return (uint32_t)row[2 * x] | (uint32_t)row[2 * x + 1] << 8;
}

const struct ow_pixel_format ow_format_rgb565 = {
    .name = "rgb565",
    .bits = 16,
    .used = 0xFFFF,
    .pack = ow_rgb565_pack,
    .unpack = ow_rgb565_unpack,
    .dither = ow_rgb565_dither,
    .fill = fill,
    .store = store,
    .get = get,
};
