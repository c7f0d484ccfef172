/* SPDX-License-Identifier: 0BSD */
/*
 * Ordered dither: Bayer's matrix of 8x8 thresholds, a function of the pixel
 * alone, so that every order, band and thread gives the same picture.
 */
#ifndef OW_DITHER_H
#define OW_DITHER_H

#include <stdint.h>

#include "ow_pixel.h"

/* 0 .. 63, each once in any 8x8 pixels: the bits of x ^ y and y, lowest first. */
static inline uint32_t ow_dither_threshold(uint32_t x, uint32_t y)
{
    uint32_t d = x ^ y;
    return (d & 1) << 5 | (y & 1) << 4 | (d & 2) << 2 | (y & 2) << 1 | (d & 4) >> 1 | (y & 4) >> 2;
}

struct ow_dithering {
    /* Fills pixels first .. end-1 of the screen's line y with one colour 0x00RRGGBB. */
    void (*fill)(const struct ow_pixel_format *format, uint8_t *row, uint32_t y, uint32_t first,
                 uint32_t end, uint32_t rgb);
    /* Stores end - first colours 0x00RRGGBB into pixels first .. end-1. */
    void (*store)(const struct ow_pixel_format *format, uint8_t *row, uint32_t y, uint32_t first,
                  uint32_t end, const uint32_t *rgb);
};
extern const struct ow_dithering ow_dithering;

#endif
