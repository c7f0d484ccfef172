/* SPDX-License-Identifier: 0BSD */
/* A tree in memory, from a file that may be replaced while the program runs. */
#ifndef OLDWELL_BOARDS_LINUX_TREE_H
#define OLDWELL_BOARDS_LINUX_TREE_H

#include <stdbool.h>
#include <stddef.h>

#include "ow_tree.h"

struct loaded_tree {
    struct ow_tree tree;
    void *bytes; /* malloc */
};

/* Reads and opens a file. False: why says what is wrong and what to do; *tree is all zero. */
bool loaded_tree_read(struct loaded_tree *tree, const char *file, char *why, size_t why_bytes);
void loaded_tree_free(struct loaded_tree *tree);

#endif
