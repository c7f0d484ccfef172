/* SPDX-License-Identifier: 0BSD */
/*
 * Building the obstruction tree. A list of faces becomes a sequence of its
 * components; a component of several faces becomes a switch, whose two halves
 * are lists again. The lists that wait stand on a stack. Each half is shorter
 * than the component that it came from, so this ends.
 */
#include "obstruction.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "map64.h"
#include "obstruction_chunks.h"
#include "obstruction_components.h"
#include "obstruction_cuts.h"
#include "obstruction_faces.h"
#include "obstruction_plane.h"
#include "obstruction_whole.h"
#include "ow_blob.h"
#include "random.h"
#include "tools/common/xalloc.h"

/* Faces of a model up to which no effort is spared; larger ones get less. */
enum { SMALL_MODEL = 20000 };

/* Faces in one plane from which on their order is not searched for. */
enum { MANY_FLAT = 4096 };

static const struct obstruction_effort great_effort = { .own = 64,
                                                        .edges = 400,
                                                        .directions = 13,
                                                        .sample = 1024,
                                                        .climbs = 150,
                                                        .finalists = 8,
                                                        .ahead = 2000,
                                                        .balance = 0.1 };
static const struct obstruction_effort less_effort = { .own = 32,
                                                       .edges = 64,
                                                       .directions = 7,
                                                       .sample = 256,
                                                       .climbs = 60,
                                                       .finalists = 4,
                                                       .ahead = 500,
                                                       .balance = 0.1 };

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
    struct place place;
};

struct builder {
    struct tree *tree;
    struct planes *planes;
    const struct mesh *mesh;
    struct arrangement *arrangement;
    struct pieces *pieces;
    struct progress *progress;
    struct obstruction_effort effort;
    struct random random;
    double tolerance; /* lattice steps */
    struct obstruction_cuts cuts;
    struct task *tasks;
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
static void push(struct builder *b, tree_item *items, uint32_t count, struct place place)
{
    if (count == 0) {
        free(items);
        return;
    }
    items = xresize(items, count, sizeof *items);
    b->tasks = xgrow(b->tasks, &b->task_capacity, b->task_count + 1, sizeof *b->tasks);
    b->tasks[b->task_count++] = (struct task){ items, count, place };
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

static void put_face(struct builder *b, struct halves *h, const struct obstruction_face *face,
                     uint32_t plane, uint8_t where)
{
    switch (where) {
    case OBSTRUCTION_ON:
        h->on[h->on_count++] = face->item;
        break;
    case OBSTRUCTION_FRONT:
        h->front[h->front_count++] = face->item;
        break;
    case OBSTRUCTION_BACK:
        h->back[h->back_count++] = face->item;
        break;
    case OBSTRUCTION_ACROSS: {
        tree_item parts[2];
        obstruction_cut(&b->cuts, b->arrangement, b->pieces, face->item, plane, parts);
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

/* Where each face goes. */
static uint8_t *find_places(const struct builder *b, struct obstruction_set *set,
                            const uint32_t *faces, uint32_t count, uint32_t number)
{
    const struct plane *plane = &b->planes->all[number];
    double length = sqrt(plane->normal[0] * plane->normal[0] + plane->normal[1] * plane->normal[1] +
                         plane->normal[2] * plane->normal[2]);
    double normal[3] = { plane->normal[0] / length, plane->normal[1] / length,
                         plane->normal[2] / length };
    uint8_t *places = xalloc(count, sizeof *places);
    for (uint32_t i = 0; i < count; i++) {
        places[i] = (uint8_t)obstruction_place_of(set, &set->faces[faces[i]], number);
    }
    obstruction_keep_whole(set, normal, plane->offset / length, faces, count, places);
    return places;
}

static void make_switch(struct builder *b, struct obstruction_set *set, const uint32_t *faces,
                        uint32_t count, struct place place)
{
    uint32_t plane = obstruction_choose(set, b->planes, faces, count, &b->effort, &b->random);
    uint32_t node = tree_add_node(b->tree, plane);
    struct halves halves = { xalloc(count, sizeof(tree_item)),
                             xalloc(count, sizeof(tree_item)),
                             xalloc(count, sizeof(tree_item)),
                             0,
                             0,
                             0 };
    uint8_t *places = find_places(b, set, faces, count, plane);
    for (uint32_t i = 0; i < count; i++) {
        put_face(b, &halves, &set->faces[faces[i]], plane, places[i]);
    }
    free(places);
    put(b, place, tree_item_of(OW_ITEM_NODE, node));
    add_coplanar(b, node, &halves);
    free(halves.on);
    push(b, halves.back, halves.back_count, (struct place){ SLOT_BACK, node });
    push(b, halves.front, halves.front_count, (struct place){ SLOT_FRONT, node });
}

/* ---- sequences ---- */

/* What becomes one item of a sequence: a face, a component, or a chunk of faces. */
struct entry {
    uint32_t first; /* of the components' faces */
    uint32_t count;
    bool chunk;
};

static struct entry *add_entry(struct entry *entries, size_t *capacity, uint32_t *count,
                               struct entry entry)
{
    entries = xgrow(entries, capacity, (size_t)*count + 1, sizeof *entries);
    entries[(*count)++] = entry;
    return entries;
}

/* Single faces that follow one another, in chunks if they are many. */
static struct entry *add_run(struct obstruction_set *set, struct components *c, uint32_t first,
                             uint32_t length, struct entry *entries, size_t *capacity,
                             uint32_t *count)
{
    if (length < CHUNK_RUN) {
        for (uint32_t i = first; i < first + length; i++) {
            entries = add_entry(entries, capacity, count, (struct entry){ i, 1, false });
        }
        return entries;
    }
    uint32_t *ends = xalloc(length, sizeof *ends);
    uint32_t chunks = obstruction_chunks(set, c->faces + first, length, ends);
    for (uint32_t i = 0; i < chunks; i++) {
        uint32_t begin = i > 0 ? ends[i - 1] : 0;
        entries = add_entry(entries, capacity, count,
                            (struct entry){ first + begin, ends[i] - begin, true });
    }
    free(ends);
    return entries;
}

static struct entry *list_entries(struct obstruction_set *set, struct components *c,
                                  uint32_t *count)
{
    struct entry *entries = NULL;
    size_t capacity = 0;
    uint32_t i = 0;
    *count = 0;
    while (i < c->count) {
        uint32_t run = i;
        while (run < c->count && c->starts[run + 1] - c->starts[run] == 1) {
            run++;
        }
        entries = add_run(set, c, c->starts[i], run - i, entries, &capacity, count);
        if (run < c->count) {
            struct entry component = { c->starts[run], c->starts[run + 1] - c->starts[run], false };
            entries = add_entry(entries, &capacity, count, component);
            run++;
        }
        i = run;
    }
    return entries;
}

static void put_chunk(struct builder *b, const struct obstruction_set *set, const uint32_t *faces,
                      uint32_t count, struct place place)
{
    uint32_t node = tree_add_node(b->tree, MESH_NONE);
    for (uint32_t i = 0; i < count; i++) {
        tree_add_item(b->tree, node, set->faces[faces[i]].item);
    }
    put(b, place, tree_item_of(OW_ITEM_NODE, node));
    b->placed += count;
}

static bool is_flat(const struct obstruction_set *set)
{
    uint32_t i = 1;
    while (i < set->count && set->faces[i].plane == set->faces[0].plane) {
        i++;
    }
    return i == set->count;
}

/*
 * Faces in one plane, in the file's order: no search for components, which takes
 * long where very many lie on one another.
 */
static void make_flat_sequence(struct builder *b, const struct obstruction_set *set,
                               struct place place)
{
    struct by_file *sorted = xalloc(set->count, sizeof *sorted);
    uint32_t *faces = xalloc(set->count, sizeof *faces);
    for (uint32_t i = 0; i < set->count; i++) {
        sorted[i] = (struct by_file){ set->faces[i].polygon, i };
    }
    qsort(sorted, set->count, sizeof *sorted, compare_by_file);
    for (uint32_t i = 0; i < set->count; i++) {
        faces[i] = sorted[i].item;
    }
    uint32_t node = tree_add_node(b->tree, MESH_NONE);
    size_t first = b->tree->item_count;
    for (uint32_t i = 0; i < set->count; i += CHUNK_MOST) {
        tree_add_item(b->tree, node, OW_ITEM_NONE); /* put below */
    }
    put(b, place, tree_item_of(OW_ITEM_NODE, node));
    for (uint32_t i = 0; i < set->count; i += CHUNK_MOST) {
        uint32_t count = set->count - i < CHUNK_MOST ? set->count - i : CHUNK_MOST;
        struct place chunk = { SLOT_ITEM, first + i / CHUNK_MOST };
        put_chunk(b, set, faces + i, count, chunk);
    }
    free(sorted);
    free(faces);
}

static void make_sequence(struct builder *b, struct obstruction_set *set, struct place place)
{
    struct components c;
    uint32_t count;
    if (set->count >= MANY_FLAT && is_flat(set)) {
        make_flat_sequence(b, set, place);
        return;
    }
    components_find(&c, set);
    if (c.count == 1 && set->count > 1) {
        make_switch(b, set, c.faces, set->count, place);
        components_free(&c);
        return;
    }
    struct entry *entries = list_entries(set, &c, &count);
    uint32_t node = tree_add_node(b->tree, MESH_NONE);
    size_t first = b->tree->item_count;
    for (uint32_t i = 0; i < count; i++) {
        tree_add_item(b->tree, node, set->faces[c.faces[entries[i].first]].item);
    }
    put(b, place, tree_item_of(OW_ITEM_NODE, node));
    for (uint32_t i = 0; i < count; i++) {
        struct place here = { SLOT_ITEM, first + i };
        if (entries[i].chunk) {
            put_chunk(b, set, c.faces + entries[i].first, entries[i].count, here);
        } else if (entries[i].count > 1) {
            make_switch(b, set, c.faces + entries[i].first, entries[i].count, here);
        } else {
            b->placed++;
        }
    }
    free(entries);
    components_free(&c);
}

static void build_task(struct builder *b, const struct task *task)
{
    if (task->count == 1) {
        put(b, task->place, task->items[0]);
        b->placed++;
        return;
    }
    struct obstruction_set set;
    obstruction_set_begin(&set, b->mesh, b->arrangement, b->pieces, b->tolerance, task->items,
                          task->count);
    make_sequence(b, &set, task->place);
    b->tree->relations += set.relations;
    obstruction_set_free(&set);
}

static void push_all(struct builder *b, bool two_sided)
{
    uint32_t sides = two_sided ? 2 : 1;
    uint32_t count = b->pieces->count * sides;
    tree_item *items = xalloc(count, sizeof *items);
    for (uint32_t i = 0; i < b->pieces->count; i++) {
        for (uint32_t k = 0; k < sides; k++) {
            items[i * sides + k] = tree_item_of(k == 0 ? OW_ITEM_FACE : OW_ITEM_REVERSE, i);
        }
    }
    push(b, items, count, (struct place){ SLOT_ROOT, 0 });
}

bool obstruction_build(struct tree *tree, struct planes *planes, const struct mesh *mesh,
                       struct arrangement *arrangement, struct pieces *pieces,
                       const struct obstruction_options *options, struct progress *progress)
{
    struct builder b = { .tree = tree,
                         .planes = planes,
                         .mesh = mesh,
                         .arrangement = arrangement,
                         .pieces = pieces,
                         .progress = progress,
                         .effort = pieces->count > SMALL_MODEL ? less_effort : great_effort,
                         .random = { options->seed },
                         .tolerance = options->tolerance_q8 / 256.0 };
    if (options->balance > 0) {
        b.effort.balance = options->balance;
    }
    *tree = (struct tree){ .root = OW_ITEM_NONE };
    push_all(&b, options->two_sided);
    bool fine = true;
    while (b.task_count > 0) {
        struct task task = b.tasks[--b.task_count];
        b.waiting -= task.count;
        fine = fine && (options->most == 0 || b.placed + b.waiting <= options->most);
        if (fine) {
            build_task(&b, &task);
        }
        free(task.items);
        if (progress != NULL) {
            progress_show(progress, "building", b.placed, b.placed + b.waiting);
        }
    }
    if (fine) {
        obstruction_cuts_share(&b.cuts, tree);
    }
    obstruction_cuts_free(&b.cuts);
    free(b.tasks);
    return fine;
}
