/* SPDX-License-Identifier: 0BSD */
/* Computed vertex normals: sharp beyond the crease angle, smooth within it, blind to cuts. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "owc_models.h"
#include "tools/owc/clean.h"
#include "tools/owc/import.h"
#include "tools/owc/normals.h"
#include "tools/owc/problem.h"

static const double size[3] = { 2, 2, 2 };
static const struct models_pose at_home = { 0, 0, { 0, 0, 0 } };

static void make_box(struct mesh *mesh, uint32_t cells, double crease)
{
    struct model model;
    struct problem problem;
    memset(&model, 0, sizeof model);
    models_box(&model, size, cells, &at_home);
    memset(mesh, 0, sizeof *mesh);
    assert_true(clean_model(mesh, &model, false, &problem));
    normals_compute(mesh, crease);
    import_free(&model);
}

enum { SIDE = OW_LATTICE_MAX * OW_LATTICE_MAX };

static double length(const float n[3])
{
    return sqrt((double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2]);
}

/* The sides of a box meet at 90 degrees: below that each corner has its own side's normal. */
static void edges_beyond_the_crease_stay_sharp(void **state)
{
    (void)state;
    struct mesh mesh;
    make_box(&mesh, 2, 89);
    for (uint32_t p = 0; p < mesh.polygon_count; p++) {
        const struct mesh_polygon *polygon = &mesh.polygons[p];
        int64_t area[3];
        mesh_area((const int16_t(*)[3])mesh.points, mesh.corners + polygon->first, polygon->count,
                  area);
        for (uint32_t i = 0; i < polygon->count; i++) {
            for (int k = 0; k < 3; k++) {
                double due = area[k] > 0 ? 1 : area[k] < 0 ? -1 : 0;
                assert_true(fabs((double)mesh.normals[polygon->first + i][k] - due) < 1e-6);
            }
        }
    }
    mesh_discard(&mesh);
}

/*
 * At 90 degrees all three sides are taken: a corner's normal points away from
 * the middle, however many squares of each side meet there.
 */
static void edges_within_the_crease_are_smooth_however_they_are_cut(void **state)
{
    (void)state;
    for (uint32_t cells = 1; cells <= 3; cells++) {
        struct mesh mesh;
        make_box(&mesh, cells, 90);
        uint32_t corners = 0;
        for (size_t i = 0; i < mesh.corner_count; i++) {
            const int16_t *at = mesh.points[mesh.corners[i]];
            const float *n = mesh.normals[i];
            assert_true(fabs(length(n) - 1) < 1e-6);
            if (at[0] * at[0] != SIDE || at[1] * at[1] != SIDE || at[2] * at[2] != SIDE) {
                continue; /* not a corner of the box */
            }
            corners++;
            for (int k = 0; k < 3; k++) {
                assert_true(fabs(fabs((double)n[k]) - sqrt(1.0 / 3)) < 1e-6);
                assert_true((n[k] > 0) == (at[k] > 0));
            }
        }
        assert_int_equal(corners, 24);
        mesh_discard(&mesh);
    }
}

/* They reach the blob: one a vertex, 127 long. */
static void computed_normals_reach_the_blob(void **state)
{
    (void)state;
    struct model model;
    memset(&model, 0, sizeof model);
    models_box(&model, size, 1, &at_home);
    struct compile_options options = models_options();
    options.compute_normals = true;
    options.crease = 180;
    struct blob blob;
    struct compile_stats stats;
    models_compile(&blob, &stats, &model, &options);
    struct ow_tree tree;
    assert_int_equal(ow_tree_open(&tree, blob.bytes, (uint32_t)blob.size), OW_OK);
    assert_true(tree.flags & OW_TREE_NORMALS);
    assert_int_equal(tree.vertex_count, 8);
    for (uint32_t i = 0; i < 3 * tree.vertex_count; i++) {
        assert_int_equal(abs((int8_t)tree.bytes[tree.normals_at + i]), 73); /* 127 / sqrt(3) */
    }
    blob_free(&blob);
    import_free(&model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_beyond_the_crease_stay_sharp),
        cmocka_unit_test(edges_within_the_crease_are_smooth_however_they_are_cut),
        cmocka_unit_test(computed_normals_reach_the_blob),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
