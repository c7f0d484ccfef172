/* SPDX-License-Identifier: 0BSD */
/* Pixels of 16 bits, RRRRRGGG GGGBBBBB: what the formats of either byte order share. */
#ifndef OW_RGB565_H
#define OW_RGB565_H

#include "ow_level.h"
#include "ow_memory.h"

static inline uint32_t ow_rgb565_pack(uint32_t rgb)
{
    return ow_level(rgb >> 16 & 255, 31) << 11 | ow_level(rgb >> 8 & 255, 63) << 5 |
           ow_level(rgb & 255, 31);
}

static inline uint32_t ow_rgb565_dither(uint32_t rgb, uint32_t threshold)
{
    return ow_level_dithered(rgb >> 16 & 255, 31, threshold) << 11 |
           ow_level_dithered(rgb >> 8 & 255, 63, threshold) << 5 |
           ow_level_dithered(rgb & 255, 31, threshold);
}

/* The factors give value * 255 / levels rounded to the nearest. */
static inline uint32_t ow_rgb565_unpack(uint32_t value)
{
    uint32_t r = ((value >> 11 & 31) * 527 + 23) >> 6;
    uint32_t g = ((value >> 5 & 63) * 259 + 33) >> 6;
    uint32_t b = ((value & 31) * 527 + 23) >> 6;
    return r << 16 | g << 8 | b;
}

/* Sets 16-bit pixels to the two bytes that begin both_pixels, which is the same pixel twice. */
static inline void ow_fill16(uint8_t *row, uint32_t first, uint32_t end, uint32_t both_pixels)
{
    ow_word16 *pixel = (ow_word16 *)(void *)row;
    uint16_t one;
    memcpy(&one, &both_pixels, sizeof one);
    if ((first & 1) && first < end) {
        pixel[first++] = one;
    }
    ow_word32 *pair = (ow_word32 *)(void *)row;
    for (; first + 2 <= end; first += 2) {
        pair[first / 2] = both_pixels;
    }
    if (first < end) {
        pixel[first] = one;
    }
}

#endif
