/* SPDX-License-Identifier: 0BSD */
/* The tree as a file, and the lattice that its header places in model units. */
#ifndef OLDWELL_BOARDS_SIM_TREE_FILE_H
#define OLDWELL_BOARDS_SIM_TREE_FILE_H

#include <stddef.h>

#include "ow_tree.h"

struct tree_file {
    const char *name; /* for messages */
    struct ow_tree tree;
    void *bytes; /* the file; malloc */
    /* A plane image: its pixels, which begin with the blob, and how many there are; or NULL. */
    const uint8_t *planes;
    uint32_t planes_size[2];
    double origin[3]; /* model coordinates of lattice point 0, 0, 0 */
    double step;      /* model units in a lattice step */
};

/* Reads a file whole ("-": standard input) into malloc'd memory; ends the program on failure. */
void *read_whole_file(const char *file, const char *name, size_t max_bytes, size_t *bytes);

/* Reads and opens a tree; ends the program with status 1 if it is not a good one. */
void tree_file_open(struct tree_file *file, const char *name);

/* Likewise from a plane image. The tree is that in the image, as if in memory. */
void tree_file_open_planes(struct tree_file *file, const char *name);
void tree_file_close(struct tree_file *file);

#endif
