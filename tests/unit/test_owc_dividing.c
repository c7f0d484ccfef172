/* SPDX-License-Identifier: 0BSD */
/* Dividing planes, the location problem, and the polygon conflicts [FKN80]. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ow_read.h"
#include "tests/property/blob_builder.h"
#include "tests/unit/owc_models.h"
#include "tools/owc/clean.h"
#include "tools/owc/conflict.h"
#include "tools/owc/dividing.h"
#include "tools/owc/import.h"
#include "tools/owc/locate.h"
#include "tools/owc/random.h"
#include "tools/owc/split.h"

/* ---- the user's planes ---- */

static void planes_are_read(void **state)
{
    (void)state;
    struct user_planes planes;
    struct problem problem;
    assert_true(
        user_planes_read(&planes, "# two planes\n\n 1,0,0,-2\t# x = 2\n0,0.5,1e-3,7", &problem));
    assert_int_equal(planes.count, 2);
    assert_true(planes.all[0][0] == 1 && planes.all[0][3] == -2);
    assert_true(planes.all[1][1] == 0.5 && planes.all[1][2] == 1e-3 && planes.all[1][3] == 7);
    user_planes_free(&planes);
    static const char *const wrong[] = { "1,0,0,1\n1,0,0", "\n1,0,0,1,5", "\n0,0,0,1",
                                         "\n1,0,nan,0",    "\n1,0,0,1x",  "\n1 0 0 1" };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_false(user_planes_read(&planes, wrong[i], &problem));
        assert_int_equal(problem.line, 2);
        user_planes_free(&planes);
    }
}

static void planes_come_to_the_lattice(void **state)
{
    (void)state;
    struct user_planes planes;
    struct problem problem;
    struct planes added = { .tolerance_q8 = 256 };
    struct lattice lattice = { { 10, 20, 30 }, 0.01 };
    uint32_t numbers[3];
    /* x = 12 is 200 steps from the middle; the second is far outside; the third slants. */
    assert_true(user_planes_read(&planes, "-3,0,0,36\n1,0,0,9999\n1,1,0,-30", &problem));
    assert_int_equal(user_planes_add(&planes, &lattice, &added, numbers), 2);
    const struct plane *plane = &added.all[numbers[0]];
    assert_int_equal(exact_side(plane, (const int16_t[]){ 200, 5, 5 }), 0);
    assert_true(exact_side(plane, (const int16_t[]){ 199, 0, 0 }) > 0);
    assert_true(exact_side(plane, (const int16_t[]){ 201, 0, 0 }) < 0);
    plane = &added.all[numbers[1]];
    assert_int_equal(exact_side(plane, (const int16_t[]){ 700, -700, 5 }), 0);
    assert_true(exact_side(plane, (const int16_t[]){ 1, 0, 0 }) > 0);
    planes_free(&added);
    user_planes_free(&planes);
}

/* ---- a scene on the lattice ---- */

struct scene {
    struct model model;
    struct mesh mesh;
    struct planes planes;
    struct arrangement arrangement;
    struct pieces pieces;
    uint32_t list[64];
};

static void scene_begin(struct scene *s)
{
    struct problem problem;
    assert_true(clean_model(&s->mesh, &s->model, false, &problem));
    plane_group(&s->planes, &s->mesh, &s->model, 256);
    arrangement_begin(&s->arrangement, &s->mesh, &s->planes);
    pieces_begin(&s->pieces, &s->mesh, &s->arrangement);
    for (uint32_t i = 0; i < s->pieces.count; i++) {
        s->list[i] = i;
    }
}

static void scene_end(struct scene *s)
{
    pieces_free(&s->pieces);
    arrangement_free(&s->arrangement);
    planes_free(&s->planes);
    mesh_discard(&s->mesh);
    import_free(&s->model);
}

static void add_tetrahedron(struct model *model, double x, double y, double z)
{
    models_tetrahedron(model, 1, &(struct models_pose){ 0.3, 0.5, { x, y, z } });
}

/* Of two gaps the one that shares out the pieces best; a plane found cuts nothing. */
static void gaps_are_found(void **state)
{
    (void)state;
    struct scene s = { 0 };
    for (int i = 0; i < 4; i++) {
        add_tetrahedron(&s.model, i < 2 ? 4 * i : 20 + 4 * i, 0, 0);
    }
    scene_begin(&s);
    uint32_t plane = dividing_axis_plane(&s.arrangement, &s.pieces, s.list, 16, &s.planes);
    assert_int_not_equal(plane, MESH_NONE);
    uint32_t sides[4] = { 0 };
    for (uint32_t i = 0; i < 16; i++) {
        sides[split_side_of(&s.arrangement, &s.pieces, i, plane)]++;
    }
    assert_int_equal(sides[SPLIT_FRONT], 8);
    assert_int_equal(sides[SPLIT_BACK], 8);
    /* Within one tetrahedron there is none. */
    assert_int_equal(dividing_axis_plane(&s.arrangement, &s.pieces, s.list, 4, &s.planes),
                     MESH_NONE);
    scene_end(&s);
}

static uint32_t splits_with(const struct model *model, struct compile_options *options,
                            uint32_t *switches)
{
    struct compile_stats stats;
    struct blob blob;
    models_compile(&blob, &stats, model, options);
    *switches = blob.switches;
    blob_free(&blob);
    return stats.splits;
}

/* Clusters whose polygons' planes cut one another's: dividing planes keep them apart. */
static void clusters_are_kept_apart(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct user_planes planes;
    struct problem problem;
    struct compile_options options = models_options();
    uint32_t switches;
    for (int i = 0; i < 9; i++) {
        models_box(&model, (double[]){ 1, 1, 1 }, 1,
                   &(struct models_pose){ 0.4 * i, 0.3 * i, { 4 * (i % 3), 4 * (i / 3), 0 } });
    }
    options.select = BSP_FIRST;
    assert_true(splits_with(&model, &options, &switches) > 9);
    options.dividing_axis = true;
    assert_int_equal(splits_with(&model, &options, &switches), 0);
    /* Eight planes part nine boxes; a box is a chain of five switches and a face. */
    assert_int_equal(switches, 8 + 9 * 5);
    options.dividing_axis = false;
    assert_true(
        user_planes_read(&planes, "1,0,0,-2\n1,0,0,-6\n0,1,0,-2\n0,1,0,-6\n0,0,1,5", &problem));
    options.dividing = &planes;
    assert_int_equal(splits_with(&model, &options, &switches), 0);
    assert_int_equal(switches, 8 + 9 * 5); /* the last plane parts nothing and is left out */
    user_planes_free(&planes);
    import_free(&model);
}

/* ---- conflicts ---- */

static void add_square(struct model *model, int axis, double at, double low, double high)
{
    uint32_t v[4];
    for (int i = 0; i < 4; i++) {
        double p[3];
        p[axis] = at;
        p[(axis + 1) % 3] = i == 1 || i == 2 ? high : low;
        p[(axis + 2) % 3] = i > 1 ? high : low;
        v[i] = models_vertex(model, p[0], p[1], p[2]);
    }
    models_polygon(model, v, 4);
}

/*
 * Four squares: z = 0, which parts x = 1 (above) from y = 2 (below), and is met by
 * the plane of neither; a square that stands across it.
 */
static void conflicts_are_counted(void **state)
{
    (void)state;
    struct scene s = { 0 };
    struct conflict conflict = { 0 };
    uint64_t relations = 0;
    add_square(&s.model, 2, 0, -9, 9);
    add_square(&s.model, 0, 1, 2, 5);    /* in front: y and z from 2 to 5 */
    add_square(&s.model, 1, 2, -5, -1);  /* behind: z and x from -5 to -1; y = 2 */
    add_square(&s.model, 0, 3, -4, 4);   /* across: y and z from -4 to 4 */
    add_square(&s.model, 1, 0, -8, 8);   /* across: z and x from -8 to 8; meets the one before */
    add_square(&s.model, 0, -2, -8, -7); /* behind: y and z from -8 to -7 */
    scene_begin(&s);
    uint32_t plane = s.pieces.all[0].record;
    /*
     * In front {1}, behind {2, 5}, across {3, 4}. The plane x = 1 meets neither 2 nor 5:
     * I(1,3) = 0. The plane y = 2 only touches 1, x = -2 does not meet it: I(3,1) = 0.
     * The plane x = 3 meets 4, the plane y = 0 meets 3: I(2,2) = 2.
     */
    assert_true(conflict_score(&conflict, &s.arrangement, &s.pieces, s.list, 6, plane, 1,
                               &relations) == -2);
    assert_true(conflict_score(&conflict, &s.arrangement, &s.pieces, s.list, 6, plane, 2.5,
                               &relations) == -5);
    assert_int_equal(relations, 2 * (6 + 2 + 2 + 4));
    /* 0, 2 and 4 stand across the plane x = -2, 1 and 3 are in front of it. */
    plane = s.pieces.all[5].record;
    double score =
        conflict_score(&conflict, &s.arrangement, &s.pieces, s.list, 6, plane, 1, &relations);
    /* Nothing behind. Across {0, 2, 4}: the planes of 2 and 4 meet 0, that of 0 meets 4. */
    assert_true(score == -3);
    conflict_free(&conflict);
    scene_end(&s);
}

/* What is saved counts: two crossing squares on different sides of the root. */
static void saved_conflicts_count(void **state)
{
    (void)state;
    struct scene s = { 0 };
    struct conflict conflict = { 0 };
    uint64_t relations = 0;
    add_square(&s.model, 2, 0, -1, 1);
    add_square(&s.model, 0, 1, 2, 4);     /* in front: y, z from 2 to 4 */
    add_square(&s.model, 1, 3, -4, 4);    /* across: z, x from -4 to 4 */
    add_square(&s.model, 1, 2.5, -4, -1); /* behind: z, x from -4 to -1: its plane meets 1 */
    scene_begin(&s);
    assert_true(conflict_score(&conflict, &s.arrangement, &s.pieces, s.list, 4,
                               s.pieces.all[0].record, 9, &relations) == 1);
    conflict_free(&conflict);
    scene_end(&s);
}

/*
 * [FKN80]'s three polygons each of which lies over the next one: five in the tree
 * if the root is well chosen. Just the first makes six of them.
 */
static void three_in_a_ring_become_five(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct compile_options options = models_options();
    for (int i = 0; i < 3; i++) {
        double along[2] = { cos(2.0943951 * i), sin(2.0943951 * i) };
        uint32_t v[4];
        for (int k = 0; k < 4; k++) {
            double far = k == 1 || k == 2 ? 3 : -3;
            double side = k > 1 ? 1.2 : 0.8;
            v[k] = models_vertex(&model, far * along[0] + side * along[1],
                                 far * along[1] - side * along[0], far / 3);
        }
        models_polygon(&model, v, 4);
    }
    options.sides = SIDES_ONE;
    for (int i = 0; i < 4; i++) {
        static const enum method methods[] = { METHOD_BSP, METHOD_FEUDAL_STATIC,
                                               METHOD_FEUDAL_DYNAMIC, METHOD_BSP };
        uint32_t switches;
        options.method = methods[i];
        options.select = i == 0 ? BSP_EXHAUSTIVE : BSP_FIRST;
        assert_int_equal(splits_with(&model, &options, &switches), i < 3 ? 2 : 3);
    }
    import_free(&model);
}

/* ---- the location problem ---- */

/* x = 0; in front of it y = 0, and behind that z = 0; behind x = 0 a face. */
static void regions_are_numbered(void **state)
{
    (void)state;
    struct builder *b = builder_new(OW_TREE_SWITCH_ONLY);
    static const int corners[3][3] = { { -9, -5, -5 }, { -9, 5, -5 }, { -9, 0, 5 } };
    (void)builder_colour(b, 0);
    uint32_t face = builder_triangle(b, corners, 0, 1);
    uint32_t x = builder_switch(b, (const int64_t[]){ 1, 0, 0, 0 });
    uint32_t y = builder_switch(b, (const int64_t[]){ 0, 1, 0, -10 });
    uint32_t z = builder_switch(b, (const int64_t[]){ 0, 0, 1, 0 });
    builder_child(b, x, 0, OW_ITEM_NODE, y);
    builder_child(b, x, 1, OW_ITEM_FACE, face);
    builder_child(b, y, 1, OW_ITEM_NODE, z);
    uint32_t size;
    uint8_t *blob = builder_finish(b, x, &size);
    struct ow_tree tree;
    assert_int_equal(ow_tree_open(&tree, blob, size), OW_OK);
    static const struct {
        int32_t at[3];
        uint32_t leaf;
        uint32_t sides;
        bool last_in_front;
    } cases[] = {
        { { -3, 0, 0 }, 1, 1, false }, /* behind x: the first region met */
        { { 3, 99, 0 }, 2, 2, true },  { { 3, 5, 7 }, 3, 3, true },
        { { 3, 5, -7 }, 4, 3, false }, { { 0, 10, -7 }, 2, 2, true }, /* on planes: in front */
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct locate_side sides[3];
        struct locate_region region;
        int32_t at[3];
        for (int k = 0; k < 3; k++) {
            at[k] = cases[i].at[k] * 256;
        }
        assert_int_equal(locate_point(&tree, at, sides, &region), OW_OK);
        assert_int_equal(region.leaf, cases[i].leaf);
        assert_int_equal(region.side_count, cases[i].sides);
        assert_int_equal(sides[region.side_count - 1].front, cases[i].last_in_front);
        assert_int_equal(sides[0].n[0], 1);
    }
    struct locate_region region;
    struct locate_side sides[3];
    tree.flags = 0;
    assert_int_equal(locate_point(&tree, cases[0].at, sides, &region), OW_UNSUPPORTED);
    free(blob);
    free(b);
}

/* A compiled tree: a region's number and its sides say the same, and every number comes up once. */
static void numbers_are_regions(void **state)
{
    (void)state;
    enum { POINTS = 3000, MOST = 64 };
    struct model model = { 0 };
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob blob;
    struct ow_tree tree;
    struct random random = { 5 };
    static bool known[MOST][MOST];
    static uint32_t lengths[MOST];
    struct locate_side *sides;
    models_box(&model, (double[]){ 2, 1, 3 }, 1, &(struct models_pose){ 0.2, 0.3, { 0, 0, 0 } });
    models_box(&model, (double[]){ 1, 2, 1 }, 1, &(struct models_pose){ 0.7, 0.1, { 1, 0, 1 } });
    models_compile(&blob, &stats, &model, &options);
    assert_int_equal(ow_tree_open(&tree, blob.bytes, blob.size), OW_OK);
    assert_true(tree.switch_count + 1 < MOST);
    sides = calloc(tree.depth, sizeof *sides);
    uint32_t found = 0;
    for (int i = 0; i < POINTS; i++) {
        int32_t at[3];
        struct locate_region region;
        for (int k = 0; k < 3; k++) {
            at[k] = ((int32_t)random_below(&random, 65535) - 32767) * 256;
        }
        assert_int_equal(locate_point(&tree, at, sides, &region), OW_OK);
        assert_in_range(region.leaf, 1, tree.switch_count + 1);
        for (uint32_t k = 0; k < region.side_count; k++) {
            int64_t height = sides[k].d * 256;
            for (int c = 0; c < 3; c++) {
                height += (int64_t)sides[k].n[c] * at[c];
            }
            assert_true(sides[k].front == (height >= 0));
            if (lengths[region.leaf] != 0) {
                assert_true(known[region.leaf][k] == sides[k].front);
            }
            known[region.leaf][k] = sides[k].front;
        }
        found += lengths[region.leaf] == 0;
        assert_true(lengths[region.leaf] == 0 || lengths[region.leaf] == region.side_count);
        lengths[region.leaf] = region.side_count;
    }
    assert_true(found > 8);
    free(sides);
    blob_free(&blob);
    import_free(&model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_are_read),
        cmocka_unit_test(planes_come_to_the_lattice),
        cmocka_unit_test(gaps_are_found),
        cmocka_unit_test(clusters_are_kept_apart),
        cmocka_unit_test(conflicts_are_counted),
        cmocka_unit_test(saved_conflicts_count),
        cmocka_unit_test(three_in_a_ring_become_five),
        cmocka_unit_test(regions_are_numbered),
        cmocka_unit_test(numbers_are_regions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
