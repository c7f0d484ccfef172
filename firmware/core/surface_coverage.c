/* SPDX-License-Identifier: 0BSD */
/*
 * Surface: coverage, nearest first. A pixel gathers the colours of its samples
 * until it has all 16, and is stored then, or at the end with the background's
 * share. Where a face has all samples of pixels that have none yet, it is
 * written at once, as on the dynamic screen, whose unlit bits stand here for
 * pixels that miss a sample.
 */
#include "ow_bits.h"
#include "ow_coverage.h"
#include "ow_dither.h"
#include "ow_memory.h"

/* A line of pixels that a face is put into. */
struct row {
    struct ow_surface *surface;
    uint32_t line;
    uint32_t *unlit;
    uint32_t *sampled;
    struct ow_samples *samples;
    uint32_t open; /* unlit pixels */
};

static struct row row_of(struct ow_surface *surface, uint32_t line)
{
    uint32_t number = line - surface->target->first_line;
    return (struct row){
        .surface = surface,
        .line = line,
        .unlit = surface->unlit + number * surface->words_in_line,
        .sampled = surface->sampled + number * surface->words_in_line,
        .samples = surface->samples + number * surface->width,
        .open = surface->open_pixels[number],
    };
}

static void begin(struct ow_surface *surface, uint32_t background)
{
    ow_surface_dynamic.begin(surface, background);
    memset(surface->sampled, 0,
           (size_t)surface->target->line_count * surface->words_in_line * sizeof *surface->sampled);
}

static uint32_t count_bits(uint32_t mask)
{
    mask = mask - (mask >> 1 & 0x5555);
    mask = (mask & 0x3333) + (mask >> 2 & 0x3333);
    mask = (mask + (mask >> 4)) & 0x0F0F;
    return (mask + (mask >> 8)) & 31;
}

static void add_colour(struct ow_samples *samples, uint32_t mask, uint32_t rgb)
{
    uint32_t count = count_bits(mask);
    samples->mask = (uint16_t)(samples->mask | mask);
    samples->sum[0] = (uint16_t)(samples->sum[0] + (rgb >> 16 & 255) * count);
    samples->sum[1] = (uint16_t)(samples->sum[1] + (rgb >> 8 & 255) * count);
    samples->sum[2] = (uint16_t)(samples->sum[2] + (rgb & 255) * count);
}

static uint32_t mean(uint32_t sum)
{
    return (sum + OW_SAMPLES / 2) / OW_SAMPLES;
}

static void store_pixel(const struct row *row, uint32_t x)
{
    const struct ow_surface *surface = row->surface;
    const struct ow_pixel_format *format = surface->target->format;
    uint8_t *pixels = ow_line_pixels(surface->target, row->line);
    const uint16_t *sum = row->samples[x].sum;
    uint32_t rgb = mean(sum[0]) << 16 | mean(sum[1]) << 8 | mean(sum[2]);
    if (surface->dither != NULL) {
        surface->dither->store(format, pixels, row->line, x, x + 1, &rgb);
    } else {
        format->store(pixels, x, x + 1, &rgb);
    }
}

/* Gives the face those of the mask's samples that no nearer face has. The pixel is unlit. */
static void cover_pixel(struct row *row, uint32_t x, uint32_t mask)
{
    struct ow_surface *surface = row->surface;
    struct ow_samples *samples = &row->samples[x];
    uint32_t bit = 1u << (x & 31);
    if (!(row->sampled[x / 32] & bit)) {
        row->sampled[x / 32] |= bit;
        *samples = (struct ow_samples){ 0, { 0, 0, 0 } };
        surface->pixels_written++;
    }
    mask &= ~(uint32_t)samples->mask;
    if (mask == 0) {
        return;
    }
    surface->spans_written++;
    add_colour(samples, mask,
               surface->gradient != NULL ? ow_smooth_pixel(surface, row->line, x) : surface->rgb);
    if (samples->mask == OW_ALL_SAMPLES) {
        store_pixel(row, x);
        row->unlit[x / 32] &= ~bit;
        row->open--;
    }
}

/* The samples that spans of the row's four lines have of a pixel. */
static uint32_t pixel_mask(const struct ow_span *spans, uint32_t count, uint32_t x)
{
    uint32_t mask = 0;
    uint32_t left = x * OW_SIDE;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t first = spans[i].first > left ? spans[i].first - left : 0;
        uint32_t end = spans[i].end > left ? spans[i].end - left : 0;
        end = end < OW_SIDE ? end : OW_SIDE;
        if (first < end) {
            mask |= ((1u << end) - (1u << first)) << (spans[i].line % OW_SIDE * OW_SIDE);
        }
    }
    return mask;
}

static void cover_edge(struct row *row, const struct ow_span *spans, uint32_t count, uint32_t first,
                       uint32_t end)
{
    while (first < end) {
        uint32_t x = ow_next_bit(row->unlit, first, end, 0);
        uint32_t mask = x < end ? pixel_mask(spans, count, x) : 0;
        if (mask != 0) {
            cover_pixel(row, x, mask);
        }
        first = x + 1;
    }
}

/* Pixels that no face has a sample of: as on the dynamic screen. */
static void write_run(struct row *row, uint32_t first, uint32_t end)
{
    ow_write_run(row->surface, row->line, first, end);
    ow_clear_bits(row->unlit, first, end);
    row->open -= end - first;
}

/* Pixels of which the face has all samples. */
static void cover_inside(struct row *row, uint32_t first, uint32_t end)
{
    uint32_t x = first < end ? ow_next_bit(row->unlit, first, end, 0) : end;
    while (x < end) {
        uint32_t stop = ow_next_bit(row->unlit, x, end, 0xFFFFFFFFu);
        while (x < stop) {
            uint32_t sampled = ow_next_bit(row->sampled, x, stop, 0);
            if (x < sampled) {
                write_run(row, x, sampled);
            } else {
                cover_pixel(row, x, OW_ALL_SAMPLES);
                sampled++;
            }
            x = sampled;
        }
        x = stop < end ? ow_next_bit(row->unlit, stop, end, 0) : end;
    }
}

/*
 * Spans of one row of pixels. Four that have samples in common lie on the row's
 * four lines, one on each, since those of one line have none.
 */
static void take_row(struct row *row, const struct ow_span *spans, uint32_t count)
{
    uint32_t low = spans[0].first; /* samples that any or all of the spans have */
    uint32_t high = spans[0].end;
    uint32_t inner_low = low;
    uint32_t inner_high = high;
    for (uint32_t i = 1; i < count; i++) {
        uint32_t first = spans[i].first;
        uint32_t end = spans[i].end;
        low = first < low ? first : low;
        high = end > high ? end : high;
        inner_low = first > inner_low ? first : inner_low;
        inner_high = end < inner_high ? end : inner_high;
    }
    uint32_t end = (high + OW_SIDE - 1) / OW_SIDE;
    uint32_t inner = (inner_low + OW_SIDE - 1) / OW_SIDE;
    uint32_t inner_end = inner_high / OW_SIDE;
    if (inner >= inner_end || count != OW_SIDE) {
        cover_edge(row, spans, count, low / OW_SIDE, end);
        return;
    }
    cover_edge(row, spans, count, low / OW_SIDE, inner);
    cover_inside(row, inner, inner_end);
    cover_edge(row, spans, count, inner_end, end);
}

static void take(struct ow_surface *surface, const struct ow_span *spans, uint32_t count)
{
    uint32_t next;
    for (uint32_t i = 0; i < count; i = next) {
        uint32_t line = spans[i].line / OW_SIDE;
        for (next = i + 1; next < count && spans[next].line / OW_SIDE == line; next++) {
        }
        struct row row = row_of(surface, line);
        if (row.open > 0) {
            take_row(&row, spans + i, next - i);
            surface->open_pixels[line - surface->target->first_line] = (uint16_t)row.open;
            surface->lines_open -= row.open == 0;
        }
    }
}

/* The samples that are left belong to the background. */
static void finish_pixel(const struct row *row, uint32_t x)
{
    struct ow_samples *samples = &row->samples[x];
    add_colour(samples, ~(uint32_t)samples->mask & OW_ALL_SAMPLES, row->surface->background);
    store_pixel(row, x);
}

static void end_row(const struct row *row, uint32_t background)
{
    struct ow_surface *surface = row->surface;
    uint32_t x = ow_next_bit(row->unlit, 0, surface->width, 0);
    while (x < surface->width) {
        uint32_t stop = ow_next_bit(row->unlit, x, surface->width, 0xFFFFFFFFu);
        while (x < stop) {
            uint32_t sampled = ow_next_bit(row->sampled, x, stop, 0);
            if (x < sampled) {
                ow_write_background(surface, row->line, x, sampled, background);
                surface->pixels_background += sampled - x;
            } else {
                finish_pixel(row, x);
                sampled++;
            }
            x = sampled;
        }
        x = stop < surface->width ? ow_next_bit(row->unlit, stop, surface->width, 0) : stop;
    }
}

static void end(struct ow_surface *surface, uint32_t background)
{
    for (uint32_t i = 0; i < surface->target->line_count; i++) {
        struct row row = row_of(surface, surface->target->first_line + i);
        if (row.open > 0) {
            end_row(&row, background);
        }
    }
}

static bool hides(const struct ow_surface *surface, const struct ow_box *box)
{
    return ow_surface_dynamic.hides(surface, box);
}

static const struct ow_surface_kind surface_coverage = {
    .direction = OW_NEAREST_FIRST,
    .begin = begin,
    .take = take,
    .end = end,
    .hides = hides,
};

static void draw_face(struct ow_frame *frame)
{
    struct ow_workspace *workspace = frame->workspace;
    const struct ow_window fine = { frame->window.first_line * OW_SIDE,
                                    frame->window.end_line * OW_SIDE,
                                    frame->window.width * OW_SIDE };
    struct ow_box box;
    if (!ow_face_project(frame) ||
        !ow_outline_box_4x4(workspace->outline, frame->points, &fine, &box)) {
        return;
    }
    const struct ow_box pixels = { .left = box.left / OW_SIDE,
                                   .right = (box.right + OW_SIDE - 1) / OW_SIDE,
                                   .line = box.line / OW_SIDE,
                                   .end_line = (box.end_line + OW_SIDE - 1) / OW_SIDE };
    if (!hides(&frame->surface, &pixels)) {
        ow_scan_4x4(workspace->outline, frame->points, frame->rule, &box, workspace->edges,
                    &frame->sink);
    }
}

const struct ow_face_kind ow_faces_covering = { &surface_coverage, draw_face, NULL, NULL };
