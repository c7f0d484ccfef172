/* SPDX-License-Identifier: 0BSD */
/* Snapping, joining and cleaning: what is dropped, what stays, and how uneven polygons are cut. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "ow_blob.h"
#include "tests/unit/owc_models.h"
#include "tools/owc/clean.h"
#include "tools/owc/import.h"
#include "tools/owc/random.h"
#include "tools/owc/triangulate.h"

static void clean(struct mesh *mesh, const struct model *model)
{
    struct problem problem;
    assert_true(clean_model(mesh, model, false, &problem));
}

/* Two far corners that fix the lattice: a step is exactly 1, the origin 0. */
static void make_unit_lattice(struct model *model)
{
    uint32_t a = models_vertex(model, -OW_LATTICE_MAX, -OW_LATTICE_MAX, -OW_LATTICE_MAX);
    uint32_t b = models_vertex(model, OW_LATTICE_MAX, OW_LATTICE_MAX, OW_LATTICE_MAX);
    uint32_t c = models_vertex(model, OW_LATTICE_MAX, -OW_LATTICE_MAX, OW_LATTICE_MAX);
    models_polygon(model, (uint32_t[]){ a, b, c }, 3);
}

/* The longest side takes 65534 steps, centred; halves go up. */
static void test_lattice(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct mesh mesh;
    models_polygon(&model,
                   (uint32_t[]){ models_vertex(&model, 10, 1, 0), models_vertex(&model, 14, 1, 0),
                                 models_vertex(&model, 14, 3, 1) },
                   3);
    clean(&mesh, &model);
    assert_true(mesh.lattice.step == 4.0 / 65534);
    assert_true(mesh.lattice.origin[0] == 12 && mesh.lattice.origin[1] == 2 &&
                mesh.lattice.origin[2] == 0.5);
    assert_int_equal(mesh.points[0][0], -32767);
    assert_int_equal(mesh.points[1][0], 32767);
    int16_t at[3];
    struct lattice unit = { { 0, 0, 0 }, 1 };
    lattice_snap(&unit, (double[]){ 0.5, -0.5, 1.499 }, at);
    assert_int_equal(at[0], 1);
    assert_int_equal(at[1], 0);
    assert_int_equal(at[2], 1);
    mesh_discard(&mesh);
    import_free(&model);
}

/* Vertices in one lattice point are one; faces that lose their third corner go. */
static void test_joined(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct mesh mesh;
    make_unit_lattice(&model);
    uint32_t a = models_vertex(&model, 0, 0, 0);
    uint32_t b = models_vertex(&model, 0.4, 0, 0);
    uint32_t c = models_vertex(&model, 100, 0, 0);
    uint32_t d = models_vertex(&model, 0, 100, 0);
    models_polygon(&model, (uint32_t[]){ a, c, d }, 3);
    models_polygon(&model, (uint32_t[]){ b, d, c }, 3);    /* the other side: no repetition */
    models_polygon(&model, (uint32_t[]){ a, b, c }, 3);    /* two points */
    models_polygon(&model, (uint32_t[]){ a, b, c, d }, 4); /* the first again: that one goes */
    models_polygon(&model, (uint32_t[]){ a, a, a }, 3);
    clean(&mesh, &model);
    assert_int_equal(mesh.point_count, 6);
    assert_int_equal(mesh.degenerate_dropped, 2);
    assert_int_equal(mesh.repeated_dropped, 1);
    assert_int_equal(mesh.polygon_count, 3);
    assert_int_equal(mesh.polygons[1].source, 3);
    assert_int_equal(mesh.polygons[2].source, 5);
    assert_int_equal(mesh.polygons[2].count, 3);
    mesh_discard(&mesh);
    import_free(&model);
}

/* The same corners from another start are a repetition; the later one stays. */
static void test_repeated(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct mesh mesh;
    uint32_t v[4];
    for (uint32_t i = 0; i < 4; i++) {
        v[i] = models_vertex(&model, i == 1 || i == 2, i >= 2, 0);
    }
    for (uint32_t turn = 0; turn < 4; turn++) {
        models_polygon(
            &model,
            (uint32_t[]){ v[turn], v[(turn + 1) % 4], v[(turn + 2) % 4], v[(turn + 3) % 4] }, 4);
    }
    models_polygon(&model, (uint32_t[]){ v[3], v[2], v[1], v[0] }, 4);
    clean(&mesh, &model);
    assert_int_equal(mesh.repeated_dropped, 3);
    assert_int_equal(mesh.polygon_count, 2);
    assert_int_equal(mesh.polygons[0].source, 4);
    mesh_discard(&mesh);
    import_free(&model);
}

/* A wall with a hole, as one outline in and back along a bridge, stays one polygon. */
static void test_bridge(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct mesh mesh;
    uint32_t v[8];
    for (uint32_t i = 0; i < 4; i++) {
        double x = i == 1 || i == 2;
        double y = i >= 2;
        v[i] = models_vertex(&model, 4 * x, 4 * y, 0);
        v[4 + i] = models_vertex(&model, 1 + 2 * x, 1 + 2 * y, 0);
    }
    models_polygon(&model,
                   (uint32_t[]){ v[0], v[1], v[2], v[3], v[0], v[4], v[7], v[6], v[5], v[4] }, 10);
    clean(&mesh, &model);
    assert_int_equal(mesh.polygon_count, 1);
    assert_int_equal(mesh.polygons[0].count, 10);
    assert_int_equal(mesh.uneven_cut, 0);
    int64_t area[3];
    mesh_area((const int16_t(*)[3])mesh.points, mesh.corners, 10, area);
    double step = mesh.lattice.step;
    assert_true(fabs((double)area[2] * step * step - 2 * 12) < 0.01);
    mesh_discard(&mesh);
    import_free(&model);
}

/* A square with one corner up by h: flat up to two steps (one from the middle plane), then cut. */
static void test_uneven(void **state)
{
    (void)state;
    for (int up = 0; up < 2; up++) {
        struct model model = { 0 };
        struct mesh mesh;
        make_unit_lattice(&model);
        double h = up ? 9 : 3; /* the best plane lies a quarter of it from each corner */
        models_polygon(
            &model,
            (uint32_t[]){ models_vertex(&model, 0, 0, 0), models_vertex(&model, 1000, 0, 0),
                          models_vertex(&model, 1000, 1000, h), models_vertex(&model, 0, 1000, 0) },
            4);
        clean(&mesh, &model);
        assert_int_equal(mesh.uneven_cut, up);
        assert_int_equal(mesh.polygon_count, up ? 3 : 2);
        assert_int_equal(mesh.polygons[mesh.polygon_count - 1].source, 2);
        int marks = 0;
        for (uint32_t i = 1; i < mesh.polygon_count; i++) {
            for (uint32_t k = 0; k < mesh.polygons[i].count; k++) {
                marks += mesh.marks[mesh.polygons[i].first + k];
            }
        }
        assert_int_equal(marks, up ? 2 : 0); /* the diagonal, from either side */
        mesh_discard(&mesh);
        import_free(&model);
    }
}

static double triangle_area(const double (*p)[3], const uint32_t t[3])
{
    double at[3][3];
    for (int i = 0; i < 3; i++) {
        memcpy(at[i], p[t[i]], sizeof at[i]);
    }
    double area[3];
    outline_area((const double(*)[3])at, 3, area);
    return area[2];
}

/* Ears: a concave outline falls into triangles of positive area that add up to its own. */
static void test_ears(void **state)
{
    (void)state;
    struct random random = { 7 };
    for (int round = 0; round < 200; round++) {
        enum { CORNERS = 40 };
        double points[CORNERS][3];
        uint32_t triangles[CORNERS - 2][3];
        for (int i = 0; i < CORNERS; i++) { /* star-shaped about 0, so it does not cross itself */
            double angle = 6.283185307179586 * i / CORNERS;
            double radius = 1 + random_below(&random, 1000);
            points[i][0] = radius * cos(angle);
            points[i][1] = radius * sin(angle);
            points[i][2] = radius;
        }
        outline_triangulate((const double(*)[3])points, CORNERS, triangles);
        double whole[3];
        double sum = 0;
        outline_area((const double(*)[3])points, CORNERS, whole);
        for (int i = 0; i < CORNERS - 2; i++) {
            double area = triangle_area((const double(*)[3])points, triangles[i]);
            assert_true(area > 0);
            sum += area;
        }
        assert_true(fabs(sum - whole[2]) < 1e-9 * whole[2]);
    }
}

/* Nothing with an area: refused in words, however many there are. */
static void test_nothing_left(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct mesh mesh;
    struct problem problem;
    struct random random = { 8 };
    for (int i = 0; i < 1000; i++) {
        models_vertex(&model, random_below(&random, 100000), 0, 0);
    }
    for (int i = 0; i < 200000; i++) {
        models_polygon(&model,
                       (uint32_t[]){ random_below(&random, 1000), random_below(&random, 1000),
                                     random_below(&random, 1000) },
                       3);
    }
    assert_false(clean_model(&mesh, &model, false, &problem));
    assert_non_null(strstr(problem.text, "degenerate"));
    mesh_discard(&mesh);
    import_free(&model);
    for (int i = 0; i < 3; i++) {
        models_vertex(&model, 1, 2, 3);
    }
    models_polygon(&model, (uint32_t[]){ 0, 1, 2 }, 3);
    assert_false(clean_model(&mesh, &model, false, &problem));
    assert_non_null(strstr(problem.text, "one point"));
    mesh_discard(&mesh);
    import_free(&model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lattice),      cmocka_unit_test(test_joined),
        cmocka_unit_test(test_repeated),     cmocka_unit_test(test_bridge),
        cmocka_unit_test(test_uneven),       cmocka_unit_test(test_ears),
        cmocka_unit_test(test_nothing_left),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
