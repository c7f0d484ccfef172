/* SPDX-License-Identifier: 0BSD */
/*
 * Stage "clip": an outline against the near plane and the guard band only.
 * The screen's own borders cost nothing here: the scan cuts spans there.
 */
#ifndef OW_CLIP_H
#define OW_CLIP_H

#include <stdint.h>

#include "ow_project.h"

/*
 * Clips the count points in points[0] (Sutherland-Hodgman, one plane after the
 * other), using points[1] as the second buffer; both hold capacity points.
 * The result lies in points[*which]. A new vertex is computed from the kept
 * endpoint to the cut one, so polygons that share the edge get the same.
 * Returns the count of points left, 0 if none or, with *overflow set, if
 * capacity did not suffice.
 */
uint32_t ow_clip(const struct ow_view *view, struct ow_camera_point *const points[2],
                 uint32_t count, uint32_t capacity, uint32_t *which, bool *overflow);

#endif
