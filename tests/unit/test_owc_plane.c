/* SPDX-License-Identifier: 0BSD */
/* Plane records: who shares one, which integers it gets, and which side of it things are on. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "tests/unit/owc_models.h"
#include "tools/owc/arrangement.h"
#include "tools/owc/clean.h"
#include "tools/owc/import.h"
#include "tools/owc/plane.h"

struct scene {
    struct model model;
    struct mesh mesh;
    struct planes planes;
    struct arrangement arrangement;
};

static void scene_end(struct scene *s)
{
    arrangement_free(&s->arrangement);
    planes_free(&s->planes);
    mesh_discard(&s->mesh);
    import_free(&s->model);
}

/* Two far corners: a step is exactly 1, the origin 0. */
static void scene_begin(struct scene *s)
{
    *s = (struct scene){ 0 };
    uint32_t a = models_vertex(&s->model, -32767, -32767, -32767);
    uint32_t b = models_vertex(&s->model, 32767, 32767, 32767);
    uint32_t c = models_vertex(&s->model, 32767, -32767, 32767);
    models_polygon(&s->model, (uint32_t[]){ a, b, c }, 3);
}

static void scene_group(struct scene *s, uint32_t tolerance_q8)
{
    struct problem problem;
    assert_true(clean_model(&s->mesh, &s->model, false, &problem));
    plane_group(&s->planes, &s->mesh, &s->model, tolerance_q8);
    arrangement_begin(&s->arrangement, &s->mesh, &s->planes);
}

static void add_square(struct scene *s, double x, double y, double z, double size, double slope,
                       bool down)
{
    uint32_t v[4];
    for (uint32_t i = 0; i < 4; i++) {
        double dx = size * (i == 1 || i == 2);
        v[i] = models_vertex(&s->model, x + dx, y + size * (i >= 2), z + slope * dx);
    }
    models_polygon(&s->model, down ? (uint32_t[]){ v[3], v[2], v[1], v[0] } : v, 4);
}

static uint32_t record_of(const struct scene *s, uint32_t source)
{
    for (uint32_t i = 0; i < s->mesh.polygon_count; i++) {
        if (s->mesh.polygons[i].source == source) {
            return s->mesh.polygons[i].record;
        }
    }
    assert_true(false);
    return MESH_NONE;
}

/* Squares apart from each other in one plane share a record, also those that look the other way. */
static void test_shared(void **state)
{
    (void)state;
    struct scene s;
    scene_begin(&s);
    add_square(&s, 0, 0, 500.3, 100, 0, false);       /* 2 */
    add_square(&s, 9000, 5000, 500.3, 50, 0, false);  /* 3: far away */
    add_square(&s, 200, 0, 501.2, 20, 0, true);       /* 4: within a step, from behind */
    add_square(&s, 300, 0, 502, 20, 0, false);        /* 5: farther than a step */
    add_square(&s, 0, 200, 500.3, 90, 0.5, false);    /* 6: steep */
    add_square(&s, 100, 0, 500.3, 60, 0.01, false);   /* 7: hangs on 2, within a step */
    add_square(&s, 100, 100, 500.3, 60, 0.03, false); /* 8: hangs on 2, 1.8 steps up */
    scene_group(&s, 256);
    uint32_t record = record_of(&s, 2);
    assert_int_equal(record_of(&s, 3), record);
    assert_int_equal(record_of(&s, 4), record);
    assert_int_not_equal(record_of(&s, 5), record);
    assert_int_not_equal(record_of(&s, 6), record);
    assert_int_equal(record_of(&s, 7), record);
    assert_int_not_equal(record_of(&s, 8), record);
    assert_false(s.mesh.polygons[1].reversed);
    assert_true(s.mesh.polygons[3].reversed);
    scene_end(&s);
}

/* The grouping does not depend on luck: a slanted floor of 400 squares, turned, is one plane. */
static void test_turned_floor(void **state)
{
    (void)state;
    struct scene s;
    scene_begin(&s);
    models_box(&s.model, (double[]){ 20000, 15000, 9000 }, 20,
               &(struct models_pose){ 0.61, 0.37, { 17, 31, 71 } });
    scene_group(&s, 256);
    assert_int_equal(s.planes.count, 7);
    assert_int_equal(s.planes.shared, 6);
    scene_end(&s);
}

/* A triangle alone gets its exact plane, with a normal near the limit, if that fits. */
static void test_exact_triangle(void **state)
{
    (void)state;
    const int16_t a[3] = { 1, 2, 3 };
    const int16_t b[3] = { 1001, 2, 3 };
    const int16_t c[3] = { 1, 1002, 1503 };
    int32_t n[3];
    int64_t d;
    assert_true(plane_of_triangle(a, b, c, n, &d)); /* (0, -1500, 1000): 0, -3, 2 */
    assert_int_equal(n[0], 0);
    assert_int_equal(n[1], -8388606);
    assert_int_equal(n[2], 5592404);
    assert_int_equal(d, -(-8388606LL * 2 + 5592404LL * 3));
    const int16_t wide_b[3] = { 32767, -32766, 12345 };
    const int16_t wide_c[3] = { -32767, 32765, 23456 };
    assert_false(plane_of_triangle(a, wide_b, wide_c, n, &d)); /* too long to be exact */
    assert_false(plane_of_triangle(a, b, a, n, &d));
}

/* All corners of a record's polygons are on it, whatever snapping did to them. */
static void test_own_corners(void **state)
{
    (void)state;
    struct scene s;
    scene_begin(&s);
    models_box(&s.model, (double[]){ 30000, 25000, 9000 }, 9,
               &(struct models_pose){ 0.61, 0.37, { 17, 31, 71 } });
    scene_group(&s, 0); /* strict: only by belonging there */
    uint32_t off = 0;
    for (uint32_t i = 0; i < s.mesh.polygon_count; i++) {
        const struct mesh_polygon *polygon = &s.mesh.polygons[i];
        for (uint32_t k = 0; k < polygon->count; k++) {
            uint32_t corner = s.mesh.corners[polygon->first + k];
            assert_int_equal(arrangement_side(&s.arrangement, polygon->record, corner), 0);
            off += exact_side(&s.planes.all[polygon->record], s.mesh.points[corner]) != 0;
        }
    }
    assert_true(off > 100); /* there was something to forgive */
    scene_end(&s);
}

/* The tolerance's edge: exactly T steps from a plane is on it, T and a bit is not. */
static void test_tolerance_edge(void **state)
{
    (void)state;
    for (uint32_t steps = 0; steps < 3; steps++) {
        struct scene s;
        scene_begin(&s);
        for (int z = -3; z <= 3; z++) {
            add_square(&s, 1000 * z, 0, 100 + z, 100, 0.3, false);
        }
        scene_group(&s, steps * 256);
        uint32_t plane = plane_add(&s.planes, (int32_t[]){ 0, 0, 8388607 }, -8388607LL * 100, 0);
        for (int z = -3; z <= 3; z++) {
            const struct mesh_polygon *polygon = &s.mesh.polygons[4 + z];
            uint32_t corner = s.mesh.corners[polygon->first];
            assert_int_equal(s.mesh.points[corner][2], 100 + z);
            int expected = abs(z) <= (int)steps ? 0 : z > 0 ? 1 : -1;
            assert_int_equal(arrangement_side(&s.arrangement, plane, corner), expected);
        }
        scene_end(&s);
    }
}

/*
 * A vertex on an edge is where the plane cuts it, exactly: planes a hair to
 * either side of it tell, as does the one through it. From (0,0,0) to
 * (3000,1000,7): cut by x = 1000 at (1000, 333 1/3, 2 1/3).
 */
static void test_cut_edge(void **state)
{
    (void)state;
    struct scene s;
    scene_begin(&s);
    models_polygon(&s.model,
                   (uint32_t[]){ models_vertex(&s.model, 0, 0, 0),
                                 models_vertex(&s.model, 3000, 1000, 7),
                                 models_vertex(&s.model, 0, 9000, 0) },
                   3);
    scene_group(&s, 0);
    struct arrangement *a = &s.arrangement;
    const uint32_t *corners = s.mesh.corners + s.mesh.polygons[1].first;
    uint32_t line = arrangement_segment(a, corners[0], corners[1]);
    assert_int_equal(arrangement_segment(a, corners[1], corners[0]), line);
    uint32_t x = plane_add(&s.planes, (int32_t[]){ 1, 0, 0 }, -1000, 0);
    uint32_t v = arrangement_cut(a, line, x, corners[0], corners[1]);
    assert_int_equal(arrangement_cut(a, line, x, corners[1], corners[0]), v);
    assert_int_equal(a->vertices[v].kind, VERTEX_EDGE);
    assert_int_equal(a->vertices[v].lattice[0], 1000);
    assert_int_equal(a->vertices[v].lattice[1], 333);
    assert_int_equal(a->vertices[v].lattice[2], 2);
    uint32_t through = plane_add(&s.planes, (int32_t[]){ 0, 3, 0 }, -1000, 0);
    uint32_t above = plane_add(&s.planes, (int32_t[]){ 0, 8388606, 0 }, -2796202LL * 1000 - 1, 0);
    uint32_t below = plane_add(&s.planes, (int32_t[]){ 0, 8388606, 0 }, -2796202LL * 1000 + 1, 0);
    assert_int_equal(arrangement_side(a, x, v), 0);
    assert_int_equal(arrangement_side(a, through, v), 0);
    assert_int_equal(arrangement_side(a, above, v), -1);
    assert_int_equal(arrangement_side(a, below, v), 1);
    int64_t share[2];
    arrangement_share(a, line, v, share);
    assert_int_equal(3 * share[0], share[1]);
    scene_end(&s);
}

/* A chord's vertex is common to three planes, exactly: the fourth plane through it says 0. */
static void test_cut_chord(void **state)
{
    (void)state;
    struct scene s;
    scene_begin(&s);
    add_square(&s, 0, 0, 0, 3000, 0, false);
    scene_group(&s, 0);
    struct arrangement *a = &s.arrangement;
    const uint32_t *v = s.mesh.corners + s.mesh.polygons[1].first;
    uint32_t carrier = s.mesh.polygons[1].record;
    uint32_t low = arrangement_segment(a, v[0], v[1]);
    uint32_t high = arrangement_segment(a, v[3], v[2]);
    /* The chord runs from (1000, 0) to (2000, 3000); cut by y = x at (1500, 1500), */
    /* and by 7 y = x at (20000/20, 3000/20 ...): x = 1000 + y/3, so 7 y = 1000 + y/3, y = 150. */
    uint32_t cutter = plane_add(&s.planes, (int32_t[]){ 3, -1, 0 }, -3000, 0);
    uint32_t ends[2] = { arrangement_cut(a, low, cutter, v[0], v[1]),
                         arrangement_cut(a, high, cutter, v[3], v[2]) };
    uint32_t chord = arrangement_chord(a, carrier, cutter, ends, 2);
    uint32_t diagonal = plane_add(&s.planes, (int32_t[]){ 1, -1, 0 }, 0, 0);
    uint32_t steep = plane_add(&s.planes, (int32_t[]){ 1, -7, 0 }, 0, 0);
    uint32_t p = arrangement_cut(a, chord, diagonal, ends[0], ends[1]);
    uint32_t q = arrangement_cut(a, chord, steep, ends[0], ends[1]);
    assert_int_equal(a->vertices[p].kind, VERTEX_MEETING);
    assert_int_equal(a->vertices[p].lattice[0], 1500);
    assert_int_equal(a->vertices[p].lattice[1], 1500);
    assert_int_equal(a->vertices[q].lattice[0], 1050);
    assert_int_equal(a->vertices[q].lattice[1], 150);
    uint32_t through = plane_add(&s.planes, (int32_t[]){ 5, 3, 1 }, -12000, 0);
    uint32_t beside = plane_add(&s.planes, (int32_t[]){ 5000000, 3000000, 1 }, -12000000001, 0);
    assert_int_equal(arrangement_side(a, through, p), 0);
    assert_int_equal(arrangement_side(a, beside, p), -1);
    assert_int_equal(arrangement_side(a, carrier, p), 0);
    assert_int_equal(arrangement_side(a, steep, p), -1);
    int64_t share_p[2];
    int64_t share_q[2];
    arrangement_share(a, chord, p, share_p);
    arrangement_share(a, chord, q, share_q);
    assert_true(share_q[0] < share_p[0]);
    scene_end(&s);
}

/* Where three planes have no point in common the vertex is rounded, between the two corners. */
static void test_cut_without_meeting(void **state)
{
    (void)state;
    struct scene s;
    scene_begin(&s);
    add_square(&s, 0, 0, 0, 3000, 0, false);
    scene_group(&s, 0);
    struct arrangement *a = &s.arrangement;
    const uint32_t *v = s.mesh.corners + s.mesh.polygons[1].first;
    uint32_t cutter = plane_add(&s.planes, (int32_t[]){ 3, -1, 0 }, -3000, 0);
    uint32_t ends[2] = { arrangement_cut(a, arrangement_segment(a, v[0], v[1]), cutter, v[0], v[1]),
                         arrangement_cut(a, arrangement_segment(a, v[3], v[2]), cutter, v[3],
                                         v[2]) };
    uint32_t chord = arrangement_chord(a, s.mesh.polygons[1].record, cutter, ends, 2);
    uint32_t along = plane_add(&s.planes, (int32_t[]){ 3, -1, 5 }, -2000, 0);
    uint32_t p = arrangement_cut(a, chord, along, ends[0], ends[1]);
    assert_int_equal(a->vertices[p].kind, VERTEX_ROUNDED);
    assert_int_equal(a->rounded, 1);
    assert_in_range(a->vertices[p].lattice[0], 1000, 2000);
    assert_in_range(a->vertices[p].lattice[1], 0, 3000);
    assert_int_equal(arrangement_side(a, along, p), 1); /* where it was put: 1000 above */
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shared),         cmocka_unit_test(test_turned_floor),
        cmocka_unit_test(test_exact_triangle), cmocka_unit_test(test_own_corners),
        cmocka_unit_test(test_tolerance_edge), cmocka_unit_test(test_cut_edge),
        cmocka_unit_test(test_cut_chord),      cmocka_unit_test(test_cut_without_meeting),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
