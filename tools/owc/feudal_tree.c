/* SPDX-License-Identifier: 0BSD */
/* The feudal priority tree of pieces. */
#include "feudal_tree.h"

#include <stdlib.h>

#include "parts.h"
#include "random.h"
#include "tools/common/xalloc.h"

/* ---- relations from geometry ---- */

struct scene {
    struct arrangement *arrangement;
    struct pieces *pieces;
    const struct mesh *mesh;
    struct splitter splitter;
};

static uint32_t plane_of(void *context, uint32_t piece)
{
    const struct scene *scene = context;
    return scene->pieces->all[piece].record;
}

static bool is_reversed(void *context, uint32_t piece)
{
    const struct scene *scene = context;
    return scene->mesh->polygons[scene->pieces->all[piece].polygon].reversed;
}

static enum split_side side_of(void *context, uint32_t piece, uint32_t plane)
{
    const struct scene *scene = context;
    return split_side_of(scene->arrangement, scene->pieces, piece, plane);
}

static void split(void *context, uint32_t piece, uint32_t plane, uint32_t parts[2])
{
    struct scene *scene = context;
    split_into_parts(&scene->splitter, scene->arrangement, scene->pieces, piece, plane, parts);
}

/* ---- sequences and switches ---- */

/* A connecting node that waits, and its place in the tree. */
struct place {
    uint32_t node;
    uint32_t parent; /* switch, or MESH_NONE for the root */
    bool front;
};

struct converter {
    struct tree *tree;
    const struct feudal *feudal;
    const uint32_t *rank;
    bool two_sided;
    struct entry *entries; /* of one bunch, to be sorted */
    size_t entry_capacity;
    struct place *places;
    size_t place_count;
    size_t place_capacity;
};

struct entry {
    uint32_t rank;
    tree_item item;
};

static int compare_entries(const void *left, const void *right)
{
    const struct entry *a = left;
    const struct entry *b = right;
    return a->rank != b->rank ? (a->rank > b->rank) - (a->rank < b->rank)
                              : (a->item > b->item) - (a->item < b->item);
}

/* Adds one class of faces: a bunch, and two-sided the reverses of the opposite one. */
static void add_class(struct converter *c, uint32_t node, const struct feudal_bunch *fronts,
                      const struct feudal_bunch *reverses)
{
    uint32_t count = fronts->count + (c->two_sided ? reverses->count : 0);
    c->entries = xgrow(c->entries, &c->entry_capacity, count, sizeof *c->entries);
    for (uint32_t i = 0; i < count; i++) {
        bool front = i < fronts->count;
        size_t at = front ? fronts->first + i : reverses->first + i - fronts->count;
        uint32_t polygon = c->feudal->polygons[at];
        c->entries[i].rank = c->rank[polygon];
        c->entries[i].item = tree_item_of(front ? OW_ITEM_FACE : OW_ITEM_REVERSE, polygon);
    }
    qsort(c->entries, count, sizeof *c->entries, compare_entries);
    for (uint32_t i = 0; i < count; i++) {
        tree_add_item(c->tree, node, c->entries[i].item);
    }
}

static void set_child(struct converter *c, const struct place *place, tree_item item)
{
    if (place->parent == MESH_NONE) {
        c->tree->root = item;
    } else if (place->front) {
        c->tree->nodes[place->parent].front = item;
    } else {
        c->tree->nodes[place->parent].back = item;
    }
}

static void push(struct converter *c, uint32_t node, uint32_t parent, bool front)
{
    if (node != FEUDAL_NONE) {
        c->places = xgrow(c->places, &c->place_capacity, c->place_count + 1, sizeof *c->places);
        c->places[c->place_count++] = (struct place){ node, parent, front };
    }
}

static void add_sequence(struct converter *c, const struct feudal_node *node, bool has_switch)
{
    const struct feudal_level *levels = c->feudal->levels + node->first_level;
    uint32_t sequence = tree_add_node(c->tree, MESH_NONE);
    for (uint32_t i = 0; i < node->level_count; i++) {
        add_class(c, sequence, &levels[i].back, &levels[i].front);
    }
    if (has_switch) { /* the switch is the next node */
        tree_add_item(c->tree, sequence, tree_item_of(OW_ITEM_NODE, c->tree->node_count));
    }
    for (uint32_t i = node->level_count; i > 0; i--) {
        add_class(c, sequence, &levels[i - 1].front, &levels[i - 1].back);
    }
}

static void add_switch(struct converter *c, const struct feudal_node *node)
{
    uint32_t number = tree_add_node(c->tree, node->plane);
    add_class(c, number, &node->on, &node->on);
    push(c, node->back, number, false);
    push(c, node->front, number, true);
}

/* A node without levels is its switch alone. */
static void add_connecting(struct converter *c, const struct place *place)
{
    const struct feudal_node *node = &c->feudal->nodes[place->node];
    set_child(c, place, tree_item_of(OW_ITEM_NODE, c->tree->node_count));
    if (node->level_count > 0) {
        add_sequence(c, node, node->plane != FEUDAL_NONE);
    }
    if (node->plane != FEUDAL_NONE) {
        add_switch(c, node);
    }
}

void feudal_to_tree(struct tree *tree, const struct feudal *feudal, const uint32_t *rank,
                    bool two_sided)
{
    struct converter c = { .tree = tree, .feudal = feudal, .rank = rank, .two_sided = two_sided };
    *tree = (struct tree){ .root = OW_ITEM_NONE, .relations = feudal->relations };
    push(&c, 0, MESH_NONE, false);
    while (c.place_count > 0) {
        struct place place = c.places[--c.place_count];
        add_connecting(&c, &place);
    }
    free(c.entries);
    free(c.places);
}

/* ---- all of it ---- */

static void shuffle(uint32_t *numbers, uint32_t count, uint64_t seed)
{
    struct random random = { seed };
    for (uint32_t i = count; i > 1; i--) {
        uint32_t k = random_below(&random, i);
        uint32_t number = numbers[i - 1];
        numbers[i - 1] = numbers[k];
        numbers[k] = number;
    }
}

void feudal_build(struct tree *tree, struct arrangement *arrangement, struct pieces *pieces,
                  const struct mesh *mesh, const struct feudal_options *options,
                  struct progress *progress)
{
    struct scene scene = { .arrangement = arrangement, .pieces = pieces, .mesh = mesh };
    struct feudal_source source = { &scene, plane_of, is_reversed, side_of, split };
    struct feudal feudal;
    uint32_t count = pieces->count;
    uint32_t *order = xalloc(count, sizeof *order);
    for (uint32_t i = 0; i < count; i++) {
        order[i] = i;
    }
    if (options->dynamic) {
        shuffle(order, count, options->seed);
    }
    feudal_make(&feudal, &source, order, count, options->dynamic, progress);
    /* Faces in one plane that look the same way: the later in the file wins. */
    uint32_t *rank = xalloc(pieces->count, sizeof *rank);
    for (uint32_t i = 0; i < pieces->count; i++) {
        rank[i] = pieces->all[i].polygon;
    }
    feudal_to_tree(tree, &feudal, rank, options->two_sided);
    feudal_free(&feudal);
    splitter_free(&scene.splitter);
    free(order);
    free(rank);
}
