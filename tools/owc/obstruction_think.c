/* SPDX-License-Identifier: 0BSD */
/* What becomes of a list of faces: components, chunks, and planes for the switches. */
#include "obstruction_think.h"

#include <stdlib.h>

#include "map64.h"
#include "obstruction_chunks.h"
#include "obstruction_components.h"
#include "tools/common/xalloc.h"

struct thinker {
    struct obstruction_thought *thought;
    const struct obstruction_world *world;
    struct obstruction_set set;
    struct components components;
    size_t capacity; /* of entries */
};

static void add_entry(struct thinker *t, enum obstruction_kind kind, uint32_t first, uint32_t count)
{
    struct obstruction_thought *thought = t->thought;
    thought->entries = xgrow(thought->entries, &t->capacity, (size_t)thought->entry_count + 1,
                             sizeof *thought->entries);
    thought->entries[thought->entry_count++] =
        (struct obstruction_entry){ .kind = kind, .first = first, .count = count };
}

/* Single faces that follow one another, in chunks if they are many. */
static void add_run(struct thinker *t, uint32_t first, uint32_t length)
{
    if (length < CHUNK_RUN) {
        for (uint32_t i = first; i < first + length; i++) {
            add_entry(t, OBSTRUCTION_FACE, i, 1);
        }
        return;
    }
    uint32_t *ends = xalloc(length, sizeof *ends);
    uint32_t chunks = obstruction_chunks(&t->set, t->components.faces + first, length, ends);
    for (uint32_t i = 0; i < chunks; i++) {
        uint32_t begin = i > 0 ? ends[i - 1] : 0;
        add_entry(t, OBSTRUCTION_CHUNK, first + begin, ends[i] - begin);
    }
    free(ends);
}

static void list_entries(struct thinker *t)
{
    const struct components *c = &t->components;
    for (uint32_t i = 0; i < c->count;) {
        uint32_t run = i;
        while (run < c->count && c->starts[run + 1] - c->starts[run] == 1) {
            run++;
        }
        add_run(t, c->starts[i], run - i);
        if (run < c->count) {
            add_entry(t, OBSTRUCTION_SWITCH, c->starts[run], c->starts[run + 1] - c->starts[run]);
            run++;
        }
        i = run;
    }
}

static void choose(struct thinker *t, struct obstruction_entry *entry, uint64_t seed,
                   uint32_t spare)
{
    struct obstruction_set part;
    struct random random = { map64_hash(seed + entry->first) };
    obstruction_set_part(&part, &t->set, t->components.faces + entry->first, entry->count);
    entry->places = xalloc(entry->count, sizeof *entry->places);
    obstruction_choose(&entry->choice, entry->places, &part, t->world->planes, spare,
                       &t->world->effort, &random);
    t->set.relations += part.relations;
    obstruction_set_free(&part);
}

/* Faces in one plane from which on their order is not searched for. */
enum { MANY_FLAT = 4096 };

static bool is_flat(const struct obstruction_set *set)
{
    uint32_t i = 1;
    while (i < set->count && set->faces[i].plane == set->faces[0].plane) {
        i++;
    }
    return i == set->count;
}

struct by_file {
    uint32_t polygon;
    uint32_t face;
};

static int compare_by_file(const void *left, const void *right)
{
    const struct by_file *a = left;
    const struct by_file *b = right;
    return a->polygon != b->polygon ? (a->polygon > b->polygon ? 1 : -1)
                                    : (a->face > b->face) - (a->face < b->face);
}

/*
 * Very many faces in one plane, in the file's order: no search for components,
 * which takes long where they lie on one another.
 */
static void keep_file_order(struct thinker *t)
{
    uint32_t count = t->set.count;
    struct by_file *sorted = xalloc(count, sizeof *sorted);
    for (uint32_t i = 0; i < count; i++) {
        sorted[i] = (struct by_file){ t->set.faces[i].polygon, i };
    }
    qsort(sorted, count, sizeof *sorted, compare_by_file);
    t->components.faces = xalloc(count, sizeof *t->components.faces);
    for (uint32_t i = 0; i < count; i++) {
        t->components.faces[i] = sorted[i].face;
    }
    for (uint32_t i = 0; i < count; i += CHUNK_MOST) {
        add_entry(t, OBSTRUCTION_CHUNK, i, count - i < CHUNK_MOST ? count - i : CHUNK_MOST);
    }
    free(sorted);
}

void obstruction_think(struct obstruction_thought *thought, const struct obstruction_world *world,
                       const tree_item *items, uint32_t count, uint64_t seed, uint32_t spare)
{
    struct thinker t = { .thought = thought, .world = world };
    *thought = (struct obstruction_thought){ 0 };
    obstruction_set_begin(&t.set, world->mesh, world->arrangement, world->pieces, world->tolerance,
                          items, count);
    if (count >= MANY_FLAT && is_flat(&t.set)) {
        keep_file_order(&t);
    } else {
        components_find(&t.components, &t.set);
        list_entries(&t);
    }
    for (uint32_t i = 0; i < thought->entry_count; i++) {
        if (thought->entries[i].kind == OBSTRUCTION_SWITCH) {
            choose(&t, &thought->entries[i], seed, spare);
        }
    }
    thought->items = xalloc(count, sizeof *thought->items);
    for (uint32_t i = 0; i < count; i++) {
        thought->items[i] = t.set.faces[t.components.faces[i]].item;
    }
    thought->relations = t.set.relations;
    components_free(&t.components);
    obstruction_set_free(&t.set);
}

void obstruction_thought_free(struct obstruction_thought *thought)
{
    for (uint32_t i = 0; i < thought->entry_count; i++) {
        free(thought->entries[i].places);
    }
    free(thought->entries);
    free(thought->items);
    *thought = (struct obstruction_thought){ 0 };
}
