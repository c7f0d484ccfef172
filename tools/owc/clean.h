/* SPDX-License-Identifier: 0BSD */
/*
 * From the file's polygons to the lattice's: corners snapped and joined,
 * polygons that are not flat cut into triangles, degenerate and repeated
 * polygons dropped.
 */
#ifndef OWC_CLEAN_H
#define OWC_CLEAN_H

#include "mesh.h"
#include "problem.h"

/* Free the mesh in either case. False: no polygon is left. */
bool clean_model(struct mesh *mesh, const struct model *model, bool keep_normals,
                 struct problem *problem);

/* The same on a lattice that is given; what lies outside its cube is moved onto its sides. */
bool clean_model_on(struct mesh *mesh, const struct model *model, const struct lattice *lattice,
                    bool keep_normals, struct problem *problem);

#endif
