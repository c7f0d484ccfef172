/* SPDX-License-Identifier: 0BSD */
/* Surfaces: what they share, above all how a run of pixels is written. */
#include "ow_surface.h"

#include "ow_dither.h"

enum { CHUNK = 32 }; /* pixels shaded before they are stored */

uint32_t ow_smooth_pixel(struct ow_surface *surface, uint32_t line, uint32_t x)
{
    if (surface->gradient->line != (int32_t)line) {
        ow_gradient_line(surface->gradient, (int32_t)line);
    }
    struct ow_corner_light light;
    ow_gradient_beside(surface->gradient, x, &light);
    return ow_shade_pixel(surface->shader, surface->rgb, &light);
}

static void write_smooth(struct ow_surface *surface, uint32_t line, uint32_t first, uint32_t end)
{
    uint8_t *row = ow_line_pixels(surface->target, line);
    const struct ow_pixel_format *format = surface->target->format;
    uint32_t rgb[CHUNK];
    if (surface->gradient->line != (int32_t)line) {
        ow_gradient_line(surface->gradient, (int32_t)line);
    }
    while (first < end) {
        uint32_t stop = end - first > CHUNK ? first + CHUNK : end;
        surface->shader->shading->run(surface->shader, surface->rgb, surface->gradient->ramp, first,
                                      stop, rgb);
        if (surface->dither != NULL) {
            surface->dither->store(format, row, line, first, stop, rgb);
        } else {
            format->store(row, first, stop, rgb);
        }
        first = stop;
    }
}

static void write_dithered(struct ow_surface *surface, uint32_t line, uint32_t first, uint32_t end)
{
    surface->dither->fill(surface->target->format, ow_line_pixels(surface->target, line), line,
                          first, end, surface->rgb);
}

static void write_backdrop(struct ow_surface *surface, uint32_t line, uint32_t first, uint32_t end)
{
    const struct ow_backdrop *backdrop = surface->backdrop;
    backdrop->fill(backdrop->context, surface->target->format,
                   ow_line_pixels(surface->target, line), line, first, end);
}

static void set_write(struct ow_surface *surface,
                      void (*write)(struct ow_surface *surface, uint32_t line, uint32_t first,
                                    uint32_t end))
{
    surface->write_inner = write;
    surface->write = surface->changes != NULL ? surface->difference->write : write;
}

void ow_surface_choose_write(struct ow_surface *surface, const struct ow_look *look,
                             const struct ow_dithering *dither)
{
    bool dithers =
        look->dither && look->shade != OW_SHADE_ID && surface->target->format->dither != NULL;
    surface->dither = dithers ? dither : NULL;
    surface->background = look->background;
    surface->backdrop = look->backdrop;
    set_write(surface, surface->gradient != NULL ? write_smooth
                       : surface->dither != NULL ? write_dithered
                                                 : NULL);
}

void ow_surface_become_background(struct ow_surface *surface, uint32_t packed)
{
    surface->rgb = surface->background;
    surface->colour = packed;
    surface->gradient = NULL;
    set_write(surface, surface->backdrop != NULL ? write_backdrop
                       : surface->dither != NULL ? write_dithered
                                                 : NULL);
}

void ow_write_background(struct ow_surface *surface, uint32_t line, uint32_t first, uint32_t end,
                         uint32_t packed)
{
    uint8_t *row = ow_line_pixels(surface->target, line);
    if (surface->backdrop != NULL) {
        write_backdrop(surface, line, first, end);
    } else if (surface->dither != NULL) {
        surface->dither->fill(surface->target->format, row, line, first, end, surface->background);
    } else {
        surface->target->format->fill(row, first, end, packed);
    }
}
