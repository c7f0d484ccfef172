/* SPDX-License-Identifier: 0BSD */
/*
 * The fast way for small faces, which most models are made of: from the item
 * to the spans in one loop, without a call. What it does not know (large faces,
 * ones to be clipped or at the screen's border) goes the ordinary way, whose
 * pictures are the same; a program that has no room for it leaves it out.
 */
#include "ow_frame.h"
#include "ow_read.h"
#include "scan_low.h"
#include "walk_step.h"

enum { CORNERS = 8 }; /* of a face that goes the fast way, at most */

/* What the loop reads over and over. */
struct small_run {
    const ow_byte *bytes;
    const ow_byte *polygons;
    const struct ow_outline_point *points;
    uint32_t corners_in_record;
    uint32_t left_out; /* bits of an item that mean: not to be drawn */
    bool clips;        /* vertices may lack a place on the screen */
    struct ow_window window;
};

/* The ordinary way. */
static void draw_other(struct ow_frame *frame, uint32_t item)
{
    if (ow_walk_face(&frame->walk, item, &frame->face)) {
        frame->painted += ow_draw_face(frame);
    }
}

static inline uint32_t read_corner(const ow_byte *corners, uint32_t i, bool wide)
{
    return wide ? ow_read_u32(corners, 4 * i) : ow_read_u16(corners, 2 * i);
}

/* Twice the area; negative: a front, counter-clockwise on a screen whose y goes down. */
static OW_INLINE int64_t area(struct ow_outline_point a, struct ow_outline_point b,
                              struct ow_outline_point c)
{
    return (int64_t)(b.x - a.x) * (c.y - a.y) - (int64_t)(c.x - a.x) * (b.y - a.y);
}

struct bounds {
    ow_sub8 min_x;
    ow_sub8 max_x;
    ow_sub8 min_y;
    ow_sub8 max_y;
};

enum size { NOTHING, SMALL, OTHER };

/* The pixels of the window in these bounds; SMALL: all of them are, and few lines. */
static OW_INLINE enum size box_of(const struct bounds *bounds, const struct ow_window *window,
                                  struct ow_box *box)
{
    box->left = first_centre(bounds->min_x);
    box->right = first_centre(bounds->max_x);
    if (box->left >= box->right) {
        return NOTHING;
    }
    box->line = first_centre(bounds->min_y);
    box->end_line = first_centre(bounds->max_y);
    if (box->line >= box->end_line) {
        return NOTHING;
    }
    box->origin = bounds->min_x >> SUB_BITS;
    bool inside = box->left >= 0 && box->right <= window->width &&
                  box->line >= window->first_line && box->end_line <= window->end_line;
    bool small =
        box->end_line - box->line <= LOW_LINES && bounds->max_x - bounds->min_x < SHORT_REACH;
    return inside && small ? SMALL : OTHER;
}
_Static_assert((LOW_LINES + 1) * SUB < SHORT_REACH, "an outline of few lines is short");

/* The face's spans are in the sink; p: its outline, from the front. */
static void paint(struct ow_frame *frame, const struct ow_outline_point *p, uint32_t corners,
                  uint32_t item, uint32_t count)
{
    struct ow_surface *surface = &frame->surface;
    uint32_t before = surface->spans_written;
    frame->face.at = frame->tree->polygons_at + (item >> OW_ITEM_TAG_BITS << 1);
    frame->face.reverse = (item & OW_ITEM_REVERSE) != 0;
    if (surface->gradient == NULL) {
        surface->rgb = ow_shade_face(&frame->shader, frame->tree, &frame->face);
        surface->colour = surface->target->format->pack(surface->rgb);
        frame->kind->take(surface, frame->sink.spans, count);
    } else {
        struct ow_outline_point *outline = frame->workspace->outline;
        for (uint32_t i = 0; i < corners; i++) {
            outline[i] = p[i];
        }
        frame->points = corners;
        frame->clipped = false;
        frame->shaded = false;
        frame->sink.count = count;
        ow_paint_spans(&frame->sink);
    }
    frame->painted += surface->spans_written != before;
}

/* The lines between a left and a right border that both stand on line. */
static OW_INLINE struct ow_span *add_spans(struct ow_span *span, struct short_edge *left,
                                           struct short_edge *right, int32_t origin, int32_t line,
                                           int32_t end_line)
{
    for (; line < end_line; line++) {
        int32_t first = short_pixel(left, origin);
        int32_t end = short_pixel(right, origin);
        left->place += left->step;
        right->place += right->step;
        if (first < end) {
            *span++ = (struct ow_span){ (uint16_t)line, (uint16_t)first, (uint16_t)end };
        }
    }
    return span;
}

/* A front a, b, c; a is its top. The way from a to b is a left border, from a to c a right one. */
static OW_INLINE struct ow_span *scan_triangle(struct ow_outline_point a, struct ow_outline_point b,
                                               struct ow_outline_point c, const struct ow_box *box,
                                               struct ow_span *span)
{
    int32_t line = box->line;
    int32_t origin = box->origin;
    struct short_edge left = { 0, 0 };
    struct short_edge right = { 0, 0 };
    if (b.y < c.y) {
        int32_t bend = first_centre(b.y);
        right = short_edge(a, c, line, origin);
        if (line < bend) {
            left = short_edge(a, b, line, origin);
            span = add_spans(span, &left, &right, origin, line, bend);
        }
        if (bend < box->end_line) {
            left = short_edge(b, c, bend, origin);
            span = add_spans(span, &left, &right, origin, bend, box->end_line);
        }
    } else {
        int32_t bend = first_centre(c.y);
        left = short_edge(a, b, line, origin);
        if (line < bend) {
            right = short_edge(a, c, line, origin);
            span = add_spans(span, &left, &right, origin, line, bend);
        }
        if (bend < box->end_line) {
            right = short_edge(c, b, bend, origin);
            span = add_spans(span, &left, &right, origin, bend, box->end_line);
        }
    }
    return span;
}

/* False if the face has to go the ordinary way. */
static OW_INLINE bool draw_triangle(struct ow_frame *frame, const struct small_run *run,
                                    uint32_t item, const ow_byte *corners, bool wide)
{
    const bool reverse = (item & OW_ITEM_REVERSE) != 0;
    const struct ow_outline_point p[3] = {
        run->points[read_corner(corners, reverse ? 2 : 0, wide)],
        run->points[read_corner(corners, 1, wide)],
        run->points[read_corner(corners, reverse ? 0 : 2, wide)]
    };
    if (run->clips &&
        (p[0].x == OW_CLIP_FIRST || p[1].x == OW_CLIP_FIRST || p[2].x == OW_CLIP_FIRST)) {
        return false;
    }
    if (area(p[0], p[1], p[2]) >= 0) {
        return true;
    }
    const struct bounds bounds = { least(p[0].x, least(p[1].x, p[2].x)),
                                   most(p[0].x, most(p[1].x, p[2].x)),
                                   least(p[0].y, least(p[1].y, p[2].y)),
                                   most(p[0].y, most(p[1].y, p[2].y)) };
    struct ow_box box;
    enum size size = box_of(&bounds, &run->window, &box);
    if (size == NOTHING) {
        return true;
    }
    if (size == OTHER) {
        return false;
    }
    if (frame->kind->hides != NULL && frame->kind->hides(&frame->surface, &box)) {
        return true;
    }
    uint32_t top = p[0].y == bounds.min_y ? 0 : p[1].y == bounds.min_y ? 1 : 2;
    struct ow_span *end = scan_triangle(p[top], p[top < 2 ? top + 1 : 0], p[top > 0 ? top - 1 : 2],
                                        &box, frame->sink.spans);
    if (end != frame->sink.spans) {
        paint(frame, p, 3, item, (uint32_t)(end - frame->sink.spans));
    }
    return true;
}

/* True if a front can be seen of an outline that is a fan of such triangles. */
static inline bool shows_front(const struct ow_outline_point *p, uint32_t count)
{
    for (uint32_t i = 2; i < count; i++) {
        if (area(p[0], p[i - 1], p[i]) < 0) {
            return true;
        }
    }
    return false;
}

static inline struct bounds bounds_of(const struct ow_outline_point *p, uint32_t count)
{
    struct bounds b = { p[0].x, p[0].x, p[0].y, p[0].y };
    for (uint32_t i = 1; i < count; i++) {
        b.min_x = least(b.min_x, p[i].x);
        b.max_x = most(b.max_x, p[i].x);
        b.min_y = least(b.min_y, p[i].y);
        b.max_y = most(b.max_y, p[i].y);
    }
    return b;
}

/* Likewise, for 4 .. CORNERS corners. */
static inline bool draw_polygon(struct ow_frame *frame, const struct small_run *run, uint32_t item,
                                const ow_byte *corners, uint32_t count, bool wide)
{
    struct ow_outline_point p[CORNERS];
    bool reverse = (item & OW_ITEM_REVERSE) != 0;
    for (uint32_t i = 0; i < count; i++) {
        struct ow_outline_point point = run->points[read_corner(corners, i, wide)];
        if (run->clips && point.x == OW_CLIP_FIRST) {
            return false;
        }
        p[reverse ? count - 1 - i : i] = point;
    }
    if (!shows_front(p, count)) {
        return true;
    }
    const struct bounds bounds = bounds_of(p, count);
    struct ow_box box;
    enum size size = box_of(&bounds, &run->window, &box);
    if (size == NOTHING) {
        return true;
    }
    if (size == OTHER) {
        return false;
    }
    if (frame->kind->hides != NULL && frame->kind->hides(&frame->surface, &box)) {
        return true;
    }
    struct low_borders borders;
    uint32_t crossed = cross_low(&borders, p[count - 1], p[0], &box);
    for (uint32_t i = 1; i < count; i++) {
        crossed += cross_low(&borders, p[i - 1], p[i], &box);
    }
    if (crossed != (uint32_t)(box.end_line - box.line)) {
        return false;
    }
    struct ow_span *end = spans_between(&borders, OW_WINDING_POSITIVE, &box, frame->sink.spans);
    if (end != frame->sink.spans) {
        paint(frame, p, count, item, (uint32_t)(end - frame->sink.spans));
    }
    return true;
}

static OW_INLINE void draw_faces(struct ow_frame *frame, const struct small_run *run, bool wide)
{
    struct ow_walk *walk = &frame->walk;
    struct ow_walk_run items = walk->run;
    uint32_t met = 0;
    while (frame->surface.lines_open > 0 && to_face(walk, &items)) {
        uint32_t item = ow_read_u32(run->bytes, items.at);
        items.at += walk->step;
        items.left--;
        met++;
        if (item & run->left_out) {
            continue;
        }
        const ow_byte *record = run->polygons + (item >> OW_ITEM_TAG_BITS << 1);
        const ow_byte *corners = record + run->corners_in_record;
        uint32_t count = ow_read_u8(record, 0);
        bool done = count == 3         ? draw_triangle(frame, run, item, corners, wide)
                    : count <= CORNERS ? draw_polygon(frame, run, item, corners, count, wide)
                                       : false;
        if (!done) {
            draw_other(frame, item);
        }
    }
    walk->run = items;
    walk->faces_met += met;
}

void ow_draw_small(struct ow_frame *frame)
{
    const struct ow_tree *tree = frame->tree;
    const struct small_run run = {
        .bytes = tree->bytes,
        .polygons = tree->bytes + tree->polygons_at,
        .points = frame->workspace->points,
        .corners_in_record = tree->corners_in_record,
        .left_out = frame->walk.fronts_only ? OW_ITEM_REVERSE : 0,
        .clips = frame->clips,
        .window = frame->window,
    };
    if (tree->flags & OW_TREE_INDEX32) {
        draw_faces(frame, &run, true);
    } else {
        draw_faces(frame, &run, false);
    }
}
