/* SPDX-License-Identifier: 0BSD */
/*
 * Stage "project" for many vertices at once: a tight loop, for workspaces whose
 * cache has an entry for each. Others project a vertex when a face asks for it.
 */
#include "ow_project.h"

enum { ROUNDING = 8 }; /* camera units: what rounding may add to a vertex between corners, by far */

/* True if no vertex of the tree is OW_CLIP_FIRST, beyond doubt. */
static bool needs_no_clipping(const struct ow_tree *tree, const struct ow_view *view)
{
    if (view->cuts) {
        return false;
    }
    for (uint32_t i = 0; i < 8; i++) { /* the corners of the box that holds all vertices */
        struct ow_camera_point p =
            ow_lattice_to_camera(view, (i & 1) ? tree->box_max[0] : tree->box_min[0],
                                 (i & 2) ? tree->box_max[1] : tree->box_min[1],
                                 (i & 4) ? tree->box_max[2] : tree->box_min[2]);
        int64_t reach = ow_reach(view, p.z) - ROUNDING;
        int64_t depth = (int64_t)p.z - ROUNDING;
        if (depth < view->near_z || p.x > reach || -p.x > reach || p.y > reach || -p.y > reach) {
            return false;
        }
    }
    return true;
}

/* Nothing to clip, perspective: the commonest case, without a branch. */
static void project_perspective(const ow_byte *place, const struct ow_view *view, uint32_t count,
                                struct ow_outline_point *points)
{
    const struct ow_view v = *view; /* a copy, so that no store can touch what the loop reads */
    const struct ow_outline_point *end = points + count;
    while (points < end) {
        *points++ = ow_to_screen_perspective(&v, ow_lattice_to_camera(&v, ow_read_i16(place, 0),
                                                                      ow_read_i16(place, 2),
                                                                      ow_read_i16(place, 4)));
        place += OW_VERTEX_BYTES;
    }
}

bool ow_project_vertices(const struct ow_tree *tree, const struct ow_view *view, uint32_t first,
                         uint32_t end, struct ow_outline_point *points)
{
    const bool clips = !needs_no_clipping(tree, view);
    if (view->projection == OW_PERSPECTIVE && !clips) {
        project_perspective(tree->bytes + tree->vertices_at + first * OW_VERTEX_BYTES, view,
                            end - first, points + first);
        return clips;
    }
    for (; first < end; first++) {
        points[first] = ow_project_vertex(tree, view, first);
    }
    return clips;
}
