/* SPDX-License-Identifier: 0BSD */
/*
 * Changes: which pixels of a frame differ from what the buffer held before.
 * Front to back and scan line order write each pixel once, so they know at the
 * moment of writing; a panel on a bus is then sent only what changed.
 */
#ifndef OW_CHANGES_H
#define OW_CHANGES_H

#include <stdbool.h>
#include <stdint.h>

/* A rectangle of pixels: from left, top to before right, bottom. */
struct ow_change {
    uint16_t left;
    uint16_t top;
    uint16_t right;
    uint16_t bottom;
};

/*
 * Capacities. A line has as many runs of its own as its width over 4, within
 * these bounds: further ones are joined to the last. The list has room for three
 * rectangles for each two lines of the frame: when it is full, its last one
 * holds whatever has changed below.
 */
enum { OW_CHANGES_RUNS_MIN = 8, OW_CHANGES_RUNS_MAX = 64 };

/*
 * A run of a line, and the cheapest way to have covered the line's runs before
 * it: from run `from` on by one rectangle. Private.
 */
struct ow_changes_step {
    uint32_t cost;  /* bits */
    uint16_t first; /* the run's pixels */
    uint16_t end;
    uint8_t from;
    uint8_t grows; /* the place of the open rectangle that grows, and 1; 0: a new one */
    uint8_t used;  /* open rectangles that are used or passed */
};

/* Filled by ow_changes_place; a bit for each pixel. */
struct ow_changes {
    uint32_t *bits;
    uint32_t words_in_line;
    uint16_t width;
    uint16_t height;
    bool known; /* the buffer's content is what it was drawn to last; false: all has changed */
    struct ow_change *list; /* the rest is for ow_changes_list */
    uint32_t listed;
    uint32_t listed_max;
    struct ow_changes_step *steps;
    uint16_t *open; /* numbers of the rectangles that end at the line above */
    uint32_t opened;
    uint32_t runs_max;
};

/* Bytes of memory (aligned to 4) for a frame of this size, 1 .. OW_SCREEN_MAX each. */
uint32_t ow_changes_bytes_needed(uint16_t width, uint16_t height);
void ow_changes_place(struct ow_changes *changes, uint16_t width, uint16_t height, void *memory);

/* Begins a frame. known: the buffer still holds, byte for byte, a frame drawn to it. */
void ow_changes_begin(struct ow_changes *changes, bool known);

/* Marks pixels first .. end-1 of a line. */
void ow_changes_mark(struct ow_changes *changes, uint32_t line, uint32_t first, uint32_t end);

/* What rectangles cost where they are sent to. */
struct ow_change_costs {
    uint32_t rect_bits;  /* of one, beside its pixels */
    uint32_t pixel_bits; /* of a pixel, >= 1 */
    uint16_t align_x;    /* rectangles begin and end at multiples of these, in pixels, or at */
    uint16_t align_y;    /* the frame's edge; >= 1 */
};

/*
 * Rectangles that hold every changed pixel, from the top and from the left;
 * returns how many, they are in changes->list. Runs are joined along a line and
 * down the lines, each line's as the whole line costs least; rectangles may
 * overlap where that costs less. The marks are spent; a frame that begins makes
 * new ones.
 */
uint32_t ow_changes_list(struct ow_changes *changes, const struct ow_change_costs *costs);

#endif
