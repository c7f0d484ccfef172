/* SPDX-License-Identifier: 0BSD */
/*
 * Building the obstruction tree. A list of faces becomes a sequence of its
 * components; a component of several faces becomes a switch, whose two halves
 * are lists again. Each half is shorter than the component that it came from,
 * so this ends. Round by round, threads think about all lists that wait; then
 * what they found is carried out in the lists' order, so that the tree is the
 * same for any number of threads.
 */
#include "obstruction.h"

#include <stdlib.h>
#include <string.h>

#include "map64.h"
#include "obstruction_cuts.h"
#include "obstruction_think.h"
#include "ow_blob.h"
#include "tools/common/xalloc.h"
#include "workers.h"

/* Pieces up to which no effort is spared; from the other number on there is little. */
enum { SMALL_MODEL = 20000, LARGE_MODEL = 200000 };

static const struct obstruction_effort great_effort = { .own = 64,
                                                        .edges = 1600,
                                                        .directions = 13,
                                                        .sample = 1024,
                                                        .climbers = 100,
                                                        .climbs = 60,
                                                        .finalists = 100,
                                                        .ahead = 100,
                                                        .looks = 16,
                                                        .price = 0.5 };
static const struct obstruction_effort less_effort = { .own = 32,
                                                       .edges = 400,
                                                       .directions = 7,
                                                       .sample = 1024,
                                                       .climbers = 24,
                                                       .climbs = 60,
                                                       .finalists = 24,
                                                       .ahead = 100,
                                                       .looks = 8,
                                                       .price = 0.5 };
static const struct obstruction_effort little_effort = { .own = 16,
                                                         .edges = 64,
                                                         .directions = 5,
                                                         .sample = 512,
                                                         .climbers = 4,
                                                         .climbs = 40,
                                                         .finalists = 8,
                                                         .ahead = 50,
                                                         .looks = 4,
                                                         .price = 0.5 };

static const struct obstruction_effort *effort_for(uint32_t pieces)
{
    return pieces <= SMALL_MODEL   ? &great_effort
           : pieces <= LARGE_MODEL ? &less_effort
                                   : &little_effort;
}

/* Where a subtree's item goes. */
enum slot { SLOT_ROOT, SLOT_FRONT, SLOT_BACK, SLOT_ITEM };

struct place {
    enum slot slot;
    size_t number; /* a node, or of the tree's items */
};

/* A list that waits. */
struct task {
    tree_item *items;
    uint32_t count;
    uint64_t seed;
    struct place place;
};

struct builder {
    struct tree *tree;
    struct planes *planes;
    struct arrangement *arrangement;
    struct pieces *pieces;
    struct progress *progress;
    struct obstruction_world world;
    struct obstruction_cuts cuts;
    struct obstruction_thought *thoughts; /* of the tasks of this round */
    struct task *round;
    struct task *tasks; /* of the next one */
    size_t task_count;
    size_t task_capacity;
    uint64_t placed;  /* faces in the tree */
    uint64_t waiting; /* faces in the lists of tasks */
};

static void put(struct builder *b, struct place place, tree_item item)
{
    switch (place.slot) {
    case SLOT_ROOT:
        b->tree->root = item;
        break;
    case SLOT_FRONT:
        b->tree->nodes[place.number].front = item;
        break;
    case SLOT_BACK:
        b->tree->nodes[place.number].back = item;
        break;
    case SLOT_ITEM:
        b->tree->items[place.number] = item;
        break;
    }
}

/* Takes over the items. */
static void push(struct builder *b, tree_item *items, uint32_t count, uint64_t seed,
                 struct place place)
{
    if (count < 2) {
        if (count == 1) {
            put(b, place, items[0]);
            b->placed++;
        }
        free(items);
        return;
    }
    items = xresize(items, count, sizeof *items);
    b->tasks = xgrow(b->tasks, &b->task_capacity, b->task_count + 1, sizeof *b->tasks);
    b->tasks[b->task_count++] = (struct task){ items, count, map64_hash(seed), place };
    b->waiting += count;
}

/* ---- switches ---- */

struct halves {
    tree_item *on;
    tree_item *front;
    tree_item *back;
    uint32_t on_count;
    uint32_t front_count;
    uint32_t back_count;
};

/* In the file's order, fronts before reverses. */
struct by_file {
    uint32_t polygon;
    tree_item item;
};

static int compare_by_file(const void *left, const void *right)
{
    const struct by_file *a = left;
    const struct by_file *b = right;
    return a->polygon != b->polygon ? (a->polygon > b->polygon ? 1 : -1)
                                    : (a->item > b->item) - (a->item < b->item);
}

static void add_coplanar(struct builder *b, uint32_t node, const struct halves *halves)
{
    struct by_file *sorted = xalloc(halves->on_count, sizeof *sorted);
    for (uint32_t i = 0; i < halves->on_count; i++) {
        sorted[i].item = halves->on[i];
        sorted[i].polygon = b->pieces->all[tree_item_value(halves->on[i])].polygon;
    }
    qsort(sorted, halves->on_count, sizeof *sorted, compare_by_file);
    for (uint32_t i = 0; i < halves->on_count; i++) {
        tree_add_item(b->tree, node, sorted[i].item);
    }
    b->placed += halves->on_count;
    free(sorted);
}

static void put_face(struct builder *b, struct halves *h, tree_item face, uint32_t plane,
                     uint8_t where)
{
    switch (where) {
    case OBSTRUCTION_ON:
        h->on[h->on_count++] = face;
        break;
    case OBSTRUCTION_FRONT:
        h->front[h->front_count++] = face;
        break;
    case OBSTRUCTION_BACK:
        h->back[h->back_count++] = face;
        break;
    case OBSTRUCTION_ACROSS: {
        tree_item parts[2];
        obstruction_cut(&b->cuts, b->arrangement, b->pieces, face, plane, parts);
        if (parts[0] != OW_ITEM_NONE) {
            h->front[h->front_count++] = parts[0];
        }
        if (parts[1] != OW_ITEM_NONE) {
            h->back[h->back_count++] = parts[1];
        }
        break;
    }
    }
}

static void make_switch(struct builder *b, const struct obstruction_entry *entry,
                        const tree_item *items, uint64_t seed, struct place place)
{
    const struct obstruction_choice *choice = &entry->choice;
    uint32_t plane = choice->record != MESH_NONE ? choice->record
                                                 : plane_add(b->planes, choice->n, choice->d, 0);
    uint32_t node = tree_add_node(b->tree, plane);
    uint32_t count = entry->count;
    struct halves halves = { xalloc(count, sizeof(tree_item)),
                             xalloc(count, sizeof(tree_item)),
                             xalloc(count, sizeof(tree_item)),
                             0,
                             0,
                             0 };
    for (uint32_t i = 0; i < count; i++) {
        put_face(b, &halves, items[i], plane, entry->places[i]);
    }
    put(b, place, tree_item_of(OW_ITEM_NODE, node));
    add_coplanar(b, node, &halves);
    free(halves.on);
    push(b, halves.front, halves.front_count, seed + 1, (struct place){ SLOT_FRONT, node });
    push(b, halves.back, halves.back_count, seed + 2, (struct place){ SLOT_BACK, node });
}

/* ---- sequences ---- */

static void put_chunk(struct builder *b, const tree_item *items, uint32_t count, struct place place)
{
    uint32_t node = tree_add_node(b->tree, MESH_NONE);
    for (uint32_t i = 0; i < count; i++) {
        tree_add_item(b->tree, node, items[i]);
    }
    put(b, place, tree_item_of(OW_ITEM_NODE, node));
    b->placed += count;
}

static void put_entry(struct builder *b, const struct obstruction_thought *thought,
                      const struct obstruction_entry *entry, uint64_t seed, struct place place)
{
    const tree_item *items = thought->items + entry->first;
    switch (entry->kind) {
    case OBSTRUCTION_FACE:
        put(b, place, items[0]);
        b->placed++;
        break;
    case OBSTRUCTION_CHUNK:
        put_chunk(b, items, entry->count, place);
        break;
    case OBSTRUCTION_SWITCH:
        make_switch(b, entry, items, seed + 2 * (uint64_t)entry->first, place);
        break;
    }
}

/* Carries out what was thought about a task. */
static void build_task(struct builder *b, const struct task *task,
                       const struct obstruction_thought *thought)
{
    if (thought->entry_count == 1) {
        put_entry(b, thought, &thought->entries[0], task->seed, task->place);
        return;
    }
    uint32_t node = tree_add_node(b->tree, MESH_NONE);
    size_t first = b->tree->item_count;
    for (uint32_t i = 0; i < thought->entry_count; i++) {
        tree_add_item(b->tree, node, thought->items[thought->entries[i].first]);
    }
    put(b, task->place, tree_item_of(OW_ITEM_NODE, node));
    for (uint32_t i = 0; i < thought->entry_count; i++) {
        put_entry(b, thought, &thought->entries[i], task->seed,
                  (struct place){ SLOT_ITEM, first + i });
    }
}

/* ---- rounds ---- */

static void show_progress(const struct builder *b)
{
    if (b->progress != NULL) {
        progress_show(b->progress, "building", b->placed, b->placed + b->waiting);
    }
}

static void think(void *context, uint32_t number, uint32_t thread)
{
    struct builder *b = context;
    const struct task *task = &b->round[number];
    obstruction_think(&b->thoughts[number], &b->world, task->items, task->count, task->seed,
                      b->planes->count + thread);
    if (thread == 0) {
        show_progress(b);
    }
}

/* One round. False: it gave up. */
static bool build_round(struct builder *b, uint32_t threads, uint64_t most)
{
    uint32_t count = (uint32_t)b->task_count;
    bool fine = true;
    b->round = b->tasks;
    b->tasks = NULL;
    b->task_count = b->task_capacity = 0;
    b->thoughts = xalloc(count, sizeof *b->thoughts);
    b->planes->all = xgrow(b->planes->all, &b->planes->capacity, (size_t)b->planes->count + threads,
                           sizeof *b->planes->all);
    workers_run(threads, count, think, b);
    for (uint32_t i = 0; i < count; i++) {
        struct task *task = &b->round[i];
        free(task->items);
        b->waiting -= task->count;
        b->tree->relations += b->thoughts[i].relations;
        if (fine) {
            build_task(b, task, &b->thoughts[i]);
        }
        fine = fine && (most == 0 || b->placed + b->waiting <= most);
        obstruction_thought_free(&b->thoughts[i]);
        show_progress(b);
    }
    free(b->thoughts);
    free(b->round);
    return fine;
}

static void push_all(struct builder *b, bool two_sided, uint64_t seed)
{
    uint32_t sides = two_sided ? 2 : 1;
    uint32_t count = b->pieces->count * sides;
    tree_item *items = xalloc(count, sizeof *items);
    for (uint32_t i = 0; i < b->pieces->count; i++) {
        for (uint32_t k = 0; k < sides; k++) {
            items[i * sides + k] = tree_item_of(k == 0 ? OW_ITEM_FACE : OW_ITEM_REVERSE, i);
        }
    }
    push(b, items, count, seed, (struct place){ SLOT_ROOT, 0 });
}

bool obstruction_build(struct tree *tree, struct planes *planes, const struct mesh *mesh,
                       struct arrangement *arrangement, struct pieces *pieces,
                       const struct obstruction_options *options, struct progress *progress)
{
    uint32_t threads = options->threads > 0 ? options->threads : workers_processors();
    struct builder b = { .tree = tree,
                         .planes = planes,
                         .arrangement = arrangement,
                         .pieces = pieces,
                         .progress = progress,
                         .world = { mesh, arrangement, pieces, planes,
                                    options->tolerance_q8 / 256.0, *effort_for(pieces->count) } };
    if (options->price > 0) {
        b.world.effort.price = options->price;
    }
    *tree = (struct tree){ .root = OW_ITEM_NONE };
    push_all(&b, options->two_sided, options->seed);
    bool fine = true;
    while (fine && b.task_count > 0) {
        fine = build_round(&b, threads, options->most);
    }
    for (size_t i = 0; i < b.task_count; i++) {
        free(b.tasks[i].items);
    }
    free(b.tasks);
    if (fine) {
        obstruction_cuts_share(&b.cuts, tree);
    }
    obstruction_cuts_free(&b.cuts);
    return fine;
}
