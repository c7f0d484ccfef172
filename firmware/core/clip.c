/* SPDX-License-Identifier: 0BSD */
/* Stage "clip": Sutherland-Hodgman against five planes, in camera units. */
#include "ow_clip.h"

enum clip_plane { CLIP_NEAR, CLIP_CUT, CLIP_LEFT, CLIP_RIGHT, CLIP_BOTTOM, CLIP_TOP, CLIP_PLANES };

/* Distance inside a plane, up to a factor; negative: outside. Below 2^56. */
static int64_t inside_by(const struct ow_view *view, const struct ow_camera_point *p,
                         enum clip_plane plane)
{
    switch (plane) {
    case CLIP_NEAR:
        return (int64_t)p->z - view->near_z;
    case CLIP_CUT:
        return ow_kept_by(view, p->x, p->y, p->z);
    case CLIP_LEFT:
        return ow_reach(view, p->z) + p->x;
    case CLIP_RIGHT:
        return ow_reach(view, p->z) - p->x;
    case CLIP_BOTTOM:
        return ow_reach(view, p->z) + p->y;
    default:
        return ow_reach(view, p->z) - p->y;
    }
}

/* from + (to - from) * share; share has 30 fraction bits. */
static int32_t between(int32_t from, int32_t to, uint32_t share)
{
    return from + (int32_t)((((int64_t)to - from) * share) >> 30);
}

/*
 * Pulls p, which rounding may have left a unit or two outside, onto the plane:
 * what ow_to_screen is given must be inside.
 */
static void settle(const struct ow_view *view, struct ow_camera_point *p, enum clip_plane plane)
{
    if (plane == CLIP_NEAR) {
        p->z = view->near_z;
        return;
    }
    if (plane == CLIP_CUT) {
        return; /* a unit beyond it does no harm */
    }
    int32_t reach = (int32_t)ow_reach(view, p->z);
    if (plane == CLIP_LEFT || plane == CLIP_RIGHT) {
        p->x = plane == CLIP_LEFT ? -reach : reach;
    } else {
        p->y = plane == CLIP_BOTTOM ? -reach : reach;
    }
}

/* Where the edge from kept (distance inside >= 0) to cut (< 0) meets the plane. */
static struct ow_camera_point meet(const struct ow_view *view, const struct ow_camera_point *kept,
                                   const struct ow_camera_point *cut, int64_t kept_by,
                                   int64_t cut_by, enum clip_plane plane)
{
    uint64_t part = (uint64_t)kept_by;
    uint64_t whole = (uint64_t)(kept_by - cut_by);
    while (whole >> 31 != 0) {
        whole >>= 1;
        part >>= 1;
    }
    uint32_t share = part >= whole ? 1u << 30 : ow_ratio((uint32_t)part, (uint32_t)whole, 30);
    struct ow_camera_point p = { .x = between(kept->x, cut->x, share),
                                 .y = between(kept->y, cut->y, share),
                                 .z = between(kept->z, cut->z, share) };
    for (int i = 0; i < OW_LIGHT_PARTS; i++) {
        p.light.part[i] = between(kept->light.part[i], cut->light.part[i], share);
    }
    settle(view, &p, plane);
    return p;
}

/* One plane: from -> to. Returns the count written, capacity + 1 if they do not fit. */
static uint32_t clip_by_plane(const struct ow_view *view, const struct ow_camera_point *from,
                              uint32_t count, struct ow_camera_point *to, uint32_t capacity,
                              enum clip_plane plane)
{
    uint32_t written = 0;
    const struct ow_camera_point *last = &from[count - 1];
    int64_t last_by = inside_by(view, last, plane);
    for (uint32_t i = 0; i < count; i++) {
        const struct ow_camera_point *p = &from[i];
        int64_t by = inside_by(view, p, plane);
        if (written + 2 > capacity) {
            return capacity + 1;
        }
        if (last_by >= 0 && by < 0) {
            to[written] = meet(view, last, p, last_by, by, plane);
            to[written++].marked = plane != CLIP_CUT; /* along the plane: only a cut shows */
        } else if (last_by < 0 && by >= 0) {
            to[written] = meet(view, p, last, by, last_by, plane);
            to[written++].marked = last->marked;
        }
        if (by >= 0) {
            to[written++] = *p;
        }
        last = p;
        last_by = by;
    }
    return written;
}

uint32_t ow_clip(const struct ow_view *view, struct ow_camera_point *const points[2],
                 uint32_t count, uint32_t capacity, uint32_t *which, bool *overflow)
{
    uint32_t in = 0;
    enum clip_plane first = view->projection == OW_PERSPECTIVE ? CLIP_NEAR : CLIP_CUT;
    for (enum clip_plane plane = first; plane < CLIP_PLANES && count > 0; plane++) {
        if (plane == CLIP_CUT && !view->cuts) {
            continue;
        }
        count = clip_by_plane(view, points[in], count, points[in ^ 1], capacity, plane);
        in ^= 1;
        if (count > capacity) {
            *overflow = true;
            count = 0;
        }
    }
    *which = in;
    return count;
}
