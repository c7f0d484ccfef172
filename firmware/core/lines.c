/* SPDX-License-Identifier: 0BSD */
/* Lines: edges step along their longer axis, all integers, exact. */
#include "ow_lines.h"

#include "ow_read.h"

enum { HALF = OW_SUB / 2, SKIP = 1024 };
_Static_assert(2LL * OW_GUARD * 2 * OW_SUB < INT32_MAX, "what begin_line divides fits 32 bits");
_Static_assert(2LL * OW_GUARD * SKIP <= UINT32_MAX, "what skip divides fits 32 bits");

bool ow_edge_is_marked(const struct ow_tree *tree, const struct ow_face *face, uint32_t i)
{
    const ow_byte *bytes = tree->bytes;
    if (!(ow_read_u16(bytes, face->at + 4) & OW_POLYGON_MARKED)) {
        return false;
    }
    uint32_t corners = ow_read_u8(bytes, face->at);
    uint32_t edge = !face->reverse ? i : i + 1 < corners ? corners - 2 - i : corners - 1;
    uint32_t corner_bytes = (tree->flags & OW_TREE_INDEX32) ? 4 : 2;
    uint32_t marks_at = face->at + tree->corners_in_record + corners * corner_bytes;
    return ow_read_u16(bytes, marks_at + edge / 16 * 2) >> edge % 16 & 1;
}

/* It is marked, or the face is part of a cap, which shows only where it was cut. */
static bool leaves_out(const struct ow_frame *frame, uint32_t i)
{
    return (frame->shader.caps && frame->face.reverse) ||
           ow_edge_is_marked(frame->tree, &frame->face, i);
}

/* An edge on its way along its longer axis, from one pixel's centre to the next. */
struct line {
    int32_t along; /* the pixel on the longer axis */
    int32_t end;
    int32_t across; /* the pixel on the other axis, */
    uint32_t rest;  /* and how far into it the edge is, in 1/whole pixels */
    uint32_t whole; /* OW_SUB * length on the longer axis */
    int32_t step;   /* pixels on the other axis for one on the longer: -1, 0 or 1, */
    uint32_t part;  /* and 1/whole pixels */
};

/* The first pixel whose centre is at or beyond this coordinate. */
static int32_t first_centre(ow_sub8 coordinate)
{
    return (coordinate - HALF + OW_SUB - 1) >> OW_SUB_BITS;
}

/* floor(n / d), and what is left. */
static int32_t divide(int32_t n, uint32_t d, uint32_t *rest)
{
    int32_t quotient = n >= 0 ? (int32_t)((uint32_t)n / d) : -(int32_t)(((uint32_t)-n + d - 1) / d);
    *rest = (uint32_t)n - (uint32_t)quotient * d;
    return quotient;
}

/* Goes up to SKIP pixels ahead at once. */
static void skip(struct line *line, uint32_t pixels)
{
    uint32_t length = line->whole / OW_SUB;
    uint32_t parts = pixels * (line->part / OW_SUB);
    uint32_t carried = parts / length;
    line->along += (int32_t)pixels;
    line->across += (int32_t)pixels * line->step + (int32_t)carried;
    line->rest += OW_SUB * (parts - carried * length);
    if (line->rest >= line->whole) {
        line->rest -= line->whole;
        line->across++;
    }
}

static void next_pixel(struct line *line)
{
    line->along++;
    line->across += line->step;
    line->rest += line->part;
    if (line->rest >= line->whole) {
        line->rest -= line->whole;
        line->across++;
    }
}

/*
 * Sets up the edge from a to b, given as (longer axis, other axis), for the
 * pixels first .. end-1 of the longer axis. False if it passes no centre there.
 */
static bool begin_line(struct line *line, const ow_sub8 a[2], const ow_sub8 b[2], int32_t first,
                       int32_t end)
{
    const ow_sub8 *low = a[0] <= b[0] ? a : b;
    const ow_sub8 *high = a[0] <= b[0] ? b : a;
    line->along = first_centre(low[0]);
    line->end = first_centre(high[0]) < end ? first_centre(high[0]) : end;
    if (line->along >= line->end || line->end <= first) {
        return false;
    }
    uint32_t length = (uint32_t)(high[0] - low[0]);
    int32_t rise = high[1] - low[1];
    int32_t before = line->along * OW_SUB + HALF - low[0]; /* less than a pixel */
    line->whole = length * OW_SUB;
    int32_t inside = (low[1] & (OW_SUB - 1)) * (int32_t)length + before * rise;
    line->across = (low[1] >> OW_SUB_BITS) + divide(inside, line->whole, &line->rest);
    line->step = divide(rise, length, &line->part);
    line->part *= OW_SUB;
    while (line->along < first) {
        uint32_t left = (uint32_t)(first - line->along);
        skip(line, left < SKIP ? left : SKIP);
    }
    return true;
}

/* Hands on pixels first .. end-1 of a scan line, as far as they are in the window. */
static void add_run(struct ow_frame *frame, int32_t line, int32_t first, int32_t end)
{
    const struct ow_window *window = &frame->window;
    first = first < 0 ? 0 : first;
    end = end > window->width ? window->width : end;
    if (line < window->first_line || line >= window->end_line || first >= end) {
        return;
    }
    struct ow_span_sink *sink = &frame->sink;
    sink->spans[sink->count++] = (struct ow_span){ (uint16_t)line, (uint16_t)first, (uint16_t)end };
    if (sink->count == sink->capacity) {
        sink->take(sink);
    }
}

static void add_flat_line(struct ow_frame *frame, struct ow_outline_point a,
                          struct ow_outline_point b)
{
    struct line line;
    if (!begin_line(&line, (ow_sub8[2]){ a.x, a.y }, (ow_sub8[2]){ b.x, b.y }, 0,
                    frame->window.width)) {
        return;
    }
    while (line.along < line.end) {
        int32_t first = line.along;
        int32_t row = line.across;
        do {
            next_pixel(&line);
        } while (line.along < line.end && line.across == row);
        add_run(frame, row, first, line.along);
    }
}

static void add_steep_line(struct ow_frame *frame, struct ow_outline_point a,
                           struct ow_outline_point b)
{
    struct line line;
    if (!begin_line(&line, (ow_sub8[2]){ a.y, a.x }, (ow_sub8[2]){ b.y, b.x },
                    frame->window.first_line, frame->window.end_line)) {
        return;
    }
    for (; line.along < line.end; next_pixel(&line)) {
        add_run(frame, line.along, line.across, line.across + 1);
    }
}

static void add_point(struct ow_frame *frame, struct ow_outline_point p)
{
    int32_t x = p.x >> OW_SUB_BITS;
    add_run(frame, p.y >> OW_SUB_BITS, x, x + 1);
}

static void add_line(struct ow_frame *frame, struct ow_outline_point a, struct ow_outline_point b)
{
    int32_t dx = a.x < b.x ? b.x - a.x : a.x - b.x;
    int32_t dy = a.y < b.y ? b.y - a.y : a.y - b.y;
    if (dx >= dy) {
        add_flat_line(frame, a, b);
    } else {
        add_steep_line(frame, a, b);
    }
    add_point(frame, a);
    add_point(frame, b);
}

/* All pixels that touch the outline's bounds, in the window. False if there are none. */
static bool reach(const struct ow_frame *frame, struct ow_box *box)
{
    const struct ow_outline_point *p = frame->workspace->outline;
    const struct ow_window *window = &frame->window;
    struct ow_outline_point low = p[0];
    struct ow_outline_point high = p[0];
    for (uint32_t i = 1; i < frame->points; i++) {
        low.x = p[i].x < low.x ? p[i].x : low.x;
        low.y = p[i].y < low.y ? p[i].y : low.y;
        high.x = p[i].x > high.x ? p[i].x : high.x;
        high.y = p[i].y > high.y ? p[i].y : high.y;
    }
    box->left = low.x < 0 ? 0 : low.x >> OW_SUB_BITS;
    box->right = (high.x >> OW_SUB_BITS) + 1;
    box->line = low.y >> OW_SUB_BITS;
    box->end_line = (high.y >> OW_SUB_BITS) + 1;
    box->right = box->right > window->width ? window->width : box->right;
    box->line = box->line < window->first_line ? window->first_line : box->line;
    box->end_line = box->end_line > window->end_line ? window->end_line : box->end_line;
    return box->left < box->right && box->line < box->end_line;
}

/* True if the outline as a whole goes the way of a front. */
static bool is_front(const struct ow_frame *frame)
{
    const struct ow_outline_point *p = frame->workspace->outline;
    int64_t twice_area = 0; /* negative: counter-clockwise on a screen whose y goes down */
    for (uint32_t i = 2; i < frame->points; i++) {
        twice_area += (int64_t)(p[i - 1].x - p[0].x) * (p[i].y - p[0].y) -
                      (int64_t)(p[i].x - p[0].x) * (p[i - 1].y - p[0].y);
    }
    return twice_area < 0 || (twice_area > 0 && frame->rule == OW_WINDING_ANY);
}

static bool lines_box(const struct ow_frame *frame, struct ow_box *box)
{
    return is_front(frame) && reach(frame, box);
}

static void use_colour(struct ow_frame *frame, uint32_t rgb)
{
    frame->surface.rgb = rgb;
    frame->surface.colour = frame->surface.target->format->pack(rgb);
    frame->shaded = true;
}

static void draw_lines(struct ow_frame *frame)
{
    const struct ow_workspace *workspace = frame->workspace;
    const struct ow_outline_point *p = workspace->outline;
    use_colour(frame, ow_shade_face(&frame->shader, frame->tree, &frame->face));
    for (uint32_t i = 0; i < frame->points; i++) {
        bool marked =
            frame->clipped ? workspace->corner_lights[i].part[0] != 0 : leaves_out(frame, i);
        if (!marked) {
            add_line(frame, p[i], p[i + 1 < frame->points ? i + 1 : 0]);
        }
    }
    if (frame->sink.count > 0) {
        frame->sink.take(&frame->sink);
    }
}

static void draw_inside(struct ow_frame *frame)
{
    struct ow_workspace *workspace = frame->workspace;
    struct ow_box box;
    if (ow_outline_box(workspace->outline, frame->points, &frame->window, &box)) {
        use_colour(frame, frame->shader.background);
        ow_scan(workspace->outline, frame->points, frame->rule, &box, workspace->edges,
                &frame->sink);
    }
}

static void draw_face(struct ow_frame *frame)
{
    struct ow_box box;
    if (!ow_face_outline(frame, &box) ||
        (frame->kind->hides != NULL && frame->kind->hides(&frame->surface, &box))) {
        return;
    }
    if (frame->kind->direction == OW_NEAREST_FIRST) {
        draw_lines(frame);
        draw_inside(frame);
    } else {
        draw_inside(frame);
        draw_lines(frame);
    }
}

const struct ow_face_kind ow_faces_in_lines = { NULL, draw_face, lines_box, leaves_out };
