/* SPDX-License-Identifier: 0BSD */
/* Models that are made by a formula: the Klein bottle, the ribbon plot, the atoms. */
#include <math.h>
#include <stdio.h>

#include "tools/owgen/circle.h"
#include "tools/owgen/models.h"
#include "tools/owgen/solids.h"

/* ---- Klein bottle: 30 rings of 15 ---- */

enum { KLEIN_RINGS = 30, KLEIN_AROUND = 15, KLEIN_COLOURS = 6 };

/*
 * The bottle's usual formula: the tube's centre line runs up the neck and down through the
 * body; half way the tube's cross-section changes from "across the line" to "level".
 */
static size_t klein_vertex(struct mesh *mesh, int ring, int around)
{
    /* The last ring is the first one mirrored at the vertical, which maps its corners to itself. */
    if (ring == KLEIN_RINGS) {
        ring = 0;
        around = KLEIN_AROUND - around;
    }
    double u = 360.0 * ring / KLEIN_RINGS;
    double v = 90 + 360.0 * (around % KLEIN_AROUND) / KLEIN_AROUND;
    double radius = 4 * (1 - circle_cos(u) / 2);
    double x = 6 * circle_cos(u) * (1 + circle_sin(u));
    double y = 16 * circle_sin(u);
    if (u < 180) {
        x += radius * circle_cos(u) * circle_cos(v);
        y += radius * circle_sin(u) * circle_cos(v);
    } else {
        x -= radius * circle_cos(v);
    }
    return mesh_vertex(mesh, x, y, radius * circle_sin(v));
}

void model_klein(struct mesh *mesh, const struct model_options *options)
{
    static const uint32_t colours[KLEIN_COLOURS] = {
        0xe4572e, 0xf3a712, 0x8fb339, 0x29a19c, 0x3f7cac, 0x9b5094,
    };
    (void)options;
    for (int i = 0; i < KLEIN_COLOURS; i++) {
        char name[MESH_NAME_BYTES];
        snprintf(name, sizeof name, "glass%d", i);
        mesh_material(mesh, name, colours[i]);
    }
    mesh_part(mesh, "bottle", false);
    for (int ring = 0; ring < KLEIN_RINGS; ring++) {
        for (int k = 0; k < KLEIN_AROUND; k++) {
            size_t corners[4];
            corners[0] = klein_vertex(mesh, ring, k);
            corners[1] = klein_vertex(mesh, ring, k + 1);
            corners[2] = klein_vertex(mesh, ring + 1, k + 1);
            corners[3] = klein_vertex(mesh, ring + 1, k);
            mesh_quad(mesh, ring * KLEIN_COLOURS / KLEIN_RINGS, corners);
        }
    }
}

/* ---- ribbon plot: 8 ribbons of 46 pieces ---- */

enum { RIBBONS = 8, RIBBON_PIECES = 46 };

/* A wave that runs out from the middle and dies down. */
static double ribbon_height(double x, double z)
{
    double distance = sqrt(x * x + z * z);
    return 2.6 * exp(-distance / 4) * cos(distance * 1.6);
}

void model_ribbon(struct mesh *mesh, const struct model_options *options)
{
    static const uint32_t colours[RIBBONS] = {
        0x5b3a8c, 0x3f5fbf, 0x2f8fc4, 0x2fae9b, 0x6cbf5a, 0xc9c23f, 0xee9b35, 0xd9503f,
    };
    const double half_length = 6.9;
    const double half_width = 0.5;
    (void)options;
    for (int i = 0; i < RIBBONS; i++) {
        char name[MESH_NAME_BYTES];
        snprintf(name, sizeof name, "ribbon%d", i);
        mesh_material(mesh, name, colours[i]);
        mesh_part(mesh, name, false);
        double z = 1.5 * (i - (RIBBONS - 1) / 2.0);
        for (int k = 0; k < RIBBON_PIECES; k++) {
            double x0 = half_length * (2 * k - RIBBON_PIECES) / RIBBON_PIECES;
            double x1 = half_length * (2 * k + 2 - RIBBON_PIECES) / RIBBON_PIECES;
            double y0 = ribbon_height(x0, z);
            double y1 = ribbon_height(x1, z);
            size_t corners[4];
            corners[0] = mesh_vertex(mesh, x0, y0, z + half_width);
            corners[1] = mesh_vertex(mesh, x1, y1, z + half_width);
            corners[2] = mesh_vertex(mesh, x1, y1, z - half_width);
            corners[3] = mesh_vertex(mesh, x0, y0, z - half_width);
            mesh_quad(mesh, i, corners);
        }
    }
}

/* ---- atoms: 3 spheres of 20 x 16; a BSP tree cuts the 960 into about 1440 ---- */

enum { ATOM_SIDES = 20, ATOM_BANDS = 16 };

static void add_atom(struct mesh *mesh, const char *name, int material, double radius)
{
    struct lathe_point profile[ATOM_BANDS + 1];
    for (int i = 0; i <= ATOM_BANDS; i++) {
        double latitude = 180.0 * i / ATOM_BANDS - 90;
        profile[i].radius = radius * circle_cos(latitude);
        profile[i].height = radius * circle_sin(latitude);
        profile[i].material = material;
    }
    profile[0].radius = 0;
    profile[ATOM_BANDS].radius = 0;
    solid_lathe(mesh, name, ATOM_SIDES, profile, ATOM_BANDS + 1);
}

/* Water: the hydrogens' centres are 104.5 degrees apart and lie inside the oxygen's reach. */
void model_atoms(struct mesh *mesh, const struct model_options *options)
{
    int oxygen = mesh_material(mesh, "oxygen", 0xd8433b);
    int hydrogen = mesh_material(mesh, "hydrogen", 0xe9edf2);
    (void)options;
    add_atom(mesh, "oxygen", oxygen, 1.5);
    for (int side = -1; side <= 1; side += 2) {
        place_reset(mesh);
        place_turn(mesh, 2, side * 104.5 / 2);
        place_move(mesh, 0, -1.75, 0);
        add_atom(mesh, side < 0 ? "hydrogen left" : "hydrogen right", hydrogen, 1.0);
    }
    place_reset(mesh);
}
