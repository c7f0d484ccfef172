/* SPDX-License-Identifier: 0BSD */
/*
 * The Old Well of Chapel Hill: a stepped round base, eight columns, a ring of stone, a dome with
 * a finial, and the well between the columns. Metres; the parts touch and never overlap.
 *
 * Profiles turn inward only at level ledges, hollows end at a ledge's height, and every column's
 * inner side is one plane that no other column reaches. So there is a plane to separate any two
 * neighbours without a cut: a tree need not be larger than the model, as in [FAG83].
 */
#include "tools/owgen/models.h"
#include "tools/owgen/solids.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

/* Heights that several parts share, and the circle that the columns stand on. */
#define FLOOR 0.66
#define SPRING 3.50 /* the columns' top */
#define CROWN 5.92  /* the dome's top */
#define COLUMN_CIRCLE 2.10

enum { COLUMNS = 8 };

struct paints {
    int brick, paving, step, tread, floor;
    int plinth, column, capital;
    int architrave, frieze, cornice, ceiling, dome, lead, gold;
    int well, rim, lining, water;
};

static struct paints make_paints(struct mesh *mesh)
{
    return (struct paints){
        .brick = mesh_material(mesh, "brick", 0xa35c45),
        .paving = mesh_material(mesh, "paving", 0xb9755a),
        .step = mesh_material(mesh, "step", 0xcfc3ac),
        .tread = mesh_material(mesh, "tread", 0xe0d6c1),
        .floor = mesh_material(mesh, "floor", 0xe8dfcd),
        .plinth = mesh_material(mesh, "plinth", 0xe6dfd0),
        .column = mesh_material(mesh, "column", 0xfaf8f2),
        .capital = mesh_material(mesh, "capital", 0xf1ebdd),
        .architrave = mesh_material(mesh, "architrave", 0xf2ede1),
        .frieze = mesh_material(mesh, "frieze", 0xdfe5e8),
        .cornice = mesh_material(mesh, "cornice", 0xfaf7ef),
        .ceiling = mesh_material(mesh, "ceiling", 0xb9d3e4),
        .dome = mesh_material(mesh, "dome", 0x6f9ea3),
        .lead = mesh_material(mesh, "lead", 0x5b8288),
        .gold = mesh_material(mesh, "gold", 0xd9b04a),
        .well = mesh_material(mesh, "well", 0xcdbfa9),
        .rim = mesh_material(mesh, "rim", 0x8a7a6b),
        .lining = mesh_material(mesh, "lining", 0x5f564d),
        .water = mesh_material(mesh, "water", 0x4b9cd3),
    };
}

/* A block around a column's axis, from one height to another. */
static void add_block(struct mesh *mesh, const char *name, int material, double width,
                      double bottom, double top)
{
    const double foot[3] = { 0, bottom, 0 };
    const double size[3] = { width, top - bottom, width };
    solid_block(mesh, name, material, foot, size);
}

/* ---- low detail: base 38, columns 8 x 20, roof 110, well 26, finial 22: 356 ---- */

static void low_base(struct mesh *mesh, const struct paints *paints)
{
    const struct lathe_point profile[] = {
        { 0, 0, paints->brick },        { 3.70, 0, paints->brick },
        { 3.70, 0.26, paints->paving }, { 2.95, 0.26, paints->step },
        { 2.95, FLOOR, paints->floor }, { 0, FLOOR, paints->floor },
    };
    solid_lathe(mesh, "base", 12, profile, COUNT(profile));
}

static void low_column(struct mesh *mesh, const struct paints *paints)
{
    const double foot = FLOOR + 0.14;
    const double neck = SPRING - 0.14;
    const struct lathe_point shaft[] = {
        { 0, foot, paints->column },
        { 0.200, foot, paints->column },
        { 0.165, neck, paints->column },
        { 0, neck, paints->column },
    };
    add_block(mesh, "plinth", paints->plinth, 0.48, FLOOR, foot);
    solid_lathe(mesh, "column", 6, shaft, COUNT(shaft));
    add_block(mesh, "capital", paints->capital, 0.48, neck, SPRING);
}

static void low_roof(struct mesh *mesh, const struct paints *paints)
{
    const struct lathe_point profile[] = {
        { 0, 3.90, paints->ceiling },         { 1.80, 3.90, paints->architrave },
        { 1.80, SPRING, paints->architrave }, { 2.48, SPRING, paints->architrave },
        { 2.48, 3.90, paints->cornice },      { 2.80, 3.90, paints->cornice },
        { 2.80, 4.12, paints->cornice },      { 2.42, 4.12, paints->dome },
        { 2.12, 4.98, paints->dome },         { 1.35, 5.62, paints->dome },
        { 0.22, CROWN, paints->lead },        { 0, CROWN, paints->lead },
    };
    solid_lathe(mesh, "roof", 12, profile, COUNT(profile));
}

static void low_well(struct mesh *mesh, const struct paints *paints)
{
    const struct lathe_point profile[] = {
        { 0, FLOOR, paints->well },
        { 0.74, FLOOR, paints->well },
        { 0.74, FLOOR + 0.90, paints->rim },
        { 0.54, FLOOR + 0.90, paints->lining },
        { 0.54, FLOOR + 0.66, paints->water },
        { 0, FLOOR + 0.66, paints->water },
    };
    solid_lathe(mesh, "well", 8, profile, COUNT(profile));
}

/* ---- high detail: base 122, columns 8 x 54, roof 338, well 72, finial 36: 1000 ---- */

static void high_base(struct mesh *mesh, const struct paints *paints)
{
    const struct lathe_point profile[] = {
        { 0, 0, paints->brick },        { 3.9, 0, paints->brick },
        { 3.9, 0.16, paints->paving },  { 3.35, 0.16, paints->step },
        { 3.35, 0.41, paints->tread },  { 2.85, 0.41, paints->step },
        { 2.85, FLOOR, paints->floor }, { 0, FLOOR, paints->floor },
    };
    solid_lathe(mesh, "base", 24, profile, COUNT(profile));
}

static void high_column(struct mesh *mesh, const struct paints *paints)
{
    const double foot = FLOOR + 0.12;
    const double neck = SPRING - 0.10;
    const struct lathe_point profile[] = {
        { 0, foot, paints->capital },
        { 0.245, foot, paints->capital },
        { 0.225, foot + 0.11, paints->capital },
        { 0.185, foot + 0.11, paints->column },
        { 0.150, neck - 0.15, paints->capital },
        { 0.175, neck - 0.15, paints->capital },
        { 0.235, neck, paints->capital },
        { 0, neck, paints->capital },
    };
    add_block(mesh, "plinth", paints->plinth, 0.50, FLOOR, foot);
    solid_lathe(mesh, "column", 8, profile, COUNT(profile));
    add_block(mesh, "abacus", paints->capital, 0.50, neck, SPRING);
}

static void high_roof(struct mesh *mesh, const struct paints *paints)
{
    const struct lathe_point profile[] = {
        { 0, 3.76, paints->ceiling },         { 1.80, 3.76, paints->architrave },
        { 1.80, SPRING, paints->architrave }, { 2.44, SPRING, paints->architrave },
        { 2.44, 3.76, paints->cornice },      { 2.36, 3.76, paints->frieze },
        { 2.36, 3.98, paints->cornice },      { 2.60, 3.98, paints->cornice },
        { 2.80, 4.09, paints->cornice },      { 2.80, 4.20, paints->cornice },
        { 2.40, 4.20, paints->lead },         { 2.34, 4.50, paints->dome },
        { 2.08, 5.05, paints->dome },         { 1.58, 5.51, paints->dome },
        { 0.88, 5.82, paints->dome },         { 0.22, CROWN, paints->lead },
        { 0, CROWN, paints->lead },
    };
    solid_lathe(mesh, "roof", 24, profile, COUNT(profile));
}

static void high_well(struct mesh *mesh, const struct paints *paints)
{
    const struct lathe_point profile[] = {
        { 0, FLOOR, paints->well },
        { 0.80, FLOOR, paints->well },
        { 0.80, FLOOR + 0.14, paints->well },
        { 0.68, FLOOR + 0.14, paints->well },
        { 0.62, FLOOR + 0.76, paints->rim },
        { 0.76, FLOOR + 0.76, paints->rim },
        { 0.76, FLOOR + 0.92, paints->rim },
        { 0.54, FLOOR + 0.92, paints->lining },
        { 0.54, FLOOR + 0.76, paints->water },
        { 0, FLOOR + 0.76, paints->water },
    };
    solid_lathe(mesh, "well", 10, profile, COUNT(profile));
}

/* ---- both ---- */

/* A ball, of two sections or three, and a spire on it. */
static void add_finial(struct mesh *mesh, const struct paints *paints, bool high)
{
    const double neck = CROWN + (high ? 0.34 : 0.30);
    const double tip = CROWN + 0.84;
    const struct lathe_point ball[] = {
        { 0, CROWN, paints->gold },           { 0.11, CROWN, paints->gold },
        { 0.20, CROWN + 0.15, paints->gold }, { 0.18, CROWN + 0.25, paints->gold },
        { 0.09, neck, paints->gold },         { 0, neck, paints->gold },
    };
    const struct lathe_point plain_ball[] = {
        { 0, CROWN, paints->gold },
        { 0.12, CROWN, paints->gold },
        { 0.21, CROWN + 0.17, paints->gold },
        { 0.09, neck, paints->gold },
        { 0, neck, paints->gold },
    };
    const struct lathe_point spire[] = {
        { 0, neck, paints->gold },
        { 0.08, neck, paints->gold },
        { 0.012, tip, paints->gold },
        { 0, tip, paints->gold },
    };
    if (high) {
        solid_lathe(mesh, "finial", 8, ball, COUNT(ball));
    } else {
        solid_lathe(mesh, "finial", 6, plain_ball, COUNT(plain_ball));
    }
    solid_lathe(mesh, "spire", high ? 8 : 6, spire, COUNT(spire));
}

void model_oldwell(struct mesh *mesh, const struct model_options *options)
{
    bool high = options->detail == DETAIL_HIGH;
    const struct paints paints = make_paints(mesh);
    (high ? high_base : low_base)(mesh, &paints);
    for (int i = 0; i < COLUMNS; i++) {
        place_reset(mesh);
        place_turn(mesh, 1, 360.0 * i / COLUMNS);
        place_move(mesh, 0, 0, COLUMN_CIRCLE);
        (high ? high_column : low_column)(mesh, &paints);
    }
    place_reset(mesh);
    (high ? high_well : low_well)(mesh, &paints);
    (high ? high_roof : low_roof)(mesh, &paints);
    add_finial(mesh, &paints, high);
}
