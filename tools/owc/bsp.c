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

#include "conflict.h"
#include "dividing.h"
#include "parts.h"
#include "random.h"
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
    uint32_t dividing; /* dividing planes that were tried above; MESH_NONE: no more will do */
};

struct builder {
    struct tree *tree;
    struct arrangement *arrangement;
    struct pieces *pieces;
    const struct bsp_options *options;
    struct progress *progress;
    struct random random;
    struct splitter splitter;
    struct conflict conflict;
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

/* Of a few at random, or of all if there are few, the one with the greatest score. */
static uint32_t choose_by_conflicts(struct builder *b, const struct list *list)
{
    bool all = b->options->candidates >= list->count;
    uint32_t count = all ? list->count : b->options->candidates;
    uint32_t best = 0;
    double best_score = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t candidate = all ? i : random_below(&b->random, list->count);
        uint32_t plane = b->pieces->all[list->pieces[candidate]].record;
        double score =
            conflict_score(&b->conflict, b->arrangement, b->pieces, list->pieces, list->count,
                           plane, b->options->conflict_weight, &b->tree->relations);
        if (i == 0 || score > best_score) {
            best = candidate;
            best_score = score;
        }
    }
    return best;
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
    case BSP_CONFLICT:
        return choose_by_conflicts(b, list);
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

static void push(struct builder *b, struct list list, uint32_t parent, bool front,
                 uint32_t dividing)
{
    if (list.count == 0) {
        free(list.pieces);
        return;
    }
    list.pieces = xresize(list.pieces, list.count, sizeof *list.pieces);
    b->tasks = xgrow(b->tasks, &b->task_capacity, b->task_count + 1, sizeof *b->tasks);
    b->tasks[b->task_count++] = (struct task){ list, parent, front, dividing };
    b->waiting += list.count;
}

static void keep(struct list *list, uint32_t part)
{
    if (part != MESH_NONE) {
        list->pieces[list->count++] = part;
    }
}

/* Not all pieces are on one side of the plane. */
static bool divides(struct builder *b, const struct list *list, uint32_t plane)
{
    enum split_side first = split_side_of(b->arrangement, b->pieces, list->pieces[0], plane);
    uint32_t i = 1;
    while (first != SPLIT_ACROSS && i < list->count &&
           split_side_of(b->arrangement, b->pieces, list->pieces[i], plane) == first) {
        i++;
    }
    b->tree->relations += i;
    return first == SPLIT_ACROSS || i < list->count;
}

/* The next dividing plane that does divide the list, otherwise the chosen polygon's. */
static uint32_t choose_plane(struct builder *b, struct task *task)
{
    const struct bsp_options *options = b->options;
    while (task->dividing < options->dividing_count) {
        uint32_t plane = options->dividing[task->dividing++];
        if (divides(b, &task->list, plane)) {
            return plane;
        }
    }
    if (options->axis_planes != NULL && task->dividing != MESH_NONE) {
        uint32_t plane = dividing_axis_plane(b->arrangement, b->pieces, task->list.pieces,
                                             task->list.count, options->axis_planes);
        if (plane != MESH_NONE) {
            return plane;
        }
        task->dividing = MESH_NONE;
    }
    return b->pieces->all[task->list.pieces[choose(b, &task->list)]].record;
}

static void make_switch(struct builder *b, struct task *task)
{
    const struct list *list = &task->list;
    uint32_t plane = choose_plane(b, task);
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
            split_into_parts(&b->splitter, b->arrangement, b->pieces, piece, plane, parts);
            keep(&front, parts[0]);
            keep(&back, parts[1]);
            break;
        }
        }
    }
    b->tree->relations += list->count;
    set_child(b, task, tree_item_of(OW_ITEM_NODE, node));
    push(b, back, node, false, task->dividing);
    push(b, front, node, true, task->dividing);
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
    push(&b, all, MESH_NONE, false, 0);
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
    conflict_free(&b.conflict);
}
