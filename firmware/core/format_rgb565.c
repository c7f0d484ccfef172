/* SPDX-License-Identifier: 0BSD */
/* Pixel format: 16-bit little-endian words RRRRRGGG GGGBBBBB. */
#include "ow_memory.h"
#include "ow_pixel.h"

/* c * levels / 255 rounded to the nearest, for c 0 .. 255 and levels 31 or 63: exact. */
static uint32_t to_level(uint32_t c, uint32_t levels)
{
    uint32_t t = c * levels + 128;
    return (t + (t >> 8)) >> 8;
}

static uint32_t pack(uint32_t rgb)
{
    return to_level(rgb >> 16 & 255, 31) << 11 | to_level(rgb >> 8 & 255, 63) << 5 |
           to_level(rgb & 255, 31);
}

/* Repeating the high bits below is within 1/2 of value * 255 / levels. */
static uint32_t unpack(uint32_t value)
{
    uint32_t r = value >> 11 & 31;
    uint32_t g = value >> 5 & 63;
    uint32_t b = value & 31;
    return (r << 3 | r >> 2) << 16 | (g << 2 | g >> 4) << 8 | (b << 3 | b >> 2);
}

static void fill(uint8_t *row, uint32_t first, uint32_t end, uint32_t value)
{
    uint32_t both = ow_little32(value << 16 | value);
    ow_word16 *pixel = (ow_word16 *)(void *)row;
    uint16_t one;
    memcpy(&one, &both, sizeof one);
    if ((first & 1) && first < end) {
        pixel[first++] = one;
    }
    ow_word32 *pair = (ow_word32 *)(void *)row;
    for (; first + 2 <= end; first += 2) {
        pair[first / 2] = both;
    }
    if (first < end) {
        pixel[first] = one;
    }
}

static void store(uint8_t *row, uint32_t first, uint32_t end, const uint32_t *rgb)
{
    for (uint32_t x = first; x < end; x++) {
        uint32_t value = pack(*rgb++);
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
    .pack = pack,
    .unpack = unpack,
    .fill = fill,
    .store = store,
    .get = get,
};
