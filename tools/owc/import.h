/* SPDX-License-Identifier: 0BSD */
/* Reading models through assimp. */
#ifndef OWC_IMPORT_H
#define OWC_IMPORT_H

#include <stdbool.h>
#include <stddef.h>

#include "model.h"
#include "problem.h"

/* Reads a model file and the material files that it names. Free the model in either case. */
bool import_file(struct model *model, const char *path, struct problem *problem);

/* The same from memory; hint is the file name extension, "obj" say. No other file is read. */
bool import_memory(struct model *model, const void *bytes, size_t size, const char *hint,
                   struct problem *problem);

void import_free(struct model *model);

#endif
