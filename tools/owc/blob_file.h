/* SPDX-License-Identifier: 0BSD */
/* Trees read back from files, and the fields of their header that only host programs need. */
#ifndef OWC_BLOB_FILE_H
#define OWC_BLOB_FILE_H

#include <stdint.h>

#include "lattice.h"
#include "ow_tree.h"

struct blob_file {
    uint8_t *bytes;
    struct ow_tree tree;
    struct lattice lattice;
    uint32_t tolerance_q8;
};

/* Reads and checks a tree; a file that is none ends the program with one line. */
void blob_file_open(struct blob_file *file, const char *path);
void blob_file_close(struct blob_file *file);

#endif
