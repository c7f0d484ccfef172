/* SPDX-License-Identifier: 0BSD */
/* Pixel format: bytes of luminance. */
#include "ow_level.h"
#include "ow_memory.h"
#include "ow_pixel.h"

static uint32_t pack(uint32_t rgb)
{
    return (ow_luminance_q16(rgb) + 32768) >> 16;
}

static uint32_t unpack(uint32_t value)
{
    return (value & 255) * 0x010101;
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

const struct ow_pixel_format ow_format_gray8 = {
    .name = "gray8",
    .bits = 8,
    .used = 0xFF,
    .pack = pack,
    .unpack = unpack,
    .fill = fill,
    .store = store,
    .get = get,
};
