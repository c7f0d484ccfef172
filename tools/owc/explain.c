/* SPDX-License-Identifier: 0BSD */
/* Where polygons were split, and by what. */
#include "explain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/common/xalloc.h"

/* Without -0 and without what rounding left of a 0. */
static double tidy(double value, double unit)
{
    return fabs(value) < unit * 1e-6 ? 0 : value;
}

static void print_place(FILE *out, const struct mesh *mesh, const double at[3])
{
    const struct lattice *lattice = &mesh->lattice;
    for (int k = 0; k < 3; k++) {
        double value = tidy(lattice->origin[k] + lattice->step * at[k], lattice->step);
        fprintf(out, "%s%.6g", k > 0 ? "," : "", value);
    }
}

static void print_plane(FILE *out, const struct mesh *mesh, const struct plane *plane)
{
    const double *n = plane->normal;
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    double d = plane->offset / length * mesh->lattice.step;
    for (int k = 0; k < 3; k++) {
        fprintf(out, "%.6g,", tidy(n[k] / length, 1));
        d -= n[k] / length * mesh->lattice.origin[k];
    }
    fprintf(out, "%.6g", tidy(d, mesh->lattice.step));
}

void explain_cuts(FILE *out, const struct mesh *mesh, const struct arrangement *arrangement,
                  const struct pieces *pieces, uint32_t cut_count)
{
    const struct planes *planes = arrangement->planes;
    uint32_t *owner = xalloc_zero(planes->count, sizeof *owner); /* source numbers are from 1 */
    for (uint32_t i = mesh->polygon_count; i > 0; i--) {
        owner[mesh->polygons[i - 1].record] = mesh->polygons[i - 1].source;
    }
    for (uint32_t i = 0; i < cut_count; i++) {
        const struct piece_cut *cut = &pieces->cuts[i];
        fprintf(out, "polygon %u split by ", mesh->polygons[cut->polygon].source);
        if (owner[cut->plane] != 0) {
            fprintf(out, "the plane of polygon %u", owner[cut->plane]);
        } else {
            fprintf(out, "the dividing plane ");
            print_plane(out, mesh, &planes->all[cut->plane]);
        }
        fprintf(out, ", from ");
        print_place(out, mesh, arrangement->at[cut->ends[0]]);
        fprintf(out, " to ");
        print_place(out, mesh, arrangement->at[cut->ends[1]]);
        fprintf(out, "\n");
    }
    free(owner);
}
