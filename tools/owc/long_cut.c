/* SPDX-License-Identifier: 0BSD */
/* Pieces with more corners than a polygon record holds, cut by planes along the axes. */
#include "long_cut.h"

#include <stdlib.h>
#include <string.h>

#include "tools/common/xalloc.h"

uint32_t long_cut_part(const struct long_cuts *cuts, uint32_t piece, int part)
{
    return piece < cuts->count ? cuts->parts[piece][part] : MESH_NONE;
}

static int compare_coordinates(const void *left, const void *right)
{
    return *(const int16_t *)left - *(const int16_t *)right;
}

/* The coordinate c for which as many corners lie above c + 1/2 as below. */
static int16_t median(const struct arrangement *arrangement, const uint32_t *vertices,
                      uint32_t count, int axis)
{
    int16_t *sorted = xalloc(count, sizeof *sorted);
    for (uint32_t i = 0; i < count; i++) {
        sorted[i] = arrangement->vertices[vertices[i]].lattice[axis];
    }
    qsort(sorted, count, sizeof *sorted, compare_coordinates);
    int16_t middle = sorted[count / 2];
    if (middle == sorted[count - 1]) { /* then below the middle, so that something is above */
        middle = (int16_t)(middle - 1);
    }
    free(sorted);
    return middle;
}

/* Corners of the larger part if the piece is cut above this coordinate; 0: it is not cut. */
static uint32_t larger_part(const struct arrangement *arrangement, const uint32_t *vertices,
                            uint32_t count, int axis, int16_t coordinate)
{
    uint32_t parts[2] = { 0, 0 };
    uint32_t crossings = 0;
    bool before = arrangement->vertices[vertices[count - 1]].lattice[axis] > coordinate;
    for (uint32_t i = 0; i < count; i++) {
        bool above = arrangement->vertices[vertices[i]].lattice[axis] > coordinate;
        parts[above]++;
        crossings += above != before;
        before = above;
    }
    uint32_t larger = parts[0] > parts[1] ? parts[0] : parts[1];
    return parts[0] > 0 && parts[1] > 0 ? larger + crossings : 0;
}

static void note_parts(struct long_cuts *cuts, uint32_t piece, const uint32_t parts[2])
{
    size_t needed = (size_t)parts[1] + 1; /* parts have greater numbers than their piece */
    cuts->parts = xgrow(cuts->parts, &cuts->capacity, needed, sizeof *cuts->parts);
    memset(cuts->parts[cuts->count], 0xFF, (needed - cuts->count) * sizeof *cuts->parts);
    cuts->count = needed;
    cuts->parts[piece][0] = parts[0];
    cuts->parts[piece][1] = parts[1];
}

bool long_cut(struct long_cuts *cuts, struct arrangement *arrangement, struct planes *planes,
              struct pieces *pieces, uint32_t number)
{
    const struct piece *piece = &pieces->all[number];
    const uint32_t *vertices = pieces->vertices + piece->first;
    uint32_t least = piece->count;
    int32_t n[3] = { 0, 0, 0 };
    int64_t d = 0;
    for (int axis = 0; axis < 3; axis++) {
        int16_t at = median(arrangement, vertices, piece->count, axis);
        uint32_t larger = larger_part(arrangement, vertices, piece->count, axis, at);
        if (larger > 0 && larger < least) {
            least = larger;
            memset(n, 0, sizeof n);
            n[axis] = 1 << (NORMAL_BITS - 1);
            d = -n[axis] * (int64_t)at - n[axis] / 2;
        }
    }
    if (least == piece->count) {
        return false;
    }
    uint32_t plane = plane_add(planes, n, d, 0);
    uint32_t parts[2];
    if (split_side_of(arrangement, pieces, number, plane) != SPLIT_ACROSS) {
        return false; /* too thin for the tolerance */
    }
    split_piece(&cuts->splitter, arrangement, pieces, number, plane, &parts[0], &parts[1]);
    note_parts(cuts, number, parts);
    return true;
}

void long_cuts_free(struct long_cuts *cuts)
{
    free(cuts->parts);
    splitter_free(&cuts->splitter);
    *cuts = (struct long_cuts){ 0 };
}
