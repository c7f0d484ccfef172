/* SPDX-License-Identifier: 0BSD */
/*
 * A house with concave walls and with holes cut through them: metres, front to +z, 736 polygons.
 * Ground 28, walls 90, roof 12, chimney 38, wing 38, seven windows 252, round windows 36,
 * shutters 24, door 30, porch 52, fence 136.
 * A wall is built in its own frame: z 0 is its outer face, x runs to the right seen from outside.
 */
#include "tools/owgen/circle.h"
#include "tools/owgen/models.h"
#include "tools/owgen/solids.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])
#define OUTLINE(array) ((struct outline){ array, COUNT(array) })

/* The main block, and where its roof begins and ends. */
#define HALF_LENGTH 5.0
#define HALF_DEPTH 3.5
#define WALL 0.25
#define FLOOR 0.3
#define EAVES 3.3
#define RIDGE 6.1
#define ROOF_THICK 0.2
#define ATTIC_WINDOW 4.4

enum { ROUND = 8, PICKETS = 8 };

struct paints {
    int grass, hedge, paving, stone;
    int wall, gable, inside, wing, roof, wing_roof;
    int brick, cap, pot;
    int frame, sill, shutter, door, knob, garage;
    int porch, post, fence;
};

/* The sides of the main block, as the wall's outer face is placed. */
enum side { FRONT, BACK, LEFT, RIGHT };

static void place_side(struct mesh *mesh, enum side side)
{
    static const double angles[4] = { 0, 180, -90, 90 };
    place_reset(mesh);
    place_turn(mesh, 1, angles[side]);
    place_move(mesh, 0, 0, side == FRONT || side == BACK ? HALF_DEPTH : HALF_LENGTH);
}

static struct prism_paint one_paint(int material)
{
    return (struct prism_paint){ material, material, material };
}

/* ---- holes ---- */

struct rectangle {
    double left, bottom, right, top;
};

static const struct rectangle front_windows[2] = {
    { -3.75, 1.2, -2.25, 2.5 },
    { 2.25, 1.2, 3.75, 2.5 },
};
static const struct rectangle back_windows[2] = {
    { -3.2, 1.2, -1.8, 2.5 },
    { 1.8, 1.2, 3.2, 2.5 },
};
static const struct rectangle left_windows[2] = {
    { -2.2, 1.2, -1.0, 2.5 },
    { 1.0, 1.2, 2.2, 2.5 },
};
static const struct rectangle wing_window = { -0.45, 1.1, 0.95, 2.1 };

/* Four corners, clockwise. */
static struct outline rectangle_hole(struct flat_point points[4], struct rectangle r)
{
    points[0] = (struct flat_point){ r.left, r.bottom };
    points[1] = (struct flat_point){ r.left, r.top };
    points[2] = (struct flat_point){ r.right, r.top };
    points[3] = (struct flat_point){ r.right, r.bottom };
    return (struct outline){ points, 4 };
}

/* Eight corners about (0, ATTIC_WINDOW), clockwise for a hole. */
static struct outline round_outline(struct flat_point points[ROUND], double radius, bool clockwise)
{
    for (int i = 0; i < ROUND; i++) {
        double angle = (clockwise ? -360.0 : 360.0) * (2 * i + 1) / (2 * ROUND);
        points[i].x = radius * circle_cos(angle);
        points[i].y = ATTIC_WINDOW + radius * circle_sin(angle);
    }
    return (struct outline){ points, ROUND };
}

/* ---- the main block ---- */

static void add_ground(struct mesh *mesh, const struct paints *paints)
{
    const double lawn_low[3] = { -8, -0.2, -5.5 };
    const double lawn_high[3] = { 10.5, 0, 8 };
    const double path_low[3] = { -0.6, 0, 5.75 };
    const double path_high[3] = { 0.6, 0.05, 8 };
    const double hedge_low[3] = { 2.3, 0, 3.65 };
    const double hedge_high[3] = { 4.7, 0.55, 4.15 };
    /* Seen from above: x, and -z. */
    const struct flat_point foundation[] = {
        { -5.1, -3.6 }, { 5.1, -3.6 }, { 5.1, -2.1 }, { 8.6, -2.1 },
        { 8.6, 2.6 },   { 5.1, 2.6 },  { 5.1, 3.6 },  { -5.1, 3.6 },
    };
    place_reset(mesh);
    solid_box(mesh, "lawn", paints->grass, lawn_low, lawn_high);
    solid_box(mesh, "path", paints->paving, path_low, path_high);
    solid_box(mesh, "hedge", paints->hedge, hedge_low, hedge_high);
    place_turn(mesh, 0, -90);
    solid_prism(mesh, "foundation", one_paint(paints->stone), OUTLINE(foundation), NULL, 0, 0,
                FLOOR);
}

/* The long walls stand between the gables. */
static void add_long_walls(struct mesh *mesh, const struct paints *paints)
{
    const double end = HALF_LENGTH - WALL;
    const struct prism_paint paint = { paints->wall, paints->inside, paints->frame };
    const struct flat_point front[] = {
        { -end, FLOOR }, { -0.55, FLOOR }, { -0.55, 2.4 }, { 0.55, 2.4 },
        { 0.55, FLOOR }, { end, FLOOR },   { end, EAVES }, { -end, EAVES },
    };
    const struct flat_point back[] = {
        { -end, FLOOR },
        { end, FLOOR },
        { end, EAVES },
        { -end, EAVES },
    };
    struct flat_point corners[2][4];
    struct outline holes[2];
    for (int i = 0; i < 2; i++) {
        holes[i] = rectangle_hole(corners[i], front_windows[i]);
    }
    place_side(mesh, FRONT);
    solid_prism(mesh, "front wall", paint, OUTLINE(front), holes, 2, -WALL, 0);
    for (int i = 0; i < 2; i++) {
        holes[i] = rectangle_hole(corners[i], back_windows[i]);
    }
    place_side(mesh, BACK);
    solid_prism(mesh, "back wall", paint, OUTLINE(back), holes, 2, -WALL, 0);
}

static void add_gables(struct mesh *mesh, const struct paints *paints)
{
    const struct prism_paint paint = { paints->gable, paints->inside, paints->frame };
    const struct flat_point left[] = {
        { -HALF_DEPTH, FLOOR }, { HALF_DEPTH, FLOOR },  { HALF_DEPTH, EAVES },
        { 0, RIDGE },           { -HALF_DEPTH, EAVES },
    };
    const struct flat_point right[] = {
        { -HALF_DEPTH, FLOOR }, { 0, FLOOR },   { 0, 2.3 },
        { 0.9, 2.3 },           { 0.9, FLOOR }, { HALF_DEPTH, FLOOR },
        { HALF_DEPTH, EAVES },  { 0, RIDGE },   { -HALF_DEPTH, EAVES },
    };
    struct flat_point corners[2][4];
    struct flat_point round[ROUND];
    const struct outline holes[3] = {
        rectangle_hole(corners[0], left_windows[0]),
        rectangle_hole(corners[1], left_windows[1]),
        round_outline(round, 0.55, true),
    };
    place_side(mesh, LEFT);
    solid_prism(mesh, "left gable", paint, OUTLINE(left), holes, 3, -WALL, 0);
    place_side(mesh, RIGHT);
    solid_prism(mesh, "right gable", paint, OUTLINE(right), holes + 2, 1, -WALL, 0);
}

/* A wall across the house with a doorway, and the ceiling under the attic. */
static void add_inside(struct mesh *mesh, const struct paints *paints)
{
    const double ceiling = 3.05;
    const double end = HALF_DEPTH - WALL;
    const double low[3] = { WALL - HALF_LENGTH, ceiling, -end };
    const double high[3] = { HALF_LENGTH - WALL, EAVES, end };
    const struct flat_point wall[] = {
        { -end, FLOOR }, { 0.5, FLOOR }, { 0.5, 2.3 },     { 1.4, 2.3 },
        { 1.4, FLOOR },  { end, FLOOR }, { end, ceiling }, { -end, ceiling },
    };
    place_reset(mesh);
    solid_box(mesh, "ceiling", paints->inside, low, high);
    place_turn(mesh, 1, -90);
    solid_prism(mesh, "inner wall", one_paint(paints->inside), OUTLINE(wall), NULL, 0, -1.2, -1.0);
}

/* Two slabs that lie on the gables; seen from the left end, z to the right. */
static void add_roof(struct mesh *mesh, const struct paints *paints)
{
    const double edge = 3.8;
    const double low = 3.06; /* the slope through eaves and ridge, carried on to the edge */
    const double overhang = HALF_LENGTH + 0.3;
    const struct flat_point front[] = {
        { 0, RIDGE },
        { edge, low },
        { edge, low + ROOF_THICK },
        { 0, RIDGE + ROOF_THICK },
    };
    const struct flat_point back[] = {
        { -edge, low },
        { 0, RIDGE },
        { 0, RIDGE + ROOF_THICK },
        { -edge, low + ROOF_THICK },
    };
    place_reset(mesh);
    place_turn(mesh, 1, -90);
    solid_prism(mesh, "front roof", one_paint(paints->roof), OUTLINE(front), NULL, 0, -overhang,
                overhang);
    solid_prism(mesh, "back roof", one_paint(paints->roof), OUTLINE(back), NULL, 0, -overhang,
                overhang);
}

static void add_chimney(struct mesh *mesh, const struct paints *paints)
{
    const double top = 7.0;
    const struct flat_point stack[] = {
        { -1.6, 5.02 },
        { -0.9, 5.58 },
        { -0.9, top },
        { -1.6, top },
    };
    const double cap_low[3] = { 2.5, top, -1.7 };
    const double cap_high[3] = { 3.5, top + 0.15, -0.8 };
    const struct lathe_point pot[] = {
        { 0, top + 0.15, paints->pot },    { 0.26, top + 0.15, paints->pot },
        { 0.20, top + 0.60, paints->pot }, { 0.13, top + 0.60, paints->cap },
        { 0.13, top + 0.30, paints->cap }, { 0, top + 0.30, paints->cap },
    };
    place_reset(mesh);
    solid_box(mesh, "chimney cap", paints->cap, cap_low, cap_high);
    place_turn(mesh, 1, -90);
    solid_prism(mesh, "chimney", one_paint(paints->brick), OUTLINE(stack), NULL, 0, -3.4, -2.6);
    place_reset(mesh);
    place_move(mesh, 3.0, 0, -1.25);
    solid_lathe(mesh, "chimney pot", 8, pot, COUNT(pot));
}

/* ---- the wing: a garage under a lean-to roof ---- */

static void place_wing_side(struct mesh *mesh)
{
    place_reset(mesh);
    place_turn(mesh, 1, 90);
    place_move(mesh, 0, 0, 8.5);
}

static void add_wing(struct mesh *mesh, const struct paints *paints)
{
    const struct prism_paint paint = { paints->wing, paints->inside, paints->frame };
    const struct flat_point front[] = {
        { 5, FLOOR },   { 5.35, FLOOR }, { 5.35, 2.3 },  { 7.9, 2.3 },
        { 7.9, FLOOR }, { 8.25, FLOOR }, { 8.25, 2.65 }, { 5, EAVES },
    };
    const struct flat_point back[] = {
        { -8.25, FLOOR },
        { -5, FLOOR },
        { -5, EAVES },
        { -8.25, 2.65 },
    };
    const struct flat_point side[] = {
        { -2.0, FLOOR },
        { 2.5, FLOOR },
        { 2.5, 2.6 },
        { -2.0, 2.6 },
    };
    const struct flat_point roof[] = {
        { 5, EAVES },
        { 8.8, 2.54 },
        { 8.8, 2.72 },
        { 5, EAVES + 0.18 },
    };
    const double door_low[3] = { 5.35, FLOOR, 1.80 };
    const double door_high[3] = { 7.9, 2.3, 1.88 };
    struct flat_point corners[4];
    const struct outline hole = rectangle_hole(corners, wing_window);
    place_reset(mesh);
    solid_box(mesh, "garage door", paints->garage, door_low, door_high);
    solid_prism(mesh, "wing roof", one_paint(paints->wing_roof), OUTLINE(roof), NULL, 0, -2.8, 2.3);
    solid_prism(mesh, "wing front", paint, OUTLINE(front), NULL, 0, 2.0 - WALL, 2.0);
    place_turn(mesh, 1, 180);
    solid_prism(mesh, "wing back", paint, OUTLINE(back), NULL, 0, 2.5 - WALL, 2.5);
    place_wing_side(mesh);
    solid_prism(mesh, "wing side", paint, OUTLINE(side), &hole, 1, -WALL, 0);
}

/* ---- windows and doors, in the wall's frame ---- */

/* Frame, cross bars and sill: 16 + 14 + 6. The frame fills the hole and stands out a little. */
static void add_window(struct mesh *mesh, const struct paints *paints, struct rectangle r)
{
    const double width = 0.09;
    const double bar = 0.03;
    const struct flat_point outer[2] = { { r.left, r.bottom }, { r.right, r.top } };
    const struct flat_point inner[2] = {
        { r.left + width, r.bottom + width },
        { r.right - width, r.top - width },
    };
    const double x = (r.left + r.right) / 2;
    const double y = (r.bottom + r.top) / 2;
    const struct flat_point cross[] = {
        { x - bar, y - bar }, { x - bar, inner[0].y }, { x + bar, inner[0].y },
        { x + bar, y - bar }, { inner[1].x, y - bar }, { inner[1].x, y + bar },
        { x + bar, y + bar }, { x + bar, inner[1].y }, { x - bar, inner[1].y },
        { x - bar, y + bar }, { inner[0].x, y + bar }, { inner[0].x, y - bar },
    };
    const double sill_low[3] = { r.left - 0.1, r.bottom - 0.1, 0 };
    const double sill_high[3] = { r.right + 0.1, r.bottom, 0.12 };
    solid_frame(mesh, "window frame", paints->frame, outer, inner, -WALL - 0.03, 0.03);
    solid_prism(mesh, "window bars", one_paint(paints->frame), OUTLINE(cross), NULL, 0, -0.14,
                -0.09);
    solid_box(mesh, "window sill", paints->sill, sill_low, sill_high);
}

static void add_shutters(struct mesh *mesh, const struct paints *paints, struct rectangle r)
{
    for (int side = 0; side < 2; side++) {
        double left = side == 0 ? r.left - 0.62 : r.right + 0.04;
        const double low[3] = { left, r.bottom, 0 };
        const double high[3] = { left + 0.58, r.top, 0.06 };
        solid_box(mesh, "shutter", paints->shutter, low, high);
    }
}

static void add_windows(struct mesh *mesh, const struct paints *paints)
{
    for (int i = 0; i < 2; i++) {
        place_side(mesh, FRONT);
        add_window(mesh, paints, front_windows[i]);
        add_shutters(mesh, paints, front_windows[i]);
        place_side(mesh, BACK);
        add_window(mesh, paints, back_windows[i]);
        place_side(mesh, LEFT);
        add_window(mesh, paints, left_windows[i]);
        struct flat_point outer[ROUND];
        struct flat_point inner[ROUND];
        const struct outline ring = round_outline(outer, 0.55, false);
        const struct outline hole = round_outline(inner, 0.43, true);
        place_side(mesh, i == 0 ? LEFT : RIGHT);
        solid_prism(mesh, "round window", one_paint(paints->frame), ring, &hole, 1, -WALL - 0.04,
                    0.04);
    }
    place_wing_side(mesh);
    add_window(mesh, paints, wing_window);
}

static void add_door(struct mesh *mesh, const struct paints *paints)
{
    const struct flat_point frame[] = {
        { -0.55, FLOOR }, { -0.45, FLOOR }, { -0.45, 2.3 }, { 0.45, 2.3 },
        { 0.45, FLOOR },  { 0.55, FLOOR },  { 0.55, 2.4 },  { -0.55, 2.4 },
    };
    const double low[3] = { -0.45, FLOOR, -0.14 };
    const double high[3] = { 0.45, 2.3, -0.08 };
    const struct lathe_point knob[] = {
        { 0, -0.08, paints->knob },  { 0.03, -0.08, paints->knob }, { 0.06, -0.03, paints->knob },
        { 0.03, 0.0, paints->knob }, { 0, 0.0, paints->knob },
    };
    place_side(mesh, FRONT);
    solid_prism(mesh, "door frame", one_paint(paints->frame), OUTLINE(frame), NULL, 0, -WALL - 0.03,
                0.04);
    solid_box(mesh, "door", paints->door, low, high);
    place_move(mesh, 0.33, 1.3, 0);
    place_turn(mesh, 0, 90);
    solid_lathe(mesh, "door knob", 6, knob, COUNT(knob));
}

/* ---- porch and fence ---- */

static void add_porch(struct mesh *mesh, const struct paints *paints)
{
    static const double post_places[4] = { -1.85, -0.8, 0.8, 1.85 };
    const double floor_low[3] = { -2, 0, 3.6 };
    const double floor_high[3] = { 2, FLOOR, 5.0 };
    const double post[3] = { 0.18, 2.0, 0.18 };
    /* Seen from the left, z to the right. */
    const struct flat_point steps[] = {
        { 5.0, 0 },   { 5.75, 0 },   { 5.75, 0.1 },   { 5.5, 0.1 },
        { 5.5, 0.2 }, { 5.25, 0.2 }, { 5.25, FLOOR }, { 5.0, FLOOR },
    };
    const struct flat_point beam[] = {
        { 4.75, 2.3 },
        { 4.95, 2.3 },
        { 4.95, 2.51 },
        { 4.75, 2.55 },
    };
    const struct flat_point roof[] = {
        { 3.5, 2.8 },
        { 5.3, 2.44 },
        { 5.3, 2.58 },
        { 3.5, 2.94 },
    };
    place_reset(mesh);
    solid_box(mesh, "porch floor", paints->stone, floor_low, floor_high);
    for (int i = 0; i < 4; i++) {
        const double foot[3] = { post_places[i], FLOOR, 4.85 };
        solid_block(mesh, "porch post", paints->post, foot, post);
    }
    place_turn(mesh, 1, -90);
    solid_prism(mesh, "steps", one_paint(paints->stone), OUTLINE(steps), NULL, 0, -1.1, 1.1);
    solid_prism(mesh, "porch beam", one_paint(paints->post), OUTLINE(beam), NULL, 0, -2, 2);
    solid_prism(mesh, "porch roof", one_paint(paints->porch), OUTLINE(roof), NULL, 0, -2.3, 2.3);
}

/* A run of pointed pickets on two rails, to the right of mesh->place. */
static void add_fence(struct mesh *mesh, const struct paints *paints)
{
    static const double rail_heights[2] = { 0.28, 0.62 };
    const double pitch = 0.66;
    const struct flat_point picket[] = {
        { 0, 0 }, { 0.4, 0 }, { 0.4, 0.8 }, { 0.2, 1.0 }, { 0, 0.8 },
    };
    for (int i = 0; i < 2; i++) {
        const double low[3] = { 0.1, rail_heights[i], -0.06 };
        const double high[3] = { pitch * PICKETS - 0.36, rail_heights[i] + 0.1, 0 };
        solid_box(mesh, "fence rail", paints->fence, low, high);
    }
    for (int i = 0; i < PICKETS; i++) {
        solid_prism(mesh, "picket", one_paint(paints->fence), OUTLINE(picket), NULL, 0, 0, 0.05);
        place_move(mesh, pitch, 0, 0);
    }
}

static struct paints make_paints(struct mesh *mesh)
{
    return (struct paints){
        .grass = mesh_material(mesh, "grass", 0x7fae5a),
        .hedge = mesh_material(mesh, "hedge", 0x4f8a4a),
        .paving = mesh_material(mesh, "paving", 0xc7b9a2),
        .stone = mesh_material(mesh, "stone", 0xa9a49b),
        .wall = mesh_material(mesh, "wall", 0xf0e3c4),
        .gable = mesh_material(mesh, "gable", 0xe9d8b2),
        .inside = mesh_material(mesh, "inside", 0xd9c7b8),
        .wing = mesh_material(mesh, "wing", 0xdfcfae),
        .roof = mesh_material(mesh, "roof", 0xb0503c),
        .wing_roof = mesh_material(mesh, "wing_roof", 0x9c4a3a),
        .brick = mesh_material(mesh, "brick", 0x9a5440),
        .cap = mesh_material(mesh, "cap", 0x8d8a84),
        .pot = mesh_material(mesh, "pot", 0xc97b54),
        .frame = mesh_material(mesh, "frame", 0xfbfaf5),
        .sill = mesh_material(mesh, "sill", 0xd9d4c8),
        .shutter = mesh_material(mesh, "shutter", 0x3f7f77),
        .door = mesh_material(mesh, "door", 0x2f6d8c),
        .knob = mesh_material(mesh, "knob", 0xe0b84a),
        .garage = mesh_material(mesh, "garage", 0x8fb0b8),
        .porch = mesh_material(mesh, "porch", 0xa84b3a),
        .post = mesh_material(mesh, "post", 0xf6f3ea),
        .fence = mesh_material(mesh, "fence", 0xf4f1e8),
    };
}

void model_house(struct mesh *mesh, const struct model_options *options)
{
    const struct paints paints = make_paints(mesh);
    (void)options;
    add_ground(mesh, &paints);
    add_long_walls(mesh, &paints);
    add_gables(mesh, &paints);
    add_inside(mesh, &paints);
    add_roof(mesh, &paints);
    add_chimney(mesh, &paints);
    add_wing(mesh, &paints);
    add_windows(mesh, &paints);
    add_door(mesh, &paints);
    add_porch(mesh, &paints);
    for (int side = 0; side < 2; side++) {
        place_reset(mesh);
        place_move(mesh, side == 0 ? -6.1 : 1.08, 0, 7);
        add_fence(mesh, &paints);
    }
    place_reset(mesh);
}
