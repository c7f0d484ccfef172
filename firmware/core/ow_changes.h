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

/* Filled by ow_changes_place; a bit for each pixel. */
struct ow_changes {
    uint32_t *bits;
    uint32_t words_in_line;
    uint16_t width;
    uint16_t height;
    bool known; /* the buffer's content is what it was drawn to last; false: all has changed */
};

/* Bytes of memory (aligned to 4) for a frame of this size, 1 .. OW_SCREEN_MAX each. */
uint32_t ow_changes_bytes_needed(uint16_t width, uint16_t height);
void ow_changes_place(struct ow_changes *changes, uint16_t width, uint16_t height, void *memory);

/* Begins a frame. known: the buffer still holds, byte for byte, a frame drawn to it. */
void ow_changes_begin(struct ow_changes *changes, bool known);

/* Marks pixels first .. end-1 of a line. */
void ow_changes_mark(struct ow_changes *changes, uint32_t line, uint32_t first, uint32_t end);

/* A rectangle of pixels: from left, top to before right, bottom. */
struct ow_change {
    uint16_t left;
    uint16_t top;
    uint16_t right;
    uint16_t bottom;
};

/* Where the next rectangle is looked for; all 0 to begin with. */
struct ow_changes_cursor {
    uint32_t line;
    uint32_t x;
};

/*
 * The next rectangle that holds changed pixels, from the top; all of them
 * together hold every one. Runs are joined, along a line and down the lines, as
 * long as sending the unchanged pixels between them costs no more than another
 * rectangle would: price is that, in pixels. False: there are no more.
 */
bool ow_changes_next(const struct ow_changes *changes, struct ow_changes_cursor *cursor,
                     uint32_t price, struct ow_change *change);

#endif
