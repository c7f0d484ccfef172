/* SPDX-License-Identifier: 0BSD */
/* Writing the blob that ow_blob.h describes. */
#ifndef OWC_BLOB_WRITE_H
#define OWC_BLOB_WRITE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "mesh.h"
#include "pieces.h"
#include "plane.h"
#include "problem.h"
#include "repair.h"
#include "tree.h"

/* How large a tree may be. */
struct blob_limits {
    uint32_t bytes;
    uint32_t levels;
    uint32_t vertices;
    uint32_t node_items; /* in one node */
};

struct blob_parts {
    const struct mesh *mesh;
    const struct planes *planes;
    const struct pieces *pieces;
    uint32_t piece_count; /* pieces that repaired knows of */
    const struct repaired *repaired;
    const struct tree *tree;
    const uint32_t *colours;
    uint32_t colour_count;
    uint32_t tolerance_q8;
    const struct blob_limits *limits; /* NULL: the format's */
    bool two_sided;
    bool switch_only;
    bool keep_ids;
};

struct blob {
    uint8_t *bytes;
    uint32_t size;
    uint32_t polygons; /* the same counts as in its header */
    uint32_t vertices;
    uint32_t nodes;
    uint32_t switches;
    uint32_t switch_depth; /* most switches on a path */
};

/* False: the tree is larger than the limits. Free the blob in either case. */
bool blob_write(struct blob *blob, const struct blob_parts *parts, struct problem *problem);
void blob_free(struct blob *blob);

#endif
