/* SPDX-License-Identifier: 0BSD */
/* Checks of the model: edges, winding, inward parts, cavities, crossings; and the repair. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

#include "tests/unit/owc_models.h"
#include "tools/owc/check.h"
#include "tools/owc/clean.h"
#include "tools/owc/crossings.h"
#include "tools/owc/import.h"

static const struct models_pose at_origin = { 0, 0, { 0, 0, 0 } };

static void add_box(struct model *model, double size, double x, double y, double z)
{
    models_box(model, (double[]){ size, size, size }, 1,
               &(struct models_pose){ 0, 0, { x, y, z } });
}

/* Turns over the polygons from first to last. */
static void turn(struct model *model, size_t first, size_t last)
{
    for (size_t i = first; i <= last; i++) {
        uint32_t *corners = model->corners + model->polygons[i].first;
        uint32_t count = model->polygons[i].count;
        for (uint32_t k = 0; k < count / 2; k++) {
            uint32_t corner = corners[k];
            corners[k] = corners[count - 1 - k];
            corners[count - 1 - k] = corner;
        }
    }
}

static struct mesh_check check(const struct model *model, struct mesh *mesh, bool repair)
{
    struct mesh_check found;
    struct problem problem;
    assert_true(clean_model(mesh, model, false, &problem));
    check_mesh(&found, mesh, repair);
    return found;
}

static struct mesh_check check_once(const struct model *model)
{
    struct mesh mesh;
    struct mesh_check found = check(model, &mesh, false);
    mesh_discard(&mesh);
    return found;
}

static void nothing_is_wrong_with_boxes(void **state)
{
    (void)state;
    struct model model = { 0 };
    add_box(&model, 2, 0, 0, 0);
    add_box(&model, 2, 5, 0, 0);
    struct mesh_check found = check_once(&model);
    assert_int_equal(found.parts, 2);
    assert_true(found.closed && found.crossings_counted);
    assert_int_equal(found.open_edges + found.forked_edges + found.twisted_edges, 0);
    assert_int_equal(found.inward_parts + found.cavities + found.to_turn + found.crossings, 0);
    import_free(&model);
}

static void open_and_forked_edges(void **state)
{
    (void)state;
    struct model model = { 0 };
    add_box(&model, 2, 0, 0, 0);
    model.polygon_count--;
    struct mesh_check found = check_once(&model);
    assert_int_equal(found.open_edges, 4);
    assert_false(found.closed);
    import_free(&model);
    model = (struct model){ 0 };
    add_box(&model, 2, 0, 0, 0);
    add_box(&model, 2, 2, 2, 0); /* the two share an edge */
    found = check_once(&model);
    assert_int_equal(found.forked_edges, 1);
    assert_int_equal(found.open_edges, 0);
    import_free(&model);
    model = (struct model){ 0 };
    add_box(&model, 2, 0, 0, 0);
    models_polygon(
        &model, (uint32_t[]){ model.corners[0], model.corners[1], models_vertex(&model, 3, 3, 3) },
        3);
    found = check_once(&model);
    assert_int_equal(found.forked_edges, 1); /* of three polygons */
    assert_int_equal(found.open_edges, 2);
    import_free(&model);
}

/* One wrong polygon, or all of one part: the repair makes a closed model of it. */
static void winding_is_put_right(void **state)
{
    (void)state;
    for (int whole = 0; whole < 2; whole++) {
        struct model model = { 0 };
        struct mesh mesh;
        add_box(&model, 2, 0, 0, 0);
        add_box(&model, 1, 4, 1, 0);
        turn(&model, 6, whole ? 11 : 6);
        struct mesh_check found = check(&model, &mesh, false);
        assert_int_equal(found.twisted_edges, whole ? 0 : 4);
        assert_int_equal(found.inward_parts, whole ? 1 : 0);
        assert_int_equal(found.to_turn, whole ? 6 : 1);
        assert_false(found.repaired);
        mesh_discard(&mesh);
        found = check(&model, &mesh, true);
        assert_true(found.repaired && found.closed && mesh.closed);
        assert_int_equal(found.to_turn, whole ? 6 : 1);
        struct mesh_check again;
        check_mesh(&again, &mesh, true);
        assert_int_equal(again.to_turn + again.twisted_edges + again.inward_parts, 0);
        mesh_discard(&mesh);
        import_free(&model);
    }
}

/* The majority may be wrong: the volume decides, not the first polygon. */
static void the_volume_decides(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct mesh mesh;
    add_box(&model, 2, 0, 0, 0);
    turn(&model, 0, 4);
    struct mesh_check found = check(&model, &mesh, true);
    assert_int_equal(found.to_turn, 5);
    assert_true(mesh.closed);
    mesh_discard(&mesh);
    import_free(&model);
}

/* A hollow in an outward part stays; the same box looks inwards elsewhere and is turned. */
static void cavities_are_left(void **state)
{
    (void)state;
    struct model model = { 0 };
    add_box(&model, 6, 0, 0, 0);
    add_box(&model, 2, 0, 0, 0);
    turn(&model, 6, 11);
    struct mesh_check found = check_once(&model);
    assert_int_equal(found.cavities, 1);
    assert_int_equal(found.inward_parts + found.to_turn, 0);
    turn(&model, 0, 5); /* now the outer one looks inwards too: then neither is a hollow */
    found = check_once(&model);
    assert_int_equal(found.cavities, 0);
    assert_int_equal(found.inward_parts, 2);
    import_free(&model);
}

/* Normals, marks and sources go along when a polygon is turned over. */
static void turning_keeps_corners_together(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct mesh mesh;
    struct mesh_check found;
    struct problem problem;
    add_box(&model, 2, 0, 0, 0);
    turn(&model, 0, 5);
    for (size_t i = 0; i < model.vertex_count; i++) {
        model.normals[i][0] = (float)(i + 1);
    }
    assert_true(clean_model(&mesh, &model, true, &problem));
    uint32_t before[4];
    float normals[4];
    for (int i = 0; i < 4; i++) {
        before[i] = mesh.corners[i];
        normals[i] = mesh.normals[i][0];
    }
    mesh.marks[1] = 1; /* the edge from corner 1 to corner 2 */
    check_mesh(&found, &mesh, true);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(mesh.corners[i], before[3 - i]);
        assert_true(mesh.normals[i][0] == -normals[3 - i]);
        assert_int_equal(mesh.marks[i], i == 1); /* from old corner 2 to old corner 1 */
    }
    mesh_discard(&mesh);
    import_free(&model);
}

static uint32_t crossings(const struct model *model)
{
    struct mesh mesh;
    struct problem problem;
    bool complete;
    assert_true(clean_model(&mesh, model, false, &problem));
    uint32_t count = crossings_count(&mesh, &complete);
    assert_true(complete);
    mesh_discard(&mesh);
    return count;
}

/* A rod through a box: its four long sides pass through two of the box's. */
static void crossings_are_counted(void **state)
{
    (void)state;
    struct model model = { 0 };
    models_box(&model, (double[]){ 4, 4, 4 }, 1, &at_origin);
    models_box(&model, (double[]){ 1, 1, 9 }, 1, &(struct models_pose){ 0.3, 0, { 0, 0, 0 } });
    assert_int_equal(crossings(&model), 8);
    import_free(&model);
    /* Boxes that touch along a side, and one that stands on another. */
    model = (struct model){ 0 };
    add_box(&model, 2, 0, 0, 0);
    add_box(&model, 2, 2, 0, 0);
    models_box(&model, (double[]){ 1, 1, 1 }, 1, &(struct models_pose){ 0.5, 0, { 0, 0, 1.5 } });
    /* Rods along sides: their edges pass through the outlines of the boxes' ends. */
    models_box(&model, (double[]){ 1, 1, 9 }, 1, &(struct models_pose){ 0, 0, { -1.5, 0, 0 } });
    models_box(&model, (double[]){ 9, 0.5, 1 }, 1,
               &(struct models_pose){ 0, 0, { 0, 0.75, -1.5 } });
    assert_int_equal(crossings(&model), 0);
    import_free(&model);
}

/* Many polygons: the hierarchy finds what all pairs would. */
static void the_hierarchy_misses_nothing(void **state)
{
    (void)state;
    struct model model = { 0 };
    models_box(&model, (double[]){ 40, 4, 4 }, 8, &at_origin);
    for (int i = 0; i < 9; i++) { /* rods through cells' middles: front and back, 4 sides each */
        double x = -17.5 + 5 * (i % 8);
        double y = i == 8 ? 1.25 : 0.25;
        models_box(&model, (double[]){ 0.1, 0.1, 9 }, 1,
                   &(struct models_pose){ 0, 0, { x, y, 0 } });
    }
    assert_int_equal(crossings(&model), 9 * 8);
    import_free(&model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_is_wrong_with_boxes),
        cmocka_unit_test(open_and_forked_edges),
        cmocka_unit_test(winding_is_put_right),
        cmocka_unit_test(the_volume_decides),
        cmocka_unit_test(cavities_are_left),
        cmocka_unit_test(turning_keeps_corners_together),
        cmocka_unit_test(crossings_are_counted),
        cmocka_unit_test(the_hierarchy_misses_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
