/* SPDX-License-Identifier: 0BSD */
/* Pixel format: 32-bit little-endian words 0x00RRGGBB; the high byte is spare and written 0. */
#include "ow_memory.h"
#include "ow_pixel.h"

enum {
    SHORT = 8,  /* a span of so many pixels is filled one by one */
    LONG = 128, /* one of more by copying */
};

static uint32_t same(uint32_t rgb)
{
    return rgb & 0xFFFFFF;
}

static void fill_short(uint8_t *row, uint32_t first, uint32_t end, uint32_t value)
{
    ow_word32 *pixel = (ow_word32 *)(void *)row;
    uint32_t word = ow_little32(value);
    if ((first & 1) && first < end) {
        pixel[first++] = word;
    }
    ow_word64 *pair = (ow_word64 *)(void *)(pixel + first);
    ow_word64 both = (ow_word64)word << 32 | word;
    for (; first + 8 <= end; first += 8) {
        pair[0] = both;
        pair[1] = both;
        pair[2] = both;
        pair[3] = both;
        pair += 4;
    }
    for (; first + 2 <= end; first += 2) {
        *pair++ = both;
    }
    if (first < end) {
        pixel[first] = word;
    }
}

/* Copies what is there already, twice as much each time: the machine's widest stores. */
static void fill_long(uint8_t *row, uint32_t first, uint32_t end, uint32_t value)
{
    uint8_t *to = row + first * sizeof(ow_word32);
    size_t all = (end - first) * sizeof(ow_word32);
    size_t done = LONG / 2 * sizeof(ow_word32);
    fill_short(row, first, first + LONG / 2, value);
    while (done < all) {
        size_t more = all - done < done ? all - done : done;
        memcpy(to + done, to, more);
        done += more;
    }
}

static void fill(uint8_t *row, uint32_t first, uint32_t end, uint32_t value)
{
    if (end > first + LONG) {
        fill_long(row, first, end, value);
    } else {
        fill_short(row, first, end, value);
    }
}

static uint32_t fill_spans(uintptr_t top, uint32_t stride, const struct ow_span *spans,
                           uint32_t count, uint32_t value)
{
    const struct ow_span *end = spans + count;
    uint32_t word = ow_little32(value);
    uint32_t pixels = 0;
    for (; spans < end; spans++) {
        uint8_t *row = (uint8_t *)(top + (uintptr_t)spans->line * stride);
        uint32_t length = (uint32_t)spans->end - spans->first;
        pixels += length;
        if (length > SHORT) {
            fill(row, spans->first, spans->end, value);
            continue;
        }
        ow_word32 *pixel = (ow_word32 *)(void *)row + spans->first;
        const ow_word32 *stop = pixel + length;
        do {
            *pixel++ = word;
        } while (pixel < stop);
    }
    return pixels;
}

static void store(uint8_t *row, uint32_t first, uint32_t end, const uint32_t *rgb)
{
    ow_word32 *pixel = (ow_word32 *)(void *)row;
    for (uint32_t x = first; x < end; x++) {
        pixel[x] = ow_little32(*rgb++);
    }
}

static uint32_t get(const uint8_t *row, uint32_t x)
{
    return ow_little32(((const ow_word32 *)(const void *)row)[x]);
}

const struct ow_pixel_format ow_format_xrgb8888 = {
    .name = "xrgb8888",
    .bits = 32,
    .used = 0x00FFFFFF,
    .pack = same,
    .unpack = same,
    .fill = fill,
    .fill_spans = fill_spans,
    .store = store,
    .get = get,
};
