/* SPDX-License-Identifier: 0BSD */
/*
 * Stage "project": a lattice point to camera units and on to the screen, once
 * for each vertex and frame. Inline: these run for every vertex drawn.
 */
#ifndef OW_PROJECT_H
#define OW_PROJECT_H

#include <stdbool.h>
#include <stdint.h>

#include "ow_draw.h"
#include "ow_read.h"

/*
 * What smooth shading interpolates: the shading's own parts; then, with a depth
 * cue, the share of the colour that is seen (65536 is all).
 */
enum { OW_LIGHT_PARTS = 5 };

struct ow_corner_light {
    int32_t part[OW_LIGHT_PARTS];
};

struct ow_camera_point {
    int32_t x;
    int32_t y;
    int32_t z;
    struct ow_corner_light light; /* only clipping looks at it, and only for smooth shading */
    bool marked; /* the edge to the next point is not to be drawn; only for lines */
};

struct ow_outline_point {
    ow_sub8 x;
    ow_sub8 y;
};

/* In x of a vertex's place on the screen: it has none before clipping. */
#define OW_CLIP_FIRST INT32_MIN

/* The vertex number of corner i of the polygon record at byte offset at. */
static inline uint32_t ow_corner(const struct ow_tree *tree, uint32_t at, uint32_t i)
{
    uint32_t first = at + tree->corners_in_record;
    return (tree->flags & OW_TREE_INDEX32) ? ow_read_u32(tree->bytes, first + 4 * i)
                                           : ow_read_u16(tree->bytes, first + 2 * i);
}

/* A lattice point in camera units. */
static inline struct ow_camera_point ow_lattice_to_camera(const struct ow_view *view, int64_t x,
                                                          int64_t y, int64_t z)
{
    uint32_t shift = view->camera_shift - 8u;
    return (struct ow_camera_point){
        (int32_t)((view->right[0] * x + view->right[1] * y + view->right[2] * z +
                   view->offset[0]) >>
                  shift),
        (int32_t)((view->up[0] * x + view->up[1] * y + view->up[2] * z + view->offset[1]) >> shift),
        (int32_t)((view->forward[0] * x + view->forward[1] * y + view->forward[2] * z +
                   view->offset[2]) >>
                  shift),
        { { 0 } },
        false,
    };
}

/* Vertex number vertex of the tree in camera units. */
static inline struct ow_camera_point ow_to_camera(const struct ow_tree *tree,
                                                  const struct ow_view *view, uint32_t vertex)
{
    const ow_byte *place = tree->bytes + tree->vertices_at + vertex * OW_VERTEX_BYTES;
    return ow_lattice_to_camera(view, ow_read_i16(place, 0), ow_read_i16(place, 2),
                                ow_read_i16(place, 4));
}

/* How far from the axis a point at depth z may lie without being clipped. */
static inline int64_t ow_reach(const struct ow_view *view, int32_t z)
{
    return view->projection == OW_PERSPECTIVE ? ((int64_t)z * view->limit) >> 16 : view->limit;
}

/* How far on the kept side of the cutting plane, 20 fraction bits: below 2^56. */
static inline int64_t ow_kept_by(const struct ow_view *view, int32_t x, int32_t y, int32_t z)
{
    return (int64_t)view->cut_q20[0] * x + (int64_t)view->cut_q20[1] * y +
           (int64_t)view->cut_q20[2] * z + view->cut_offset;
}

static inline bool ow_is_inside(const struct ow_view *view, struct ow_camera_point p)
{
    if (p.z < view->near_z || (view->cuts && ow_kept_by(view, p.x, p.y, p.z) < 0)) {
        return false;
    }
    int64_t reach = ow_reach(view, p.z);
    return p.x <= reach && -p.x <= reach && p.y <= reach && -p.y <= reach;
}

/* The place on the screen of a camera point times factor * 2^-shift, rounded to the nearest. */
static inline struct ow_outline_point ow_scale_to_screen(const struct ow_view *view,
                                                         struct ow_camera_point p, uint32_t factor,
                                                         int32_t shift)
{
    int64_t half = (int64_t)1 << (shift - 1);
    int32_t x = (int32_t)(((int64_t)p.x * factor + half) >> shift);
    int32_t y = (int32_t)(((int64_t)p.y * factor + half) >> shift);
    return (struct ow_outline_point){ OW_SUB / 2 * view->width + x, OW_SUB / 2 * view->height - y };
}

/* The place on the screen of a point that is inside; perspective. */
static inline struct ow_outline_point ow_to_screen_perspective(const struct ow_view *view,
                                                               struct ow_camera_point p)
{
    uint32_t zeros = ow_leading_zeros((uint32_t)p.z);
    uint32_t reciprocal = ow_reciprocal((uint32_t)p.z << zeros);
    uint32_t factor = (uint32_t)(((uint64_t)view->scale.mantissa * reciprocal) >> 32);
    return ow_scale_to_screen(view, p, factor, view->scale.exponent + 31 - (int32_t)zeros);
}

/* The same in the view's projection. */
static inline struct ow_outline_point ow_to_screen(const struct ow_view *view,
                                                   struct ow_camera_point p)
{
    return view->projection == OW_PERSPECTIVE
               ? ow_to_screen_perspective(view, p)
               : ow_scale_to_screen(view, p, view->scale.mantissa, view->scale.exponent);
}

/* A point's place on the screen, or OW_CLIP_FIRST in x. */
static inline struct ow_outline_point ow_project_point(const struct ow_view *view,
                                                       struct ow_camera_point p)
{
    return ow_is_inside(view, p) ? ow_to_screen(view, p)
                                 : (struct ow_outline_point){ OW_CLIP_FIRST, 0 };
}

/* The same of a vertex. */
static inline struct ow_outline_point ow_project_vertex(const struct ow_tree *tree,
                                                        const struct ow_view *view, uint32_t vertex)
{
    return ow_project_point(view, ow_to_camera(tree, view, vertex));
}

/*
 * Projects vertices first .. end-1 of the tree into points[first .. end-1].
 * False: none of them is OW_CLIP_FIRST.
 */
bool ow_project_vertices(const struct ow_tree *tree, const struct ow_view *view, uint32_t first,
                         uint32_t end, struct ow_outline_point *points);

#endif
