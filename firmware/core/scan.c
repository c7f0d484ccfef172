/* SPDX-License-Identifier: 0BSD */
/*
 * Stage "scan": edges step down the scan lines by whole and fractional pixels,
 * all integers, exact. Outlines that go down once and up once (all triangles,
 * all convex outlines) take the path of two chains; the others sort the
 * crossings of each line and add up their windings.
 */
#include "ow_scan.h"

#include <stdbool.h>

/* scan_4x4.c compiles this file a second time, for pixels a quarter as large. */
#ifndef OW_SCAN_SUB_BITS
#define OW_SCAN_SUB_BITS OW_SUB_BITS
#endif
enum {
    SUB_BITS = OW_SCAN_SUB_BITS,
    SUB = 1 << SUB_BITS,
    HALF = SUB / 2 /* a pixel's centre */
};

/* The largest height and width of an edge: coordinates stay within OW_GUARD of the middle. */
#define EDGE_MAX (2LL * OW_GUARD)
_Static_assert(EDGE_MAX *(3 * SUB) < INT32_MAX, "what begin_edge divides fits 32 bits");

/* The first line or pixel whose centre is at or beyond this coordinate. */
static inline int32_t first_centre(ow_sub8 coordinate)
{
    return (coordinate - HALF + SUB - 1) >> SUB_BITS;
}

static inline ow_sub8 least(ow_sub8 a, ow_sub8 b)
{
    return a < b ? a : b;
}

static inline ow_sub8 most(ow_sub8 a, ow_sub8 b)
{
    return a > b ? a : b;
}

/* floor(n / d), and what is left. */
static inline int32_t divide(int32_t n, uint32_t d, uint32_t *rest)
{
    int32_t quotient;
    if (n >= 0) {
        quotient = (int32_t)((uint32_t)n / d);
    } else {
        quotient = -(int32_t)(((uint32_t)-n + d - 1) / d);
    }
    *rest = (uint32_t)n - (uint32_t)quotient * d;
    return quotient;
}

enum { SKIP_LINES = 1024 };
_Static_assert(EDGE_MAX *SKIP_LINES <= UINT32_MAX, "what skip_lines divides fits 32 bits");

/* Goes up to SKIP_LINES lines further down at once; part and step must be known. */
static void skip_lines(struct ow_scan_edge *edge, uint32_t lines, uint32_t height)
{
    uint32_t parts = lines * (edge->part / SUB);
    uint32_t carried = parts / height;
    edge->x += (int32_t)lines * edge->step + (int32_t)carried;
    edge->rest += SUB * (parts - carried * height);
    if (edge->rest >= edge->whole) {
        edge->rest -= edge->whole;
        edge->x++;
    }
}

/*
 * Sets up the edge between two points for the given line or the first one it
 * crosses, if that is lower. False if it crosses no line from there to the end.
 */
static inline bool begin_edge(struct ow_scan_edge *edge, struct ow_outline_point a,
                              struct ow_outline_point b, int32_t line, int32_t end_line)
{
    edge->winding = 1;
    if (a.y > b.y) {
        struct ow_outline_point swap = a;
        a = b;
        b = swap;
        edge->winding = -1;
    }
    int32_t first = first_centre(a.y);
    edge->line = first > line ? first : line;
    edge->end = first_centre(b.y);
    if (edge->end > end_line) {
        edge->end = end_line;
    }
    if (edge->line >= edge->end) {
        return false;
    }
    uint32_t height = (uint32_t)(b.y - a.y);
    int32_t across = b.x - a.x;
    int32_t down = first * SUB + HALF - a.y; /* less than a line */
    int32_t x = a.x - HALF;
    edge->whole = height * SUB;
    /* Pixels right of x's own, rounded up: three terms below SUB * EDGE_MAX. */
    int32_t beyond = (x & (SUB - 1)) * (int32_t)height + down * across + (int32_t)edge->whole - 1;
    edge->x = (x >> SUB_BITS) + divide(beyond, edge->whole, &edge->rest);
    if (edge->end - first > 1) {
        edge->step = divide(across, height, &edge->part);
        edge->part *= SUB;
        for (uint32_t lines = (uint32_t)(edge->line - first); lines > 0;) {
            uint32_t some = lines < SKIP_LINES ? lines : SKIP_LINES;
            skip_lines(edge, some, height);
            lines -= some;
        }
    }
    return true;
}

/* Adds pixels first .. end-1, cut to the box. The sink must have room. */
static inline void add_span(struct ow_span_sink *sink, int32_t line, int32_t first, int32_t end,
                            const struct ow_box *box)
{
    first = first < box->left ? box->left : first;
    end = end > box->right ? box->right : end;
    if (first < end) {
        struct ow_span *span = &sink->spans[sink->count++];
        *span = (struct ow_span){ (uint16_t)line, (uint16_t)first, (uint16_t)end };
    }
}

/* One line down: whole pixels and parts, without a branch. */
#define NEXT_LINE(x, rest, edge)                  \
    do {                                          \
        (rest) += (edge).part;                    \
        uint32_t carry_ = (rest) >= (edge).whole; \
        (rest) -= (edge).whole & (0u - carry_);   \
        (x) += (edge).step + (int32_t)carry_;     \
    } while (0)

/*
 * The lines between two edges from line to stop; both edges stand on line.
 * The places are copied so that the loop works in registers.
 */
static void add_lines(struct ow_scan_edge *left, struct ow_scan_edge *right, enum ow_winding rule,
                      int32_t line, int32_t stop, const struct ow_box *box,
                      struct ow_span_sink *sink)
{
    const struct ow_scan_edge l = *left;
    const struct ow_scan_edge r = *right;
    int32_t left_x = l.x;
    int32_t right_x = r.x;
    uint32_t left_rest = l.rest;
    uint32_t right_rest = r.rest;
    const int32_t box_left = box->left;
    const int32_t box_right = box->right;
    struct ow_span *span = sink->spans + sink->count;
    for (;;) {
        int32_t first = left_x;
        int32_t end = right_x;
        if (first > end && rule == OW_WINDING_ANY) {
            first = right_x;
            end = left_x;
        }
        first = first < box_left ? box_left : first;
        end = end > box_right ? box_right : end;
        if (first < end) {
            *span++ = (struct ow_span){ (uint16_t)line, (uint16_t)first, (uint16_t)end };
        }
        if (++line == stop) {
            break;
        }
        NEXT_LINE(left_x, left_rest, l);
        NEXT_LINE(right_x, right_rest, r);
    }
    /* An edge that goes on has its step: it has more than one line. */
    if (left->end > stop) {
        NEXT_LINE(left_x, left_rest, l);
        left->x = left_x;
        left->rest = left_rest;
    }
    if (right->end > stop) {
        NEXT_LINE(right_x, right_rest, r);
        right->x = right_x;
        right->rest = right_rest;
    }
    sink->count = (uint32_t)(span - sink->spans);
}

/* One of the two chains from the top to the bottom: which point comes next. */
struct chain {
    const struct ow_outline_point *points;
    uint32_t count;
    uint32_t at;
    bool backward;
    struct ow_scan_edge edge;
};

static bool next_edge(struct chain *chain, int32_t line, int32_t end_line, uint32_t bottom)
{
    while (chain->at != bottom) {
        uint32_t from = chain->at;
        uint32_t to = chain->backward ? (from == 0 ? chain->count - 1 : from - 1)
                                      : (from + 1 == chain->count ? 0 : from + 1);
        chain->at = to;
        if (begin_edge(&chain->edge, chain->points[from], chain->points[to], line, end_line)) {
            return true;
        }
    }
    return false;
}

/* Fronts are counter-clockwise on a screen whose y goes down: the forward chain is the left one. */
static void scan_chains(const struct ow_outline_point *points, uint32_t count, uint32_t top,
                        uint32_t bottom, enum ow_winding rule, const struct ow_box *box,
                        struct ow_span_sink *sink)
{
    int32_t line = box->line;
    struct chain left = { .points = points, .count = count, .at = top, .backward = false };
    struct chain right = { .points = points, .count = count, .at = top, .backward = true };
    left.edge.end = line;
    right.edge.end = line;
    while (line < box->end_line) {
        if (left.edge.end <= line && !next_edge(&left, line, box->end_line, bottom)) {
            return;
        }
        if (right.edge.end <= line && !next_edge(&right, line, box->end_line, bottom)) {
            return;
        }
        int32_t stop = left.edge.end < right.edge.end ? left.edge.end : right.edge.end;
        add_lines(&left.edge, &right.edge, rule, line, stop, box, sink);
        line = stop;
    }
}

/* Sorts the edges that cross this line by x; few and nearly sorted from the line before. */
static void sort_crossings(struct ow_scan_edge *edges, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        for (uint32_t k = i; k > 0 && edges[k - 1].x > edges[k].x; k--) {
            struct ow_scan_edge swap = edges[k];
            edges[k] = edges[k - 1];
            edges[k - 1] = swap;
        }
    }
}

/* Spans of one line: edges[0 .. active-1] cross it, sorted by x. */
static void wind_line(const struct ow_scan_edge *edges, uint32_t active, enum ow_winding rule,
                      int32_t line, const struct ow_box *box, struct ow_span_sink *sink)
{
    int32_t winding = 0;
    int32_t first = 0;
    bool inside = false;
    for (uint32_t i = 0; i < active;) {
        int32_t x = edges[i].x;
        while (i < active && edges[i].x == x) {
            winding += edges[i++].winding;
        }
        bool now = rule == OW_WINDING_ANY ? winding != 0 : winding > 0;
        if (now && !inside) {
            first = x;
        } else if (!now && inside) {
            add_span(sink, line, first, x, box);
            if (sink->count == sink->capacity) {
                sink->take(sink);
            }
        }
        inside = now;
    }
}

/*
 * Any outline: edges[0 .. active-1] cross the current line, the rest of the
 * count lie below it or are done.
 */
static void scan_windings(const struct ow_outline_point *points, uint32_t count,
                          enum ow_winding rule, const struct ow_box *box,
                          struct ow_scan_edge *edges, struct ow_span_sink *sink)
{
    int32_t line = box->line;
    int32_t end_line = box->end_line;
    uint32_t used = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t next = i + 1 == count ? 0 : i + 1;
        if (begin_edge(&edges[used], points[i], points[next], line, end_line)) {
            used++;
        }
    }
    uint32_t active = 0;
    for (; line < end_line && used > 0; line++) {
        for (uint32_t i = active; i < used; i++) {
            if (edges[i].line == line) {
                struct ow_scan_edge swap = edges[i];
                edges[i] = edges[active];
                edges[active++] = swap;
            }
        }
        sort_crossings(edges, active);
        wind_line(edges, active, rule, line, box, sink);
        uint32_t kept = 0;
        for (uint32_t i = 0; i < active; i++) {
            if (edges[i].end > line + 1) {
                if (kept != i) {
                    edges[kept] = edges[i];
                }
                NEXT_LINE(edges[kept].x, edges[kept].rest, edges[kept]);
                kept++;
            }
        }
        for (uint32_t i = active; i < used; i++) {
            edges[kept + i - active] = edges[i];
        }
        used -= active - kept;
        active = kept;
    }
}

static bool goes_down_once(const struct ow_outline_point *points, uint32_t count, uint32_t top,
                           uint32_t bottom)
{
    uint32_t i = top;
    bool below = true; /* still on the way to the bottom */
    for (uint32_t n = 0; n < count; n++) {
        if (i == bottom) {
            below = false;
        }
        uint32_t next = i + 1 == count ? 0 : i + 1;
        if (below ? points[next].y < points[i].y : points[next].y > points[i].y) {
            return false;
        }
        i = next;
    }
    return true;
}

/* Positive if b lies right of the line that goes down from a to c. */
static inline int64_t side_of(struct ow_outline_point a, struct ow_outline_point b,
                              struct ow_outline_point c)
{
    return (int64_t)(b.x - a.x) * (c.y - a.y) - (int64_t)(c.x - a.x) * (b.y - a.y);
}

/* True if the two had to be exchanged. */
static inline bool swap_if_above(struct ow_outline_point *a, struct ow_outline_point *b)
{
    if (b->y >= a->y) {
        return false;
    }
    struct ow_outline_point swap = *a;
    *a = *b;
    *b = swap;
    return true;
}

/* An edge of a low triangle: on the current line it crosses at pixel place / whole. */
struct low_edge {
    uint32_t place;
    uint32_t whole;
    uint32_t step; /* added to place for each line; modulo 2^32 */
};

/* The edge from p down to q on a line that it crosses; pixels are counted from the origin. */
static inline struct low_edge low_edge(struct ow_outline_point p, struct ow_outline_point q,
                                       int32_t line, ow_sub8 origin)
{
    int32_t dx = q.x - p.x;
    int32_t dy = q.y - p.y;
    int32_t down = line * SUB + HALF - p.y;
    /* (x - HALF) / SUB rounded up, which adds SUB - 1/dy. All of it is right of the origin. */
    int32_t place = (p.x - origin + HALF) * dy + down * dx - 1;
    return (struct low_edge){ (uint32_t)place, (uint32_t)(SUB * dy), (uint32_t)(SUB * dx) };
}

static inline struct ow_span *low_lines(struct ow_span *span, struct low_edge *left,
                                        struct low_edge *right, int32_t line, int32_t stop,
                                        int32_t origin_pixel, const struct ow_box *box)
{
    for (; line < stop; line++) {
        int32_t first = origin_pixel + (int32_t)(left->place / left->whole);
        int32_t end = origin_pixel + (int32_t)(right->place / right->whole);
        left->place += left->step;
        right->place += right->step;
        first = most(first, box->left);
        end = least(end, box->right);
        if (first < end) {
            *span++ = (struct ow_span){ (uint16_t)line, (uint16_t)first, (uint16_t)end };
        }
    }
    return span;
}

/*
 * A triangle of few lines: on each, two divisions find where it is crossed,
 * which is less work than making edges ready to step. a, b, c from top to bottom.
 */
static void scan_low_triangle(struct ow_outline_point a, struct ow_outline_point b,
                              struct ow_outline_point c, bool b_is_right, const struct ow_box *box,
                              struct ow_span_sink *sink)
{
    int32_t origin_pixel = least(a.x, least(b.x, c.x)) >> SUB_BITS;
    ow_sub8 origin = origin_pixel * SUB;
    int32_t line = box->line;
    int32_t bend = least(first_centre(b.y), box->end_line);
    struct low_edge whole = low_edge(a, c, line, origin);
    struct ow_span *span = sink->spans;
    if (line < bend) {
        struct low_edge part = low_edge(a, b, line, origin);
        span = b_is_right ? low_lines(span, &whole, &part, line, bend, origin_pixel, box)
                          : low_lines(span, &part, &whole, line, bend, origin_pixel, box);
        line = bend;
    }
    if (line < box->end_line) {
        struct low_edge part = low_edge(b, c, line, origin);
        span = b_is_right ? low_lines(span, &whole, &part, line, box->end_line, origin_pixel, box)
                          : low_lines(span, &part, &whole, line, box->end_line, origin_pixel, box);
    }
    sink->count = (uint32_t)(span - sink->spans);
}

/* One edge from top to bottom on one side, two on the other. a, b, c from top to bottom. */
static void scan_high_triangle(struct ow_outline_point a, struct ow_outline_point b,
                               struct ow_outline_point c, bool b_is_right, const struct ow_box *box,
                               struct ow_span_sink *sink)
{
    int32_t line = box->line;
    struct ow_scan_edge whole;
    struct ow_scan_edge part;
    struct ow_scan_edge *left = b_is_right ? &whole : &part;
    struct ow_scan_edge *right = b_is_right ? &part : &whole;
    (void)begin_edge(&whole, a, c, line, box->end_line);
    if (begin_edge(&part, a, b, line, box->end_line)) {
        add_lines(left, right, OW_WINDING_POSITIVE, line, part.end, box, sink);
        line = part.end;
    }
    if (begin_edge(&part, b, c, line, box->end_line)) {
        add_lines(left, right, OW_WINDING_POSITIVE, line, part.end, box, sink);
    }
}

enum {
    LOW_LINES = 16, /* up to here dividing on each line is cheaper than setting up steps */
    LOW_REACH = 120 * SUB
};
_Static_assert(2LL * LOW_REACH * (LOW_REACH + SUB) < INT32_MAX, "a low edge's place fits 32 bits");

/* Triangles are most of most models, and most of them are small. */
static void scan_triangle(const struct ow_outline_point *p, enum ow_winding rule,
                          const struct ow_box *box, struct ow_span_sink *sink)
{
    struct ow_outline_point a = p[0];
    struct ow_outline_point b = p[1];
    struct ow_outline_point c = p[2];
    int64_t side = side_of(a, b, c);
    if (side >= 0 && (rule == OW_WINDING_POSITIVE || side == 0)) {
        return; /* a back, or nothing */
    }
    bool b_is_right = side > 0;
    b_is_right ^= swap_if_above(&a, &b);
    b_is_right ^= swap_if_above(&b, &c);
    b_is_right ^= swap_if_above(&a, &b);
    if (box->is_small && box->end_line - box->line <= LOW_LINES) {
        scan_low_triangle(a, b, c, b_is_right, box, sink);
    } else {
        scan_high_triangle(a, b, c, b_is_right, box, sink);
    }
}

static void scan_outline(const struct ow_outline_point *points, uint32_t count,
                         enum ow_winding rule, const struct ow_box *box, struct ow_scan_edge *edges,
                         struct ow_span_sink *sink)
{
    uint32_t top = 0;
    uint32_t bottom = 0;
    for (uint32_t i = 1; i < count; i++) {
        top = points[i].y < points[top].y ? i : top;
        bottom = points[i].y > points[bottom].y ? i : bottom;
    }
    if (goes_down_once(points, count, top, bottom)) {
        scan_chains(points, count, top, bottom, rule, box, sink);
    } else {
        scan_windings(points, count, rule, box, edges, sink);
    }
}

bool ow_outline_box(const struct ow_outline_point *points, uint32_t count,
                    const struct ow_window *window, struct ow_box *box)
{
    /* A triangle's bounds without a loop: this is asked of every face. */
    ow_sub8 min_x = least(points[0].x, least(points[1].x, points[2].x));
    ow_sub8 max_x = most(points[0].x, most(points[1].x, points[2].x));
    ow_sub8 min_y = least(points[0].y, least(points[1].y, points[2].y));
    ow_sub8 max_y = most(points[0].y, most(points[1].y, points[2].y));
    for (uint32_t i = 3; i < count; i++) {
        min_x = least(min_x, points[i].x);
        max_x = most(max_x, points[i].x);
        min_y = least(min_y, points[i].y);
        max_y = most(max_y, points[i].y);
    }
    box->left = most(first_centre(min_x), 0);
    box->right = least(first_centre(max_x), window->width);
    box->line = most(first_centre(min_y), window->first_line);
    box->end_line = least(first_centre(max_y), window->end_line);
    box->is_small = (max_x - min_x) < LOW_REACH && (max_y - min_y) < LOW_REACH;
    return box->left < box->right && box->line < box->end_line;
}

void ow_scan(const struct ow_outline_point *points, uint32_t count, enum ow_winding rule,
             const struct ow_box *box, struct ow_scan_edge *edges, struct ow_span_sink *sink)
{
    if (count == 3) {
        scan_triangle(points, rule, box, sink);
    } else {
        scan_outline(points, count, rule, box, edges, sink);
    }
    if (sink->count > 0) {
        sink->take(sink);
    }
}
