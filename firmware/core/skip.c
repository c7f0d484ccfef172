/* SPDX-License-Identifier: 0BSD */
/* Skipping bounded nodes: spheres against the frustum, cones of normals against the eye. */
#include "ow_frame.h"
#include "ow_memory.h"
#include "ow_read.h"

enum {
    UNIT = 127,       /* stored vectors and cosines are this long */
    SLACK = 4,        /* lattice steps: rounding of vertices, eye and centre */
    SINE_SLACK = 192, /* of UNIT^2: normals are stored and true to 2/3 of a degree together */
    COSINE_SLACK = 2
};

struct ow_bounds ow_read_bounds(const struct ow_tree *tree, uint32_t at)
{
    struct ow_bounds bounds;
    for (uint32_t i = 0; i < 3; i++) {
        bounds.centre[i] = ow_read_i16(tree->bytes, at + 2 * i);
        bounds.axis[i] = ow_read_i8(tree->bytes, at + 8 + i);
    }
    bounds.radius = (int32_t)ow_read_u16(tree->bytes, at + 6);
    bounds.cosine = ow_read_i8(tree->bytes, at + 11);
    return bounds;
}

/* value * 2^16 / scale, at most 2^24. */
static uint32_t over_scale_q16(uint32_t value, struct ow_scale scale)
{
    struct ow_scale quotient = ow_scale_of(value, scale.mantissa);
    int32_t right = quotient.exponent - scale.exponent - 16;
    if (right >= 31) {
        return 0;
    }
    uint32_t result = right > 0 ? quotient.mantissa >> right : 1u << 24;
    return result > 1u << 24 ? 1u << 24 : result;
}

void ow_frustum_make(struct ow_frustum *frustum, const struct ow_view *view)
{
    const uint32_t half[2] = { OW_SUB / 2u * view->width, OW_SUB / 2u * view->height };
    frustum->view = view;
    for (int i = 0; i < 2; i++) {
        uint64_t tangent = over_scale_q16(half[i], view->scale) + 1;
        frustum->tangent_q16[i] = (uint32_t)tangent;
        frustum->secant_q16[i] = ow_sqrt64(((uint64_t)1 << 32) + tangent * tangent) + 1;
    }
}

/* The sphere's centre and radius in camera units. */
struct sphere {
    int64_t along[2]; /* right, up */
    int64_t ahead;
    int64_t radius;
};

static struct sphere to_camera(const struct ow_view *view, const struct ow_bounds *bounds)
{
    uint32_t shift = view->camera_shift - 8u;
    int64_t sums[3] = { view->offset[0], view->offset[1], view->offset[2] };
    for (int i = 0; i < 3; i++) {
        sums[0] += (int64_t)view->right[i] * bounds->centre[i];
        sums[1] += (int64_t)view->up[i] * bounds->centre[i];
        sums[2] += (int64_t)view->forward[i] * bounds->centre[i];
    }
    int64_t radius = ((int64_t)(bounds->radius + SLACK) << 30 >> shift) + 1;
    return (struct sphere){ { sums[0] >> shift, sums[1] >> shift }, sums[2] >> shift, radius };
}

/* Parallel: the screen's place of a camera coordinate, ow_sub8 from the middle. */
static int64_t to_pixels(const struct ow_view *view, int64_t along)
{
    return (along * view->scale.mantissa) >> view->scale.exponent;
}

/* ow_sub8 from the middle, outwards rounded, to the first and end pixel of an axis. */
static void to_range(int64_t low, int64_t high, int32_t centre, int32_t least, int32_t end,
                     int32_t *first_pixel, int32_t *end_pixel)
{
    int64_t first = ((low + centre) >> OW_SUB_BITS) - 1;
    int64_t last = ((high + centre) >> OW_SUB_BITS) + 2;
    *first_pixel = first < least ? least : first > end ? end : (int32_t)first;
    *end_pixel = last > end ? end : last < least ? least : (int32_t)last;
}

/*
 * How far the sphere reaches on one axis of the screen, in perspective: its
 * nearest depth magnifies most. reach of OW_GUARD stands for everything.
 */
static void perspective_range(const struct ow_view *view, int64_t along, const struct sphere *s,
                              int64_t *low, int64_t *high)
{
    int64_t near = s->ahead - s->radius;
    int64_t far = s->ahead + s->radius;
    *low = -OW_GUARD;
    *high = OW_GUARD;
    if (near < view->near_z || near < 1) {
        return;
    }
    int64_t from = along - s->radius;
    int64_t to = along + s->radius;
    struct ow_camera_point p = { .x = (int32_t)from, .y = (int32_t)to, .z = (int32_t)near };
    struct ow_camera_point q = p;
    q.z = far > 1 << 30 ? 1 << 30 : (int32_t)far;
    /* Whichever side of the axis an end lies on, the nearer or the farther depth is outermost. */
    if (!ow_is_inside(view, p)) {
        return;
    }
    struct ow_outline_point a = ow_to_screen(view, from < 0 ? p : q);
    struct ow_outline_point b = ow_to_screen(view, to > 0 ? p : q);
    *low = a.x - OW_SUB / 2 * view->width - 1;
    *high = OW_SUB / 2 * view->height - b.y + 1;
}

bool ow_sphere_box(const struct ow_frustum *frustum, const struct ow_bounds *bounds,
                   const struct ow_window *window, struct ow_box *box)
{
    const struct ow_view *view = frustum->view;
    struct sphere s = to_camera(view, bounds);
    int64_t low[2];
    int64_t high[2];
    if (view->projection == OW_PERSPECTIVE && s.ahead + s.radius < view->near_z) {
        return false;
    }
    for (int i = 0; i < 2; i++) {
        int64_t size = s.along[i] < 0 ? -s.along[i] : s.along[i];
        if (view->projection == OW_PERSPECTIVE) {
            if (((size << 16) - s.ahead * frustum->tangent_q16[i]) >
                s.radius * frustum->secant_q16[i]) {
                return false;
            }
            perspective_range(view, s.along[i], &s, &low[i], &high[i]);
        } else {
            low[i] = to_pixels(view, s.along[i] - s.radius) - 1;
            high[i] = to_pixels(view, s.along[i] + s.radius) + 1;
        }
    }
    to_range(low[0], high[0], OW_SUB / 2 * view->width, 0, window->width, &box->left, &box->right);
    to_range(-high[1], -low[1], OW_SUB / 2 * view->height, window->first_line, window->end_line,
             &box->line, &box->end_line);
    return box->left < box->right && box->line < box->end_line;
}

/*
 * With the eye at d from the centre, axis a and half angle t of the cone: all
 * look away if d.a cos t + |d| sin t < -radius, a bound for the greatest n.d.
 */
static bool cone_looks_away_from(const int32_t d[3], const struct ow_bounds *bounds)
{
    int64_t along = 0; /* d.a, times UNIT, and what the axis's rounding may add */
    int64_t squares = 0;
    for (int i = 0; i < 3; i++) {
        along += (int64_t)d[i] * bounds->axis[i] + (d[i] < 0 ? -d[i] : d[i]) / 2 + UNIT;
        squares += (int64_t)d[i] * d[i];
    }
    int64_t cosine = bounds->cosine - COSINE_SLACK;
    int64_t room = -along * cosine - (int64_t)(bounds->radius + SLACK) * UNIT * UNIT;
    if (along >= 0 || room <= 0) {
        return false;
    }
    int64_t sine_squared = UNIT * UNIT - cosine * cosine + SINE_SLACK;
    return (room >> 7) * (room >> 7) > squares * sine_squared;
}

bool ow_cone_looks_away(const struct ow_view *view, const struct ow_bounds *bounds)
{
    int32_t d[3];
    struct ow_bounds turned = *bounds;
    if (bounds->cosine <= COSINE_SLACK) {
        return false;
    }
    if (view->projection == OW_PERSPECTIVE) {
        for (int i = 0; i < 3; i++) {
            d[i] = (view->eye[i] >> 8) - bounds->centre[i];
        }
    } else { /* the eye is so far away that the sphere is a point */
        for (int i = 0; i < 3; i++) {
            d[i] = -(view->forward[i] >> 10);
        }
        turned.radius = 0;
    }
    return cone_looks_away_from(d, &turned);
}

static void begin(struct ow_frame *frame)
{
    ow_frustum_make(&frame->frustum, frame->view);
}

static bool hides(void *context, const struct ow_tree *tree, uint32_t bounds_at)
{
    const struct ow_frame *frame = context;
    struct ow_bounds bounds = ow_read_bounds(tree, bounds_at);
    struct ow_box box;
    return (frame->rule == OW_WINDING_POSITIVE && ow_cone_looks_away(frame->view, &bounds)) ||
           !ow_sphere_box(&frame->frustum, &bounds, &frame->window, &box) ||
           (frame->kind != NULL && frame->kind->hides != NULL &&
            frame->kind->hides(&frame->surface, &box)); /* not yet aimed: a list is being made */
}

const struct ow_skipping ow_skipping = { begin, hides };
