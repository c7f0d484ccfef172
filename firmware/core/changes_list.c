/* SPDX-License-Identifier: 0BSD */
/*
 * Changes: from marks to rectangles. Line by line, the cheapest way is found to
 * cover the line's runs, each group of neighbours either by a new rectangle or by
 * making one that ends at the line above longer (and wider, where it must be).
 */
#include "ow_changes.h"

#include "ow_bits.h"
#include "ow_memory.h"

static const uint32_t NO_COST = 0xFFFFFFFFu;

/* ---- a line's runs ---- */

/* Marks of `lines` lines from `line` on, put together in its first. Their words. */
static uint32_t *gather(const struct ow_changes *changes, uint32_t line, uint32_t lines)
{
    uint32_t *words = changes->bits + line * changes->words_in_line;
    for (uint32_t i = 1; i < lines; i++) {
        const uint32_t *more = words + i * changes->words_in_line;
        for (uint32_t w = 0; w < changes->words_in_line; w++) {
            words[w] |= more[w];
        }
    }
    return words;
}

static uint32_t round_up(uint32_t x, uint32_t step, uint32_t end)
{
    uint32_t rounded = (x + step - 1) / step * step;
    return rounded < end ? rounded : end;
}

/* Fills the steps with a line's runs, outwards to the alignment; returns how many. */
static uint32_t find_runs(const struct ow_changes *changes, const uint32_t *words, uint32_t align)
{
    struct ow_changes_step *steps = changes->steps;
    uint32_t width = changes->width;
    uint32_t count = 0;
    for (uint32_t x = ow_next_bit(words, 0, width, 0); x < width;) {
        uint32_t first = x / align * align;
        uint32_t end = round_up(ow_next_bit(words, x, width, 0xFFFFFFFFu), align, width);
        if (count > 0 && (first <= steps[count - 1].end || count == changes->runs_max)) {
            steps[count - 1].end = (uint16_t)end;
        } else {
            steps[count].first = (uint16_t)first;
            steps[count++].end = (uint16_t)end;
        }
        if (end >= width) {
            break;
        }
        x = ow_next_bit(words, end, width, 0);
    }
    return count;
}

/* ---- the cheapest way ---- */

static uint32_t area(const struct ow_change *rect)
{
    return (uint32_t)(rect->right - rect->left) * (uint32_t)(rect->bottom - rect->top);
}

/* A rectangle as it would be if it held pixels first .. end-1 of the line below too. */
static struct ow_change grown(const struct ow_change *rect, uint32_t first, uint32_t end,
                              uint32_t bottom)
{
    struct ow_change larger = *rect;
    larger.left = (uint16_t)(first < rect->left ? first : rect->left);
    larger.right = (uint16_t)(end > rect->right ? end : rect->right);
    larger.bottom = (uint16_t)bottom;
    return larger;
}

/* Where a line is in the work. */
struct line_work {
    struct ow_changes *changes;
    const struct ow_change_costs *costs;
    uint32_t top;
    uint32_t bottom;
};

/* Takes a way to cover runs from .. to, if it is cheaper than what is known. */
static void offer(const struct ow_changes *changes, uint32_t from, uint32_t to, uint32_t cost,
                  uint32_t grows)
{
    struct ow_changes_step *after = &changes->steps[to + 1];
    if (cost < after->cost || (cost == after->cost && grows != 0)) {
        after->cost = cost;
        after->from = (uint8_t)from;
        after->grows = (uint8_t)grows;
        after->used = grows != 0 ? (uint8_t)grows : changes->steps[from].used;
    }
}

/* All ways to cover runs from .. to by one rectangle. */
static void offer_group(const struct line_work *work, uint32_t from, uint32_t to)
{
    const struct ow_changes *changes = work->changes;
    const struct ow_changes_step *steps = changes->steps;
    uint32_t first = steps[from].first;
    uint32_t end = steps[to].end;
    uint32_t pixel = work->costs->pixel_bits;
    uint32_t alone = (end - first) * (work->bottom - work->top) * pixel + work->costs->rect_bits;
    offer(changes, from, to, steps[from].cost + alone, 0);
    for (uint32_t i = steps[from].used; i < changes->opened; i++) {
        const struct ow_change *rect = &changes->list[changes->open[i]];
        if (rect->left >= end) {
            break;
        }
        if (rect->right > first) {
            struct ow_change larger = grown(rect, first, end, work->bottom);
            uint32_t more = (area(&larger) - area(rect)) * pixel;
            offer(changes, from, to, steps[from].cost + more, i + 1);
        }
    }
}

/* Finds the cheapest way for all runs: after it, a walk back from the last step tells it. */
static void find_way(const struct line_work *work, uint32_t runs)
{
    const struct ow_changes *changes = work->changes;
    struct ow_changes_step *steps = changes->steps;
    uint32_t lines = work->bottom - work->top;
    uint32_t joins = work->costs->rect_bits / (work->costs->pixel_bits * lines); /* pixels */
    steps[0].cost = 0;
    steps[0].used = 0;
    for (uint32_t i = 1; i <= runs; i++) {
        steps[i].cost = NO_COST;
    }
    for (uint32_t from = 0; from < runs; from++) {
        for (uint32_t to = from; to < runs; to++) {
            if (to > from && (uint32_t)(steps[to].first - steps[to - 1].end) > joins) {
                break;
            }
            offer_group(work, from, to);
        }
    }
}

/* ---- the list ---- */

/* Turns the way round: each step's `from` becomes the step that follows. */
static void turn_way(struct ow_changes_step *steps, uint32_t runs)
{
    uint32_t next = runs;
    uint32_t grows = 0;
    for (uint32_t at = runs; at > 0;) {
        uint32_t from = steps[at].from;
        uint32_t own = steps[at].grows;
        steps[at].from = (uint8_t)next;
        steps[at].grows = (uint8_t)grows;
        next = at;
        grows = own;
        at = from;
    }
    steps[0].from = (uint8_t)next;
    steps[0].grows = (uint8_t)grows;
}

static uint32_t new_rects(const struct ow_changes *changes, uint32_t runs)
{
    uint32_t count = 0;
    for (uint32_t at = 0; at < runs; at = changes->steps[at].from) {
        count += changes->steps[at].grows == 0;
    }
    return count;
}

/* Goes the way: rectangles grow and begin; those that do not grow are closed. */
static void take_way(const struct line_work *work, uint32_t runs)
{
    struct ow_changes *changes = work->changes;
    uint16_t *still_open = changes->open + changes->runs_max;
    uint32_t count = 0;
    for (uint32_t at = 0; at < runs;) {
        const struct ow_changes_step *step = &changes->steps[at];
        uint32_t first = step->first;
        uint32_t end = changes->steps[step->from - 1].end;
        if (step->grows != 0) {
            uint16_t number = changes->open[step->grows - 1];
            changes->list[number] = grown(&changes->list[number], first, end, work->bottom);
            still_open[count++] = number;
        } else {
            changes->list[changes->listed] =
                (struct ow_change){ (uint16_t)first, (uint16_t)work->top, (uint16_t)end,
                                    (uint16_t)work->bottom };
            still_open[count++] = (uint16_t)changes->listed++;
        }
        at = step->from;
    }
    memcpy(changes->open, still_open, count * sizeof *still_open);
    changes->opened = count;
}

/* No room for more: one rectangle for all that has changed from a line on. */
static void list_rest(const struct line_work *work)
{
    struct ow_changes *changes = work->changes;
    const struct ow_change_costs *costs = work->costs;
    struct ow_change rest = { changes->width, (uint16_t)work->top, 0, (uint16_t)work->top };
    for (uint32_t top = work->top; top < changes->height; top += costs->align_y) {
        uint32_t bottom = round_up(top + 1, costs->align_y, changes->height);
        const uint32_t *words = gather(changes, top, bottom - top);
        uint32_t runs = find_runs(changes, words, costs->align_x);
        if (runs > 0) {
            rest = grown(&rest, changes->steps[0].first, changes->steps[runs - 1].end, bottom);
        }
    }
    changes->list[changes->listed++] = rest;
}

uint32_t ow_changes_list(struct ow_changes *changes, const struct ow_change_costs *costs)
{
    struct line_work work = { .changes = changes, .costs = costs };
    changes->listed = 0;
    changes->opened = 0;
    for (; work.top < changes->height; work.top = work.bottom) {
        work.bottom = round_up(work.top + 1, costs->align_y, changes->height);
        const uint32_t *words = gather(changes, work.top, work.bottom - work.top);
        uint32_t runs = find_runs(changes, words, costs->align_x);
        if (runs == 0) {
            changes->opened = 0;
            continue;
        }
        find_way(&work, runs);
        turn_way(changes->steps, runs);
        if (changes->listed + new_rects(changes, runs) >= changes->listed_max) {
            list_rest(&work);
            break;
        }
        take_way(&work, runs);
    }
    return changes->listed;
}
