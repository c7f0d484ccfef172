/* SPDX-License-Identifier: 0BSD */
/* Coplanar neighbours: what is joined, what must not be, and that nothing opens. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "tests/unit/owc_models.h"
#include "tools/common/xalloc.h"
#include "tools/owc/import.h"

struct compiled {
    struct blob blob;
    struct compile_stats stats;
    struct ow_tree tree;
};

static void compile(struct compiled *c, const struct model *model, bool normals)
{
    struct compile_options options = models_options();
    options.method = METHOD_OBSTRUCTION;
    options.merge = true;
    options.keep_normals = normals;
    models_compile(&c->blob, &c->stats, model, &options);
    assert_int_equal(ow_tree_open(&c->tree, c->blob.bytes, c->blob.size), OW_OK);
    assert_int_equal(c->stats.source_polygons - c->stats.merged, c->stats.input_polygons);
}

static void add_square(struct model *model, double x, double y, double size)
{
    uint32_t v[4];
    v[0] = models_vertex(model, x, y, 0);
    v[1] = models_vertex(model, x + size, y, 0);
    v[2] = models_vertex(model, x + size, y + size, 0);
    v[3] = models_vertex(model, x, y + size, 0);
    models_polygon(model, v, 4);
}

/* The number of corners of the record with this source number; 0: there is none. */
static uint32_t corners_of(const struct ow_tree *tree, uint32_t source)
{
    uint32_t at = tree->polygons_at;
    for (uint32_t i = 0; i < tree->polygon_count; i++) {
        struct models_record record;
        at = models_read_record(tree, at, &record);
        if (record.source == source) {
            return record.count;
        }
    }
    return 0;
}

/* A box of 6 x 9 squares becomes six of four corners, turned or not, and stays closed. */
static void boxes_get_their_sides_back(void **state)
{
    (void)state;
    static const struct models_pose poses[] = { { 0, 0, { 0, 0, 0 } }, { 0.7, 0.4, { 5, 6, 7 } } };
    for (int i = 0; i < 2; i++) {
        struct model model = { 0 };
        struct compiled c;
        models_box(&model, (double[]){ 2, 3, 1 }, 3, &poses[i]);
        compile(&c, &model, false);
        assert_true(c.stats.closed);
        assert_int_equal(c.tree.polygon_count, 6);
        assert_int_equal(models_open_edges(&c.tree), 0);
        if (i == 0) { /* corners on straight edges are gone, where no rounding bent these */
            assert_int_equal(c.tree.vertex_count, 8);
        }
        blob_free(&c.blob);
        import_free(&model);
    }
}

/* Two squares become a rectangle with the first's number; other colours and planes stay. */
static void only_like_is_joined(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct compiled c;
    add_square(&model, 1, 0, 1);
    add_square(&model, 0, 0, 1);
    add_square(&model, 2, 0, 1);
    add_square(&model, -1, 0, 1);
    model.polygons[2].colour = 1;
    model.vertices[model.corners[model.polygons[3].first]][2] = 0.2; /* slanting */
    model.vertices[model.corners[model.polygons[3].first + 3]][2] = 0.2;
    model.colours = xresize(model.colours, 2, sizeof *model.colours);
    model.colours[1] = 0x00FF00;
    model.colour_capacity = model.colour_count = 2;
    compile(&c, &model, false);
    assert_int_equal(c.tree.polygon_count, 3);
    assert_int_equal(corners_of(&c.tree, 1), 4);
    assert_int_equal(corners_of(&c.tree, 2), 0);
    assert_int_equal(corners_of(&c.tree, 3), 4);
    assert_int_equal(corners_of(&c.tree, 4), 4);
    blob_free(&c.blob);
    import_free(&model);
}

/* A corner that a neighbour in another plane has stays, on a straight edge too. */
static void neighbours_keep_their_corners(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct compiled c;
    add_square(&model, 0, 0, 1);
    add_square(&model, 1, 0, 1);
    uint32_t fin[3] = { models_vertex(&model, 1, 0, 0), models_vertex(&model, 0, 0, 0),
                        models_vertex(&model, 0.5, 0, 1) };
    models_polygon(&model, fin, 3);
    compile(&c, &model, false);
    assert_int_equal(c.tree.polygon_count, 2);
    assert_int_equal(corners_of(&c.tree, 1), 5); /* with 1,0,0, without 1,1,0 */
    assert_int_equal(corners_of(&c.tree, 3), 3);
    blob_free(&c.blob);
    import_free(&model);
}

/* Three squares in an L are not convex together: one stays. */
static void what_is_joined_is_convex(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct compiled c;
    add_square(&model, 0, 0, 1);
    add_square(&model, 1, 0, 1);
    add_square(&model, 0, 1, 1);
    compile(&c, &model, false);
    assert_int_equal(c.tree.polygon_count, 2);
    assert_int_equal(c.stats.merged, 1);
    blob_free(&c.blob);
    import_free(&model);
}

/* Where shading has an edge, one stays. */
static void other_normals_stay_apart(void **state)
{
    (void)state;
    for (int bent = 0; bent < 2; bent++) {
        struct model model = { 0 };
        struct compiled c;
        add_square(&model, 0, 0, 1);
        add_square(&model, 1, 0, 1);
        for (size_t i = 0; i < model.vertex_count; i++) {
            float tilt = bent && i >= 4 ? 0.2f : 0;
            memcpy(model.normals[i], (float[]){ tilt, 0, sqrtf(1 - tilt * tilt) },
                   sizeof model.normals[i]);
        }
        compile(&c, &model, true);
        assert_int_equal(c.tree.polygon_count, bent ? 2 : 1);
        blob_free(&c.blob);
        import_free(&model);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_get_their_sides_back),    cmocka_unit_test(only_like_is_joined),
        cmocka_unit_test(neighbours_keep_their_corners), cmocka_unit_test(what_is_joined_is_convex),
        cmocka_unit_test(other_normals_stay_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
