/* SPDX-License-Identifier: 0BSD */
/* Writes a mesh as an OBJ file and its materials as an MTL file beside it. */
#ifndef OLDWELL_TOOLS_OWGEN_WRITE_H
#define OLDWELL_TOOLS_OWGEN_WRITE_H

#include "tools/owgen/mesh.h"

/*
 * Writes `path`, and the same name with .mtl in place of .obj. Both files come whole or not at
 * all; errors end the program. Standard output and devices get no MTL and name none.
 * `title` is one line for the files' first comment.
 */
void write_model(const struct mesh *mesh, const char *title, const char *path);

#endif
