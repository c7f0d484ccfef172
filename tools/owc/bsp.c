/* SPDX-License-Identifier: 0BSD */
/*
 * The BSP tree. One step takes a list of pieces, makes a switch of one's
 * plane, and sorts the others into what lies on it, in front and behind,
 * cutting what lies across. The lists that wait stand on a stack, so that long
 * chains (parallel polygons) need no recursion.
 *
 * A cut piece's parts take its place in the lists, so that these keep the
 * file's order: of faces on the same plane the later one in the file wins.
 */
#include "bsp.h"

#include <stdlib.h>

#include "random.h"
#include "split.h"
#include "tools/common/xalloc.h"

struct list {
    uint32_t *pieces;
    uint32_t count;
};

/* A list that waits, and the place of its subtree. */
struct task {
    struct list list;
    uint32_t parent; /* node, or MESH_NONE for the root */
    bool front;
};

struct builder {
    struct tree *tree;
    struct arrangement *arrangement;
    struct pieces *pieces;
    const struct bsp_options *options;
    struct progress *progress;
    struct random random;
    struct splitter splitter;
    struct task *tasks;
    size_t task_count;
    size_t task_capacity;
    uint64_t placed;  /* pieces in the tree */
    uint64_t waiting; /* pieces in the lists of tasks */
};

/* What a plane would do to a list. */
struct score {
    uint32_t cuts;
    uint32_t imbalance;
    uint32_t candidate; /* place in the list */
};

/* Fewest cuts, then most balanced, then first. */
static bool is_better(const struct score *a, const struct score *b)
{
    return a->cuts != b->cuts             ? a->cuts < b->cuts
           : a->imbalance != b->imbalance ? a->imbalance < b->imbalance
                                          : a->candidate < b->candidate;
}

/* Tries a candidate; gives up once it cuts more than the best so far. */
static void try_candidate(struct builder *b, const struct list *list, uint32_t candidate,
                          struct score *best)
{
    uint32_t plane = b->pieces->all[list->pieces[candidate]].record;
    uint32_t in_front = 0;
    uint32_t behind = 0;
    struct score score = { 0, 0, candidate };
    uint32_t i = 0;
    for (; i < list->count && score.cuts <= best->cuts; i++) {
        enum split_side side = split_side_of(b->arrangement, b->pieces, list->pieces[i], plane);
        in_front += side == SPLIT_FRONT;
        behind += side == SPLIT_BACK;
        score.cuts += side == SPLIT_ACROSS;
    }
    b->tree->relations += i;
    score.imbalance = in_front > behind ? in_front - behind : behind - in_front;
    if (score.cuts <= best->cuts && is_better(&score, best)) {
        *best = score;
    }
}

static uint32_t choose(struct builder *b, const struct list *list)
{
    struct score best = { MESH_NONE, MESH_NONE, MESH_NONE };
    switch (b->options->select) {
    case BSP_FIRST:
        return 0;
    case BSP_RANDOM:
        return random_below(&b->random, list->count);
    case BSP_KEDEM:
        if (b->options->candidates < list->count) {
            for (uint32_t i = 0; i < b->options->candidates; i++) {
                try_candidate(b, list, random_below(&b->random, list->count), &best);
            }
            return best.candidate;
        }
        break;
    case BSP_EXHAUSTIVE:
        break;
    }
    for (uint32_t i = 0; i < list->count; i++) {
        try_candidate(b, list, i, &best);
    }
    return best.candidate;
}

static void add_faces(struct builder *b, uint32_t node, uint32_t piece)
{
    tree_add_item(b->tree, node, tree_item_of(OW_ITEM_FACE, piece));
    if (b->options->two_sided) {
        tree_add_item(b->tree, node, tree_item_of(OW_ITEM_REVERSE, piece));
    }
    b->placed++;
}

static void set_child(struct builder *b, const struct task *task, tree_item item)
{
    if (task->parent == MESH_NONE) {
        b->tree->root = item;
    } else if (task->front) {
        b->tree->nodes[task->parent].front = item;
    } else {
        b->tree->nodes[task->parent].back = item;
    }
}

static void push(struct builder *b, struct list list, uint32_t parent, bool front)
{
    if (list.count == 0) {
        free(list.pieces);
        return;
    }
    list.pieces = xresize(list.pieces, list.count, sizeof *list.pieces);
    b->tasks = xgrow(b->tasks, &b->task_capacity, b->task_count + 1, sizeof *b->tasks);
    b->tasks[b->task_count++] = (struct task){ list, parent, front };
    b->waiting += list.count;
}

/* Adds a piece that cutting made, unless it only runs to and fro along one line. */
static void keep(const struct pieces *pieces, struct list *list, uint32_t number)
{
    const struct piece *piece = &pieces->all[number];
    const uint32_t *edges = pieces->edges + piece->first;
    if (piece->count > 2 || (piece->count == 2 && edges[0] >> 1 != edges[1] >> 1)) {
        list->pieces[list->count++] = number;
    }
}

static void make_switch(struct builder *b, const struct task *task)
{
    const struct list *list = &task->list;
    uint32_t root = list->pieces[choose(b, list)];
    uint32_t plane = b->pieces->all[root].record;
    uint32_t node = tree_add_node(b->tree, plane);
    struct list front = { xalloc(list->count, sizeof *front.pieces), 0 };
    struct list back = { xalloc(list->count, sizeof *back.pieces), 0 };
    for (uint32_t i = 0; i < list->count; i++) {
        uint32_t piece = list->pieces[i];
        switch (split_side_of(b->arrangement, b->pieces, piece, plane)) {
        case SPLIT_ON:
            add_faces(b, node, piece);
            break;
        case SPLIT_FRONT:
            front.pieces[front.count++] = piece;
            break;
        case SPLIT_BACK:
            back.pieces[back.count++] = piece;
            break;
        case SPLIT_ACROSS: {
            uint32_t parts[2];
            split_piece(&b->splitter, b->arrangement, b->pieces, piece, plane, &parts[0],
                        &parts[1]);
            keep(b->pieces, &front, parts[0]);
            keep(b->pieces, &back, parts[1]);
            break;
        }
        }
    }
    b->tree->relations += list->count;
    set_child(b, task, tree_item_of(OW_ITEM_NODE, node));
    push(b, back, node, false);
    push(b, front, node, true);
}

/* A single piece: a face, or the two sides of one. */
static void make_leaf(struct builder *b, const struct task *task)
{
    uint32_t piece = task->list.pieces[0];
    if (b->options->two_sided) {
        uint32_t node = tree_add_node(b->tree, MESH_NONE);
        add_faces(b, node, piece);
        set_child(b, task, tree_item_of(OW_ITEM_NODE, node));
    } else {
        b->placed++;
        set_child(b, task, tree_item_of(OW_ITEM_FACE, piece));
    }
}

void bsp_build(struct tree *tree, struct arrangement *arrangement, struct pieces *pieces,
               const struct bsp_options *options, struct progress *progress)
{
    struct builder b = { .tree = tree,
                         .arrangement = arrangement,
                         .pieces = pieces,
                         .options = options,
                         .random = { options->seed } };
    struct list all = { xalloc(pieces->count, sizeof *all.pieces), pieces->count };
    *tree = (struct tree){ .root = OW_ITEM_NONE };
    for (uint32_t i = 0; i < all.count; i++) {
        all.pieces[i] = i;
    }
    push(&b, all, MESH_NONE, false);
    while (b.task_count > 0) {
        struct task task = b.tasks[--b.task_count];
        b.waiting -= task.list.count;
        if (task.list.count == 1) {
            make_leaf(&b, &task);
        } else {
            make_switch(&b, &task);
        }
        free(task.list.pieces);
        if (progress != NULL) {
            progress_show(progress, "building", b.placed, b.placed + b.waiting);
        }
    }
    free(b.tasks);
    splitter_free(&b.splitter);
}
