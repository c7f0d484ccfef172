/* SPDX-License-Identifier: 0BSD */
/*
 * Where edges cross lines, and outlines of few lines, whose borders are all
 * found before there is a span. Private to the files that scan;
 * OW_SCAN_SUB_BITS may be set before.
 *
 * A short edge crosses by its slope, a quotient with 16 fraction bits: it is
 * off by less than 1/500 pixel at the far end. Longer ones are exact (scan.c).
 * Which rule holds, and what it gives, depends on the two endpoints alone.
 */
#ifndef OW_SCAN_LOW_H
#define OW_SCAN_LOW_H

#include <stdbool.h>

#include "ow_scan.h"

#ifndef OW_SCAN_SUB_BITS
#define OW_SCAN_SUB_BITS OW_SUB_BITS
#endif

enum {
    SUB_BITS = OW_SCAN_SUB_BITS,
    SUB = 1 << SUB_BITS,
    HALF = SUB / 2,             /* a pixel's centre */
    LOW_LINES = 16,             /* an outline of more is not low */
    SHORT_REACH = 120 * OW_SUB, /* a short edge and a low outline reach less on both axes */
    PLACE_BITS = SUB_BITS + 16, /* fraction bits of a place, which counts pixels */
    PLACE_ONE = 1 << PLACE_BITS
};
_Static_assert((SHORT_REACH + SUB) * 65536LL + PLACE_ONE < INT32_MAX, "a place fits 32 bits");

/* The first line or pixel whose centre is at or beyond this coordinate. */
static inline int32_t first_centre(ow_sub8 coordinate)
{
    return (coordinate - HALF + SUB - 1) >> SUB_BITS;
}

static inline int32_t least(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static inline int32_t most(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

static inline bool is_short(int32_t dx, int32_t dy)
{
    return dx < SHORT_REACH && -dx < SHORT_REACH && dy < SHORT_REACH;
}

/* A short edge on a line: it crosses at pixel place, rounded up already. */
struct short_edge {
    uint32_t place; /* from the origin on, PLACE_BITS fraction bits; modulo 2^32 */
    uint32_t step;  /* added to place for each line; modulo 2^32 */
};

/* The edge from p down to q on a line that it crosses; pixels are counted from the origin. */
static inline struct short_edge short_edge(struct ow_outline_point p, struct ow_outline_point q,
                                           int32_t line, int32_t origin)
{
    int32_t slope_q16 = (q.x - p.x) * 65536 / (q.y - p.y);
    int32_t place = (p.x - HALF - origin * SUB) * 65536 + slope_q16 * (line * SUB + HALF - p.y);
    return (struct short_edge){ (uint32_t)place + (PLACE_ONE - 1), (uint32_t)slope_q16 * SUB };
}

/* The first pixel whose centre is right of the edge. */
static inline int32_t short_pixel(const struct short_edge *edge, int32_t origin)
{
    return origin + ((int32_t)edge->place >> PLACE_BITS);
}

/* Where an outline's borders cross the lines of its box: the first pixel right of each. */
struct low_borders {
    int32_t left[LOW_LINES];
    int32_t right[LOW_LINES];
};

/*
 * Finds the crossings of the edge from p to q with the box's lines: down is a
 * left border, up a right one. Returns how many lines it crosses downward.
 */
static inline uint32_t cross_low(struct low_borders *borders, struct ow_outline_point p,
                                 struct ow_outline_point q, const struct ow_box *box)
{
    int32_t top = first_centre(p.y);
    int32_t bottom = first_centre(q.y);
    if (top == bottom) {
        return 0;
    }
    bool down = top < bottom;
    if (!down) {
        struct ow_outline_point swap = p;
        p = q;
        q = swap;
        int32_t line = top;
        top = bottom;
        bottom = line;
    }
    top = most(top, box->line);
    bottom = least(bottom, box->end_line);
    if (top >= bottom) {
        return 0;
    }
    struct short_edge edge = short_edge(p, q, top, box->origin);
    int32_t *border = (down ? borders->left : borders->right) - box->line;
    for (int32_t line = top; line < bottom; line++) {
        border[line] = short_pixel(&edge, box->origin);
        edge.place += edge.step;
    }
    return down ? (uint32_t)(bottom - top) : 0;
}

/* Makes the spans between the borders, at most one a line. Returns the end of them. */
static inline struct ow_span *spans_between(const struct low_borders *borders, enum ow_winding rule,
                                            const struct ow_box *box, struct ow_span *span)
{
    uint32_t lines = (uint32_t)(box->end_line - box->line);
    for (uint32_t i = 0; i < lines; i++) {
        int32_t first = borders->left[i];
        int32_t end = borders->right[i];
        if (rule == OW_WINDING_ANY && first > end) {
            int32_t swap = first;
            first = end;
            end = swap;
        }
        first = most(first, box->left);
        end = least(end, box->right);
        if (first < end) {
            *span++ = (struct ow_span){ (uint16_t)((uint32_t)box->line + i), (uint16_t)first,
                                        (uint16_t)end };
        }
    }
    return span;
}

#endif
