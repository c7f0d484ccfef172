/* SPDX-License-Identifier: 0BSD */
/*
 * Pixel format: 32-bit little-endian words 0x00RRGGBB whose high byte belongs
 * to somebody else, a tree in bit planes say. It is neither written nor read:
 * video memory may be slow to read, and others may write it meanwhile.
 */
#include "ow_pixel.h"

enum { BYTES = 4 };

static uint32_t same(uint32_t rgb)
{
    return rgb & 0xFFFFFF;
}

static void set(uint8_t *pixel, uint32_t value)
{
    pixel[0] = (uint8_t)value;
    pixel[1] = (uint8_t)(value >> 8);
    pixel[2] = (uint8_t)(value >> 16);
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
        set(p, *rgb++);
    }
}

static uint32_t get(const uint8_t *row, uint32_t x)
{
    const uint8_t *p = row + BYTES * x;
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16;
}

const struct ow_pixel_format ow_format_xrgb8888_kept = {
    .name = "xrgb8888-kept",
    .bits = 32,
    .used = 0x00FFFFFF,
    .keeps = true,
    .pack = same,
    .unpack = same,
    .fill = fill,
    .store = store,
    .get = get,
};
