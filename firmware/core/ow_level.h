/* SPDX-License-Identifier: 0BSD */
/*
 * Channels to levels: what the pixel formats share. A level is 0 .. levels;
 * levels stands for 255.
 */
#ifndef OW_LEVEL_H
#define OW_LEVEL_H

#include <stdint.h>

/* c * levels / 255 rounded to the nearest, for c and levels 0 .. 255: exact. */
static inline uint32_t ow_level(uint32_t c, uint32_t levels)
{
    uint32_t t = c * levels + 128;
    return (t + (t >> 8)) >> 8;
}

/*
 * The level below or above, by an ordered dither's threshold 0 .. 63:
 * c * levels / 255 + (2 * threshold + 1) / 128 rounded down. 0 and 255 are kept.
 */
static inline uint32_t ow_level_dithered(uint32_t c, uint32_t levels, uint32_t threshold)
{
    return (c * levels * 128 + (2 * threshold + 1) * 255) / (255 * 128);
}

/* Luminance by Rec. 601's weights, 255 * 65536 for white. */
static inline uint32_t ow_luminance_q16(uint32_t rgb)
{
    return 19595 * (rgb >> 16 & 255) + 38470 * (rgb >> 8 & 255) + 7471 * (rgb & 255);
}

/* Luminance as the nearest level. */
static inline uint32_t ow_grey_level(uint32_t rgb, uint32_t levels)
{
    return (ow_luminance_q16(rgb) * levels + 255 * 32768) / (255 * 65536);
}

/* Luminance as the level below or above, for levels up to 15. */
static inline uint32_t ow_grey_level_dithered(uint32_t rgb, uint32_t levels, uint32_t threshold)
{
    return (ow_luminance_q16(rgb) * levels + (2 * threshold + 1) * (255 * 512)) / (255 * 65536);
}

#endif
