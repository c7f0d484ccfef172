/* SPDX-License-Identifier: 0BSD */
/* Adding the polygons of a model to a tree of switches that is there already [GC91]. */
#ifndef OWC_INSERT_H
#define OWC_INSERT_H

#include <stdbool.h>
#include <stdint.h>

#include "arrangement.h"
#include "blob_file.h"
#include "mesh.h"
#include "model.h"
#include "pieces.h"
#include "plane.h"
#include "problem.h"
#include "progress.h"
#include "tree.h"

/* A tree that polygons are added to. Its records become the mesh's first polygons. */
struct insertion {
    const struct blob_file *file;
    uint32_t *record_at; /* where each of its polygon records begins, ascending */
    uint32_t *plane_of;  /* of each node, in their order: its plane, set by insertion_join */
    uint32_t new_first;  /* the first polygon of the mesh that is new */
};

/* False: sequences order its faces, so nothing can be added. Free it in either case. */
bool insertion_begin(struct insertion *insertion, const struct blob_file *file,
                     struct problem *problem);
void insertion_free(struct insertion *insertion);

/*
 * Makes a model ready to be compiled into the tree: checks that it lies in the
 * tree's lattice cube, and adds the tree's colours to its own.
 */
bool insertion_take(const struct insertion *insertion, struct model *model,
                    struct problem *problem);

/* Puts the tree's polygons before the mesh's, which has the tree's lattice, and adds planes. */
void insertion_join(struct insertion *insertion, struct mesh *mesh, struct planes *planes);

/* The tree with all new pieces added. progress may be NULL. */
void insertion_build(struct tree *tree, const struct insertion *insertion,
                     struct arrangement *arrangement, struct pieces *pieces, bool two_sided,
                     struct progress *progress);

#endif
