/* SPDX-License-Identifier: 0BSD */
/*
 * Skipping: a bounded node that is out of view, faces away or is covered goes
 * in one test. The walk works without it; a board that lacks room leaves it out.
 */
#ifndef OW_SKIP_H
#define OW_SKIP_H

#include <stdbool.h>
#include <stdint.h>

#include "ow_scan.h"
#include "ow_view.h"

/* A node's bounds as they are stored: lattice steps; axis and cosine 127 for 1. */
struct ow_bounds {
    int32_t centre[3];
    int32_t radius;
    int32_t axis[3];
    int32_t cosine; /* -128: the faces look everywhere */
};

struct ow_frame;

struct ow_bounds ow_read_bounds(const struct ow_tree *tree, uint32_t at);

/* The view made ready for tests of spheres: the frustum's sides. */
struct ow_frustum {
    const struct ow_view *view;
    uint32_t tangent_q16[2]; /* half the picture's width and height at distance 1 */
    uint32_t secant_q16[2];  /* sqrt(1 + tangent^2), rounded up */
};

void ow_frustum_make(struct ow_frustum *frustum, const struct ow_view *view);

/*
 * The window's pixels that the sphere may reach. False: it is out of view for
 * sure. Everything is rounded outwards.
 */
bool ow_sphere_box(const struct ow_frustum *frustum, const struct ow_bounds *bounds,
                   const struct ow_window *window, struct ow_box *box);

/* True if every face within the bounds surely looks away from the eye. */
bool ow_cone_looks_away(const struct ow_view *view, const struct ow_bounds *bounds);

/* How a frame skips: begin makes ready; hides tells whether all below the bounds is unseen. */
struct ow_skipping {
    void (*begin)(struct ow_frame *frame);
    bool (*hides)(void *frame, const struct ow_tree *tree, uint32_t bounds_at);
};
extern const struct ow_skipping ow_skipping;

#endif
