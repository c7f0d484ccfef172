/* SPDX-License-Identifier: 0BSD */
/*
 * Stage "scan": edges step down the scan lines by whole and fractional pixels,
 * all integers, exact. Outlines that go down once and up once (all triangles,
 * all convex outlines) take the path of two chains; the others sort the
 * crossings of each line and add up their windings.
 */
#include "ow_scan.h"

#include "scan_low.h"

/* scan_4x4.c compiles this file a second time, for pixels a quarter as large. */
/* The largest height and width of an edge: coordinates stay within OW_GUARD of the middle. */
#define EDGE_MAX (2LL * OW_GUARD)
_Static_assert(EDGE_MAX *(3 * SUB) < INT32_MAX, "what begin_edge divides fits 32 bits");

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

/* Stands the edge on edge->line by its slope. */
static inline void begin_short_edge(struct ow_scan_edge *edge, struct ow_outline_point a,
                                    struct ow_outline_point b)
{
    int32_t origin = a.x >> SUB_BITS;
    struct short_edge at = short_edge(a, b, edge->line, origin);
    edge->x = short_pixel(&at, origin);
    edge->rest = at.place & (PLACE_ONE - 1);
    edge->whole = PLACE_ONE;
    edge->step = (int32_t)at.step >> PLACE_BITS;
    edge->part = at.step & (PLACE_ONE - 1);
}

/* Stands the edge on edge->line, exactly; first is the first line it crosses. */
static void begin_long_edge(struct ow_scan_edge *edge, struct ow_outline_point a,
                            struct ow_outline_point b, int32_t first)
{
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
    if (is_short(b.x - a.x, b.y - a.y)) {
        begin_short_edge(edge, a, b);
    } else {
        begin_long_edge(edge, a, b, first);
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

/* False if more than two borders cross a line: that is not done here. */
static bool scan_low(const struct ow_outline_point *points, uint32_t count, enum ow_winding rule,
                     const struct ow_box *box, struct ow_span_sink *sink)
{
    struct low_borders borders;
    uint32_t crossed = 0;
    for (uint32_t i = 0; i < count; i++) {
        crossed += cross_low(&borders, points[i], points[i + 1 == count ? 0 : i + 1], box);
    }
    if (crossed != (uint32_t)(box->end_line - box->line)) {
        return false;
    }
    sink->count = (uint32_t)(spans_between(&borders, rule, box, sink->spans) - sink->spans);
    return true;
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
    box->origin = min_x >> SUB_BITS;
    box->left = most(first_centre(min_x), 0);
    box->right = least(first_centre(max_x), window->width);
    box->line = most(first_centre(min_y), window->first_line);
    box->end_line = least(first_centre(max_y), window->end_line);
    box->is_small = (max_x - min_x) < SHORT_REACH && (max_y - min_y) < SHORT_REACH;
    return box->left < box->right && box->line < box->end_line;
}

void ow_scan(const struct ow_outline_point *points, uint32_t count, enum ow_winding rule,
             const struct ow_box *box, struct ow_scan_edge *edges, struct ow_span_sink *sink)
{
    bool is_low = box->is_small && box->end_line - box->line <= LOW_LINES;
    if (!is_low || !scan_low(points, count, rule, box, sink)) {
        scan_outline(points, count, rule, box, edges, sink);
    }
    if (sink->count > 0) {
        sink->take(sink);
    }
}
