/* SPDX-License-Identifier: 0BSD */
/* Pixel format: one bit, set for light; 8 pixels a byte, the leftmost in the highest bit. */
#include "ow_level.h"
#include "ow_memory.h"
#include "ow_pixel.h"

static uint32_t pack(uint32_t rgb)
{
    return ow_grey_level(rgb, 1);
}

static uint32_t dither(uint32_t rgb, uint32_t threshold)
{
    return ow_grey_level_dithered(rgb, 1, threshold);
}

static uint32_t unpack(uint32_t value)
{
    return (value & 1) * 0xFFFFFF;
}

static void set_bits(uint8_t *byte, uint32_t mask, uint32_t value)
{
    *byte = (uint8_t)(value ? *byte | mask : *byte & ~mask);
}

static void fill(uint8_t *row, uint32_t first, uint32_t end, uint32_t value)
{
    if (first >= end) {
        return;
    }
    uint8_t *byte = row + first / 8;
    uint8_t *last = row + (end - 1) / 8;
    uint32_t mask = 0xFFu >> (first & 7);
    uint32_t last_mask = 0xFFu << (7 - ((end - 1) & 7));
    if (byte == last) {
        set_bits(byte, mask & last_mask, value);
        return;
    }
    set_bits(byte++, mask, value);
    memset(byte, value ? 0xFF : 0, (size_t)(last - byte));
    set_bits(last, last_mask & 0xFF, value);
}

static void store(uint8_t *row, uint32_t first, uint32_t end, const uint32_t *rgb)
{
    for (uint32_t x = first; x < end; x++) {
        set_bits(row + x / 8, 0x80u >> (x & 7), pack(*rgb++));
    }
}

static uint32_t get(const uint8_t *row, uint32_t x)
{
    return (uint32_t)row[x / 8] >> (7 - (x & 7)) & 1;
}

const struct ow_pixel_format ow_format_mono = {
    .name = "mono",
    .bits = 1,
    .used = 1,
    .pack = pack,
    .unpack = unpack,
    .dither = dither,
    .fill = fill,
    .store = store,
    .get = get,
};
