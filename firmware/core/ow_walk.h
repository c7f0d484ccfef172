/* SPDX-License-Identifier: 0BSD */
/*
 * The walk: faces of a tree in an order that is right for one view, farthest
 * or nearest first [FKN80; GC91; CW96]. Iterative, with the caller's stack.
 */
#ifndef OW_WALK_H
#define OW_WALK_H

#include <stdbool.h>
#include <stdint.h>

#include "ow_tree.h"
#include "ow_view.h"

enum ow_direction {
    OW_FARTHEST_FIRST, /* a face comes after all faces that it can hide nothing of */
    OW_NEAREST_FIRST   /* the exact reverse */
};

enum ow_cull {
    OW_CULL_AUTO, /* as the tree was built: one-sided trees like OW_CULL_BACK, others both sides */
    OW_CULL_BACK, /* only polygons that show their front */
    OW_CULL_NONE  /* both sides; needs a two-sided or switch-only tree */
};

/* One step's result: a polygon record and which of its sides looks at the eye. */
struct ow_face {
    uint32_t at;  /* byte offset of the polygon record in the blob */
    bool reverse; /* the polygon's back: its outline is to be read backwards */
};

/* Items that are to be met: the next one's byte offset in the blob, and how many are left. */
struct ow_walk_run {
    uint32_t at;
    uint32_t left;
};

/*
 * Asked at each bounded node: true leaves out the node and all below it.
 * bounds_at: byte offset of the node's bounds.
 */
struct ow_walk_skip {
    bool (*hides)(void *context, const struct ow_tree *tree, uint32_t bounds_at);
    void *context;
};

/*
 * Asked at each instance: false leaves it out; otherwise *node_at is the byte
 * offset of the object's root, and ow_walk_see_by was called with the object's
 * view. leave takes that back.
 */
struct ow_walk_instances {
    bool (*enter)(void *context, uint32_t number, uint32_t *node_at);
    void (*leave)(void *context);
    void *context;
};

/* Private to walk.c, here so that the caller can place it. */
struct ow_walk {
    const struct ow_tree *tree;
    const struct ow_view *view;
    struct ow_walk_run *stack;
    uint32_t entries;       /* on the stack */
    uint32_t step;          /* from an item to the next, bytes; modulo 2^32 */
    struct ow_walk_run run; /* the items being read */
    uint32_t faces_met;     /* all faces the walk came by, rejected ones included */
    uint32_t nodes_skipped;
    struct ow_walk_instances instances; /* likewise; enter NULL: all are left out */
    struct ow_walk_skip skip; /* set between begin and the first next; hides NULL: never */
    enum ow_direction direction;
    bool fronts_only;  /* skip OW_ITEM_REVERSE */
    bool reject_backs; /* skip faces that surely look away */
    int32_t
        towards[3]; /* the eye, lattice steps; parallel: the direction to it, 20 fraction bits */
    int32_t from_vertex; /* mask: all ones if a vertex is to be subtracted from towards */
    int32_t doubt;       /* a face looks away for sure beyond this */
};

/* Bytes of stack that a walk of this tree needs: two entries a level, one for an instance. */
uint32_t ow_walk_stack_bytes(const struct ow_tree *tree);

/*
 * Starts a walk. stack: ow_walk_stack_bytes(tree), kept until the walk ends.
 * Errors: OW_SIDES where the tree cannot order what cull asks for.
 */
enum ow_status ow_walk_begin(struct ow_walk *walk, const struct ow_tree *tree,
                             const struct ow_view *view, enum ow_direction direction,
                             enum ow_cull cull, struct ow_walk_run *stack);

/* From now on the eye is this view's. */
void ow_walk_see_by(struct ow_walk *walk, const struct ow_view *view);

/*
 * The walk in the parts that ow_walk_next is made of, for loops that draw many
 * faces at once: ow_walk_to_face goes on to where the first item of walk->run is
 * a face (false at the end); the loop takes items while they are faces, counts
 * them in faces_met, and puts back into walk->run what is left of it.
 * ow_walk_face tells an item's face; false if it surely cannot be seen.
 */
bool ow_walk_to_face(struct ow_walk *walk);
bool ow_walk_face(struct ow_walk *walk, uint32_t item, struct ow_face *face);

/*
 * The next face. Faces that look away are left out where their stored normal
 * shows it beyond doubt; the others' outlines decide when they are scanned.
 * With OW_CULL_NONE on a one-sided tree no face is left out, and the outline
 * decides which side is seen. False at the end.
 */
bool ow_walk_next(struct ow_walk *walk, struct ow_face *face);

/*
 * On which side of a plane the eye (parallel projection: the direction to it)
 * lies: 1 front, -1 back, 0 on it. plane_at: byte offset of a switch's plane.
 * Exact: 24-bit normals against 30-bit eyes fit 64 bits.
 */
int ow_eye_side(const struct ow_tree *tree, const struct ow_view *view, uint32_t plane_at);

#endif
