/* SPDX-License-Identifier: 0BSD */
/*
 * Stage "scan": edges step down the scan lines by whole and fractional pixels,
 * all integers, exact. Outlines that go down once and up once (all triangles,
 * all convex outlines) take the path of two chains; the others sort the
 * crossings of each line and add up their windings.
 */
#include "ow_scan.h"

#include <stdbool.h>

enum { SUB = 16, HALF = 8, SUB_BITS = 4 }; /* 1/16 pixels; a pixel's centre lies at its half */

/* Bounds of coordinates: OW_GUARD around a centre of at most 8 * OW_SCREEN_MAX. */
_Static_assert(2 * (OW_GUARD + 8 * OW_SCREEN_MAX) < 1 << 19, "edges are below 2^19 in each axis");
_Static_assert(OW_GUARD < 1 << 17, "so x and y differences of one outline are below 2^18");

/* The first line or pixel whose centre is at or beyond this coordinate. */
static inline int32_t first_centre(ow_sub4 coordinate)
{
    return (coordinate - HALF + SUB - 1) >> SUB_BITS;
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

/* Goes lines further down at once; part and step must be known. */
static void skip_lines(struct ow_scan_edge *edge, uint32_t lines, uint32_t height)
{
    uint32_t parts = lines * (edge->part / SUB); /* below 2^14 * 2^18 */
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
    int32_t down = first * SUB + HALF - a.y; /* 0 .. 15 */
    int32_t x = a.x - HALF;
    edge->whole = height * SUB;
    /* Pixels right of x's own, rounded up: all terms are below 2^23. */
    int32_t beyond = (x & (SUB - 1)) * (int32_t)height + down * across + (int32_t)edge->whole - 1;
    edge->x = (x >> SUB_BITS) + divide(beyond, edge->whole, &edge->rest);
    if (edge->end - first > 1) {
        edge->step = divide(across, height, &edge->part);
        edge->part *= SUB;
        if (edge->line > first) {
            skip_lines(edge, (uint32_t)(edge->line - first), height);
        }
    }
    return true;
}

static inline void next_line(struct ow_scan_edge *edge)
{
    edge->x += edge->step;
    edge->rest += edge->part;
    if (edge->rest >= edge->whole) {
        edge->rest -= edge->whole;
        edge->x++;
    }
}

/* Adds pixels first .. end-1, cut to the width. The sink must have room. */
static inline void add_span(struct ow_span_sink *sink, int32_t line, int32_t first, int32_t end,
                            int32_t width)
{
    first = first < 0 ? 0 : first;
    end = end > width ? width : end;
    if (first < end) {
        struct ow_span *span = &sink->spans[sink->count++];
        span->line = (uint16_t)line;
        span->first = (uint16_t)first;
        span->end = (uint16_t)end;
    }
}

/* The lines between two edges from line to stop; both edges stand on line. */
static inline int32_t add_lines(struct ow_scan_edge *left, struct ow_scan_edge *right,
                                enum ow_winding rule, int32_t line, int32_t stop, int32_t width,
                                struct ow_span_sink *sink)
{
    for (; line < stop; line++) {
        if (left->x < right->x) {
            add_span(sink, line, left->x, right->x, width);
        } else if (rule == OW_WINDING_ANY) {
            add_span(sink, line, right->x, left->x, width);
        }
        next_line(left);
        next_line(right);
    }
    return line;
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
                        uint32_t bottom, enum ow_winding rule, int32_t line, int32_t end_line,
                        int32_t width, struct ow_span_sink *sink)
{
    struct chain left = {.points = points, .count = count, .at = top, .backward = false};
    struct chain right = {.points = points, .count = count, .at = top, .backward = true};
    left.edge.end = line;
    right.edge.end = line;
    while (line < end_line) {
        if (left.edge.end <= line && !next_edge(&left, line, end_line, bottom)) {
            return;
        }
        if (right.edge.end <= line && !next_edge(&right, line, end_line, bottom)) {
            return;
        }
        int32_t stop = left.edge.end < right.edge.end ? left.edge.end : right.edge.end;
        line = add_lines(&left.edge, &right.edge, rule, line, stop, width, sink);
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
                      int32_t line, int32_t width, struct ow_span_sink *sink)
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
            add_span(sink, line, first, x, width);
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
                          enum ow_winding rule, int32_t line, int32_t end_line, int32_t width,
                          struct ow_scan_edge *edges, struct ow_span_sink *sink)
{
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
        wind_line(edges, active, rule, line, width, sink);
        uint32_t kept = 0;
        for (uint32_t i = 0; i < active; i++) {
            if (edges[i].end > line + 1) {
                if (kept != i) {
                    edges[kept] = edges[i];
                }
                next_line(&edges[kept++]);
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

static inline void swap_if_above(struct ow_outline_point *a, struct ow_outline_point *b,
                                 int64_t *side)
{
    if (b->y < a->y) {
        struct ow_outline_point swap = *a;
        *a = *b;
        *b = swap;
        *side = -*side;
    }
}

/* One edge from top to bottom on one side, two on the other. */
static void scan_triangle(const struct ow_outline_point *points, enum ow_winding rule,
                          const struct ow_window *window, struct ow_span_sink *sink)
{
    struct ow_outline_point a = points[0];
    struct ow_outline_point b = points[1];
    struct ow_outline_point c = points[2];
    int64_t side = side_of(a, b, c);
    if (side >= 0 && rule == OW_WINDING_POSITIVE) {
        return; /* a back, or nothing */
    }
    swap_if_above(&a, &b, &side);
    swap_if_above(&b, &c, &side);
    swap_if_above(&a, &b, &side);
    int32_t line = first_centre(a.y);
    int32_t end_line = first_centre(c.y);
    line = line < window->first_line ? window->first_line : line;
    end_line = end_line > window->end_line ? window->end_line : end_line;
    struct ow_scan_edge whole;
    struct ow_scan_edge part;
    if (line >= end_line || !begin_edge(&whole, a, c, line, end_line)) {
        return;
    }
    struct ow_scan_edge *left = side > 0 ? &whole : &part;
    struct ow_scan_edge *right = side > 0 ? &part : &whole;
    if (begin_edge(&part, a, b, line, end_line)) {
        line = add_lines(left, right, OW_WINDING_POSITIVE, line, part.end, window->width, sink);
    }
    if (begin_edge(&part, b, c, line, end_line)) {
        add_lines(left, right, OW_WINDING_POSITIVE, line, part.end, window->width, sink);
    }
}

/* True if the outline holds no pixel's centre of the window, by its bounds alone. */
static inline bool is_nowhere(const struct ow_outline_point *points, uint32_t count,
                              const struct ow_window *window)
{
    ow_sub4 min_x = points[0].x;
    ow_sub4 max_x = min_x;
    ow_sub4 min_y = points[0].y;
    ow_sub4 max_y = min_y;
    for (uint32_t i = 1; i < count; i++) {
        min_x = points[i].x < min_x ? points[i].x : min_x;
        max_x = points[i].x > max_x ? points[i].x : max_x;
        min_y = points[i].y < min_y ? points[i].y : min_y;
        max_y = points[i].y > max_y ? points[i].y : max_y;
    }
    int32_t left = first_centre(min_x);
    int32_t right = first_centre(max_x);
    int32_t line = first_centre(min_y);
    int32_t end_line = first_centre(max_y);
    return left >= right || line >= end_line || right <= 0 || left >= window->width ||
           end_line <= window->first_line || line >= window->end_line;
}

static void scan_outline(const struct ow_outline_point *points, uint32_t count,
                         enum ow_winding rule, const struct ow_window *window,
                         struct ow_scan_edge *edges, struct ow_span_sink *sink)
{
    uint32_t top = 0;
    uint32_t bottom = 0;
    for (uint32_t i = 1; i < count; i++) {
        top = points[i].y < points[top].y ? i : top;
        bottom = points[i].y > points[bottom].y ? i : bottom;
    }
    int32_t line = first_centre(points[top].y);
    int32_t end_line = first_centre(points[bottom].y);
    line = line < window->first_line ? window->first_line : line;
    end_line = end_line > window->end_line ? window->end_line : end_line;
    if (goes_down_once(points, count, top, bottom)) {
        scan_chains(points, count, top, bottom, rule, line, end_line, window->width, sink);
    } else {
        scan_windings(points, count, rule, line, end_line, window->width, edges, sink);
    }
}

void ow_scan(const struct ow_outline_point *points, uint32_t count, enum ow_winding rule,
             const struct ow_window *window, struct ow_scan_edge *edges,
             struct ow_span_sink *sink)
{
    if (is_nowhere(points, count, window)) {
        return;
    }
    if (count == 3) {
        scan_triangle(points, rule, window, sink);
    } else {
        scan_outline(points, count, rule, window, edges, sink);
    }
    if (sink->count > 0) {
        sink->take(sink);
    }
}
