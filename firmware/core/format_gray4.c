/* SPDX-License-Identifier: 0BSD */
/* Pixel format: luminance in 4 bits, two pixels a byte, the left one in the high half. */
#include "ow_level.h"
#include "ow_memory.h"
#include "ow_pixel.h"

enum { LEVELS = 15 };

static uint32_t pack(uint32_t rgb)
{
    return ow_grey_level(rgb, LEVELS);
}

static uint32_t dither(uint32_t rgb, uint32_t threshold)
{
    return ow_grey_level_dithered(rgb, LEVELS, threshold);
}

static uint32_t unpack(uint32_t value)
{
    return (value & 15) * 0x111111;
}

static void set(uint8_t *row, uint32_t x, uint32_t value)
{
    uint8_t *byte = row + x / 2;
    *byte = (uint8_t)(x & 1 ? (*byte & 0xF0u) | value : (*byte & 0x0Fu) | value << 4);
}

static void fill(uint8_t *row, uint32_t first, uint32_t end, uint32_t value)
{
    if ((first & 1) && first < end) {
        set(row, first++, value);
    }
    if (first + 2 <= end) {
        memset(row + first / 2, (int)(value * 17), (end - first) / 2);
    }
    if (first < end && (end & 1)) {
        set(row, end - 1, value);
    }
}

static void store(uint8_t *row, uint32_t first, uint32_t end, const uint32_t *rgb)
{
    for (uint32_t x = first; x < end; x++) {
        set(row, x, pack(*rgb++));
    }
}

static uint32_t get(const uint8_t *row, uint32_t x)
{
    return x & 1 ? row[x / 2] & 15u : row[x / 2] >> 4;
}

const struct ow_pixel_format ow_format_gray4 = {
    .name = "gray4",
    .bits = 4,
    .used = 0x0F,
    .pack = pack,
    .unpack = unpack,
    .dither = dither,
    .fill = fill,
    .store = store,
    .get = get,
};
