/* SPDX-License-Identifier: 0BSD */
/* Cutting, and BSP trees: each piece lies on its side of every switch above it, and nothing is lost. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/unit/owc_models.h"
#include "tools/common/xalloc.h"
#include "tools/owc/arrangement.h"
#include "tools/owc/bsp.h"
#include "tools/owc/clean.h"
#include "tools/owc/import.h"
#include "tools/owc/pieces.h"
#include "tools/owc/plane.h"
#include "tools/owc/random.h"
#include "tools/owc/split.h"

struct scene {
    struct model model;
    struct mesh mesh;
    struct planes planes;
    struct arrangement arrangement;
    struct pieces pieces;
    struct tree tree;
};

/* Expects the model in the scene. */
static void scene_prepare(struct scene *s, uint32_t tolerance_q8)
{
    struct problem problem;
    assert_true(clean_model(&s->mesh, &s->model, false, &problem));
    plane_group(&s->planes, &s->mesh, &s->model, tolerance_q8);
    arrangement_begin(&s->arrangement, &s->mesh, &s->planes);
    pieces_begin(&s->pieces, &s->mesh, &s->arrangement);
}

/* Frees all but the model. */
static void scene_clear(struct scene *s)
{
    tree_free(&s->tree);
    pieces_free(&s->pieces);
    arrangement_free(&s->arrangement);
    planes_free(&s->planes);
    mesh_discard(&s->mesh);
}

/* The area vector times 2 of a piece, from its exact vertices' nearest doubles. */
static void piece_area(const struct scene *s, uint32_t number, double area[3])
{
    const struct piece *piece = &s->pieces.all[number];
    const uint32_t *v = s->pieces.vertices + piece->first;
    memset(area, 0, 3 * sizeof *area);
    for (uint32_t i = 0; i < piece->count; i++) {
        const double *p = s->arrangement.at[v[i]];
        const double *q = s->arrangement.at[v[(i + 1) % piece->count]];
        for (int k = 0; k < 3; k++) {
            int a = (k + 1) % 3;
            int b = (k + 2) % 3;
            area[k] += p[a] * q[b] - p[b] * q[a];
        }
    }
}

static void add_random_triangles(struct model *model, uint32_t count, uint32_t size)
{
    struct random random = { 9 };
    for (uint32_t i = 0; i < count; i++) {
        uint32_t v[3];
        double middle[3];
        for (int k = 0; k < 3; k++) {
            middle[k] = random_below(&random, 1000);
        }
        for (int c = 0; c < 3; c++) {
            double at[3];
            for (int k = 0; k < 3; k++) {
                at[k] = middle[k] + random_below(&random, size);
            }
            v[c] = models_vertex(model, at[0], at[1], at[2]);
        }
        models_polygon(model, v, 3);
    }
}

/* Put on the lattice, so up to a step beside where it ought to be, which is up to a step off. */
static bool is_rounded_near(const struct scene *s, uint32_t plane, uint32_t vertex)
{
    const struct plane *p = &s->planes.all[plane];
    const struct vertex *v = &s->arrangement.vertices[vertex];
    return v->kind == VERTEX_ROUNDED &&
           llabs(exact_side(p, v->lattice)) <= p->tolerance + p->reach + exact_tolerance(p->n, 256);
}

/* All pieces of a subtree lie on one side of a plane, or on it. */
static void assert_side(const struct scene *s, tree_item root, uint32_t plane, int side)
{
    tree_item *stack = xalloc(s->tree.node_count * 2 + s->pieces.count + 2, sizeof *stack);
    size_t count = 0;
    stack[count++] = root;
    while (count > 0) {
        tree_item item = stack[--count];
        if (item == OW_ITEM_NONE) {
            continue;
        }
        uint32_t value = tree_item_value(item);
        if (tree_item_tag(item) == OW_ITEM_NODE) {
            const struct tree_node *node = &s->tree.nodes[value];
            stack[count++] = node->front;
            stack[count++] = node->back;
            for (uint32_t i = 0; i < node->count; i++) {
                stack[count++] = s->tree.items[node->first + i];
            }
            continue;
        }
        const struct piece *piece = &s->pieces.all[value];
        for (uint32_t i = 0; i < piece->count; i++) {
            uint32_t v = s->pieces.vertices[piece->first + i];
            assert_true(arrangement_side(&s->arrangement, plane, v) * side >= 0 ||
                        is_rounded_near(s, plane, v));
        }
    }
    free(stack);
}

static void assert_ordered(const struct scene *s)
{
    for (uint32_t i = 0; i < s->tree.node_count; i++) {
        const struct tree_node *node = &s->tree.nodes[i];
        if (node->plane == MESH_NONE) {
            continue;
        }
        assert_side(s, node->front, node->plane, 1);
        assert_side(s, node->back, node->plane, -1);
        for (uint32_t k = 0; k < node->count; k++) {
            assert_side(s, s->tree.items[node->first + k], node->plane, 1);
            assert_side(s, s->tree.items[node->first + k], node->plane, -1);
        }
    }
}

/* The pieces in the tree together have each polygon's area. */
static void assert_complete(const struct scene *s)
{
    double(*sums)[3] = xalloc_zero(s->mesh.polygon_count, sizeof *sums);
    for (size_t i = 0; i < s->tree.item_count + 2 * (size_t)s->tree.node_count; i++) {
        size_t n = i - s->tree.item_count;
        tree_item item = i < s->tree.item_count ? s->tree.items[i]
                         : n % 2                ? s->tree.nodes[n / 2].front
                                                : s->tree.nodes[n / 2].back;
        if (item == OW_ITEM_NONE || tree_item_tag(item) != OW_ITEM_FACE) {
            continue;
        }
        double area[3];
        piece_area(s, tree_item_value(item), area);
        for (int k = 0; k < 3; k++) {
            sums[s->pieces.all[tree_item_value(item)].polygon][k] += area[k];
        }
    }
    for (uint32_t i = 0; i < s->mesh.polygon_count; i++) {
        double area[3];
        double difference = 0;
        double size = 0;
        piece_area(s, i, area); /* piece i was polygon i, before anything was cut */
        for (int k = 0; k < 3; k++) {
            difference += fabs(area[k] - sums[i][k]);
            size += fabs(area[k]);
        }
        assert_true(difference < 1e-3 * size + 1e4);
    }
    free(sums);
}

/* Every selection, one and two sides, strict and not: ordered and complete. */
static void test_random_triangles(void **state)
{
    (void)state;
    struct scene s = { 0 };
    add_random_triangles(&s.model, 40, 600);
    for (int select = BSP_FIRST; select <= BSP_EXHAUSTIVE; select++) {
        for (uint32_t way = 0; way < 4; way++) {
            struct bsp_options options = { .select = (enum bsp_select)select,
                                           .candidates = 5,
                                           .seed = way,
                                           .two_sided = way % 2 == 1 };
            scene_prepare(&s, way / 2 * 256);
            bsp_build(&s.tree, &s.arrangement, &s.pieces, &options, NULL);
            assert_ordered(&s);
            assert_complete(&s);
            scene_clear(&s);
        }
    }
    import_free(&s.model);
}

/* Exhaustive cuts no more at the root than any; kedem with all candidates is exhaustive. */
static void test_selection(void **state)
{
    (void)state;
    struct scene s = { 0 };
    add_random_triangles(&s.model, 60, 400);
    uint32_t splits[2];
    uint32_t roots[2];
    for (int way = 0; way < 2; way++) {
        struct bsp_options options = { .select = way ? BSP_KEDEM : BSP_EXHAUSTIVE,
                                       .candidates = 1000000,
                                       .seed = 3 };
        scene_prepare(&s, 256);
        bsp_build(&s.tree, &s.arrangement, &s.pieces, &options, NULL);
        splits[way] = s.pieces.splits;
        roots[way] = s.tree.nodes[0].plane;
        scene_clear(&s);
    }
    assert_int_equal(splits[0], splits[1]);
    assert_int_equal(roots[0], roots[1]);
    scene_prepare(&s, 256);
    uint32_t least = MESH_NONE;
    uint32_t root_cuts = 0;
    for (uint32_t c = 0; c < s.pieces.count; c++) {
        uint32_t cuts = 0;
        for (uint32_t i = 0; i < s.pieces.count; i++) {
            cuts +=
                split_side_of(&s.arrangement, &s.pieces, i, s.pieces.all[c].record) == SPLIT_ACROSS;
        }
        least = cuts < least ? cuts : least;
        root_cuts = s.pieces.all[c].record == roots[0] ? cuts : root_cuts;
    }
    assert_int_equal(root_cuts, least);
    scene_clear(&s);
    import_free(&s.model);
}

/* 10,000 parallel triangles, always the first one's plane: a chain as long, and no recursion. */
static void test_chain(void **state)
{
    (void)state;
    enum { COUNT = 10000 };
    struct model model = { 0 };
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob blob;
    for (uint32_t i = 0; i < COUNT; i++) {
        uint32_t v[3];
        for (uint32_t k = 0; k < 3; k++) {
            v[k] = models_vertex(&model, k == 1, k == 2, i * 3.0);
        }
        models_polygon(&model, v, 3);
    }
    options.select = BSP_FIRST;
    options.sides = SIDES_ONE;
    models_compile(&blob, &stats, &model, &options);
    assert_int_equal(blob.polygons, COUNT);
    assert_int_equal(blob.switch_depth, COUNT - 1);
    blob_free(&blob);
    import_free(&model);
}

/* Faces in one plane stand in the file's order, so that the later one wins. */
static void test_painting_order(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob blob;
    struct ow_tree tree;
    for (uint32_t i = 0; i < 50; i++) { /* overlapping squares, small and large by turns */
        uint32_t v[4];
        double size = 1 + (i * 37 % 50);
        for (uint32_t k = 0; k < 4; k++) {
            v[k] = models_vertex(&model, i + size * (k == 1 || k == 2), size * (k >= 2), 0);
        }
        models_polygon(&model, v, 4);
    }
    for (int two = 0; two < 2; two++) {
        options.sides = two ? SIDES_TWO : SIDES_ONE;
        models_compile(&blob, &stats, &model, &options);
        assert_int_equal(ow_tree_open(&tree, blob.bytes, blob.size), OW_OK);
        assert_int_equal(tree.node_count, 1);
        assert_int_equal(tree.switch_count, 1);
        assert_int_equal(tree.face_count, two ? 100 : 50);
        uint32_t at = tree.polygons_at;
        for (uint32_t i = 0; i < 50; i++) {
            struct models_record record;
            at = models_read_record(&tree, at, &record);
            assert_int_equal(record.source, i + 1);
        }
        blob_free(&blob);
    }
    import_free(&model);
}

/* A comb cut through its teeth: both parts have their areas, and use the same crossings. */
static void test_split_comb(void **state)
{
    (void)state;
    struct scene s = { 0 };
    uint32_t v[22];
    v[0] = models_vertex(&s.model, 0, -1000, 0);
    v[1] = models_vertex(&s.model, 5000, -1000, 0);
    for (uint32_t i = 0; i < 5; i++) {
        double x = 5000 - 1000.0 * i;
        v[2 + 4 * i] = models_vertex(&s.model, x, 1000, 0);
        v[3 + 4 * i] = models_vertex(&s.model, x - 500, 1000, 0);
        v[4 + 4 * i] = models_vertex(&s.model, x - 500, 0, 0);
        v[5 + 4 * i] = models_vertex(&s.model, x - 1000, 0, 0);
    }
    models_polygon(&s.model, v, 22);
    scene_prepare(&s, 0);
    double step = s.mesh.lattice.step;
    uint32_t plane = plane_add(&s.planes, (int32_t[]){ 0, 2, 0 }, -15001, 0);
    struct splitter splitter = { 0 };
    uint32_t front;
    uint32_t back;
    assert_int_equal(split_side_of(&s.arrangement, &s.pieces, 0, plane), SPLIT_ACROSS);
    split_piece(&splitter, &s.arrangement, &s.pieces, 0, plane, &front, &back);
    double areas[3][3];
    piece_area(&s, 0, areas[0]);
    piece_area(&s, front, areas[1]);
    piece_area(&s, back, areas[2]);
    double height = 1000 - 7500.5 * step; /* of the teeth above the cut */
    assert_true(fabs(areas[1][2] * step * step / 2 - 5 * 500 * height) < 1000);
    assert_true(fabs(areas[1][2] + areas[2][2] - areas[0][2]) < 1);
    assert_int_equal(s.pieces.all[front].count, 20);
    assert_int_equal(s.pieces.all[back].count, 22 - 10 + 10);
    assert_int_equal(split_side_of(&s.arrangement, &s.pieces, front, plane), SPLIT_FRONT);
    assert_int_equal(split_side_of(&s.arrangement, &s.pieces, back, plane), SPLIT_BACK);
    uint32_t marks = 0;
    for (uint32_t i = 0; i < 20; i++) { /* five chords, and nothing else, is marked */
        marks += s.pieces.edges[s.pieces.all[front].first + i] & 1;
    }
    assert_int_equal(marks, 5);
    splitter_free(&splitter);
    scene_clear(&s);
    import_free(&s.model);
}

/* A plane through corners: no vertex is made, and an edge on the plane goes to one part. */
static void test_split_corners(void **state)
{
    (void)state;
    struct scene s = { 0 };
    static const double at[8][2] = { { 0, 0 },       { 4000, 0 },    { 4000, 2000 }, { 3000, 2000 },
                                     { 2000, 4000 }, { 1000, 2000 }, { 500, 2000 },  { 0, 2000 } };
    uint32_t v[8];
    for (int i = 0; i < 8; i++) {
        v[i] = models_vertex(&s.model, at[i][0], at[i][1], 0);
    }
    models_polygon(&s.model, v, 8);
    scene_prepare(&s, 0);
    const struct piece *whole = &s.pieces.all[0];
    int16_t y = s.arrangement.vertices[s.pieces.vertices[whole->first + 7]].lattice[1];
    uint32_t plane = plane_add(&s.planes, (int32_t[]){ 0, 1, 0 }, -y, 0);
    struct splitter splitter = { 0 };
    uint32_t vertices = s.arrangement.vertex_count;
    uint32_t front;
    uint32_t back;
    split_piece(&splitter, &s.arrangement, &s.pieces, 0, plane, &front, &back);
    assert_int_equal(s.arrangement.vertex_count, vertices);
    double areas[3][3];
    piece_area(&s, 0, areas[0]);
    piece_area(&s, front, areas[1]);
    piece_area(&s, back, areas[2]);
    assert_true(areas[1][2] > 0 && areas[2][2] > 0);
    assert_true(areas[1][2] + areas[2][2] == areas[0][2]);
    /* Of the outline's eight edges each is in one part; only the cut is in both. */
    uint32_t unmarked = 0;
    for (uint32_t part = front; part <= back; part++) {
        for (uint32_t i = 0; i < s.pieces.all[part].count; i++) {
            unmarked += !(s.pieces.edges[s.pieces.all[part].first + i] & 1);
        }
    }
    assert_int_equal(unmarked, 8);
    splitter_free(&splitter);
    scene_clear(&s);
    import_free(&s.model);
}

/* A corner that only touches the plane from behind stays out of the front part. */
static void test_split_touching(void **state)
{
    (void)state;
    struct scene s = { 0 };
    static const double at[8][2] = { { 0, 0 },       { 4000, 0 },    { 4000, 4000 }, { 3000, 4000 },
                                     { 3000, 1000 }, { 2000, 2000 }, { 1000, 2000 }, { 0, 1000 } };
    uint32_t v[8];
    for (int i = 0; i < 8; i++) {
        v[i] = models_vertex(&s.model, at[i][0], at[i][1], 0);
    }
    models_polygon(&s.model, v, 8);
    scene_prepare(&s, 0);
    const struct piece *whole = &s.pieces.all[0];
    int16_t y = s.arrangement.vertices[s.pieces.vertices[whole->first + 5]].lattice[1];
    uint32_t plane = plane_add(&s.planes, (int32_t[]){ 0, 1, 0 }, -y, 0);
    struct splitter splitter = { 0 };
    uint32_t front;
    uint32_t back;
    split_piece(&splitter, &s.arrangement, &s.pieces, 0, plane, &front, &back);
    assert_int_equal(s.pieces.all[front].count, 4);
    assert_int_equal(s.pieces.all[back].count, 8);
    splitter_free(&splitter);
    scene_clear(&s);
    import_free(&s.model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_triangles),
        cmocka_unit_test(test_selection),
        cmocka_unit_test(test_chain),
        cmocka_unit_test(test_painting_order),
        cmocka_unit_test(test_split_comb),
        cmocka_unit_test(test_split_corners),
        cmocka_unit_test(test_split_touching),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
