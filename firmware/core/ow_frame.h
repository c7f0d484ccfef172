/* SPDX-License-Identifier: 0BSD */
/* One call of ow_draw. It lies in the workspace, not on the stack. */
#ifndef OW_FRAME_H
#define OW_FRAME_H

#include <stdbool.h>
#include <stdint.h>

#include "ow_draw.h"
#include "ow_gradient.h"
#include "ow_scan.h"
#include "ow_shade.h"
#include "ow_skip.h"
#include "ow_surface.h"

/* What one call of ow_draw works with. */
struct ow_frame {
    struct ow_span_sink sink; /* first: the frame is found from its sink */
    const struct ow_surface_kind *kind;
    struct ow_shader shader;
    struct ow_walk walk;
    struct ow_face face;
    uint32_t points; /* of its outline */
    bool shaded;     /* the surface has this face's colour or gradient */
    bool clipped;    /* the clipper has made the lights of its corners */
    struct ow_gradient gradient;
    struct ow_frustum frustum;
    const struct ow_tree *tree;
    const struct ow_view *view;
    struct ow_workspace *workspace;
    struct ow_window window;
    enum ow_winding rule;
    uint32_t tag; /* the stamp in bits 24-31 */
    uint32_t dropped;
    struct ow_surface surface;
};

#endif
