/* SPDX-License-Identifier: 0BSD */
/* Whether a mesh bounds a volume. */
#ifndef OWC_CLOSED_H
#define OWC_CLOSED_H

#include "mesh.h"

/* True if each edge runs as often one way as the other and the volume is positive. */
bool closed_mesh(const struct mesh *mesh);

#endif
