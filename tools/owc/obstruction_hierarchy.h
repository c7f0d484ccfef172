/* SPDX-License-Identifier: 0BSD */
/*
 * A hierarchy over the faces of a set: boxes around their corners, boxes
 * around their normals, and the heights of a point above their planes. It
 * yields the faces not yet visited that stand in the relation to a given one,
 * without looking at all pairs.
 */
#ifndef OWC_OBSTRUCTION_HIERARCHY_H
#define OWC_OBSTRUCTION_HIERARCHY_H

#include <stdbool.h>
#include <stdint.h>

#include "obstruction_faces.h"

struct hierarchy_node {
    double low[3]; /* of the corners */
    double high[3];
    double normal_low[3];
    double normal_high[3];
    double middle[3];
    double height_low; /* of the middle above the faces' planes */
    double height_high;
    uint32_t first; /* faces: places first .. first + count - 1 */
    uint32_t count;
    uint32_t left;   /* not yet visited */
    uint32_t next;   /* the node after this one and all below it */
    uint32_t parent; /* MESH_NONE: the root */
    bool leaf;
};

struct hierarchy {
    struct obstruction_set *set;
    struct hierarchy_node *nodes; /* each before those below it */
    uint32_t node_count;
    uint32_t *faces;   /* by place */
    uint32_t *leaf_of; /* by face */
    bool *visited;     /* by face */
    bool *coplanar;    /* by face: others have the same plane and look the same way */
};

/* Where a search goes on. All zero to begin with. */
struct hierarchy_cursor {
    uint32_t node;
    bool among_coplanar;
};

/* Which faces are wanted. */
enum hierarchy_way {
    HIERARCHY_HIDING, /* those that must come later than the given face: they can obstruct it */
    HIERARCHY_HIDDEN  /* those that must come earlier */
};

void hierarchy_begin(struct hierarchy *hierarchy, struct obstruction_set *set);
void hierarchy_free(struct hierarchy *hierarchy);

/* All faces are not yet visited again. */
void hierarchy_reset(struct hierarchy *hierarchy);

void hierarchy_visit(struct hierarchy *hierarchy, uint32_t face);

/* The next face not yet visited that stands in the relation, or MESH_NONE. */
uint32_t hierarchy_find(struct hierarchy *hierarchy, uint32_t face, enum hierarchy_way way,
                        struct hierarchy_cursor *cursor);

/* May a node hold a face that stands in the relation? Never false if it does; not coplanar ones. */
bool hierarchy_may_hold(const struct hierarchy *hierarchy, const struct hierarchy_node *node,
                        const struct obstruction_face *face, enum hierarchy_way way);

#endif
