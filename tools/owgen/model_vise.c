/* SPDX-License-Identifier: 0BSD */
/*
 * A machinist's vise: concave profiles and holes right through, every part closed.
 * Foot 54, swivel 34, body 22, rails 12, moving jaw 22, jaw plates 40, screw 66, head 12,
 * bar 8, knobs 28, anvil 6: 304 polygons. The screw runs along x.
 */
#include "tools/owgen/circle.h"
#include "tools/owgen/models.h"
#include "tools/owgen/solids.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

/* Shared heights and lengths. */
#define FOOT_TOP 0.5
#define BODY_BOTTOM 1.0
#define BED_TOP 2.3
#define JAW_TOP 4.7
#define HALF_WIDTH 1.2
#define SCREW_HEIGHT 3.1
#define HEAD_FACE -4.4 /* where the screw meets its head */
#define FIXED_FACE 1.2 /* where it meets the fixed jaw */

enum { LUGS = 4, LUG_POINTS = 5, HOLE_POINTS = 8, TEETH_POINTS = 16 };

struct paints {
    int foot, swivel, body, rail, jaw, plate, screw, head, bar, anvil;
};

static struct prism_paint one_paint(int material)
{
    return (struct prism_paint){ material, material, material };
}

/* A round hole: the points run clockwise. */
static void hole_points(struct flat_point *points, int count, double x, double y, double radius)
{
    for (int i = 0; i < count; i++) {
        double angle = -360.0 * (2 * i + 1) / (2 * count);
        points[i].x = x + radius * circle_cos(angle);
        points[i].y = y + radius * circle_sin(angle);
    }
}

/* A plate with four lugs, a bolt hole in each, seen from above: 20 + 32 + 2. */
static void add_foot(struct mesh *mesh, const struct paints *paints)
{
    /* A lug: along its own direction, and across. */
    static const struct flat_point lug[LUG_POINTS] = {
        { 2.6, -0.75 }, { 3.7, -0.75 }, { 4.15, 0 }, { 3.7, 0.75 }, { 2.6, 0.75 },
    };
    struct flat_point points[LUGS * LUG_POINTS];
    struct flat_point bolts[LUGS][HOLE_POINTS];
    struct outline holes[LUGS];
    for (int i = 0; i < LUGS; i++) {
        double c = circle_cos(45 + 90 * i);
        double s = circle_sin(45 + 90 * i);
        for (int k = 0; k < LUG_POINTS; k++) {
            points[i * LUG_POINTS + k].x = lug[k].x * c - lug[k].y * s;
            points[i * LUG_POINTS + k].y = lug[k].x * s + lug[k].y * c;
        }
        hole_points(bolts[i], HOLE_POINTS, 3.3 * c, 3.3 * s, 0.36);
        holes[i] = (struct outline){ bolts[i], HOLE_POINTS };
    }
    place_turn(mesh, 0, -90);
    solid_prism(mesh, "foot", one_paint(paints->foot), (struct outline){ points, COUNT(points) },
                holes, LUGS, 0, FOOT_TOP);
    place_reset(mesh);
}

/* The bed, the fixed jaw and the anvil's seat in one profile, with a hole through the web. */
static void add_body(struct mesh *mesh, const struct paints *paints)
{
    const struct lathe_point swivel[] = {
        { 0, FOOT_TOP, paints->swivel },    { 2.42, FOOT_TOP, paints->swivel },
        { 2.42, 0.85, paints->swivel },     { 2.30, BODY_BOTTOM, paints->swivel },
        { 0, BODY_BOTTOM, paints->swivel },
    };
    const struct flat_point profile[] = {
        { -1.9, BODY_BOTTOM },
        { 1.9, BODY_BOTTOM },
        { 3.1, 2.1 },
        { 4.6, 2.9 },
        { 4.6, 3.5 },
        { 2.4, 3.5 },
        { 2.1, JAW_TOP },
        { FIXED_FACE, JAW_TOP },
        { FIXED_FACE, BED_TOP },
        { -4.0, BED_TOP },
        { -4.0, 1.85 },
        { -2.7, 1.65 },
    };
    struct flat_point web[HOLE_POINTS];
    const struct outline hole = { web, HOLE_POINTS };
    const double anvil_low[3] = { 2.6, 3.5, -1.05 };
    const double anvil_high[3] = { 4.5, 3.72, 1.05 };
    hole_points(web, HOLE_POINTS, 2.2, 2.6, 0.55);
    solid_lathe(mesh, "swivel", 16, swivel, COUNT(swivel));
    solid_prism(mesh, "body", (struct prism_paint){ paints->body, paints->body, paints->body },
                (struct outline){ profile, COUNT(profile) }, &hole, 1, -HALF_WIDTH, HALF_WIDTH);
    solid_box(mesh, "anvil", paints->anvil, anvil_low, anvil_high);
}

/* Two rails on the bed, and the jaw that straddles them. */
static void add_slide(struct mesh *mesh, const struct paints *paints)
{
    const double rail_top = 2.6;
    const struct flat_point profile[] = {
        { -HALF_WIDTH, BED_TOP }, { -0.9, BED_TOP },       { -0.9, rail_top },
        { -0.5, rail_top },       { -0.5, BED_TOP },       { 0.5, BED_TOP },
        { 0.5, rail_top },        { 0.9, rail_top },       { 0.9, BED_TOP },
        { HALF_WIDTH, BED_TOP },  { HALF_WIDTH, JAW_TOP }, { -HALF_WIDTH, JAW_TOP },
    };
    struct flat_point bore[HOLE_POINTS];
    const struct outline hole = { bore, HOLE_POINTS };
    for (int side = 0; side < 2; side++) {
        const double low[3] = { -3.9, BED_TOP, side == 0 ? -0.9 : 0.5 };
        const double high[3] = { FIXED_FACE, rail_top, side == 0 ? -0.5 : 0.9 };
        solid_box(mesh, "rail", paints->rail, low, high);
    }
    hole_points(bore, HOLE_POINTS, 0, SCREW_HEIGHT, 0.38);
    place_turn(mesh, 1, 90);
    solid_prism(mesh, "moving jaw", one_paint(paints->jaw),
                (struct outline){ profile, COUNT(profile) }, &hole, 1, -2.5, -FIXED_FACE);
    place_reset(mesh);
}

/* Serrated plates that face each other across the gap, seen from above. */
static void add_plates(struct mesh *mesh, const struct paints *paints)
{
    struct flat_point points[TEETH_POINTS + 2];
    for (int i = 0; i < TEETH_POINTS; i++) {
        points[i].x = i % 2 == 0 ? -0.88 : -0.98;
        points[i].y = HALF_WIDTH * (2 * i - (TEETH_POINTS - 1)) / (TEETH_POINTS - 1);
    }
    points[TEETH_POINTS] = (struct flat_point){ -FIXED_FACE, HALF_WIDTH };
    points[TEETH_POINTS + 1] = (struct flat_point){ -FIXED_FACE, -HALF_WIDTH };
    for (int side = 0; side < 2; side++) {
        place_reset(mesh);
        place_turn(mesh, 1, 180 * side);
        place_turn(mesh, 0, -90);
        solid_prism(mesh, "jaw plate", one_paint(paints->plate),
                    (struct outline){ points, COUNT(points) }, NULL, 0, 3.85, JAW_TOP);
    }
    place_reset(mesh);
}

static void add_screw(struct mesh *mesh, const struct paints *paints)
{
    const int steel = paints->screw;
    const struct lathe_point profile[] = {
        { 0, HEAD_FACE, steel },     { 0.32, HEAD_FACE, steel }, { 0.24, -3.9, steel },
        { 0.32, -3.4, steel },       { 0.24, -2.9, steel },      { 0.32, -2.4, steel },
        { 0.32, -0.9, steel },       { 0.24, -0.2, steel },      { 0.32, 0.5, steel },
        { 0.24, FIXED_FACE, steel }, { 0, FIXED_FACE, steel },
    };
    place_move(mesh, 0, SCREW_HEIGHT, 0);
    place_turn(mesh, 2, -90);
    solid_lathe(mesh, "screw", 8, profile, COUNT(profile));
    place_reset(mesh);
}

/* The screw's head has a cross bore in which the bar lies loosely; knobs keep it there. */
static void add_handle(struct mesh *mesh, const struct paints *paints)
{
    const double centre = HEAD_FACE - 0.42;
    const double reach = 2.1;
    const struct flat_point block[] = {
        { centre - 0.42, SCREW_HEIGHT - 0.45 },
        { HEAD_FACE, SCREW_HEIGHT - 0.45 },
        { HEAD_FACE, SCREW_HEIGHT + 0.45 },
        { centre - 0.42, SCREW_HEIGHT + 0.45 },
    };
    const struct lathe_point knob[] = {
        { 0, reach, paints->bar },          { 0.18, reach, paints->bar },
        { 0.28, reach + 0.2, paints->bar }, { 0.18, reach + 0.42, paints->bar },
        { 0, reach + 0.42, paints->bar },
    };
    struct flat_point bore[6];
    const struct outline hole = { bore, COUNT(bore) };
    hole_points(bore, COUNT(bore), centre, SCREW_HEIGHT, 0.23);
    solid_prism(mesh, "head", one_paint(paints->head), (struct outline){ block, 4 }, &hole, 1,
                -0.42, 0.42);
    for (int side = 0; side < 2; side++) {
        place_reset(mesh);
        place_move(mesh, centre, SCREW_HEIGHT, 0);
        place_turn(mesh, 0, side == 0 ? 90 : -90);
        if (side == 0) {
            solid_cylinder(mesh, "bar", paints->bar, 6, 0.16, -reach, reach);
        }
        solid_lathe(mesh, "knob", 6, knob, COUNT(knob));
    }
    place_reset(mesh);
}

void model_vise(struct mesh *mesh, const struct model_options *options)
{
    const struct paints paints = {
        .foot = mesh_material(mesh, "foot", 0x2f5d8a),
        .swivel = mesh_material(mesh, "swivel", 0x7d8894),
        .body = mesh_material(mesh, "body", 0x3f78ad),
        .rail = mesh_material(mesh, "rail", 0xc3c9cf),
        .jaw = mesh_material(mesh, "jaw", 0x4a86bd),
        .plate = mesh_material(mesh, "plate", 0xd3d7da),
        .screw = mesh_material(mesh, "screw", 0xb7a98e),
        .head = mesh_material(mesh, "head", 0xa09584),
        .bar = mesh_material(mesh, "bar", 0xd8d8d4),
        .anvil = mesh_material(mesh, "anvil", 0xaeb4ba),
    };
    (void)options;
    add_foot(mesh, &paints);
    add_body(mesh, &paints);
    add_slide(mesh, &paints);
    add_plates(mesh, &paints);
    add_screw(mesh, &paints);
    add_handle(mesh, &paints);
}
