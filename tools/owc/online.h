/* SPDX-License-Identifier: 0BSD */
/* A tree of switches to which polygons are added one after the other [GC91]. */
#ifndef OWC_ONLINE_H
#define OWC_ONLINE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "arrangement.h"
#include "pieces.h"
#include "progress.h"
#include "split.h"
#include "tree.h"

struct online_node {
    uint32_t plane;
    uint32_t front; /* nodes, or MESH_NONE */
    uint32_t back;
    uint32_t first; /* of the faces in the plane, in the order of insertion; MESH_NONE: none */
    uint32_t last;
};

struct online_face {
    uint32_t piece;
    uint32_t next; /* MESH_NONE: the last one */
};

/* Node 0 is the root. */
struct online {
    struct arrangement *arrangement;
    struct pieces *pieces;
    struct online_node *nodes;
    uint32_t node_count;
    size_t node_capacity;
    struct online_face *faces;
    uint32_t face_count;
    size_t face_capacity;
    struct online_task *tasks; /* parts that wait, while a polygon is inserted */
    size_t task_capacity;
    struct splitter splitter;
    uint64_t relations;
};

/* An empty tree. */
void online_begin(struct online *online, struct arrangement *arrangement, struct pieces *pieces);
void online_free(struct online *online);

/* For trees that are there already: a node without children, and a face in its plane. */
uint32_t online_add_node(struct online *online, uint32_t plane);
void online_add_face(struct online *online, uint32_t node, uint32_t piece);

/* Adds a piece to the tree; planes of the tree that it lies across cut it. */
void online_insert(struct online *online, uint32_t piece);

/* The tree as it is written. two_sided: each piece's back is a face too. */
void online_to_tree(struct tree *tree, const struct online *online, bool two_sided);

/* The tree of all pieces, added in their order. progress may be NULL. */
void online_build(struct tree *tree, struct arrangement *arrangement, struct pieces *pieces,
                  bool two_sided, struct progress *progress);

#endif
