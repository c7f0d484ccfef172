/* SPDX-License-Identifier: 0BSD */
/* The location problem as a command. */
#include "locate_print.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "blob_file.h"
#include "locate.h"
#include "tools/common/fail.h"
#include "tools/common/outfile.h"
#include "tools/common/xalloc.h"

#define FARTHEST 4194303.0 /* lattice units: with 8 fraction bits below 2^30 */

static void to_lattice(const struct lattice *lattice, const double point[3], int32_t out[3])
{
    double scaled[3];
    lattice_scale(lattice, point, scaled);
    for (int k = 0; k < 3; k++) {
        out[k] = (int32_t)floor(scaled[k] * 256 + 0.5);
    }
}

static bool is_far(const struct lattice *lattice, const double point[3])
{
    double scaled[3];
    lattice_scale(lattice, point, scaled);
    return !(fabs(scaled[0]) <= FARTHEST && fabs(scaled[1]) <= FARTHEST &&
             fabs(scaled[2]) <= FARTHEST);
}

/* n.(v - origin) / step + d = 0 as a unit normal and a distance in model units. */
static void print_side(FILE *out, const struct lattice *lattice, const struct locate_side *side)
{
    double length = 0;
    double d = (double)side->d * lattice->step;
    for (int k = 0; k < 3; k++) {
        length += (double)side->n[k] * side->n[k];
        d -= side->n[k] * lattice->origin[k];
    }
    length = sqrt(length);
    fprintf(out, "%s %.9g,%.9g,%.9g,%.9g\n", side->front ? "front " : "behind", side->n[0] / length,
            side->n[1] / length, side->n[2] / length, d / length);
}

void locate_print(const char *path, const double point[3])
{
    struct blob_file file;
    struct locate_region region;
    int32_t at[3];
    blob_file_open(&file, path);
    if (is_far(&file.lattice, point)) {
        fail(FAIL_INPUT, path, 0, "the point is too far away: more than 64 cubes");
    }
    to_lattice(&file.lattice, point, at);
    struct locate_side *sides = xalloc(file.tree.depth, sizeof *sides);
    if (locate_point(&file.tree, at, sides, &region) != OW_OK) {
        fail(FAIL_INPUT, path, 0,
             "sequences order its faces, so that its switches bound no "
             "regions: compile with --method bsp or online");
    }
    struct outfile *out = outfile_open("-");
    FILE *stream = outfile_stream(out);
    fprintf(stream, "region %" PRIu32 " of %" PRIu32 ", planes a,b,c,d with ax + by + cz + d = 0\n",
            region.leaf, file.tree.switch_count + 1);
    for (uint32_t i = 0; i < region.side_count; i++) {
        print_side(stream, &file.lattice, &sides[i]);
    }
    outfile_commit(out);
    free(sides);
    blob_file_close(&file);
}
