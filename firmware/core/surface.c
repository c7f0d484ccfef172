/* SPDX-License-Identifier: 0BSD */
/* Surfaces: what they share. */
#include "ow_surface.h"

enum { CHUNK = 32 }; /* pixels shaded before they are stored */

void ow_write_smooth_run(struct ow_surface *surface, uint32_t line, uint32_t first, uint32_t end)
{
    struct ow_gradient *gradient = surface->gradient;
    uint8_t *row = ow_line_pixels(surface->target, line);
    uint32_t rgb[CHUNK];
    if (gradient->line != (int32_t)line) {
        ow_gradient_line(gradient, (int32_t)line);
    }
    while (first < end) {
        uint32_t stop = end - first > CHUNK ? first + CHUNK : end;
        for (uint32_t x = first; x < stop; x++) {
            struct ow_corner_light light;
            for (uint32_t i = 0; i < gradient->parts; i++) {
                light.part[i] = ow_ramp_value(&gradient->ramp[i], x);
            }
            rgb[x - first] = ow_shade_pixel(surface->shader, surface->colour, &light);
        }
        surface->target->format->store(row, first, stop, rgb);
        first = stop;
    }
}
