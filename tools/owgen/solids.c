/* SPDX-License-Identifier: 0BSD */
/* Closed solids that the models are put together from: lathes, boxes, prisms, frames. */
#include "tools/owgen/solids.h"

#include "tools/common/fail.h"
#include "tools/owgen/circle.h"

enum { MAX_SIDES = 64 };

static size_t lathe_vertex(struct mesh *mesh, const struct lathe_point *point, int sides, int side)
{
    double angle = 360.0 * (2 * (side % sides) - 1) / (2 * sides);
    return mesh_vertex(mesh, point->radius * circle_sin(angle), point->height,
                       point->radius * circle_cos(angle));
}

/* A level cap: at the bottom it looks down, so its corners run the other way. */
static void lathe_cap(struct mesh *mesh, const struct lathe_point *rim, int sides, int material,
                      bool bottom)
{
    size_t corners[MAX_SIDES];
    for (int i = 0; i < sides; i++) {
        corners[i] = lathe_vertex(mesh, rim, sides, bottom ? sides - i : i);
    }
    mesh_polygon(mesh, material, (size_t)sides, corners);
}

/* The sides between two points of the profile; at the axis they are triangles. */
static void lathe_band(struct mesh *mesh, const struct lathe_point *here,
                       const struct lathe_point *next, int sides)
{
    for (int k = 0; k < sides; k++) {
        size_t corners[4];
        corners[0] = lathe_vertex(mesh, here, sides, k);
        corners[1] = lathe_vertex(mesh, here, sides, k + 1);
        corners[2] = lathe_vertex(mesh, next, sides, k + 1);
        corners[3] = lathe_vertex(mesh, next, sides, k);
        mesh_quad(mesh, here->material, corners);
    }
}

void solid_lathe(struct mesh *mesh, const char *name, int sides, const struct lathe_point *profile,
                 size_t count)
{
    mesh_part(mesh, name, true);
    for (size_t i = 0; i + 1 < count; i++) {
        const struct lathe_point *here = &profile[i];
        const struct lathe_point *next = &profile[i + 1];
        bool level = here->height >= next->height && here->height <= next->height;
        if (level && i == 0) {
            lathe_cap(mesh, next, sides, here->material, true);
        } else if (level && i + 2 == count) {
            lathe_cap(mesh, here, sides, here->material, false);
        } else {
            lathe_band(mesh, here, next, sides);
        }
    }
}

void solid_cylinder(struct mesh *mesh, const char *name, int material, int sides, double radius,
                    double bottom, double top)
{
    const struct lathe_point profile[] = {
        { 0, bottom, material },
        { radius, bottom, material },
        { radius, top, material },
        { 0, top, material },
    };
    solid_lathe(mesh, name, sides, profile, 4);
}

void solid_box(struct mesh *mesh, const char *name, int material, const double low[3],
               const double high[3])
{
    /* Corner k has its high x, y, z where bit 0, 1, 2 of k is set. */
    static const int faces[6][4] = {
        { 1, 3, 7, 5 }, { 0, 4, 6, 2 }, { 2, 6, 7, 3 },
        { 0, 1, 5, 4 }, { 4, 5, 7, 6 }, { 0, 2, 3, 1 },
    };
    size_t at[8];
    mesh_part(mesh, name, true);
    for (int k = 0; k < 8; k++) {
        at[k] = mesh_vertex(mesh, (k & 1) != 0 ? high[0] : low[0], (k & 2) != 0 ? high[1] : low[1],
                            (k & 4) != 0 ? high[2] : low[2]);
    }
    for (int f = 0; f < 6; f++) {
        const size_t corners[4] = { at[faces[f][0]], at[faces[f][1]], at[faces[f][2]],
                                    at[faces[f][3]] };
        mesh_quad(mesh, material, corners);
    }
}

void solid_block(struct mesh *mesh, const char *name, int material, const double foot[3],
                 const double size[3])
{
    const double low[3] = { foot[0] - size[0] / 2, foot[1], foot[2] - size[2] / 2 };
    const double high[3] = { foot[0] + size[0] / 2, foot[1] + size[1], foot[2] + size[2] / 2 };
    solid_box(mesh, name, material, low, high);
}

/* ---- prisms with holes ---- */

/* An outline into which holes are woven, one after the other. */
struct weave {
    struct flat_point points[PRISM_POINTS];
    size_t count;
};

/* Twice the area of the triangle a b c, positive if it is counter-clockwise. */
static double turn_of(struct flat_point a, struct flat_point b, struct flat_point c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

static bool same_point(struct flat_point a, struct flat_point b)
{
    return a.x >= b.x && a.x <= b.x && a.y >= b.y && a.y <= b.y;
}

/* True if the segments a b and c d meet anywhere but at a common end. */
static bool segments_meet(struct flat_point a, struct flat_point b, struct flat_point c,
                          struct flat_point d)
{
    const double touch = 1e-9;
    if (same_point(a, c) || same_point(a, d) || same_point(b, c) || same_point(b, d)) {
        return false;
    }
    double c_side = turn_of(a, b, c);
    double d_side = turn_of(a, b, d);
    double a_side = turn_of(c, d, a);
    double b_side = turn_of(c, d, b);
    return c_side * d_side < touch && a_side * b_side < touch;
}

static bool meets_outline(struct flat_point a, struct flat_point b, const struct flat_point *points,
                          size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (segments_meet(a, b, points[i], points[(i + 1) % count])) {
            return true;
        }
    }
    return false;
}

/* A point that ends a bridge occurs twice; a second bridge there could cross the first. */
static bool ends_bridge(const struct weave *weave, size_t point)
{
    for (size_t i = 0; i < weave->count; i++) {
        if (i != point && same_point(weave->points[i], weave->points[point])) {
            return true;
        }
    }
    return false;
}

/* Puts the hole, begun at its corner `inner`, and the bridge after the outline's `outer`. */
static void insert_hole(struct weave *weave, struct outline hole, size_t outer, size_t inner)
{
    size_t more = hole.count + 2;
    for (size_t i = weave->count; i-- > outer;) {
        weave->points[i + more] = weave->points[i];
    }
    for (size_t k = 0; k <= hole.count; k++) {
        weave->points[outer + 1 + k] = hole.points[(inner + k) % hole.count];
    }
    weave->count += more;
}

/* Weaves one hole in by the shortest free bridge; `rest` are holes not yet woven in. */
static void weave_hole(struct weave *weave, struct outline hole, const struct outline *rest,
                       size_t rest_count)
{
    const double tie = 1e-9; /* of equal bridges the first wins, however they are rounded */
    double best = -1;
    size_t best_outer = 0;
    size_t best_inner = 0;
    for (size_t i = 0; i < weave->count; i++) {
        for (size_t k = 0; k < hole.count; k++) {
            struct flat_point a = weave->points[i];
            struct flat_point b = hole.points[k];
            double length = (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
            bool good = (best < 0 || length < best - tie) && !ends_bridge(weave, i) &&
                        !meets_outline(a, b, weave->points, weave->count) &&
                        !meets_outline(a, b, hole.points, hole.count);
            for (size_t r = 0; good && r < rest_count; r++) {
                good = !meets_outline(a, b, rest[r].points, rest[r].count);
            }
            if (good) {
                best = length;
                best_outer = i;
                best_inner = k;
            }
        }
    }
    if (best < 0 || weave->count + hole.count + 2 > PRISM_POINTS) {
        fail(FAIL_INPUT, NULL, 0, "defect: a hole of a prism cannot be joined to its outline");
    }
    insert_hole(weave, hole, best_outer, best_inner);
}

static void prism_face(struct mesh *mesh, const struct weave *weave, int material, double z,
                       bool front)
{
    size_t corners[PRISM_POINTS];
    for (size_t i = 0; i < weave->count; i++) {
        const struct flat_point *p = &weave->points[front ? i : weave->count - 1 - i];
        corners[i] = mesh_vertex(mesh, p->x, p->y, z);
    }
    mesh_polygon(mesh, material, weave->count, corners);
}

static void prism_sides(struct mesh *mesh, struct outline outline, int material, double back,
                        double front)
{
    for (size_t i = 0; i < outline.count; i++) {
        struct flat_point p = outline.points[i];
        struct flat_point q = outline.points[(i + 1) % outline.count];
        size_t corners[4];
        corners[0] = mesh_vertex(mesh, p.x, p.y, back);
        corners[1] = mesh_vertex(mesh, q.x, q.y, back);
        corners[2] = mesh_vertex(mesh, q.x, q.y, front);
        corners[3] = mesh_vertex(mesh, p.x, p.y, front);
        mesh_quad(mesh, material, corners);
    }
}

void solid_prism(struct mesh *mesh, const char *name, struct prism_paint paint,
                 struct outline outline, const struct outline *holes, size_t hole_count,
                 double back, double front)
{
    struct weave weave = { .count = outline.count };
    for (size_t i = 0; i < outline.count; i++) {
        weave.points[i] = outline.points[i];
    }
    for (size_t h = 0; h < hole_count; h++) {
        weave_hole(&weave, holes[h], holes + h + 1, hole_count - h - 1);
    }
    mesh_part(mesh, name, true);
    prism_face(mesh, &weave, paint.front, front, true);
    prism_face(mesh, &weave, paint.back, back, false);
    prism_sides(mesh, outline, paint.side, back, front);
    for (size_t h = 0; h < hole_count; h++) {
        prism_sides(mesh, holes[h], paint.side, back, front);
    }
}

void solid_frame(struct mesh *mesh, const char *name, int material,
                 const struct flat_point outer[2], const struct flat_point inner[2], double back,
                 double front)
{
    const struct flat_point *rectangles[2] = { outer, inner };
    size_t at[2][2][4]; /* outer or inner, back or front, corner counter-clockwise */
    mesh_part(mesh, name, true);
    for (int r = 0; r < 2; r++) {
        for (int k = 0; k < 4; k++) {
            double x = rectangles[r][k == 1 || k == 2].x;
            double y = rectangles[r][k >= 2].y;
            at[r][0][k] = mesh_vertex(mesh, x, y, back);
            at[r][1][k] = mesh_vertex(mesh, x, y, front);
        }
    }
    for (int k = 0; k < 4; k++) {
        int n = (k + 1) % 4;
        const size_t quads[4][4] = {
            { at[0][1][k], at[0][1][n], at[1][1][n], at[1][1][k] },
            { at[0][0][n], at[0][0][k], at[1][0][k], at[1][0][n] },
            { at[0][0][k], at[0][0][n], at[0][1][n], at[0][1][k] },
            { at[1][0][n], at[1][0][k], at[1][1][k], at[1][1][n] },
        };
        for (int q = 0; q < 4; q++) {
            mesh_quad(mesh, material, quads[q]);
        }
    }
}
