/* SPDX-License-Identifier: 0BSD */
/*
 * Stage "scan": a projected outline becomes spans of pixels.
 *
 * The pixel rule: a pixel belongs to a face if the winding number of the
 * outline at the pixel's centre is positive (with OW_WINDING_ANY: not zero).
 * An edge crosses the scan lines whose centres lie in [top, bottom) of it, at
 * an x that depends on its two endpoints alone; a centre there counts as right
 * of it. So two faces that share an edge share no pixel and leave none out.
 * The x of an edge that reaches less than 120 pixels on both axes goes by its
 * slope with 16 fraction bits, rounded towards 0, and is less than 1/500 pixel
 * off; that of a longer edge is exact.
 */
#ifndef OW_SCAN_H
#define OW_SCAN_H

#include <stdbool.h>
#include <stdint.h>

#include "ow_project.h"

/* An edge on its way down the scan lines. Private to scan.c. */
struct ow_scan_edge {
    int32_t x;       /* first pixel whose centre is right of the edge on the current line */
    uint32_t rest;   /* how far beyond, in 1/whole pixels */
    uint32_t whole;  /* OW_SUB * height of the edge, ow_sub8 */
    int32_t step;    /* pixels a line */
    uint32_t part;   /* and 1/whole pixels a line */
    int32_t line;    /* the current line */
    int32_t end;     /* the first line below the edge */
    int32_t winding; /* 1 if the outline goes down here (a left border), -1 if up */
};

enum ow_winding { OW_WINDING_POSITIVE, OW_WINDING_ANY };

/* The part of the screen that is drawn. */
struct ow_window {
    int32_t first_line;
    int32_t end_line;
    int32_t width;
};

/* Whole pixels: first to before the end on each axis. */
struct ow_box {
    int32_t left;
    int32_t right;
    int32_t line;
    int32_t end_line;
    int32_t origin; /* the pixel column of the outline's leftmost point */
    bool is_small;  /* the outline reaches less than 120 pixels on each axis */
};

/* Receives spans: line by line, from left to right, at most capacity at a time. */
struct ow_span_sink {
    struct ow_span *spans;
    uint32_t count;
    uint32_t capacity;                       /* at least the box's lines */
    void (*take)(struct ow_span_sink *sink); /* must set count to 0 */
};

/* The pixels of the window whose centres are within the outline's bounds. False if there are none. */
bool ow_outline_box(const struct ow_outline_point *points, uint32_t count,
                    const struct ow_window *window, struct ow_box *box);

/*
 * Scans the outline points[0 .. count-1] (count >= 3, coordinates within
 * OW_GUARD of the screen's centre) inside its box. The sink must be empty; all
 * its spans have been taken at the end. edges: count entries of scratch memory.
 */
void ow_scan(const struct ow_outline_point *points, uint32_t count, enum ow_winding rule,
             const struct ow_box *box, struct ow_scan_edge *edges, struct ow_span_sink *sink);

#endif
