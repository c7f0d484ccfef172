/* SPDX-License-Identifier: 0BSD */
/*
 * Surface: the dynamic screen, nearest first, each pixel written once [GC91].
 * Where the paper keeps a list of unlit segments for each scan line, this keeps
 * a bit for each pixel: its memory is bounded, and a span is tested a word at a
 * time. A count for each line makes a full line cost one test, and a count of
 * open lines ends the walk when the band is full.
 */
#include "ow_bits.h"
#include "ow_memory.h"
#include "ow_surface.h"

static void begin(struct ow_surface *surface, uint32_t background)
{
    (void)background;
    uint32_t lines = surface->target->line_count;
    uint32_t words = surface->words_in_line;
    memset(surface->unlit, 0xFF, (size_t)lines * words * sizeof *surface->unlit);
    for (uint32_t i = 0; i < lines; i++) {
        surface->open_pixels[i] = (uint16_t)surface->width;
        surface->unlit[(i + 1) * words - 1] = ow_bits_to((surface->width - 1) & 31);
    }
    surface->lines_open = lines;
    memset(surface->open_tiles, 0xFF,
           (size_t)ow_tile_words(surface->width) * ow_tiles(lines) * sizeof *surface->open_tiles);
}

/* True if none of a column of words has any of the mask's bits. */
static bool column_is_lit(const struct ow_surface *surface, uint32_t column, uint32_t row,
                          uint32_t end_row, uint32_t mask)
{
    const uint32_t *word = surface->unlit + row * surface->words_in_line + column;
    for (; row < end_row; row++) {
        if (*word & mask) {
            return false;
        }
        word += surface->words_in_line;
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
    uint32_t lines = surface->target->line_count;
    if (!column_is_lit(surface, column, row, end_row < lines ? end_row : lines, 0xFFFFFFFFu)) {
        return false;
    }
    *open &= ~bit;
    return true;
}

static bool hides(const struct ow_surface *surface, const struct ow_box *box)
{
    uint32_t row = (uint32_t)box->line - surface->target->first_line;
    uint32_t end_row = (uint32_t)box->end_line - surface->target->first_line;
    uint32_t column = (uint32_t)box->left / OW_TILE;
    uint32_t last_column = ((uint32_t)box->right - 1) / OW_TILE;
    if (column == last_column && end_row - row <= OW_TILE) { /* small: exactly */
        uint32_t mask =
            ow_bits_from((uint32_t)box->left & 31) & ow_bits_to(((uint32_t)box->right - 1) & 31);
        return column_is_lit(surface, column, row, end_row, mask);
    }
    uint32_t last_tile_row = (end_row - 1) >> OW_TILE_BITS;
    for (uint32_t tile_row = row >> OW_TILE_BITS; tile_row <= last_tile_row; tile_row++) {
        for (uint32_t c = column; c <= last_column; c++) {
            if (!tile_is_lit(surface, c, tile_row)) {
                return false;
            }
        }
    }
    return true;
}

/* Writes the unlit runs among pixels first .. end-1 of a line (first < end); they are lit then. */
static void write_unlit(struct ow_surface *surface, uint32_t line, uint32_t *words, uint32_t first,
                        uint32_t end)
{
    uint32_t x = ow_next_bit(words, first, end, 0);
    if (x == end) {
        return;
    }
    while (x < end) {
        uint32_t stop = ow_next_bit(words, x, end, 0xFFFFFFFFu);
        ow_write_run(surface, line, x, stop);
        x = stop < end ? ow_next_bit(words, stop, end, 0) : end;
    }
    ow_clear_bits(words, first, end);
}

static void take(struct ow_surface *surface, const struct ow_span *spans, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const struct ow_span *span = &spans[i];
        uint32_t row = span->line - (uint32_t)surface->target->first_line;
        uint32_t open = surface->open_pixels[row];
        if (open == 0) {
            continue;
        }
        uint32_t before = surface->pixels_written;
        write_unlit(surface, span->line, surface->unlit + row * surface->words_in_line, span->first,
                    span->end);
        open -= surface->pixels_written - before;
        surface->open_pixels[row] = (uint16_t)open;
        if (open == 0) {
            surface->lines_open--;
        }
    }
}

/* The background goes where nothing was written: no clear before, each pixel once. */
static void end(struct ow_surface *surface, uint32_t background)
{
    uint32_t pixels = surface->pixels_written;
    uint32_t spans = surface->spans_written;
    ow_surface_become_background(surface, background);
    for (uint32_t row = 0; row < surface->target->line_count; row++) {
        if (surface->open_pixels[row] > 0) {
            write_unlit(surface, surface->target->first_line + row,
                        surface->unlit + row * surface->words_in_line, 0, surface->width);
        }
    }
    surface->pixels_background += surface->pixels_written - pixels;
    surface->pixels_written = pixels;
    surface->spans_written = spans;
}

const struct ow_surface_kind ow_surface_dynamic = {
    .direction = OW_NEAREST_FIRST,
    .writes_once = true,
    .begin = begin,
    .take = take,
    .end = end,
    .hides = hides,
};
