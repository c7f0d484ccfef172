/* SPDX-License-Identifier: 0BSD */
/*
 * The feudal priority tree [CW96]: which polygons go into which bunch, and whose
 * planes become switches. It is fed with relations, not with geometry.
 *
 * A connecting node has levels. The polygons of a level's back bunch have nothing
 * behind their planes of what was left when the level was made, those of its
 * front bunch nothing in front. What no level takes is divided by a switch: by
 * a plane that cuts nothing where there is one, otherwise by one that cuts least.
 */
#ifndef OWC_FEUDAL_H
#define OWC_FEUDAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "progress.h"
#include "split.h"

#define FEUDAL_NONE 0xFFFFFFFFu

/* What the algorithm may ask and do. Polygons and planes are numbers. */
struct feudal_source {
    void *context;
    uint32_t (*plane)(void *context, uint32_t polygon);
    bool (*reversed)(void *context, uint32_t polygon); /* it looks against its plane */
    /* Where a polygon lies, seen from a plane that is not its own. */
    enum split_side (*side)(void *context, uint32_t polygon, uint32_t plane);
    /* Cuts a polygon; parts: in front and behind, or FEUDAL_NONE where nothing is left. */
    void (*split)(void *context, uint32_t polygon, uint32_t plane, uint32_t parts[2]);
};

/* A run of feudal.polygons. */
struct feudal_bunch {
    size_t first;
    uint32_t count;
};

struct feudal_level {
    struct feudal_bunch back;
    struct feudal_bunch front;
};

/* A connecting node and the switch below it. */
struct feudal_node {
    size_t first_level;
    uint32_t level_count;
    uint32_t plane;         /* the switch's, or FEUDAL_NONE: there is no switch */
    uint32_t polygon;       /* whose plane it is */
    struct feudal_bunch on; /* polygons in the switch's plane */
    uint32_t front;         /* connecting nodes, or FEUDAL_NONE: nothing is there */
    uint32_t back;
};

/* The first node is the root; children have greater numbers. */
struct feudal {
    struct feudal_node *nodes;
    uint32_t node_count;
    size_t node_capacity;
    struct feudal_level *levels;
    size_t level_count;
    size_t level_capacity;
    uint32_t *polygons;
    size_t polygon_count;
    size_t polygon_capacity;
    uint64_t relations; /* one-way priorities that were computed */
};

/*
 * Builds the tree of the polygons, count >= 1, which are taken in the given
 * order. dynamic: acts as soon as a polygon's row of relations is known;
 * otherwise all rows come first. progress may be NULL.
 */
void feudal_make(struct feudal *feudal, const struct feudal_source *source,
                 const uint32_t *polygons, uint32_t count, bool dynamic, struct progress *progress);
void feudal_free(struct feudal *feudal);

#endif
