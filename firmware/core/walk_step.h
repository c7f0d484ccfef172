/* SPDX-License-Identifier: 0BSD */
/*
 * The steps of the walk, for walk.c and for loops that have no room for a call
 * a node. Private to the core.
 */
#ifndef OW_WALK_STEP_H
#define OW_WALK_STEP_H

#include "ow_read.h"
#include "ow_walk.h"

/* For what is in a loop that has no room for a call. */
#if defined(__GNUC__)
#define OW_INLINE __attribute__((always_inline)) inline
#else
#define OW_INLINE inline
#endif

/* Component i of a plane's normal; i = 0 .. 2. */
static inline int64_t plane_normal(const ow_byte *bytes, uint32_t plane_at, uint32_t i)
{
    return (int32_t)(ow_read_u32(bytes, plane_at + 4 * i) << 8) >> 8;
}

static inline int64_t plane_distance(const ow_byte *bytes, uint32_t plane_at)
{
    int64_t high = (int64_t)ow_read_i8(bytes, plane_at + 7) * 256 + ow_read_u8(bytes, plane_at + 3);
    return high * 4294967296 + ow_read_u32(bytes, plane_at + 12);
}

static inline int eye_side(const struct ow_tree *tree, const struct ow_view *view,
                           uint32_t plane_at)
{
    bool perspective = view->projection == OW_PERSPECTIVE;
    int64_t sum = perspective ? plane_distance(tree->bytes, plane_at) * 256 : 0;
    for (uint32_t i = 0; i < 3; i++) {
        int64_t towards = perspective ? view->eye[i] : -view->forward[i];
        sum += plane_normal(tree->bytes, plane_at, i) * towards;
    }
    return (sum > 0) - (sum < 0);
}

static inline void push(struct ow_walk *walk, struct ow_walk_run run)
{
    walk->stack[walk->entries++] = run;
}

/* count items, the first at this offset, from the end where the walk begins. */
static inline struct ow_walk_run run_of(const struct ow_walk *walk, uint32_t first_at,
                                        uint32_t count)
{
    bool forward = walk->step == 4;
    return (struct ow_walk_run){ forward ? first_at : first_at + 4 * (count - 1), count };
}

/* The far or the near child goes first; the coplanar faces and the other one wait. */
static inline struct ow_walk_run enter_switch(struct ow_walk *walk, uint32_t children_at,
                                              uint32_t coplanar)
{
    const ow_byte *bytes = walk->tree->bytes;
    int side = eye_side(walk->tree, walk->view, children_at + OW_SWITCH_CHILDREN_BYTES);
    bool front_first = (side > 0) == (walk->direction == OW_NEAREST_FIRST);
    uint32_t first_at = children_at + (front_first ? 0 : 4);
    uint32_t second_at = children_at + (front_first ? 4 : 0);
    if (ow_read_u32(bytes, second_at) != OW_ITEM_NONE) {
        push(walk, (struct ow_walk_run){ second_at, 1 });
    }
    if (coplanar > 0) {
        push(walk, run_of(walk, children_at + OW_SWITCH_CHILDREN_BYTES + OW_SWITCH_PLANE_BYTES,
                          coplanar));
    }
    return (struct ow_walk_run){ first_at, ow_read_u32(bytes, first_at) != OW_ITEM_NONE };
}

/* The first run of what is below the node. */
static inline struct ow_walk_run enter(struct ow_walk *walk, uint32_t at)
{
    uint32_t word = ow_read_u32(walk->tree->bytes, at);
    uint32_t rest_at = at + OW_NODE_WORD_BYTES;
    if (word & OW_NODE_BOUNDED) {
        if (walk->skip.hides != NULL && walk->skip.hides(walk->skip.context, walk->tree, rest_at)) {
            walk->nodes_skipped++;
            return (struct ow_walk_run){ 0, 0 };
        }
        rest_at += OW_NODE_BOUNDS_BYTES;
    }
    uint32_t count = word >> OW_NODE_COUNT_SHIFT;
    return (word & OW_NODE_KIND_MASK) == OW_NODE_SEQUENCE ? run_of(walk, rest_at, count)
                                                          : enter_switch(walk, rest_at, count);
}

/* The first run of an object; it is empty if the object is left out. */
struct ow_walk_run ow_walk_enter_instance(struct ow_walk *walk, uint32_t number);

/* What an empty run on the stack stands for: the root, or at 0 an object's end. */
struct ow_walk_run ow_walk_take_mark(struct ow_walk *walk, uint32_t at);

/* Goes on to where the run's next item is a face. False at the walk's end. */
static OW_INLINE bool to_face(struct ow_walk *walk, struct ow_walk_run *run)
{
    for (;;) {
        while (run->left == 0) {
            if (walk->entries == 0) {
                return false;
            }
            *run = walk->stack[--walk->entries];
            if (run->left == 0) {
                *run = ow_walk_take_mark(walk, run->at);
            }
        }
        uint32_t item = ow_read_u32(walk->tree->bytes, run->at);
        if (!(item & OW_ITEM_NODE)) {
            return true;
        }
        run->at += walk->step;
        if (--run->left > 0) {
            push(walk, *run);
        }
        *run = (item & OW_ITEM_REVERSE)
                   ? ow_walk_enter_instance(walk, item >> OW_ITEM_TAG_BITS)
                   : enter(walk, walk->tree->nodes_at + 4 * (item >> OW_ITEM_TAG_BITS));
    }
}

#endif
