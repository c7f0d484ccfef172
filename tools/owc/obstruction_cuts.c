/* SPDX-License-Identifier: 0BSD */
/* Cutting faces, and sharing the parts between a polygon's two sides. */
#include "obstruction_cuts.h"

#include <stdlib.h>

#include "ow_blob.h"
#include "tools/common/xalloc.h"

/* A part, or MESH_NONE if it only runs to and fro along one line. */
static uint32_t with_area(const struct pieces *pieces, uint32_t number)
{
    const struct piece *piece = &pieces->all[number];
    const uint32_t *edges = pieces->edges + piece->first;
    bool flat = piece->count < 2 || (piece->count == 2 && edges[0] >> 1 == edges[1] >> 1);
    return flat ? MESH_NONE : number;
}

void obstruction_cut(struct obstruction_cuts *cuts, struct arrangement *arrangement,
                     struct pieces *pieces, tree_item face, uint32_t plane, tree_item parts[2])
{
    uint32_t piece = tree_item_value(face);
    uint32_t found = map64_put(&cuts->by_plane, map64_key(piece, plane), (uint32_t)cuts->count);
    if (found == cuts->count) {
        uint32_t made[2];
        split_piece(&cuts->splitter, arrangement, pieces, piece, plane, &made[0], &made[1]);
        cuts->parts = xgrow(cuts->parts, &cuts->capacity, cuts->count + 1, sizeof *cuts->parts);
        cuts->parts[cuts->count++] = (struct obstruction_parts){ { with_area(pieces, made[0]),
                                                                   with_area(pieces, made[1]) } };
    }
    map64_put(&cuts->by_side, face, found);
    for (int k = 0; k < 2; k++) {
        uint32_t part = cuts->parts[found].piece[k];
        parts[k] = part == MESH_NONE ? OW_ITEM_NONE : tree_item_of(tree_item_tag(face), part);
    }
}

/* ---- sharing ---- */

struct sharer {
    const struct obstruction_cuts *cuts;
    tree_item *stack;
    size_t capacity;
    tree_item *items; /* the tree's new ones */
    size_t count;
    size_t item_capacity;
};

static void add_item(struct sharer *s, tree_item item)
{
    s->items = xgrow(s->items, &s->item_capacity, s->count + 1, sizeof *s->items);
    s->items[s->count++] = item;
}

/* The other side's parts of a face, or MAP64_NONE. */
static uint32_t other_parts(const struct sharer *s, tree_item face)
{
    uint32_t tag = tree_item_tag(face) == OW_ITEM_FACE ? OW_ITEM_REVERSE : OW_ITEM_FACE;
    return map64_get(&s->cuts->by_side, tree_item_of(tag, tree_item_value(face)));
}

/* Adds an item, or the parts that the other side of the face has been cut into. */
static void add_shared(struct sharer *s, tree_item item)
{
    size_t length = 0;
    s->stack = xgrow(s->stack, &s->capacity, 1, sizeof *s->stack);
    s->stack[length++] = item;
    while (length > 0) {
        item = s->stack[--length];
        uint32_t found = tree_item_tag(item) == OW_ITEM_NODE ? MAP64_NONE : other_parts(s, item);
        if (found == MAP64_NONE) {
            add_item(s, item);
            continue;
        }
        for (int k = 1; k >= 0; k--) {
            uint32_t part = s->cuts->parts[found].piece[k];
            if (part != MESH_NONE) {
                s->stack = xgrow(s->stack, &s->capacity, length + 1, sizeof *s->stack);
                s->stack[length++] = tree_item_of(tree_item_tag(item), part);
            }
        }
    }
}

/* A switch's child: a face that is shared in parts becomes a sequence of them. */
static tree_item share_child(struct sharer *s, struct tree *tree, tree_item child)
{
    if (child == OW_ITEM_NONE || tree_item_tag(child) == OW_ITEM_NODE ||
        other_parts(s, child) == MAP64_NONE) {
        return child;
    }
    size_t first = s->count;
    uint32_t node = tree_add_node(tree, MESH_NONE);
    add_shared(s, child);
    tree->nodes[node].first = first;
    tree->nodes[node].count = (uint32_t)(s->count - first);
    return tree_item_of(OW_ITEM_NODE, node);
}

void obstruction_cuts_share(const struct obstruction_cuts *cuts, struct tree *tree)
{
    struct sharer s = { .cuts = cuts };
    uint32_t count = tree->node_count;
    for (uint32_t i = 0; i < count; i++) {
        size_t first = s.count;
        for (uint32_t k = 0; k < tree->nodes[i].count; k++) {
            add_shared(&s, tree->items[tree->nodes[i].first + k]);
        }
        tree->nodes[i].first = first;
        tree->nodes[i].count = (uint32_t)(s.count - first);
        tree_item front = share_child(&s, tree, tree->nodes[i].front);
        tree_item back = share_child(&s, tree, tree->nodes[i].back);
        tree->nodes[i].front = front;
        tree->nodes[i].back = back;
    }
    tree->root = share_child(&s, tree, tree->root);
    free(tree->items);
    free(s.stack);
    tree->items = s.items;
    tree->item_count = s.count;
    tree->item_capacity = s.item_capacity;
}

void obstruction_cuts_free(struct obstruction_cuts *cuts)
{
    splitter_free(&cuts->splitter);
    map64_free(&cuts->by_plane);
    map64_free(&cuts->by_side);
    free(cuts->parts);
    *cuts = (struct obstruction_cuts){ 0 };
}
