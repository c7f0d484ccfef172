/* SPDX-License-Identifier: 0BSD */
/*
 * On-line insertion. A piece sinks from the root: to the side of the plane on
 * which it lies, to both sides in two parts where the plane cuts it, into the
 * node where it lies in the plane. Where nothing is yet it becomes a node.
 */
#include "online.h"

#include <stdlib.h>

#include "parts.h"
#include "tools/common/fail.h"
#include "tools/common/xalloc.h"

/* A part of the polygon that is being inserted, and a node that it has come to. */
struct online_task {
    uint32_t piece;
    uint32_t node;
};

void online_begin(struct online *online, struct arrangement *arrangement, struct pieces *pieces)
{
    *online = (struct online){ .arrangement = arrangement, .pieces = pieces };
}

void online_free(struct online *online)
{
    free(online->nodes);
    free(online->faces);
    free(online->tasks);
    splitter_free(&online->splitter);
    *online = (struct online){ 0 };
}

uint32_t online_add_node(struct online *online, uint32_t plane)
{
    if (online->node_count == MESH_NONE - 1) {
        fail(FAIL_INPUT, NULL, 0, "the tree has more than %u nodes", MESH_NONE - 1);
    }
    online->nodes = xgrow(online->nodes, &online->node_capacity, (size_t)online->node_count + 1,
                          sizeof *online->nodes);
    online->nodes[online->node_count] =
        (struct online_node){ plane, MESH_NONE, MESH_NONE, MESH_NONE, MESH_NONE };
    return online->node_count++;
}

void online_add_face(struct online *online, uint32_t number, uint32_t piece)
{
    struct online_node *node = &online->nodes[number];
    uint32_t face = online->face_count++;
    online->faces =
        xgrow(online->faces, &online->face_capacity, online->face_count, sizeof *online->faces);
    online->faces[face] = (struct online_face){ piece, MESH_NONE };
    if (node->last == MESH_NONE) {
        node->first = face;
    } else {
        online->faces[node->last].next = face;
    }
    node->last = face;
}

static void sink(struct online *o, size_t *waiting, uint32_t piece, uint32_t parent, bool front)
{
    uint32_t child = front ? o->nodes[parent].front : o->nodes[parent].back;
    if (piece == MESH_NONE) {
        return;
    }
    if (child != MESH_NONE) {
        o->tasks = xgrow(o->tasks, &o->task_capacity, *waiting + 1, sizeof *o->tasks);
        o->tasks[(*waiting)++] = (struct online_task){ piece, child };
        return;
    }
    child = online_add_node(o, o->pieces->all[piece].record);
    online_add_face(o, child, piece);
    if (front) {
        o->nodes[parent].front = child;
    } else {
        o->nodes[parent].back = child;
    }
}

static void pass_node(struct online *o, size_t *waiting, struct online_task task)
{
    uint32_t plane = o->nodes[task.node].plane;
    uint32_t parts[2];
    o->relations++;
    switch (split_side_of(o->arrangement, o->pieces, task.piece, plane)) {
    case SPLIT_ON:
        online_add_face(o, task.node, task.piece);
        break;
    case SPLIT_FRONT:
        sink(o, waiting, task.piece, task.node, true);
        break;
    case SPLIT_BACK:
        sink(o, waiting, task.piece, task.node, false);
        break;
    case SPLIT_ACROSS:
        split_into_parts(&o->splitter, o->arrangement, o->pieces, task.piece, plane, parts);
        sink(o, waiting, parts[0], task.node, true);
        sink(o, waiting, parts[1], task.node, false);
        break;
    }
}

void online_insert(struct online *o, uint32_t piece)
{
    if (o->node_count == 0) {
        online_add_face(o, online_add_node(o, o->pieces->all[piece].record), piece);
        return;
    }
    size_t waiting = 1;
    o->tasks = xgrow(o->tasks, &o->task_capacity, 1, sizeof *o->tasks);
    o->tasks[0] = (struct online_task){ piece, 0 };
    while (waiting > 0) {
        pass_node(o, &waiting, o->tasks[--waiting]);
    }
}

/* ---- the tree as it is written ---- */

static void add_faces(struct tree *tree, const struct online *online, uint32_t node,
                      const struct online_node *from, bool two_sided)
{
    for (uint32_t i = from->first; i != MESH_NONE; i = online->faces[i].next) {
        tree_add_item(tree, node, tree_item_of(OW_ITEM_FACE, online->faces[i].piece));
        if (two_sided) {
            tree_add_item(tree, node, tree_item_of(OW_ITEM_REVERSE, online->faces[i].piece));
        }
    }
}

/* What a node becomes: a face, the two sides of one, or a switch. */
static tree_item convert(struct tree *tree, const struct online *online,
                         const struct online_node *from, bool two_sided)
{
    bool is_leaf = from->front == MESH_NONE && from->back == MESH_NONE;
    bool one_face = from->first != MESH_NONE && from->first == from->last;
    if (is_leaf && one_face && !two_sided) {
        return tree_item_of(OW_ITEM_FACE, online->faces[from->first].piece);
    }
    uint32_t node = tree_add_node(tree, is_leaf && one_face ? MESH_NONE : from->plane);
    add_faces(tree, online, node, from, two_sided);
    return tree_item_of(OW_ITEM_NODE, node);
}

/* Parents come before their children in online->nodes, so that the same order serves the tree. */
void online_to_tree(struct tree *tree, const struct online *online, bool two_sided)
{
    uint64_t relations = online->relations;
    *tree = (struct tree){ .root = OW_ITEM_NONE, .relations = relations };
    tree_item *items = xalloc(online->node_count, sizeof *items);
    for (uint32_t i = 0; i < online->node_count; i++) {
        items[i] = convert(tree, online, &online->nodes[i], two_sided);
    }
    for (uint32_t i = 0; i < online->node_count; i++) {
        const struct online_node *from = &online->nodes[i];
        if (from->front == MESH_NONE && from->back == MESH_NONE) {
            continue;
        }
        struct tree_node *node = &tree->nodes[tree_item_value(items[i])];
        node->front = from->front == MESH_NONE ? OW_ITEM_NONE : items[from->front];
        node->back = from->back == MESH_NONE ? OW_ITEM_NONE : items[from->back];
    }
    if (online->node_count > 0) {
        tree->root = items[0];
    }
    free(items);
}

void online_build(struct tree *tree, struct arrangement *arrangement, struct pieces *pieces,
                  bool two_sided, struct progress *progress)
{
    struct online online;
    uint32_t count = pieces->count;
    online_begin(&online, arrangement, pieces);
    for (uint32_t i = 0; i < count; i++) {
        online_insert(&online, i);
        if (progress != NULL) {
            progress_show(progress, "building", i, count);
        }
    }
    online_to_tree(tree, &online, two_sided);
    online_free(&online);
}
