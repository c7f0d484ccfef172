/* SPDX-License-Identifier: 0BSD */
/* Changes: bits set while a frame is written. changes_list.c makes rectangles of them. */
#include "ow_changes.h"

#include "ow_bits.h"
#include "ow_memory.h"

static uint32_t words_for(uint32_t width)
{
    return (width + 31) / 32;
}

static uint32_t runs_for(uint32_t width)
{
    uint32_t runs = width / 4;
    return runs < OW_CHANGES_RUNS_MIN   ? OW_CHANGES_RUNS_MIN
           : runs > OW_CHANGES_RUNS_MAX ? OW_CHANGES_RUNS_MAX
                                        : runs;
}

static uint32_t listed_for(uint32_t height)
{
    return (3 * height + 1) / 2;
}

static uint32_t bits_bytes(const struct ow_changes *changes)
{
    return changes->words_in_line * changes->height * (uint32_t)sizeof(uint32_t);
}

uint32_t ow_changes_bytes_needed(uint16_t width, uint16_t height)
{
    uint32_t runs = runs_for(width);
    return words_for(width) * height * (uint32_t)sizeof(uint32_t) +
           listed_for(height) * (uint32_t)sizeof(struct ow_change) +
           (runs + 1) * (uint32_t)sizeof(struct ow_changes_step) +
           (2 * runs + 1) / 2 * 2 * (uint32_t)sizeof(uint16_t);
}

void ow_changes_place(struct ow_changes *changes, uint16_t width, uint16_t height, void *memory)
{
    changes->bits = memory;
    changes->words_in_line = words_for(width);
    changes->width = width;
    changes->height = height;
    changes->runs_max = runs_for(width);
    changes->listed_max = listed_for(height);
    changes->listed = 0;
    changes->opened = 0;
    uint8_t *at = (uint8_t *)memory + bits_bytes(changes);
    changes->steps = (struct ow_changes_step *)(void *)at;
    at += (changes->runs_max + 1) * sizeof(struct ow_changes_step);
    changes->list = (struct ow_change *)(void *)at;
    at += changes->listed_max * sizeof(struct ow_change);
    changes->open = (uint16_t *)(void *)at;
    ow_changes_begin(changes, false);
}

void ow_changes_begin(struct ow_changes *changes, bool known)
{
    changes->known = known;
    memset(changes->bits, known ? 0 : 0xFF, bits_bytes(changes));
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
