/* SPDX-License-Identifier: 0BSD */
/*
 * Pixel format: 24 bits, of which the low 16 are RGB565, little-endian; the
 * high byte belongs to somebody else and is neither written nor read. The 1983
 * frame buffer was used so: 16 planes of picture, 8 of tree [FAG83].
 */
#include "ow_pixel.h"
#include "ow_rgb565.h"

enum { BYTES = 3 };

static void set(uint8_t *pixel, uint32_t value)
{
    pixel[0] = (uint8_t)value;
    pixel[1] = (uint8_t)(value >> 8);
}

static void fill(uint8_t *row, uint32_t first, uint32_t end, uint32_t value)
{
    for (uint8_t *p = row + BYTES * first; p < row + BYTES * end; p += BYTES) {
        set(p, value);
    }
}

static void store(uint8_t *row, uint32_t first, uint32_t end, const uint32_t *rgb)
{
    for (uint8_t *p = row + BYTES * first; p < row + BYTES * end; p += BYTES) {
        set(p, ow_rgb565_pack(*rgb++));
    }
}

static uint32_t get(const uint8_t *row, uint32_t x)
{
    const uint8_t *p = row + BYTES * x;
    return (uint32_t)p[0] | (uint32_t)p[1] << 8;
}

const struct ow_pixel_format ow_format_x8rgb565_kept = {
    .name = "x8rgb565-kept",
    .bits = 24,
    .used = 0xFFFF,
    .keeps = true,
    .pack = ow_rgb565_pack,
    .unpack = ow_rgb565_unpack,
    .dither = ow_rgb565_dither,
    .fill = fill,
    .store = store,
    .get = get,
};
