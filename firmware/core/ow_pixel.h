/* SPDX-License-Identifier: 0BSD */
/*
 * Pixel formats. A format is one file format_NAME.c and a line here. Names
 * give the channels from the highest bit down; _le and _be the byte order.
 */
#ifndef OW_PIXEL_H
#define OW_PIXEL_H

#include <stdbool.h>
#include <stdint.h>

/* Pixels first .. end-1 of a scan line. */
struct ow_span {
    uint16_t line;
    uint16_t first;
    uint16_t end;
};

struct ow_pixel_format {
    const char *name;
    uint8_t bits;  /* of a pixel, spare bits included */
    uint32_t used; /* mask of the packed value's bits that show; the others are 0 */
    bool keeps;    /* in memory the others are somebody else's: never written, never read */
    /* 0x00RRGGBB to the format's value, rounded to the nearest level. */
    uint32_t (*pack)(uint32_t rgb);
    /* The inverse: 0x00RRGGBB, exact at the ends 0 and 255. */
    uint32_t (*unpack)(uint32_t value);
    /*
     * Like pack, but rounded by an ordered dither's threshold 0 .. 63: over all
     * thresholds the mean is the colour. NULL: the levels are fine enough.
     */
    uint32_t (*dither)(uint32_t rgb, uint32_t threshold);
    /* Sets pixels first .. end-1 of a row to a packed value; row: aligned to 4 bytes. */
    void (*fill)(uint8_t *row, uint32_t first, uint32_t end, uint32_t value);
    /*
     * The same for count spans that are not empty; top: where line 0's row would be, stride
     * bytes from a row to the next. Returns how many pixels that were. NULL: fill does.
     */
    uint32_t (*fill_spans)(uintptr_t top, uint32_t stride, const struct ow_span *spans,
                           uint32_t count, uint32_t value);
    /* Packs end - first colours 0x00RRGGBB into pixels first .. end-1 of a row. */
    void (*store)(uint8_t *row, uint32_t first, uint32_t end, const uint32_t *rgb);
    /* The packed value of one pixel of a row. */
    uint32_t (*get)(const uint8_t *row, uint32_t x);
};

extern const struct ow_pixel_format ow_format_xrgb8888;  /* 32-bit little-endian words */
extern const struct ow_pixel_format ow_format_rgb565;    /* 16-bit little-endian words */
extern const struct ow_pixel_format ow_format_rgb565_be; /* the same, high byte first */
extern const struct ow_pixel_format ow_format_rgb332;    /* bytes */
extern const struct ow_pixel_format ow_format_gray8;     /* bytes of luminance */
extern const struct ow_pixel_format ow_format_gray4;     /* 2 pixels a byte, the left one high */
extern const struct ow_pixel_format ow_format_mono;      /* 8 pixels a byte, the leftmost highest */

/*
 * Two that leave a byte of each pixel alone, which belongs to somebody else: a
 * tree in bit planes. Their names are not in the list below: memory must suit.
 */
extern const struct ow_pixel_format ow_format_xrgb8888_kept; /* the high byte of 32-bit words */
extern const struct ow_pixel_format
    ow_format_x8rgb565_kept; /* the third byte; the first two RGB565 */

/* The others, and the one of this name or NULL. A program that uses these contains all of them. */
extern const struct ow_pixel_format *const ow_formats[];
extern const uint32_t ow_format_count;
const struct ow_pixel_format *ow_format_by_name(const char *name);

/* Bytes of a row of width pixels without padding. */
uint32_t ow_row_bytes(const struct ow_pixel_format *format, uint32_t width);

#endif
