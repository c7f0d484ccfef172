/* SPDX-License-Identifier: 0BSD */
/* Three interlocking cubes: open frames that pass through each other without touching. */
#include <stdio.h>

#include "tools/owgen/models.h"

/* A frame is 3 x 3 x 3 cells: filled are those on an edge of the cube, 20 of 27. */
static bool is_filled(const int cell[3])
{
    int middles = 0;
    for (int i = 0; i < 3; i++) {
        if (cell[i] < 0 || cell[i] > 2) {
            return false;
        }
        middles += cell[i] == 1;
    }
    return middles <= 1;
}

/* The side of `cell` that looks along `axis`, to its low or high end. */
static void add_side(struct mesh *mesh, int material, const int cell[3], int axis, int high)
{
    static const double edges[4] = { -1, -0.76, 0.76, 1 };
    /* Counter-clockwise seen from the high end; the low end's are turned round. */
    static const int steps[4][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
    size_t corners[4];
    int u = (axis + 1) % 3;
    int v = (axis + 2) % 3;
    for (int k = 0; k < 4; k++) {
        const int *step = steps[high != 0 ? k : 3 - k];
        double at[3];
        at[axis] = edges[cell[axis] + high];
        at[u] = edges[cell[u] + step[0]];
        at[v] = edges[cell[v] + step[1]];
        corners[k] = mesh_vertex(mesh, at[0], at[1], at[2]);
    }
    mesh_polygon(mesh, material, 4, corners);
}

/* 72 polygons: 8 on each side of the cube and 4 in each of its six windows. */
static void add_frame(struct mesh *mesh, const char *name, int bar, int corner)
{
    mesh_part(mesh, name, true);
    for (int number = 0; number < 27; number++) {
        int cell[3] = { number % 3, number / 3 % 3, number / 9 };
        int material = cell[0] != 1 && cell[1] != 1 && cell[2] != 1 ? corner : bar;
        for (int side = 0; is_filled(cell) && side < 6; side++) {
            int axis = side / 2;
            int high = side % 2;
            int beyond[3] = { cell[0], cell[1], cell[2] };
            beyond[axis] += high != 0 ? 1 : -1;
            if (!is_filled(beyond)) {
                add_side(mesh, material, cell, axis, high);
            }
        }
    }
}

void model_cubes(struct mesh *mesh, const struct model_options *options)
{
    static const uint32_t bars[3] = { 0xd9503f, 0x3f8fd2, 0xf0b63c };
    static const uint32_t corners[3] = { 0xa8372a, 0x2a68a0, 0xc48a1c };
    /* Any two differ on every axis by more than a bar and less than a window. */
    static const double places[3][3] = {
        { 0, 0.6, 1.2 },
        { 0.6, 1.2, 0 },
        { 1.2, 0, 0.6 },
    };
    (void)options;
    for (int i = 0; i < 3; i++) {
        char name[MESH_NAME_BYTES];
        snprintf(name, sizeof name, "bar%d", i);
        int bar = mesh_material(mesh, name, bars[i]);
        snprintf(name, sizeof name, "corner%d", i);
        int corner = mesh_material(mesh, name, corners[i]);
        snprintf(name, sizeof name, "cube%d", i);
        place_reset(mesh);
        place_move(mesh, places[i][0], places[i][1], places[i][2]);
        add_frame(mesh, name, bar, corner);
    }
    place_reset(mesh);
}
