/* SPDX-License-Identifier: 0BSD */
/* The lattice of a model's bounding cube, and the snapping of coordinates to it. */
#include "lattice.h"

#include <math.h>

#include "ow_blob.h"

bool lattice_of_model(struct lattice *lattice, const struct model *model)
{
    double low[3] = { INFINITY, INFINITY, INFINITY };
    double high[3] = { -INFINITY, -INFINITY, -INFINITY };
    for (size_t i = 0; i < model->corner_count; i++) {
        const double *v = model->vertices[model->corners[i]];
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], v[k]);
            high[k] = fmax(high[k], v[k]);
        }
    }
    double longest = 0;
    for (int k = 0; k < 3; k++) {
        lattice->origin[k] = low[k] / 2 + high[k] / 2;
        longest = fmax(longest, high[k] - low[k]);
    }
    lattice->step = longest / (2 * OW_LATTICE_MAX);
    return lattice->step > 0 && isfinite(lattice->step);
}

void lattice_snap(const struct lattice *lattice, const double at[3], int16_t out[3])
{
    double scaled[3];
    lattice_scale(lattice, at, scaled);
    for (int i = 0; i < 3; i++) {
        double l = floor(scaled[i] + 0.5);
        l = fmax(fmin(l, OW_LATTICE_MAX), -OW_LATTICE_MAX);
        out[i] = (int16_t)l;
    }
}
