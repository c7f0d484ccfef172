/* SPDX-License-Identifier: 0BSD */
/* Vertex normals for smooth shading, where the model brings none. */
#ifndef OWC_NORMALS_H
#define OWC_NORMALS_H

#include "mesh.h"

/*
 * Sets mesh->normals: at each corner the mean of the normals of the polygons
 * around its point, weighted by their angles there, of those that are turned
 * against the corner's own polygon by at most crease degrees (0 .. 180).
 */
void normals_compute(struct mesh *mesh, double crease);

#endif
