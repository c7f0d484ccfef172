/* SPDX-License-Identifier: 0BSD */
/*
 * Stage "walk": one explicit stack, at most one entry a level. Items are read
 * in runs; a node met in a run puts the rest of the run on the stack.
 */
#include "ow_walk.h"

#include "ow_read.h"

/*
 * A stack entry is either the rest of a run (at: the next item, left: how many
 * items) or a switch with work to do after its first child (at: its first word,
 * left: one of these marks and the second child's place).
 */
enum {
    PENDING_COPLANAR = 1 << 30,
    PENDING_SECOND = 1 << 29,
    SECOND_IS_BACK = 1 << 28,
    PENDING = PENDING_COPLANAR | PENDING_SECOND
};
_Static_assert((int)OW_NODE_MAX_ITEMS < (int)SECOND_IS_BACK,
               "a run's length never looks like a mark");

uint32_t ow_walk_stack_bytes(const struct ow_tree *tree)
{
    return tree->depth * (uint32_t)sizeof(struct ow_walk_entry);
}

/* Component i of a plane's normal; i = 0 .. 2. */
static int64_t plane_normal(const uint8_t *bytes, uint32_t plane_at, uint32_t i)
{
    return (int32_t)(ow_read_u32(bytes, plane_at + 4 * i) << 8) >> 8;
}

static int64_t plane_distance(const uint8_t *bytes, uint32_t plane_at)
{
    int64_t high = (int64_t)ow_read_i8(bytes, plane_at + 7) * 256 + ow_read_u8(bytes, plane_at + 3);
    return high * 4294967296 + ow_read_u32(bytes, plane_at + 12);
}

int ow_eye_side(const struct ow_tree *tree, const struct ow_view *view, uint32_t plane_at)
{
    bool perspective = view->projection == OW_PERSPECTIVE;
    int64_t sum = perspective ? plane_distance(tree->bytes, plane_at) * 256 : 0;
    for (uint32_t i = 0; i < 3; i++) {
        int64_t towards = perspective ? view->eye[i] : -view->forward[i];
        sum += plane_normal(tree->bytes, plane_at, i) * towards;
    }
    return (sum > 0) - (sum < 0);
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
    const uint8_t *bytes = tree->bytes;
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

/* A node's first word, and where what follows word and bounds begins. */
static uint32_t node_word(const uint8_t *bytes, uint32_t at, uint32_t *rest_at)
{
    uint32_t word = ow_read_u32(bytes, at);
    *rest_at = at + OW_NODE_WORD_BYTES + ((word & OW_NODE_BOUNDED) ? OW_NODE_BOUNDS_BYTES : 0);
    return word;
}

static void run(struct ow_walk *walk, uint32_t first_at, uint32_t count)
{
    uint32_t last_at = first_at + 4 * (count - 1);
    walk->run_at = walk->direction == OW_FARTHEST_FIRST ? first_at : last_at;
    walk->run_left = count;
}

/* One of a switch's children, 0 front and 1 back, as a run of one item; none: an empty run. */
static void run_child(struct ow_walk *walk, uint32_t children_at, uint32_t child)
{
    uint32_t at = children_at + 4 * child;
    walk->run_at = at;
    walk->run_left = ow_read_u32(walk->tree->bytes, at) != OW_ITEM_NONE;
}

static void push(struct ow_walk *walk, uint32_t at, uint32_t left)
{
    walk->stack[walk->entries++] = (struct ow_walk_entry){ at, left };
}

static void enter(struct ow_walk *walk, uint32_t at)
{
    uint32_t rest_at;
    uint32_t word = node_word(walk->tree->bytes, at, &rest_at);
    if ((word & OW_NODE_BOUNDED) && walk->skip.hides != NULL &&
        walk->skip.hides(walk->skip.context, walk->tree, at + OW_NODE_WORD_BYTES)) {
        walk->nodes_skipped++;
        walk->run_left = 0;
        return;
    }
    if ((word & OW_NODE_KIND_MASK) == OW_NODE_SEQUENCE) {
        run(walk, rest_at, word >> OW_NODE_COUNT_SHIFT);
        return;
    }
    int side = ow_eye_side(walk->tree, walk->view, rest_at + OW_SWITCH_CHILDREN_BYTES);
    bool front_first = (side > 0) == (walk->direction == OW_NEAREST_FIRST);
    push(walk, at, PENDING_COPLANAR | (front_first ? SECOND_IS_BACK : 0));
    run_child(walk, rest_at, front_first ? 0 : 1);
}

enum ow_status ow_walk_begin(struct ow_walk *walk, const struct ow_tree *tree,
                             const struct ow_view *view, enum ow_direction direction,
                             enum ow_cull cull, struct ow_walk_entry *stack)
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
    walk->direction = direction;
    walk->fronts_only = cull == OW_CULL_BACK;
    walk->reject_backs = !outline_decides;
    make_facing(walk, view);
    walk->run_left = 0;
    push(walk, tree->nodes_at, 0); /* a rest of no items: the root is entered first */
    return OW_OK;
}

/* Goes on with what the top of the stack says. */
static void resume(struct ow_walk *walk)
{
    struct ow_walk_entry entry = walk->stack[--walk->entries];
    if (!(entry.left & PENDING)) {
        if (entry.left == 0) {
            enter(walk, entry.at);
        } else {
            walk->run_at = entry.at;
            walk->run_left = entry.left;
        }
        return;
    }
    uint32_t rest_at;
    uint32_t word = node_word(walk->tree->bytes, entry.at, &rest_at);
    if (entry.left & PENDING_COPLANAR) {
        push(walk, entry.at, PENDING_SECOND | (entry.left & SECOND_IS_BACK));
        run(walk, rest_at + OW_SWITCH_CHILDREN_BYTES + OW_SWITCH_PLANE_BYTES,
            word >> OW_NODE_COUNT_SHIFT);
    } else {
        run_child(walk, rest_at, (entry.left & SECOND_IS_BACK) ? 1 : 0);
    }
}

bool ow_walk_next(struct ow_walk *walk, struct ow_face *face)
{
    const struct ow_tree *tree = walk->tree;
    const uint8_t *bytes = tree->bytes;
    uint32_t step = walk->direction == OW_FARTHEST_FIRST ? 4 : 0u - 4;
    for (;;) {
        uint32_t at = walk->run_at;
        for (uint32_t left = walk->run_left; left > 0; left--) {
            uint32_t item = ow_read_u32(bytes, at);
            uint32_t tag = item & 3;
            at += step;
            if (tag == OW_ITEM_NODE) {
                if (left > 1) {
                    push(walk, at, left - 1);
                }
                enter(walk, tree->nodes_at + 4 * (item >> OW_ITEM_TAG_BITS));
                at = walk->run_at;
                left = walk->run_left + 1;
                continue;
            }
            uint32_t polygon_at = tree->polygons_at + (item >> OW_ITEM_TAG_BITS << 1);
            walk->faces_met++;
            if ((tag == OW_ITEM_REVERSE && walk->fronts_only) ||
                (walk->reject_backs && looks_away(walk, polygon_at, tag == OW_ITEM_REVERSE))) {
                continue;
            }
            face->at = polygon_at;
            face->reverse = tag == OW_ITEM_REVERSE;
            walk->run_at = at;
            walk->run_left = left - 1;
            return true;
        }
        walk->run_left = 0;
        if (walk->entries == 0) {
            return false;
        }
        resume(walk);
    }
}
