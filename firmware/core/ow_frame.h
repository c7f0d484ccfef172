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

/* Scan line order: a face that touches the view; its number is its place in the list. */
struct ow_listed_face {
    uint32_t at;
    uint32_t next; /* face of the line's list or of those at hand */
    uint16_t end_line;
    bool reverse;
    bool painted;
};

/* How faces come to the surface where filling their outlines is not all. */
struct ow_face_kind {
    const struct ow_surface_kind *surface; /* NULL: the order's */
    void (*draw)(struct ow_frame *frame);  /* draws frame->face */
    /* As ow_outline_box, of frame->face's outline; NULL: that. */
    bool (*box)(const struct ow_frame *frame, struct ow_box *box);
    /* True if the edge from corner i of frame->face's outline is not drawn; NULL: never asked. */
    bool (*leaves_out)(const struct ow_frame *frame, uint32_t i);
};

/* Scan line order: lists the faces that touch the view; draws lines from the list. */
struct ow_line_order {
    enum ow_status (*begin)(struct ow_frame *frame);
    enum ow_status (*draw)(struct ow_frame *frame, const struct ow_target *target);
};
extern const struct ow_line_order ow_line_order;

/* Instances: what draw.c and scan_lines.c ask of them. */
struct ow_instancing {
    uint32_t state_bytes; /* in the workspace */
    /* When the shader is made and the tree's vertices are projected. */
    void (*begin)(struct ow_frame *frame);
    /* The walk comes to an instance, and leaves it; context: the frame. */
    bool (*enter)(void *context, uint32_t number, uint32_t *node_at);
    void (*leave)(void *context);
    /* Into the space that frame->face is in. */
    void (*go_to_face)(struct ow_frame *frame);
};
extern const struct ow_instancing ow_instancing;

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
    bool clips;   /* of the projected vertices, an object's too, some may be OW_CLIP_FIRST */
    bool out_of_budget;
    uint32_t dropped;
    uint32_t instance;                /* in whose space all is done, from 1; 0: the tree\'s */
    uint32_t instances_outside;       /* of their region */
    const struct ow_face_kind *faces; /* NULL: they are filled */
    uint32_t visited;                 /* faces that walks came by */
    uint32_t skipped;                 /* nodes that walks left out */
    uint32_t painted;                 /* faces of which a pixel was written */
    uint32_t background;              /* packed */
    const struct ow_look *look;
    /* Scan line order. */
    struct ow_target line; /* the line being drawn */
    uint32_t lines_done;   /* the first line not drawn or passed over */
    uint32_t listed;       /* faces in the list */
    uint32_t unlisted;     /* faces that found no room in it */
    uint32_t at_hand;      /* the nearest listed face that touches the line */
    struct ow_surface surface;
};

/* Makes frame->face's outline in workspace->outline, not shaded yet. False if there is none. */
bool ow_face_project(struct ow_frame *frame);

/*
 * Makes frame->face's outline in workspace->outline and the pixels of the
 * window that it may hold. False if there are none.
 */
bool ow_face_outline(struct ow_frame *frame, struct ow_box *box);

/* Draws frame->face within the window. True if a pixel was written. */
bool ow_draw_face(struct ow_frame *frame);

/*
 * Draws the walk to its end, small triangles the fast way. The workspace has a point for every
 * vertex and OW_SMALL_SPANS spans, the rule is positive winding, there is no budget.
 */
enum { OW_SMALL_SPANS = 16 };
void ow_draw_small(struct ow_frame *frame);

/* The frame's sink: shades the face, unless that was done, and gives its spans to the surface. */
void ow_paint_spans(struct ow_span_sink *sink);

/* Aims the frame at a band or line. */
void ow_frame_aim(struct ow_frame *frame, const struct ow_surface_kind *kind,
                  const struct ow_target *target);

/* Draws all faces of the walk, begun anew, into what the frame is aimed at. */
void ow_frame_walk(struct ow_frame *frame);

/* True if this look can be drawn with this workspace. */
bool ow_look_fits(const struct ow_look *look, const struct ow_workspace *workspace);

#endif
