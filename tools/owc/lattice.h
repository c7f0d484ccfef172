/* SPDX-License-Identifier: 0BSD */
/* The lattice of a model's bounding cube, and the snapping of coordinates to it. */
#ifndef OWC_LATTICE_H
#define OWC_LATTICE_H

#include <stdbool.h>
#include <stdint.h>

#include "model.h"

struct lattice {
    double origin[3]; /* model coordinates of lattice point 0,0,0: the box's centre */
    double step;      /* model units in a lattice step: longest side / 65534 */
};

/* The lattice of the vertices that polygons use. False: they all lie in one point. */
bool lattice_of_model(struct lattice *lattice, const struct model *model);

/* Model coordinates in lattice steps, not rounded. */
static inline void lattice_scale(const struct lattice *lattice, const double at[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = (at[i] - lattice->origin[i]) / lattice->step;
    }
}

/* The nearest lattice point; halves go up. */
void lattice_snap(const struct lattice *lattice, const double at[3], int16_t out[3]);

#endif
