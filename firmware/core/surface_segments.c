/* SPDX-License-Identifier: 0BSD */
/*
 * Surface: the dynamic screen as in the paper, nearest first, with a list of
 * unlit segments for each scan line [GC91]. The pool is as large as
 * surface_dynamic.c's bits and cut into equal parts, a line each: a list is an
 * array in its line's part, from left to right. A list that outgrows it becomes
 * a bit for each pixel in the same place, which always has room: counted, and
 * the same picture.
 */
#include "ow_bits.h"
#include "ow_memory.h"
#include "ow_surface.h"

/* A segment of pixels: the first in the low half, the one behind the last in the high. */
enum { END_SHIFT = 16, FIRST_MASK = 0xFFFF };
#define LIST_END 0xFFFFFFFFu /* behind the last segment: it begins behind every span */

/* In open_pixels, beside the count of unlit pixels: the line's part holds bits. */
enum { HOLDS_BITS = 0x8000 };
_Static_assert((int)OW_SCREEN_MAX < (int)HOLDS_BITS, "a count of pixels leaves the mark alone");

enum { SEGMENTS_MOST = 64 }; /* of a list: it is copied to the stack when it becomes bits */

enum { RUNS_MOST = 24 }; /* on their way to the target, to be written in one call */

/* One scan line after the other. */
struct line {
    uint32_t *list; /* its part of the pool */
    uint32_t number;
    uint32_t open; /* unlit pixels, and the mark */
    uint32_t run_count;
    struct ow_span runs[RUNS_MOST];
};

static inline uint32_t segment(uint32_t first, uint32_t end)
{
    return first | end << END_SHIFT;
}

/* Segments that a line's part may hold, beside the end mark. */
static inline uint32_t room(const struct ow_surface *surface)
{
    return surface->words_in_line <= SEGMENTS_MOST ? surface->words_in_line - 1 : SEGMENTS_MOST;
}

static void begin(struct ow_surface *surface, uint32_t background)
{
    (void)background;
    uint32_t lines = surface->target->line_count;
    uint32_t words = surface->words_in_line;
    for (uint32_t i = 0; i < lines; i++) {
        uint32_t *part = surface->unlit + i * words;
        surface->open_pixels[i] = (uint16_t)surface->width;
        if (words == 1) { /* so narrow that bits are all there is room for */
            surface->open_pixels[i] = (uint16_t)(surface->width | HOLDS_BITS);
            part[0] = ow_bits_to(surface->width - 1);
        } else {
            part[0] = segment(0, surface->width);
            part[1] = LIST_END;
        }
    }
    surface->lines_open = lines;
    memset(surface->open_tiles, 0xFF,
           (size_t)ow_tile_words(surface->width) * ow_tiles(lines) * sizeof *surface->open_tiles);
}

/* True if none of pixels first .. end-1 of a row is unlit. */
static bool run_is_lit(const struct ow_surface *surface, uint32_t row, uint32_t first, uint32_t end)
{
    const uint32_t *part = surface->unlit + row * surface->words_in_line;
    if (surface->open_pixels[row] & HOLDS_BITS) {
        return ow_next_bit(part, first, end, 0) == end;
    }
    while (*part >> END_SHIFT <= first) {
        part++;
    }
    return (*part & FIRST_MASK) >= end;
}

static bool rows_are_lit(const struct ow_surface *surface, uint32_t row, uint32_t end_row,
                         uint32_t first, uint32_t end)
{
    for (; row < end_row; row++) {
        if (surface->open_pixels[row] != 0 && !run_is_lit(surface, row, first, end)) {
            return false;
        }
    }
    return true;
}

/* True if a tile has no unlit pixel; remembered, since no pixel becomes unlit again. */
static bool tile_is_lit(const struct ow_surface *surface, uint32_t column, uint32_t tile_row)
{
    uint32_t *open = surface->open_tiles + tile_row * ow_tile_words(surface->width) + column / 32;
    uint32_t bit = 1u << (column & 31);
    if (!(*open & bit)) {
        return true;
    }
    uint32_t row = tile_row << OW_TILE_BITS;
    uint32_t end_row = row + OW_TILE;
    uint32_t first = column * OW_TILE;
    uint32_t end = first + OW_TILE;
    uint32_t lines = surface->target->line_count;
    if (!rows_are_lit(surface, row, end_row < lines ? end_row : lines, first,
                      end < surface->width ? end : surface->width)) {
        return false;
    }
    *open &= ~bit;
    return true;
}

static bool hides(const struct ow_surface *surface, const struct ow_box *box)
{
    uint32_t row = (uint32_t)box->line - surface->target->first_line;
    uint32_t end_row = (uint32_t)box->end_line - surface->target->first_line;
    uint32_t left = (uint32_t)box->left;
    uint32_t right = (uint32_t)box->right;
    if (right - left <= OW_TILE && end_row - row <= OW_TILE) { /* small: exactly */
        return rows_are_lit(surface, row, end_row, left, right);
    }
    uint32_t last_tile_row = (end_row - 1) >> OW_TILE_BITS;
    uint32_t last_column = (right - 1) / OW_TILE;
    for (uint32_t tile_row = row >> OW_TILE_BITS; tile_row <= last_tile_row; tile_row++) {
        for (uint32_t column = left / OW_TILE; column <= last_column; column++) {
            if (!tile_is_lit(surface, column, tile_row)) {
                return false;
            }
        }
    }
    return true;
}

static inline void paint(struct ow_surface *surface, struct line *line, uint32_t first,
                         uint32_t end)
{
    if (line->run_count == RUNS_MOST) {
        ow_write_spans(surface, line->runs, RUNS_MOST);
        line->run_count = 0;
    }
    line->runs[line->run_count++] =
        (struct ow_span){ (uint16_t)line->number, (uint16_t)first, (uint16_t)end };
    line->open -= end - first;
}

/* Makes place for one more segment before at. False if there is none. */
static bool move_up(const struct ow_surface *surface, const uint32_t *list, uint32_t *at)
{
    uint32_t *end = at;
    while (*end != LIST_END) {
        end++;
    }
    if (end - list == (ptrdiff_t)room(surface)) {
        return false;
    }
    for (; end >= at; end--) {
        end[1] = end[0];
    }
    return true;
}

/* A list that has outgrown its line's part becomes bits in the same place. */
static void become_bits(struct ow_surface *surface, struct line *line)
{
    uint32_t copy[SEGMENTS_MOST];
    uint32_t count = room(surface);
    memcpy(copy, line->list, count * sizeof *copy);
    memset(line->list, 0, surface->words_in_line * sizeof *line->list);
    for (uint32_t i = 0; i < count; i++) {
        ow_set_bits(line->list, copy[i] & FIRST_MASK, copy[i] >> END_SHIFT);
    }
    line->open |= HOLDS_BITS;
    surface->lines_outgrown++;
}

/* Writes the unlit ones of pixels first .. end-1 on a line of bits; they are lit then. */
static void merge_bits(struct ow_surface *surface, struct line *line, uint32_t first, uint32_t end)
{
    uint32_t x = ow_next_bit(line->list, first, end, 0);
    while (x < end) {
        uint32_t stop = ow_next_bit(line->list, x, end, 0xFFFFFFFFu);
        paint(surface, line, x, stop);
        x = stop < end ? ow_next_bit(line->list, stop, end, 0) : end;
    }
    ow_clear_bits(line->list, first, end);
}

/*
 * Merges pixels first .. end-1 with a line's list of unlit segments: the eight
 * cases of [GC91], by its numbers.
 */
static inline void merge(struct ow_surface *surface, struct line *line, uint32_t first,
                         uint32_t end)
{
    uint32_t *at = line->list;
    while (*at >> END_SHIFT <= first) { /* 8: the segment lies before the span */
        at++;
    }
    uint32_t low = *at & FIRST_MASK;
    uint32_t high = *at >> END_SHIFT;
    if (first > low) {
        if (end < high) { /* 3: the span lies within the segment, which is split */
            if (!move_up(surface, line->list, at)) {
                become_bits(surface, line);
                merge_bits(surface, line, first, end);
                return;
            }
            at[0] = segment(low, first);
            at[1] = segment(end, high);
            paint(surface, line, first, end);
            return;
        }
        *at++ = segment(low, first); /* 5, 7: the segment loses its right part */
        paint(surface, line, first, high);
    }
    uint32_t *gap = at;
    while ((low = *at & FIRST_MASK) < end) { /* else 1: the span lies before the segment */
        high = *at >> END_SHIFT;
        if (end < high) { /* 2: the segment loses its left part */
            *at = segment(end, high);
            paint(surface, line, low, end);
            break;
        }
        at++; /* 4, 6: nothing is left of the segment */
        paint(surface, line, low, high);
    }
    if (gap < at) {
        do {
            *gap++ = *at;
        } while (*at++ != LIST_END);
    }
}

static inline void take_span(struct ow_surface *surface, struct line *line,
                             const struct ow_span *span)
{
    uint32_t row = span->line - (uint32_t)surface->target->first_line;
    line->open = surface->open_pixels[row];
    if (line->open == 0) {
        return;
    }
    line->list = surface->unlit + row * surface->words_in_line;
    line->number = span->line;
    if (line->open & HOLDS_BITS) {
        merge_bits(surface, line, span->first, span->end);
    } else {
        merge(surface, line, span->first, span->end);
    }
    if ((line->open & ~(uint32_t)HOLDS_BITS) == 0) {
        line->open = 0;
        surface->lines_open--;
    }
    surface->open_pixels[row] = (uint16_t)line->open;
}

static void take(struct ow_surface *surface, const struct ow_span *spans, uint32_t count)
{
    struct line line;
    line.run_count = 0;
    for (; count > 0; count--, spans++) {
        take_span(surface, &line, spans);
    }
    ow_write_spans(surface, line.runs, line.run_count);
}

/* The background goes where nothing was written: no clear before, each pixel once. */
static void end(struct ow_surface *surface, uint32_t background)
{
    uint32_t pixels = surface->pixels_written;
    uint32_t spans = surface->spans_written;
    struct line line;
    line.run_count = 0;
    ow_surface_become_background(surface, background);
    for (uint32_t row = 0; row < surface->target->line_count; row++) {
        const struct ow_span whole = { (uint16_t)(surface->target->first_line + row), 0,
                                       (uint16_t)surface->width };
        take_span(surface, &line, &whole);
    }
    ow_write_spans(surface, line.runs, line.run_count);
    surface->pixels_background += surface->pixels_written - pixels;
    surface->pixels_written = pixels;
    surface->spans_written = spans;
}

const struct ow_surface_kind ow_surface_segments = {
    .direction = OW_NEAREST_FIRST,
    .writes_once = true,
    .begin = begin,
    .take = take,
    .end = end,
    .hides = hides,
};
