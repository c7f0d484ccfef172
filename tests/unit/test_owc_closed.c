/* SPDX-License-Identifier: 0BSD */
/*
 * Closed models stay closed: after cutting, rounding and repair each edge of
 * the tree's polygons runs as often one way as the other.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "tests/unit/owc_models.h"
#include "tools/owc/import.h"
#include "tools/owc/random.h"

/* Compiles in every way that a tree can be built, and looks for open edges. */
static void assert_stays_closed(const struct model *model)
{
    static const uint32_t tolerances[] = { 0, 256, 33 * 256, 2000 * 256 };
    for (int select = BSP_FIRST; select <= BSP_EXHAUSTIVE; select++) {
        for (size_t t = 0; t < sizeof tolerances / sizeof tolerances[0]; t++) {
            struct compile_options options = models_options();
            struct compile_stats stats;
            struct blob blob;
            struct ow_tree tree;
            options.select = (enum bsp_select)select;
            options.tolerance_q8 = tolerances[t];
            options.seed = t;
            models_compile(&blob, &stats, model, &options);
            assert_true(stats.closed);
            assert_int_equal(ow_tree_open(&tree, blob.bytes, blob.size), OW_OK);
            assert_int_equal(models_open_edges(&tree), 0);
            assert_true(tree.flags & OW_TREE_CLOSED);
            blob_free(&blob);
        }
    }
}

static void test_tetrahedron(void **state)
{
    (void)state;
    struct model model = { 0 };
    models_tetrahedron(&model, 1, &(struct models_pose){ 0.3, 0.5, { 0, 0, 0 } });
    assert_stays_closed(&model);
    import_free(&model);
}

/* A turned box in a grid of squares: many coplanar neighbours that rounding bends. */
static void test_turned_grid(void **state)
{
    (void)state;
    struct model model = { 0 };
    models_box(&model, (double[]){ 2, 3, 1.7 }, 4,
               &(struct models_pose){ 0.61, 0.27, { 0.1, 0.2, 0.3 } });
    assert_stays_closed(&model);
    import_free(&model);
}

/* Two boxes that run into each other cut each other to pieces. */
static void test_two_boxes(void **state)
{
    (void)state;
    struct model model = { 0 };
    models_box(&model, (double[]){ 2, 2, 2 }, 2, &(struct models_pose){ 0, 0, { 0, 0, 0 } });
    models_box(&model, (double[]){ 2, 2, 2 }, 2,
               &(struct models_pose){ 0.7, 0.4, { 0.3, 0.2, 0.1 } });
    assert_stays_closed(&model);
    import_free(&model);
}

/* A crowd of tetrahedra in one another: small and large, near-parallel, many meeting points. */
static void test_crowd(void **state)
{
    (void)state;
    struct random random = { 5 };
    struct model model = { 0 };
    for (int i = 0; i < 24; i++) {
        double size = i % 3 == 0 ? 1 : i % 3 == 1 ? 0.2 : 0.003;
        struct models_pose pose = { i % 4 * 1e-4, i % 5 * 1e-4 + (i % 2), { 0, 0, 0 } };
        for (int k = 0; k < 3; k++) {
            pose.at[k] = (double)random_below(&random, 1000) / 1500;
        }
        models_tetrahedron(&model, size, &pose);
    }
    assert_stays_closed(&model);
    import_free(&model);
}

/* Concave lids: a comb, cut through its teeth by a box and by the teeth's own sides. */
static void test_comb(void **state)
{
    (void)state;
    double outline[4 * 20 + 2][2] = { { 0, -1 }, { 4, -1 } };
    struct model model = { 0 };
    for (int i = 0; i < 20; i++) {
        double x = 4 - i * 0.2;
        double tooth[4][2] = {
            { x, 1 }, { x - 0.1, 1 + 0.01 * i }, { x - 0.1, 0 }, { x - 0.2, 0 }
        };
        for (int k = 0; k < 4; k++) {
            outline[2 + 4 * i + k][0] = tooth[k][0];
            outline[2 + 4 * i + k][1] = tooth[k][1];
        }
    }
    models_prism(&model, (const double(*)[2])outline, 82, 0.5);
    models_box(&model, (double[]){ 5, 0.7, 0.7 }, 1,
               &(struct models_pose){ 0.1, 0.2, { 2, 0.4, 0.3 } });
    assert_stays_closed(&model);
    import_free(&model);
}

/* A lid of 600 corners does not fit a record: it is cut, and its rim with it. */
static void test_long_outline(void **state)
{
    (void)state;
    enum { CORNERS = 600 };
    double outline[CORNERS][2];
    struct model model = { 0 };
    for (int i = 0; i < CORNERS; i++) {
        double angle = 6.283185307179586 * i / CORNERS;
        double radius = i % 2 ? 1 : 0.8; /* a star: concave */
        outline[i][0] = radius * cos(angle);
        outline[i][1] = radius * sin(angle);
    }
    models_prism(&model, (const double(*)[2])outline, CORNERS, 0.2);
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob blob;
    struct ow_tree tree;
    options.select = BSP_FIRST; /* the lids, which nothing cuts then */
    models_compile(&blob, &stats, &model, &options);
    assert_true(stats.long_cut >= 4);
    assert_true(blob.polygons == CORNERS + 2 + stats.splits + stats.long_cut); /* no triangles */
    assert_int_equal(ow_tree_open(&tree, blob.bytes, blob.size), OW_OK);
    assert_int_equal(models_open_edges(&tree), 0);
    blob_free(&blob);
    import_free(&model);
}

/*
 * A square's side carries a sliver without area: its middle corner goes into
 * the neighbour, the sliver goes, and the box stays closed. Also slivers on slivers.
 */
static void test_slivers(void **state)
{
    (void)state;
    struct model model = { 0 };
    uint32_t v[8];
    for (uint32_t i = 0; i < 8; i++) {
        v[i] = models_vertex(&model, i & 1 ? 1 : 0, i & 2 ? 1 : 0, i & 4 ? 1 : 0);
    }
    uint32_t quarter = models_vertex(&model, 0.25, 0, 0);
    uint32_t half = models_vertex(&model, 0.5, 0, 0);
    uint32_t most = models_vertex(&model, 0.75, 0, 0);
    /* The floor meets the edge from 0 to 1 whole, the front wall in four parts. */
    models_polygon(&model, (uint32_t[]){ v[0], v[2], v[3], v[1] }, 4);
    models_polygon(&model, (uint32_t[]){ v[0], quarter, half, most, v[1], v[5], v[4] }, 7);
    models_polygon(&model, (uint32_t[]){ v[4], v[5], v[7], v[6] }, 4);
    models_polygon(&model, (uint32_t[]){ v[2], v[6], v[7], v[3] }, 4);
    models_polygon(&model, (uint32_t[]){ v[0], v[4], v[6], v[2] }, 4);
    models_polygon(&model, (uint32_t[]){ v[1], v[3], v[7], v[5] }, 4);
    /* Slivers between them: 0-1-half, and one on each half. */
    models_polygon(&model, (uint32_t[]){ v[0], v[1], half }, 3);
    models_polygon(&model, (uint32_t[]){ v[0], half, quarter }, 3);
    models_polygon(&model, (uint32_t[]){ half, v[1], most }, 3);
    /* And two pairs, back to back, that want other middles for the long edge. */
    models_polygon(&model, (uint32_t[]){ v[0], v[1], quarter }, 3);
    models_polygon(&model, (uint32_t[]){ v[1], v[0], quarter }, 3);
    models_polygon(&model, (uint32_t[]){ v[0], v[1], most }, 3);
    models_polygon(&model, (uint32_t[]){ v[1], v[0], most }, 3);
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob blob;
    struct ow_tree tree;
    models_compile(&blob, &stats, &model, &options);
    assert_int_equal(stats.degenerate_dropped, 7);
    assert_int_equal(stats.degenerate_kept, 0);
    assert_int_equal(stats.input_polygons, 6);
    assert_true(stats.closed);
    assert_int_equal(ow_tree_open(&tree, blob.bytes, blob.size), OW_OK);
    assert_int_equal(models_open_edges(&tree), 0);
    assert_int_equal(tree.vertex_count, 11);
    uint32_t at = tree.polygons_at;
    for (uint32_t i = 0; i < tree.polygon_count; i++) { /* floor and wall: each corner once */
        struct models_record record;
        at = models_read_record(&tree, at, &record);
        assert_int_equal(record.count, record.source <= 2 ? 7 : 4);
        for (uint32_t k = 1; k < record.count; k++) {
            assert_int_not_equal(record.corners[k], record.corners[0]);
        }
    }
    blob_free(&blob);
    import_free(&model);
}

/* The models outside the repository, where they are. */
static void test_shared_models(void **state)
{
    (void)state;
    static const char *const names[] = { "cow", "spot", "fandisk" };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char path[64];
        struct model model;
        struct problem problem;
        snprintf(path, sizeof path, "../shared/models/%s.obj", names[i]);
        bool there = import_file(&model, path, &problem);
        if (there) {
            struct compile_options options = models_options();
            struct compile_stats stats;
            struct blob blob;
            struct ow_tree tree;
            models_compile(&blob, &stats, &model, &options);
            assert_true(stats.closed);
            assert_int_equal(ow_tree_open(&tree, blob.bytes, blob.size), OW_OK);
            assert_int_equal(models_open_edges(&tree), 0);
            blob_free(&blob);
        }
        import_free(&model);
        if (!there) {
            print_message("skip %s: models outside the repository (%s)\n", names[i], path);
        }
    }
}

/* What is open is told apart: a box without a lid, and a box turned inside out. */
static void test_not_closed(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob blob;
    models_box(&model, (double[]){ 1, 1, 1 }, 1, &(struct models_pose){ 0, 0, { 0, 0, 0 } });
    model.polygon_count--;
    models_compile(&blob, &stats, &model, &options);
    assert_false(stats.closed);
    assert_true(stats.two_sided);
    blob_free(&blob);
    model.polygon_count++;
    for (size_t i = 0; i < model.polygon_count; i++) {
        uint32_t *corners = model.corners + model.polygons[i].first;
        uint32_t swap = corners[1];
        corners[1] = corners[3];
        corners[3] = swap;
    }
    models_compile(&blob, &stats, &model, &options);
    assert_false(stats.closed);
    blob_free(&blob);
    import_free(&model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tetrahedron), cmocka_unit_test(test_turned_grid),
        cmocka_unit_test(test_two_boxes),   cmocka_unit_test(test_crowd),
        cmocka_unit_test(test_comb),        cmocka_unit_test(test_long_outline),
        cmocka_unit_test(test_slivers),     cmocka_unit_test(test_shared_models),
        cmocka_unit_test(test_not_closed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
