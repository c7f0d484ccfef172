/* SPDX-License-Identifier: 0BSD */
/* Edges that new polygons share with a tree whose polygons were cut there. */
#ifndef OWC_INSERT_EDGES_H
#define OWC_INSERT_EDGES_H

#include "mesh.h"
#include "ow_tree.h"

/*
 * Cutting put corners on the tree's edges, and rounding moved them. Where both
 * ends of a new polygon's edge are corners of the tree, those within rounding
 * of the edge become corners of the polygon too, so that no gap opens.
 */
void insert_edges(struct mesh *mesh, const struct ow_tree *tree);

#endif
