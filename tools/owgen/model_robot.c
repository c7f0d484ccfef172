/* SPDX-License-Identifier: 0BSD */
/*
 * A robot arm with a two-finger gripper; every polygon convex, every part closed.
 * Plate 14, bolts 48, pedestal 14, turntable 26, shoulder 18 + 20, upper arm 12,
 * forearm 24 + 20 + 6, wrist 26, palm 6, fingers 24: 258 polygons.
 */
#include "tools/owgen/circle.h"
#include "tools/owgen/models.h"
#include "tools/owgen/solids.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

/* Pivots, the arm's half thickness (its links run between cheeks), the joints' angles. */
#define SHOULDER_HEIGHT 2.55
#define UPPER_LENGTH 2.40
#define FOREARM_LENGTH 1.50
#define HALF 0.32
#define SHOULDER_ANGLE 20.0
#define ELBOW_ANGLE -95.0

enum { BOLTS = 6, END_POINTS = 5 };

struct paints {
    int iron, steel, orange, amber, dark, rubber;
};

/* A link between two round ends: ten points counter-clockwise, the low end at the origin. */
static void link_outline(struct flat_point points[2 * END_POINTS], double low, double high,
                         double length)
{
    for (int i = 0; i < END_POINTS; i++) {
        double angle = 180.0 * i / (END_POINTS - 1);
        points[i].x = -low * circle_cos(angle);
        points[i].y = -low * circle_sin(angle);
        points[END_POINTS + i].x = high * circle_cos(angle);
        points[END_POINTS + i].y = length + high * circle_sin(angle);
    }
}

static void add_link(struct mesh *mesh, const char *name, int material, double low, double high,
                     double length, double back, double front)
{
    struct flat_point points[2 * END_POINTS];
    struct prism_paint paint = { material, material, material };
    link_outline(points, low, high, length);
    solid_prism(mesh, name, paint, (struct outline){ points, COUNT(points) }, NULL, 0, back, front);
}

/* A pin on each side of a joint: eight-sided, along z. */
static void add_pins(struct mesh *mesh, const char *name, int material, double radius, double near,
                     double far)
{
    for (int side = 0; side < 2; side++) {
        struct placing before = mesh->place;
        place_turn(mesh, 0, side == 0 ? 90 : -90);
        solid_cylinder(mesh, name, material, 8, radius, near, far);
        mesh->place = before;
    }
}

static void add_base(struct mesh *mesh, const struct paints *paints)
{
    const struct lathe_point pedestal[] = {
        { 0, 0.2, paints->dark },
        { 1.0, 0.2, paints->dark },
        { 0.72, 1.3, paints->dark },
        { 0, 1.3, paints->dark },
    };
    const struct lathe_point turntable[] = {
        { 0, 1.3, paints->steel },      { 0.98, 1.3, paints->steel },
        { 0.98, 1.52, paints->orange }, { 0.88, 1.62, paints->orange },
        { 0, 1.62, paints->orange },
    };
    solid_cylinder(mesh, "plate", paints->iron, 12, 1.6, 0, 0.2);
    for (int i = 0; i < BOLTS; i++) {
        place_turn(mesh, 1, 360.0 / BOLTS);
        struct placing before = mesh->place;
        place_move(mesh, 0, 0, 1.3);
        solid_cylinder(mesh, "bolt", paints->steel, 6, 0.12, 0.2, 0.32);
        mesh->place = before;
    }
    place_reset(mesh);
    solid_lathe(mesh, "pedestal", 12, pedestal, COUNT(pedestal));
    solid_lathe(mesh, "turntable", 12, turntable, COUNT(turntable));
}

static void add_shoulder(struct mesh *mesh, const struct paints *paints)
{
    const struct flat_point cheek[] = {
        { -0.60, 1.62 }, { 0.60, 1.62 },    { 0.42, 2.55 },  { 0.297, 2.847 },
        { 0, 2.97 },     { -0.297, 2.847 }, { -0.42, 2.55 },
    };
    const struct outline outline = { cheek, COUNT(cheek) };
    const struct prism_paint paint = { paints->amber, paints->amber, paints->amber };
    solid_prism(mesh, "cheek", paint, outline, NULL, 0, HALF, 0.55);
    solid_prism(mesh, "cheek", paint, outline, NULL, 0, -0.55, -HALF);
}

/* Two links that meet at the wrist; the palm is as long as the gripper is wide. */
static void add_finger(struct mesh *mesh, const struct paints *paints, double palm)
{
    const struct flat_point lower[] = {
        { 0.20, palm },
        { 0.36, palm },
        { 0.56, palm + 0.42 },
        { 0.40, palm + 0.42 },
    };
    const struct flat_point tip[] = {
        { 0.40, palm + 0.42 },
        { 0.56, palm + 0.42 },
        { 0.26, palm + 0.95 },
        { 0.17, palm + 0.95 },
    };
    const struct prism_paint steel = { paints->steel, paints->steel, paints->steel };
    const struct prism_paint rubber = { paints->rubber, paints->rubber, paints->rubber };
    solid_prism(mesh, "finger", steel, (struct outline){ lower, 4 }, NULL, 0, -0.13, 0.13);
    solid_prism(mesh, "fingertip", rubber, (struct outline){ tip, 4 }, NULL, 0, -0.13, 0.13);
}

static void add_hand(struct mesh *mesh, const struct paints *paints)
{
    const struct lathe_point wrist[] = {
        { 0, 1.95, paints->dark },     { 0.26, 1.95, paints->dark },  { 0.26, 2.15, paints->steel },
        { 0.19, 2.22, paints->steel }, { 0.19, 2.36, paints->steel }, { 0, 2.36, paints->steel },
    };
    const double foot[3] = { 0, 2.36, 0 };
    const double palm[3] = { 0.90, 0.16, 0.34 };
    solid_lathe(mesh, "wrist", 8, wrist, COUNT(wrist));
    solid_block(mesh, "palm", paints->dark, foot, palm);
    add_finger(mesh, paints, foot[1] + palm[1]);
    place_turn(mesh, 1, 180);
    add_finger(mesh, paints, foot[1] + palm[1]);
}

void model_robot(struct mesh *mesh, const struct model_options *options)
{
    const struct paints paints = {
        .iron = mesh_material(mesh, "iron", 0x565d66),
        .steel = mesh_material(mesh, "steel", 0xb8c0c8),
        .orange = mesh_material(mesh, "orange", 0xf07d2a),
        .amber = mesh_material(mesh, "amber", 0xf5a13c),
        .dark = mesh_material(mesh, "dark", 0x3a4048),
        .rubber = mesh_material(mesh, "rubber", 0x2c2f34),
    };
    const double body_low[3] = { -0.19, 0.60, -HALF };
    const double body_high[3] = { 0.19, 1.95, HALF };
    (void)options;
    add_base(mesh, &paints);
    add_shoulder(mesh, &paints);
    place_move(mesh, 0, SHOULDER_HEIGHT, 0);
    add_pins(mesh, "shoulder pin", paints.steel, 0.24, 0.55, 0.68);
    place_turn(mesh, 2, SHOULDER_ANGLE);
    add_link(mesh, "upper arm", paints.orange, 0.42, 0.30, UPPER_LENGTH, -HALF, HALF);
    place_move(mesh, 0, UPPER_LENGTH, 0);
    place_turn(mesh, 2, ELBOW_ANGLE);
    add_link(mesh, "forearm", paints.amber, 0.33, 0.21, FOREARM_LENGTH, HALF, 0.46);
    add_link(mesh, "forearm", paints.amber, 0.33, 0.21, FOREARM_LENGTH, -0.46, -HALF);
    add_pins(mesh, "elbow pin", paints.steel, 0.17, 0.46, 0.56);
    solid_box(mesh, "forearm body", paints.orange, body_low, body_high);
    add_hand(mesh, &paints);
    place_reset(mesh);
}
