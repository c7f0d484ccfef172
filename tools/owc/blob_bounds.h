/* SPDX-License-Identifier: 0BSD */
/* The bounds of a node in the blob: a sphere around its faces and a cone of their normals. */
#ifndef OWC_BLOB_BOUNDS_H
#define OWC_BLOB_BOUNDS_H

#include <stdbool.h>
#include <stdint.h>

#include "repair.h"
#include "tree.h"

struct blob_bounds {
    int16_t centre[3];
    uint16_t radius;
    int8_t axis[3];
    int8_t cosine;
};

/* Has the node bounds? Long sequences of faces alone have. */
bool blob_is_bounded(const struct tree *tree, const struct tree_node *node);

/* Of the rounded corners and the normals as the blob stores them. */
void blob_bounds_find(struct blob_bounds *bounds, const struct repaired *repaired,
                      const struct tree *tree, const struct tree_node *node);

#endif
