/* SPDX-License-Identifier: 0BSD */
/* Changes: bits set while a frame is written, rectangles read from them after it. */
#include "ow_changes.h"

#include "ow_bits.h"
#include "ow_memory.h"

static uint32_t words_for(uint32_t width)
{
    return (width + 31) / 32;
}

uint32_t ow_changes_bytes_needed(uint16_t width, uint16_t height)
{
    return words_for(width) * height * (uint32_t)sizeof(uint32_t);
}

void ow_changes_place(struct ow_changes *changes, uint16_t width, uint16_t height, void *memory)
{
    changes->bits = memory;
    changes->words_in_line = words_for(width);
    changes->width = width;
    changes->height = height;
    ow_changes_begin(changes, false);
}

void ow_changes_begin(struct ow_changes *changes, bool known)
{
    changes->known = known;
    memset(changes->bits, known ? 0 : 0xFF,
           ow_changes_bytes_needed(changes->width, changes->height));
}

void ow_changes_mark(struct ow_changes *changes, uint32_t line, uint32_t first, uint32_t end)
{
    uint32_t *words = changes->bits + line * changes->words_in_line;
    for (uint32_t x = first; x < end;) {
        uint32_t w = x / 32;
        uint32_t stop = (w + 1) * 32 < end ? (w + 1) * 32 : end;
        words[w] |= ow_bits_from(x & 31) & ow_bits_to((stop - 1) & 31);
        x = stop;
    }
}

/* The next run of a line from pixel x on, gaps of up to price pixels included. */
static bool next_run(const struct ow_changes *changes, uint32_t line, uint32_t x, uint32_t price,
                     uint32_t *first, uint32_t *end)
{
    const uint32_t *words = changes->bits + line * changes->words_in_line;
    uint32_t width = changes->width;
    if (x >= width) {
        return false;
    }
    *first = ow_next_bit(words, x, width, 0);
    if (*first == width) {
        return false;
    }
    *end = ow_next_bit(words, *first, width, 0xFFFFFFFFu);
    while (*end < width) {
        uint32_t next = ow_next_bit(words, *end, width, 0);
        if (next == width || next - *end > price) {
            break;
        }
        *end = ow_next_bit(words, next, width, 0xFFFFFFFFu);
    }
    return true;
}

/* A line that has one run: what may join the rectangle above it. */
static bool only_run(const struct ow_changes *changes, uint32_t line, uint32_t price,
                     uint32_t *first, uint32_t *end)
{
    uint32_t another[2];
    return next_run(changes, line, 0, price, first, end) &&
           !next_run(changes, line, *end, price, &another[0], &another[1]);
}

/* Takes the lines below into the rectangle as long as that is cheaper than another one. */
static void grow_down(const struct ow_changes *changes, uint32_t price, struct ow_change *change)
{
    uint32_t first;
    uint32_t end;
    while (change->bottom < changes->height &&
           only_run(changes, change->bottom, price, &first, &end)) {
        uint32_t left = first < change->left ? first : change->left;
        uint32_t right = end > change->right ? end : change->right;
        uint32_t lines = (uint32_t)(change->bottom - change->top);
        uint32_t apart = lines * (uint32_t)(change->right - change->left) + (end - first) + price;
        if ((lines + 1) * (right - left) > apart) {
            return;
        }
        change->left = (uint16_t)left;
        change->right = (uint16_t)right;
        change->bottom++;
    }
}

bool ow_changes_next(const struct ow_changes *changes, struct ow_changes_cursor *cursor,
                     uint32_t price, struct ow_change *change)
{
    uint32_t first;
    uint32_t end;
    for (; cursor->line < changes->height; cursor->line++, cursor->x = 0) {
        if (next_run(changes, cursor->line, cursor->x, price, &first, &end)) {
            break;
        }
    }
    if (cursor->line == changes->height) {
        return false;
    }
    change->left = (uint16_t)first;
    change->right = (uint16_t)end;
    change->top = (uint16_t)cursor->line;
    change->bottom = (uint16_t)(cursor->line + 1);
    uint32_t another[2];
    bool alone =
        cursor->x == 0 && !next_run(changes, cursor->line, end, price, &another[0], &another[1]);
    if (alone) {
        grow_down(changes, price, change);
        cursor->line = change->bottom;
        cursor->x = 0;
    } else {
        cursor->x = end;
    }
    return true;
}
