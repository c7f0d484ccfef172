/* SPDX-License-Identifier: 0BSD */
/*
 * Surfaces: who receives the spans, in walk order. Each is one file; draw.c
 * chooses. All write the same picture.
 */
#ifndef OW_SURFACE_H
#define OW_SURFACE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "ow_draw.h"
#include "ow_gradient.h"
#include "ow_scan.h"
#include "ow_shade.h"

/* Coverage: what a pixel has of its 16 samples so far. */
struct ow_samples {
    uint16_t mask;   /* a bit for each sample, row by row */
    uint16_t sum[3]; /* red, green, blue of those in the mask */
};

struct ow_surface {
    const struct ow_target *target;
    const struct ow_backdrop *backdrop; /* NULL: one colour */
    const struct ow_differences *difference;
    struct ow_changes *changes; /* to be marked at writing; NULL: nobody asks, or all were marked */
    uint32_t width;
    uint32_t rgb;    /* of the face being scanned; the material's if it is smooth */
    uint32_t colour; /* the same packed, if it is not smooth */
    const struct ow_shader *shader;
    struct ow_gradient *gradient; /* of the face being scanned; NULL: it has one colour */
    /* Writes pixels first .. end-1 of a line; NULL: a fill with the colour does. */
    void (*write)(struct ow_surface *surface, uint32_t line, uint32_t first, uint32_t end);
    /* What writes beneath the comparison with what was there; likewise. */
    void (*write_inner)(struct ow_surface *surface, uint32_t line, uint32_t first, uint32_t end);
    const struct ow_dithering *dither; /* NULL: colours are rounded */
    uint32_t background;               /* 0x00RRGGBB */
    uint32_t pixels_written;
    uint32_t spans_written;
    uint32_t pixels_background;
    /* Front to back: a bit for each pixel that nothing has been written to. */
    uint32_t *unlit;
    struct ow_samples *samples; /* coverage: of each pixel */
    uint32_t *sampled;          /* coverage: a bit for each pixel that has a sample */
    uint32_t words_in_line;
    uint32_t lines_open;     /* lines with unlit pixels; 0: nothing more can be seen */
    uint16_t *open_pixels;   /* unlit pixels of each line */
    uint32_t *open_tiles;    /* a bit for each tile that may have any */
    uint32_t lines_outgrown; /* segments: lines whose list became bits */
};

/*
 * Front to back remembers which tiles are lit whole, so that a face whose box
 * is covered costs a few tests. A tile is as wide as a word of the unlit bits.
 */
enum { OW_TILE = 32, OW_TILE_BITS = 5 };

static inline uint32_t ow_tiles(uint32_t pixels)
{
    return (pixels + OW_TILE - 1) / OW_TILE;
}

/* 32-bit words for the open bits of a row of tiles. */
static inline uint32_t ow_tile_words(uint32_t width)
{
    return (ow_tiles(width) + 31) / 32;
}

struct ow_surface_kind {
    enum ow_direction direction;
    bool writes_once; /* each pixel: what is written differs from what was shown, or does not */
    void (*begin)(struct ow_surface *surface, uint32_t background);
    /* Writes count spans of one face in the surface's colour. */
    void (*take)(struct ow_surface *surface, const struct ow_span *spans, uint32_t count);
    void (*end)(struct ow_surface *surface, uint32_t background);
    /* True if no pixel of the box can be seen any more; NULL: never known. */
    bool (*hides)(const struct ow_surface *surface, const struct ow_box *box);
};

extern const struct ow_surface_kind ow_surface_painter;
extern const struct ow_surface_kind ow_surface_dynamic;
extern const struct ow_surface_kind ow_surface_segments;

static inline uint8_t *ow_line_pixels(const struct ow_target *target, uint32_t line)
{
    return target->pixels + (line - target->first_line) * target->stride;
}

/* Decides how runs are written; format and gradient must be set. dither: NULL without. */
void ow_surface_choose_write(struct ow_surface *surface, const struct ow_look *look,
                             const struct ow_dithering *dither);

/* Who sees at writing time which pixels become different. */
struct ow_differences {
    /* Writes as ow_surface.write, and marks the pixels that were something else before. */
    void (*write)(struct ow_surface *surface, uint32_t line, uint32_t first, uint32_t end);
    /* Marks all pixels of the surface's band. */
    void (*mark_all)(struct ow_changes *changes, const struct ow_target *target, uint32_t width);
};
extern const struct ow_differences ow_differences;

/* From now on the surface writes the background; packed: its colour. */
void ow_surface_become_background(struct ow_surface *surface, uint32_t packed);

/* Writes the background into pixels first .. end-1 of a line. Counts nothing. */
void ow_write_background(struct ow_surface *surface, uint32_t line, uint32_t first, uint32_t end,
                         uint32_t packed);

/* Coverage: the colour of one pixel by the surface's gradient, which is set for such questions. */
uint32_t ow_smooth_pixel(struct ow_surface *surface, uint32_t line, uint32_t x);

/* Writes pixels first .. end-1 of a line in the colour or gradient of the face. */
static inline void ow_write_run(struct ow_surface *surface, uint32_t line, uint32_t first,
                                uint32_t end)
{
    if (surface->write != NULL) {
        surface->write(surface, line, first, end);
    } else {
        surface->target->format->fill(ow_line_pixels(surface->target, line), first, end,
                                      surface->colour);
    }
    surface->pixels_written += end - first;
    surface->spans_written++;
}

/* The same for count spans. */
static inline void ow_write_spans(struct ow_surface *surface, const struct ow_span *spans,
                                  uint32_t count)
{
    const struct ow_target *target = surface->target;
    if (surface->write == NULL && target->format->fill_spans != NULL) {
        surface->pixels_written += target->format->fill_spans(
            (uintptr_t)target->pixels - (uintptr_t)target->first_line * target->stride,
            target->stride, spans, count, surface->colour);
        surface->spans_written += count;
        return;
    }
    for (uint32_t i = 0; i < count; i++) {
        ow_write_run(surface, spans[i].line, spans[i].first, spans[i].end);
    }
}

#endif
