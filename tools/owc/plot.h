/* SPDX-License-Identifier: 0BSD */
/* A picture of a tree. */
#ifndef OWC_PLOT_H
#define OWC_PLOT_H

#include <stdio.h>

#include "ow_tree.h"

/* Nodes that are drawn one by one; the largest subtrees are opened first. */
enum { PLOT_MOST_NODES = 400 };

/*
 * Writes the tree as SVG: depth goes downward, switches are circles, sequences
 * are boxes, both with their number of faces; a child that is one face is a dot;
 * a subtree that is not opened is a triangle with its number of nodes.
 */
void plot_tree(FILE *out, const struct ow_tree *tree);

#endif
