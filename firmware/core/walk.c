/* SPDX-License-Identifier: 0BSD */
/*
 * Stage "walk": one explicit stack of runs of items that are still to come. A
 * node met in a run puts the rest of the run there; a switch puts its coplanar
 * faces and its second child there: two entries a level at most. An instance
 * puts a mark there, an empty run at 0, which ends it.
 */
#include "walk_step.h"

enum { ENTRIES_A_LEVEL = 2 };

uint32_t ow_walk_stack_bytes(const struct ow_tree *tree)
{
    uint32_t entries = tree->depth * ENTRIES_A_LEVEL + (tree->instance_count > 0);
    return entries * (uint32_t)sizeof(struct ow_walk_run);
}

int ow_eye_side(const struct ow_tree *tree, const struct ow_view *view, uint32_t plane_at)
{
    return eye_side(tree, view, plane_at);
}

/*
 * Prepares looks_away. A stored normal is 127 long, rounded by at most 1/2 in
 * each component, and true to a quarter of a degree (127/229) where the outline
 * is not marked uneven: with all rounding of the eye and the vertex the sum of
 * products is off by less than 1.25 times the sum of the sizes, taken here at
 * their largest in the cube, and four lattice steps.
 */
static void make_facing(struct ow_walk *walk, const struct ow_view *view)
{
    bool perspective = view->projection == OW_PERSPECTIVE;
    int32_t sizes = 0;
    for (int i = 0; i < 3; i++) {
        int32_t towards = perspective ? view->eye[i] >> 8 : -(view->forward[i] >> 10);
        walk->towards[i] = towards;
        sizes += (towards < 0 ? -towards : towards) + (perspective ? OW_LATTICE_MAX + 1 : 1);
    }
    walk->from_vertex = perspective ? -1 : 0;
    walk->doubt = sizes + sizes / 4 + (perspective ? 4 * 127 : 0);
}
_Static_assert(3LL * 127 * ((OW_EYE_MAX >> 8) + OW_LATTICE_MAX + 1) < INT32_MAX,
               "looks_away's sum fits 32 bits");

/* True if the face at this record surely looks away from the eye. */
static inline bool looks_away(const struct ow_walk *walk, uint32_t at, bool reverse)
{
    const struct ow_tree *tree = walk->tree;
    const ow_byte *bytes = tree->bytes;
    uint32_t corner_at = at + tree->corners_in_record;
    uint32_t corner = (tree->flags & OW_TREE_INDEX32) ? ow_read_u32(bytes, corner_at)
                                                      : ow_read_u16(bytes, corner_at);
    uint32_t vertex_at = tree->vertices_at + corner * OW_VERTEX_BYTES;
    int32_t mask = walk->from_vertex;
    int32_t x = walk->towards[0] - (ow_read_i16(bytes, vertex_at) & mask);
    int32_t y = walk->towards[1] - (ow_read_i16(bytes, vertex_at + 2) & mask);
    int32_t z = walk->towards[2] - (ow_read_i16(bytes, vertex_at + 4) & mask);
    int32_t sum = ow_read_i8(bytes, at + 1) * x + ow_read_i8(bytes, at + 2) * y +
                  ow_read_i8(bytes, at + 3) * z;
    sum = reverse ? -sum : sum;
    return sum < -walk->doubt && !(ow_read_u16(bytes, at + 4) & OW_POLYGON_UNEVEN);
}

enum ow_status ow_walk_begin(struct ow_walk *walk, const struct ow_tree *tree,
                             const struct ow_view *view, enum ow_direction direction,
                             enum ow_cull cull, struct ow_walk_run *stack)
{
    bool two_sided = (tree->flags & OW_TREE_TWO_SIDED) != 0;
    bool outline_decides = cull == OW_CULL_NONE && !two_sided;
    if (outline_decides && !(tree->flags & OW_TREE_SWITCH_ONLY)) {
        return OW_SIDES;
    }
    walk->tree = tree;
    walk->view = view;
    walk->stack = stack;
    walk->entries = 0;
    walk->faces_met = 0;
    walk->nodes_skipped = 0;
    walk->skip = (struct ow_walk_skip){ NULL, NULL };
    walk->instances = (struct ow_walk_instances){ NULL, NULL, NULL };
    walk->direction = direction;
    walk->step = direction == OW_FARTHEST_FIRST ? 4 : 0u - 4;
    walk->fronts_only = cull == OW_CULL_BACK;
    walk->reject_backs = !outline_decides;
    make_facing(walk, view);
    walk->run = (struct ow_walk_run){ 0, 0 };
    push(walk, (struct ow_walk_run){ tree->nodes_at, 0 });
    return OW_OK;
}

void ow_walk_see_by(struct ow_walk *walk, const struct ow_view *view)
{
    walk->view = view;
    make_facing(walk, view);
}

struct ow_walk_run ow_walk_enter_instance(struct ow_walk *walk, uint32_t number)
{
    uint32_t node_at;
    if (walk->instances.enter == NULL ||
        !walk->instances.enter(walk->instances.context, number, &node_at)) {
        return (struct ow_walk_run){ 0, 0 };
    }
    push(walk, (struct ow_walk_run){ 0, 0 });
    return enter(walk, node_at);
}

struct ow_walk_run ow_walk_take_mark(struct ow_walk *walk, uint32_t at)
{
    if (at != 0) {
        return enter(walk, at);
    }
    walk->instances.leave(walk->instances.context);
    return (struct ow_walk_run){ 0, 0 };
}

bool ow_walk_to_face(struct ow_walk *walk)
{
    struct ow_walk_run run = walk->run;
    bool more = to_face(walk, &run);
    walk->run = run;
    return more;
}

bool ow_walk_face(struct ow_walk *walk, uint32_t item, struct ow_face *face)
{
    face->at = walk->tree->polygons_at + (item >> OW_ITEM_TAG_BITS << 1);
    face->reverse = (item & 3) == OW_ITEM_REVERSE;
    return !(face->reverse && walk->fronts_only) &&
           !(walk->reject_backs && looks_away(walk, face->at, face->reverse));
}

bool ow_walk_next(struct ow_walk *walk, struct ow_face *face)
{
    while (ow_walk_to_face(walk)) {
        uint32_t item = ow_read_u32(walk->tree->bytes, walk->run.at);
        walk->run.at += walk->step;
        walk->run.left--;
        walk->faces_met++;
        if (ow_walk_face(walk, item, face)) {
            return true;
        }
    }
    return false;
}
