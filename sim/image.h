/* SPDX-License-Identifier: 0BSD */
/*
 * Pictures on the host: in memory, as PPM, PNG and GIF files, side by side on
 * a sheet, and compared. Functions that can fail return false and leave one
 * sentence in the error's text.
 */
#ifndef OLDWELL_SIM_IMAGE_H
#define OLDWELL_SIM_IMAGE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { IMAGE_SIZE_MAX = 65535 }; /* pixels, width and height */

struct image {
    uint32_t width; /* pixels, 1 .. IMAGE_SIZE_MAX */
    uint32_t height;
    uint8_t *rgb; /* 3 bytes a pixel, rows top down without padding; malloc */
};

struct image_error {
    char text[200];
};

/* ---- image.c ---- */

/* Pixels are not set. On failure *image is all zero. */
bool image_make(struct image *image, uint32_t width, uint32_t height, struct image_error *error);
bool image_copy(struct image *to, const struct image *from, struct image_error *error);
void image_free(struct image *image); /* leaves it all zero */

/* Writes the sentence, cut to its room; returns false for `return image_fail(...)`. */
bool image_fail(struct image_error *error, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static inline uint32_t image_pixel(const struct image *image, uint32_t x, uint32_t y)
{
    const uint8_t *p = image->rgb + 3 * ((size_t)y * image->width + x);
    return (uint32_t)p[0] << 16 | (uint32_t)p[1] << 8 | p[2];
}

static inline void image_set_pixel(struct image *image, uint32_t x, uint32_t y, uint32_t rgb)
{
    uint8_t *p = image->rgb + 3 * ((size_t)y * image->width + x);
    p[0] = (uint8_t)(rgb >> 16);
    p[1] = (uint8_t)(rgb >> 8);
    p[2] = (uint8_t)rgb;
}

/* ---- files: image_ppm.c, image_png.c, chosen by image_formats.c ---- */

/* Writing leaves errors of the stream (a full disk) to whoever closes it. */
struct image_format {
    const char *name;
    const char *extension; /* with its dot */
    bool (*write)(FILE *stream, const struct image *image, struct image_error *error);
    /* Reads one picture; *image is made by it. */
    bool (*read)(FILE *stream, struct image *image, struct image_error *error);
};

extern const struct image_format image_ppm;

/* The format that a file's name asks for; NULL, and the sentence, where there is none. */
const struct image_format *image_format_of(const char *file, struct image_error *error);

/* The format number i of those that are built in, NULL after the last; the best comes first. */
const struct image_format *image_format_at(uint32_t i);

/*
 * Writes an animated picture that starts again for ever; each frame stands for
 * delay_cs hundredths of a second. One palette of at most 255 colours for all,
 * the same bytes for the same frames. All frames have the first one's size.
 */
bool image_write_gif(FILE *stream, const struct image *frames, uint32_t count, uint32_t delay_cs,
                     struct image_error *error);
bool image_has_gif(void); /* false: not built in */

/* ---- image_palette.c ---- */

enum { PALETTE_COLOURS = 255 };

struct palette {
    uint32_t rgb[PALETTE_COLOURS];
    uint32_t count;
    struct palette_entry *table; /* every colour that occurred, and its place in rgb */
    uint32_t capacity;           /* a power of two */
    uint32_t used;
};

/* A palette for all the frames: their own colours if they are few, else by median cut. */
bool palette_make(struct palette *palette, const struct image *frames, uint32_t count,
                  struct image_error *error);
uint32_t palette_index(const struct palette *palette, uint32_t rgb); /* of a colour that occurred */
void palette_free(struct palette *palette);

/* ---- image_sheet.c ---- */

/*
 * Puts the frames side by side in so many columns (0: about square), reduced by
 * a whole number so that the sheet is at most SHEET_WIDTH wide.
 */
enum { SHEET_WIDTH = 2560, SHEET_GAP = 4 };
bool image_sheet(struct image *sheet, const struct image *frames, uint32_t count, uint32_t columns,
                 struct image_error *error);

/* ---- image_diff.c ---- */

/* How many pixels differ. Pictures of different size differ in all pixels of the larger. */
uint64_t image_count_differences(const struct image *actual, const struct image *expected);

/* The expected picture, dark and grey, with each pixel that differs in red. */
bool image_difference(struct image *picture, const struct image *actual,
                      const struct image *expected, struct image_error *error);

#endif
