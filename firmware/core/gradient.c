/* SPDX-License-Identifier: 0BSD */
/*
 * Gradients. A triangle's values lie in a plane over the screen. Other outlines
 * are interpolated along the edges, then along the line between the outermost
 * two crossings, as if nothing of it were hidden [GC91].
 */
#include "ow_gradient.h"

#include "ow_memory.h"

enum {
    SUB = OW_SUB,
    HALF = OW_SUB / 2,
    FRACTION = 16,             /* fraction bits of a value */
    PLANE_MIN = 8 * SUB * SUB, /* twice its area: a triangle of less than 4 pixels is even */
    RECIPROCAL_BITS = 22
};

/*
 * numerator * 2^FRACTION / denominator within 2^-20 of it. |numerator| < 2^40,
 * denominator PLANE_MIN .. 2^43: the result is below 2^37.
 */
static int64_t divide(int64_t numerator, uint64_t denominator)
{
    int32_t shift = 0; /* denominator * 2^-shift has 32 bits */
    while (denominator >> 32 != 0) {
        denominator >>= 1;
        shift++;
    }
    uint32_t zeros = ow_leading_zeros((uint32_t)denominator);
    shift -= (int32_t)zeros;
    int64_t reciprocal = ow_reciprocal((uint32_t)denominator << zeros) >> (32 - RECIPROCAL_BITS);
    int64_t product = numerator * reciprocal;
    return product >> (31 + RECIPROCAL_BITS - FRACTION + shift);
}

static void begin_plane(struct ow_gradient *g, int64_t cross)
{
    const struct ow_outline_point *p = g->points;
    int64_t x1 = p[1].x - p[0].x;
    int64_t y1 = p[1].y - p[0].y;
    int64_t x2 = p[2].x - p[0].x;
    int64_t y2 = p[2].y - p[0].y;
    int64_t sign = cross < 0 ? -1 : 1;
    uint64_t size = (uint64_t)(cross * sign);
    for (uint32_t i = 0; i < g->parts; i++) {
        int64_t a1 = g->lights[1].part[i] - g->lights[0].part[i];
        int64_t a2 = g->lights[2].part[i] - g->lights[0].part[i];
        g->right[i] = divide((a1 * y2 - a2 * y1) * sign, size);
        g->down[i] = divide((a2 * x1 - a1 * x2) * sign, size);
    }
}

/* A small triangle has one value: the mean of its corners'. */
static void begin_even(struct ow_gradient *g)
{
    for (uint32_t i = 0; i < g->parts; i++) {
        int32_t sum = g->lights[0].part[i] + g->lights[1].part[i] + g->lights[2].part[i];
        g->ramp[i].low = sum / 3;
        g->ramp[i].high = sum / 3;
        g->right[i] = 0;
        g->down[i] = 0;
    }
}

void ow_gradient_begin(struct ow_gradient *gradient, const struct ow_outline_point *points,
                       const struct ow_corner_light *lights, uint32_t count, uint32_t parts)
{
    gradient->points = points;
    gradient->lights = lights;
    gradient->count = count;
    gradient->parts = parts;
    gradient->line = -1;
    gradient->is_plane = count == 3;
    for (uint32_t i = 0; i < parts; i++) {
        struct ow_ramp *ramp = &gradient->ramp[i];
        ramp->low = lights[0].part[i];
        ramp->high = ramp->low;
        for (uint32_t k = 1; k < count; k++) {
            int32_t value = lights[k].part[i];
            ramp->low = value < ramp->low ? value : ramp->low;
            ramp->high = value > ramp->high ? value : ramp->high;
        }
    }
    if (gradient->is_plane) {
        const struct ow_outline_point *p = points;
        int64_t cross = (int64_t)(p[1].x - p[0].x) * (p[2].y - p[0].y) -
                        (int64_t)(p[2].x - p[0].x) * (p[1].y - p[0].y);
        if (cross > -PLANE_MIN && cross < PLANE_MIN) {
            begin_even(gradient);
        } else {
            begin_plane(gradient, cross);
        }
    }
}

/* Where an edge crosses a line's centre. */
struct crossing {
    ow_sub8 x;
    int32_t part[OW_LIGHT_PARTS];
};

/* The edge from corner i, which crosses the centre y; down its share from the top, 13 bits. */
static struct crossing cross_edge(const struct ow_gradient *g, uint32_t i, ow_sub8 y)
{
    uint32_t top = i;
    uint32_t bottom = i + 1 == g->count ? 0 : i + 1;
    if (g->points[top].y > g->points[bottom].y) {
        uint32_t swap = top;
        top = bottom;
        bottom = swap;
    }
    const struct ow_outline_point *a = &g->points[top];
    const struct ow_outline_point *b = &g->points[bottom];
    uint32_t height = (uint32_t)(b->y - a->y); /* below 2^21 */
    uint32_t coarser = height >> 18 ? 3 : 0;
    int64_t share = ((uint32_t)(y - a->y) >> coarser << 13) / (height >> coarser);
    struct crossing c = { a->x + (ow_sub8)(((b->x - a->x) * share) >> 13), { 0 } };
    for (uint32_t k = 0; k < g->parts; k++) {
        int32_t from = g->lights[top].part[k];
        c.part[k] = from + (int32_t)(((g->lights[bottom].part[k] - from) * share) >> 13);
    }
    return c;
}

/* The leftmost and the rightmost crossing of a line; unchanged if the outline does not cross it. */
static void find_ends(const struct ow_gradient *g, ow_sub8 y, struct crossing *left,
                      struct crossing *right)
{
    bool any = false;
    for (uint32_t i = 0; i < g->count; i++) {
        uint32_t next = i + 1 == g->count ? 0 : i + 1;
        if ((g->points[i].y <= y) == (g->points[next].y <= y)) {
            continue;
        }
        struct crossing c = cross_edge(g, i, y);
        *left = !any || c.x < left->x ? c : *left;
        *right = !any || c.x > right->x ? c : *right;
        any = true;
    }
}

/* The ramp through the outermost two crossings of the line. */
static void span_line(struct ow_gradient *g, ow_sub8 y)
{
    struct crossing left = { 1, { 0 } };
    struct crossing right = { 0, { 0 } };
    find_ends(g, y, &left, &right);
    g->left = left.x;
    g->right_end = right.x;
    int32_t across = right.x - left.x;
    for (uint32_t k = 0; k < g->parts; k++) {
        int64_t slope = 0; /* per 1/256 pixel */
        if (across > 0) {
            int32_t rise = right.part[k] - left.part[k];
            uint32_t steep = ((uint32_t)(rise < 0 ? -rise : rise) << 14) / (uint32_t)across;
            slope = (rise < 0 ? -(int64_t)steep : (int64_t)steep) * 4;
        }
        g->ramp[k].slope = slope * SUB;
        g->ramp[k].at = (int64_t)left.part[k] * (1 << FRACTION) + slope * (HALF - left.x);
    }
}

void ow_gradient_line(struct ow_gradient *gradient, int32_t line)
{
    ow_sub8 y = line * SUB + HALF;
    gradient->line = line;
    if (!gradient->is_plane || gradient->beside) {
        span_line(gradient, y);
        return;
    }
    const struct ow_outline_point *p = gradient->points;
    for (uint32_t i = 0; i < gradient->parts; i++) {
        struct ow_ramp *ramp = &gradient->ramp[i];
        ramp->slope = gradient->right[i] * SUB;
        ramp->at = (int64_t)gradient->lights[0].part[i] * (1 << FRACTION) +
                   gradient->right[i] * (HALF - p[0].x) + gradient->down[i] * (y - p[0].y);
    }
}

/* How far along the edge from a to b the point nearest to c lies, 13 bits. */
static int32_t nearest_share(const struct ow_outline_point *a, const struct ow_outline_point *b,
                             ow_sub8 x, ow_sub8 y)
{
    int64_t dx = b->x - a->x;
    int64_t dy = b->y - a->y;
    int64_t along = dx * (x - a->x) + dy * (y - a->y);
    int64_t whole = dx * dx + dy * dy;
    if (along <= 0 || whole == 0) {
        return 0;
    }
    if (along >= whole) {
        return 1 << 13;
    }
    while (whole >> 18 != 0) {
        whole >>= 1;
        along >>= 1;
    }
    return (int32_t)(((uint32_t)along << 13) / (uint32_t)whole);
}

/* The values at the outline's point nearest to (x, y). */
static void find_nearest(const struct ow_gradient *g, ow_sub8 x, ow_sub8 y,
                         struct ow_corner_light *light)
{
    int64_t least = INT64_MAX;
    for (uint32_t i = 0; i < g->count; i++) {
        uint32_t next = i + 1 == g->count ? 0 : i + 1;
        const struct ow_outline_point *a = &g->points[i];
        const struct ow_outline_point *b = &g->points[next];
        int64_t share = nearest_share(a, b, x, y);
        int64_t dx = x - a->x - (((b->x - a->x) * share) >> 13);
        int64_t dy = y - a->y - (((b->y - a->y) * share) >> 13);
        if (dx * dx + dy * dy >= least) {
            continue;
        }
        least = dx * dx + dy * dy;
        for (uint32_t k = 0; k < g->parts; k++) {
            int32_t from = g->lights[i].part[k];
            light->part[k] = from + (int32_t)(((g->lights[next].part[k] - from) * share) >> 13);
        }
    }
}

void ow_gradient_beside(const struct ow_gradient *gradient, uint32_t x,
                        struct ow_corner_light *light)
{
    ow_sub8 centre = (ow_sub8)x * SUB + HALF;
    if (centre < gradient->left || centre > gradient->right_end) {
        find_nearest(gradient, centre, gradient->line * SUB + HALF, light);
        return;
    }
    for (uint32_t i = 0; i < gradient->parts; i++) {
        light->part[i] = ow_ramp_value(&gradient->ramp[i], x);
    }
}
