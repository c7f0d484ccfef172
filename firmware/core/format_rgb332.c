/* SPDX-License-Identifier: 0BSD */
/* Pixel format: bytes RRRGGGBB. */
#include "ow_level.h"
#include "ow_memory.h"
#include "ow_pixel.h"

static uint32_t pack(uint32_t rgb)
{
    return ow_level(rgb >> 16 & 255, 7) << 5 | ow_level(rgb >> 8 & 255, 7) << 2 |
           ow_level(rgb & 255, 3);
}

static uint32_t dither(uint32_t rgb, uint32_t threshold)
{
    return ow_level_dithered(rgb >> 16 & 255, 7, threshold) << 5 |
           ow_level_dithered(rgb >> 8 & 255, 7, threshold) << 2 |
           ow_level_dithered(rgb & 255, 3, threshold);
}

static uint32_t unpack_3_bits(uint32_t level)
{
    return level << 5 | level << 2 | level >> 1;
}

static uint32_t unpack(uint32_t value)
{
    return unpack_3_bits(value >> 5 & 7) << 16 | unpack_3_bits(value >> 2 & 7) << 8 |
           (value & 3) * 85;
}

static void fill(uint8_t *row, uint32_t first, uint32_t end, uint32_t value)
{
    if (first < end) {
        memset(row + first, (int)value, end - first);
    }
}

static void store(uint8_t *row, uint32_t first, uint32_t end, const uint32_t *rgb)
{
    for (uint32_t x = first; x < end; x++) {
        row[x] = (uint8_t)pack(*rgb++);
    }
}

static uint32_t get(const uint8_t *row, uint32_t x)
{
    return row[x];
}

const struct ow_pixel_format ow_format_rgb332 = {
    .name = "rgb332",
    .bits = 8,
    .used = 0xFF,
    .pack = pack,
    .unpack = unpack,
    .dither = dither,
    .fill = fill,
    .store = store,
    .get = get,
};
