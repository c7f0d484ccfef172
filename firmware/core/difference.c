/* SPDX-License-Identifier: 0BSD */
/*
 * The difference against what the target showed, known at the moment of
 * writing where each pixel is written once.
 */
#include "ow_surface.h"

enum { CHUNK = 32 }; /* pixels compared at a time */

/* Writes, and marks the pixels that were something else before. */
static void write(struct ow_surface *surface, uint32_t line, uint32_t first, uint32_t end)
{
    uint8_t *row = ow_line_pixels(surface->target, line);
    const struct ow_pixel_format *format = surface->target->format;
    uint32_t before[CHUNK];
    while (first < end) {
        uint32_t stop = end - first > CHUNK ? first + CHUNK : end;
        for (uint32_t x = first; x < stop; x++) {
            before[x - first] = format->get(row, x);
        }
        if (surface->write_inner != NULL) {
            surface->write_inner(surface, line, first, stop);
        } else {
            format->fill(row, first, stop, surface->colour);
        }
        for (uint32_t x = first; x < stop; x++) {
            if (((format->get(row, x) ^ before[x - first]) & format->used) != 0) {
                ow_changes_mark(surface->changes, line, x, x + 1);
            }
        }
        first = stop;
    }
}

static void mark_all(struct ow_changes *changes, const struct ow_target *target, uint32_t width)
{
    for (uint32_t i = 0; i < target->line_count; i++) {
        ow_changes_mark(changes, target->first_line + i, 0, width);
    }
}

const struct ow_differences ow_differences = { write, mark_all };
