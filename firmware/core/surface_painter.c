/* SPDX-License-Identifier: 0BSD */
/* Surface: the painter's, farthest first, each face over what was there [FKN80]. */
#include "ow_memory.h"
#include "ow_surface.h"

static void begin(struct ow_surface *surface, uint32_t background)
{
    const struct ow_target *target = surface->target;
    bool lines_are_equal =
        surface->backdrop == NULL && surface->dither == NULL && !target->format->keeps;
    for (uint32_t i = 0; i < target->line_count; i++) {
        if (i > 0 && lines_are_equal) {
            memcpy(target->pixels + i * target->stride, target->pixels,
                   ow_row_bytes(target->format, surface->width));
        } else {
            ow_write_background(surface, target->first_line + i, 0, surface->width, background);
        }
    }
    surface->pixels_background += surface->width * target->line_count;
    surface->lines_open = target->line_count; /* for ever: what is painted can be painted over */
}

static void end(struct ow_surface *surface, uint32_t background)
{
    (void)surface;
    (void)background;
}

const struct ow_surface_kind ow_surface_painter = {
    .direction = OW_FARTHEST_FIRST,
    .begin = begin,
    .take = ow_write_spans,
    .end = end,
};
