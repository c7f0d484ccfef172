/* SPDX-License-Identifier: 0BSD */
/*
 * Faces without area. A triangle whose corners lie in one line may only go
 * when its middle corner is put into the long edge of the neighbour, or a
 * closed surface would open there.
 */
#ifndef OWC_CONFORM_H
#define OWC_CONFORM_H

#include "mesh.h"

/*
 * Drops (count = 0) the polygons whose corners lie in one line, and puts their
 * middle corners into all polygons that have the long edges. Counts in mesh.
 */
void conform_drop_lines(struct mesh *mesh);

#endif
