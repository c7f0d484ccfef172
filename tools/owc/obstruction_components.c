/* SPDX-License-Identifier: 0BSD */
/*
 * Components by two depth-first searches (Kosaraju): the first follows the
 * relation from hidden to hiding and notes in which order it is done with the
 * faces; the second takes them the other way round, follows the relation
 * backwards, and each face from which it starts anew begins a component. Both
 * only ask for faces that are not yet visited.
 */
#include "obstruction_components.h"

#include <stdlib.h>

#include "obstruction_hierarchy.h"
#include "tools/common/xalloc.h"

/* A face on the path of the search. */
struct step {
    uint32_t face;
    struct hierarchy_cursor cursor;
};

struct search {
    struct hierarchy hierarchy;
    struct step *path;
    uint32_t length;
};

static void enter(struct search *s, uint32_t face)
{
    hierarchy_visit(&s->hierarchy, face);
    s->path[s->length++] = (struct step){ face, { 0, false } };
}

/* Appends all that is reached from a face to done, each when nothing more is reached from it. */
static uint32_t *reach(struct search *s, uint32_t face, enum hierarchy_way way, uint32_t *done)
{
    enter(s, face);
    while (s->length > 0) {
        struct step *step = &s->path[s->length - 1];
        uint32_t next = hierarchy_find(&s->hierarchy, step->face, way, &step->cursor);
        if (next != MESH_NONE) {
            enter(s, next);
        } else {
            *done++ = step->face;
            s->length--;
        }
    }
    return done;
}

void components_find(struct components *c, struct obstruction_set *set)
{
    uint32_t count = set->count;
    struct search s = { .path = xalloc(count, sizeof *s.path) };
    uint32_t *order = xalloc(count, sizeof *order);
    uint32_t *done = order;
    hierarchy_begin(&s.hierarchy, set);
    for (uint32_t i = 0; i < count; i++) {
        if (!s.hierarchy.visited[i]) {
            done = reach(&s, i, HIERARCHY_HIDING, done);
        }
    }
    hierarchy_reset(&s.hierarchy);
    c->faces = xalloc(count, sizeof *c->faces);
    c->starts = xalloc((size_t)count + 1, sizeof *c->starts);
    c->count = 0;
    done = c->faces;
    for (uint32_t i = count; i > 0; i--) {
        if (!s.hierarchy.visited[order[i - 1]]) {
            c->starts[c->count++] = (uint32_t)(done - c->faces);
            done = reach(&s, order[i - 1], HIERARCHY_HIDDEN, done);
        }
    }
    c->starts[c->count] = count;
    hierarchy_free(&s.hierarchy);
    free(s.path);
    free(order);
}

void components_free(struct components *c)
{
    free(c->faces);
    free(c->starts);
    *c = (struct components){ 0 };
}
