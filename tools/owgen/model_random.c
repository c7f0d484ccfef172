/* SPDX-License-Identifier: 0BSD */
/* The two kinds of random triangles that [GC91] measures with. */
#include <stdio.h>

#include "tools/owgen/models.h"
#include "tools/owgen/random_source.h"

/* Side of the cube that the centres lie in. */
#define SPACE 1000.0

enum { PALETTE = 16 };

static const uint32_t palette[PALETTE] = {
    0xd94f45, 0x3f8fd2, 0xf2b33d, 0x58a55c, 0x9a62c4, 0xef7f3a, 0x36b3a8, 0xe07ab0,
    0x8a6d4b, 0x6fa8e8, 0xb7c93f, 0x4a5fb5, 0xf0d26a, 0x7b8794, 0xb23a6b, 0x9fd8b4,
};

static void begin(struct mesh *mesh)
{
    for (int i = 0; i < PALETTE; i++) {
        char name[MESH_NAME_BYTES];
        snprintf(name, sizeof name, "colour%02d", i);
        mesh_material(mesh, name, palette[i]);
    }
    mesh_part(mesh, "triangles", false);
}

static void corner_in(struct random_source *source, const double centre[3], double size,
                      double corner[3])
{
    for (int i = 0; i < 3; i++) {
        corner[i] = random_between(source, centre[i] - size / 2, centre[i] + size / 2);
    }
}

static double turn_seen_from_z(double at[3][3])
{
    return (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) -
           (at[2][0] - at[0][0]) * (at[1][1] - at[0][1]);
}

static void add_triangle(struct mesh *mesh, double at[3][3], uint64_t number)
{
    size_t corners[3];
    for (int k = 0; k < 3; k++) {
        corners[k] = mesh_vertex_new(mesh, at[k][0], at[k][1], at[k][2]);
    }
    mesh_polygon(mesh, (int)(number % PALETTE), 3, corners);
}

void model_random(struct mesh *mesh, const struct model_options *options)
{
    struct random_source source = { options->seed };
    begin(mesh);
    for (uint64_t i = 0; i < options->count; i++) {
        double centre[3];
        double at[3][3];
        for (int k = 0; k < 3; k++) {
            centre[k] = random_between(&source, 0, SPACE);
        }
        for (int k = 0; k < 3; k++) {
            corner_in(&source, centre, options->size, at[k]);
        }
        add_triangle(mesh, at, i);
    }
}

/* All triangles face +z, where [GC91]'s viewer is; the order of the corners is free. */
void model_parallel(struct mesh *mesh, const struct model_options *options)
{
    struct random_source source = { options->seed };
    begin(mesh);
    for (uint64_t i = 0; i < options->count; i++) {
        double centre[3] = { 0 };
        double at[3][3];
        centre[0] = random_between(&source, 0, SPACE);
        centre[1] = random_between(&source, 0, SPACE);
        for (int k = 0; k < 3; k++) {
            corner_in(&source, centre, options->size, at[k]);
            at[k][2] = (double)i * SPACE / (double)options->count;
        }
        if (turn_seen_from_z(at) < 0) {
            for (int k = 0; k < 2; k++) {
                double swapped = at[1][k];
                at[1][k] = at[2][k];
                at[2][k] = swapped;
            }
        }
        add_triangle(mesh, at, i);
    }
}
