/* SPDX-License-Identifier: 0BSD */
/* The blob that the compiler writes: the core reads back what went in. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ow_read.h"
#include "tests/unit/owc_models.h"
#include "tools/owc/import.h"

#define AT(name) ((uint32_t)offsetof(struct ow_disk_header, name))

static void make_two_boxes(struct model *model)
{
    models_box(model, (double[]){ 2, 2, 2 }, 3, &(struct models_pose){ 0, 0, { 5, 6, 7 } });
    models_box(model, (double[]){ 2, 2, 2 }, 3,
               &(struct models_pose){ 0.7, 0.4, { 5.3, 6.2, 7.1 } });
}

static void compile_and_open(struct blob *blob, struct compile_stats *stats, struct ow_tree *tree,
                             const struct model *model, const struct compile_options *options)
{
    models_compile(blob, stats, model, options);
    assert_int_equal(ow_tree_open(tree, blob->bytes, blob->size), OW_OK);
}

/* The header's counts are the compiler's, and every record can be read. */
static void test_counts(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob blob;
    struct ow_tree tree;
    make_two_boxes(&model);
    compile_and_open(&blob, &stats, &tree, &model, &options);
    assert_int_equal(stats.source_polygons, 108);
    assert_int_equal(stats.input_polygons, 108);
    assert_true(stats.splits > 0);
    assert_int_equal(blob.polygons, stats.input_polygons + stats.splits - stats.vanished);
    assert_int_equal(tree.polygon_count, blob.polygons);
    assert_int_equal(tree.face_count, blob.polygons);
    assert_int_equal(tree.vertex_count, blob.vertices);
    assert_int_equal(tree.node_count, blob.nodes);
    assert_int_equal(tree.switch_count, blob.switches);
    assert_int_equal(tree.flags, OW_TREE_SWITCH_ONLY | OW_TREE_CLOSED | OW_TREE_IDS);
    bool seen[109] = { false };
    uint32_t at = tree.polygons_at;
    uint32_t next_vertex = 0;
    for (uint32_t i = 0; i < tree.polygon_count; i++) {
        struct models_record record;
        at = models_read_record(&tree, at, &record);
        assert_in_range(record.source, 1, 108);
        seen[record.source] = true;
        for (uint32_t k = 0; k < record.count; k++) { /* vertices by first use */
            assert_true(record.corners[k] <= next_vertex);
            next_vertex += record.corners[k] == next_vertex;
        }
    }
    assert_int_equal((at + 3) / 4 * 4, tree.vertices_at);
    assert_int_equal(next_vertex, tree.vertex_count);
    for (uint32_t i = 1; i <= 108; i++) {
        assert_true(seen[i]);
    }
    blob_free(&blob);
    import_free(&model);
}

/* Origin and step lead from lattice points back to the model's coordinates. */
static void test_coordinates(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob blob;
    struct ow_tree tree;
    double lattice[4]; /* origin, step */
    models_box(&model, (double[]){ 2, 4, 8 }, 1, &(struct models_pose){ 0, 0, { 5, 6, 7 } });
    compile_and_open(&blob, &stats, &tree, &model, &options);
    for (uint32_t k = 0; k < 4; k++) {
        uint32_t at = (k < 3 ? AT(origin_bits) : AT(step_bits)) + (k < 3 ? 8 * k : 0);
        uint64_t bits = ow_read_u32(tree.bytes, at) | (uint64_t)ow_read_u32(tree.bytes, at + 4)
                                                          << 32;
        memcpy(&lattice[k], &bits, sizeof bits);
    }
    assert_true(lattice[3] == 8.0 / 65534);
    assert_int_equal(tree.vertex_count, 8);
    for (uint32_t i = 0; i < 8; i++) {
        static const double low[3] = { 4, 4, 3 };
        static const double high[3] = { 6, 8, 11 };
        int32_t v[3];
        models_read_vertex(&tree, i, v);
        for (uint32_t k = 0; k < 3; k++) {
            double value = lattice[k] + v[k] * lattice[3];
            assert_true(fabs(value - low[k]) < 1e-4 || fabs(value - high[k]) < 1e-4);
            assert_in_range(v[k] - tree.box_min[k], 0, tree.box_max[k] - tree.box_min[k]);
        }
    }
    assert_int_equal(ow_read_u32(tree.bytes, AT(tolerance_q8)), 256);
    blob_free(&blob);
    import_free(&model);
}

/* Equal seeds give equal blobs; another seed gives another tree here. */
static void test_seeds(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob first;
    struct blob again;
    make_two_boxes(&model);
    options.candidates = 1;
    models_compile(&first, &stats, &model, &options);
    models_compile(&again, &stats, &model, &options);
    assert_int_equal(first.size, again.size);
    assert_memory_equal(first.bytes, again.bytes, first.size);
    blob_free(&again);
    options.seed = 2;
    models_compile(&again, &stats, &model, &options);
    assert_true(first.size != again.size || memcmp(first.bytes, again.bytes, first.size) != 0);
    blob_free(&first);
    blob_free(&again);
    import_free(&model);
}

/* With two sides each polygon has a face and, next to it, its reverse. */
static void test_two_sides(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob blob;
    struct ow_tree tree;
    make_two_boxes(&model);
    options.sides = SIDES_TWO;
    options.keep_ids = false;
    compile_and_open(&blob, &stats, &tree, &model, &options);
    assert_int_equal(tree.flags, OW_TREE_SWITCH_ONLY | OW_TREE_CLOSED | OW_TREE_TWO_SIDED);
    assert_int_equal(tree.face_count, 2 * tree.polygon_count);
    uint32_t pairs = 0;
    for (uint32_t at = tree.nodes_at; at < tree.polygons_at;) {
        uint32_t word = ow_read_u32(tree.bytes, at);
        at += 4;
        if ((word & OW_NODE_KIND_MASK) == OW_NODE_SWITCH) {
            assert_int_not_equal(ow_read_u32(tree.bytes, at) & 3, OW_ITEM_FACE);
            assert_int_not_equal(ow_read_u32(tree.bytes, at + 4) & 3, OW_ITEM_FACE);
            at += OW_SWITCH_CHILDREN_BYTES + OW_SWITCH_PLANE_BYTES;
        }
        for (uint32_t i = 0; i < word >> OW_NODE_COUNT_SHIFT; i += 2, at += 8, pairs++) {
            uint32_t face = ow_read_u32(tree.bytes, at);
            assert_int_equal(face & 3, OW_ITEM_FACE);
            assert_int_equal(ow_read_u32(tree.bytes, at + 4), face + OW_ITEM_REVERSE);
        }
    }
    assert_int_equal(pairs, tree.polygon_count);
    blob_free(&blob);
    import_free(&model);
}

/* One polygon alone is a sequence of one face, with either number of sides. */
static void test_single(void **state)
{
    (void)state;
    for (int two = 0; two < 2; two++) {
        struct model model = { 0 };
        struct compile_options options = models_options();
        struct compile_stats stats;
        struct blob blob;
        struct ow_tree tree;
        models_tetrahedron(&model, 1, &(struct models_pose){ 0, 0, { 0, 0, 0 } });
        model.polygon_count = 1;
        options.sides = two ? SIDES_TWO : SIDES_ONE;
        compile_and_open(&blob, &stats, &tree, &model, &options);
        assert_int_equal(tree.node_count, 1);
        assert_int_equal(tree.switch_count, 0);
        assert_int_equal(tree.face_count, 1 + two);
        assert_int_equal(tree.depth, 1);
        assert_int_equal(blob.switch_depth, 0);
        blob_free(&blob);
        import_free(&model);
    }
}

/* Normals are 127 times the unit normal of the corners; flat faces are never uneven. */
static void test_face_normals(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob blob;
    struct ow_tree tree;
    models_box(&model, (double[]){ 2, 4, 8 }, 2, &(struct models_pose){ 0, 0, { 0, 0, 0 } });
    compile_and_open(&blob, &stats, &tree, &model, &options);
    uint32_t at = tree.polygons_at;
    for (uint32_t i = 0; i < tree.polygon_count; i++) {
        struct models_record record;
        at = models_read_record(&tree, at, &record);
        int axis = (int)(record.source - 1) / 4 / 2;
        for (int k = 0; k < 3; k++) {
            int sign = (record.source - 1) / 4 % 2 ? 1 : -1;
            assert_int_equal(record.normal[k], k == axis ? 127 * sign : 0);
        }
        assert_int_equal(record.look & OW_POLYGON_UNEVEN, 0);
        assert_int_equal(record.look & OW_POLYGON_MARKED, 0);
    }
    blob_free(&blob);
    import_free(&model);
}

/* Cut edges are marked, and the model's own edges are not. */
static void test_marks(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob blob;
    struct ow_tree tree;
    /* A square that a second one cuts in halves. */
    for (int i = 0; i < 2; i++) {
        uint32_t v[4];
        for (uint32_t k = 0; k < 4; k++) {
            double x = k == 1 || k == 2 ? 1 : -1;
            double y = k >= 2 ? 1 : -1;
            v[k] = i ? models_vertex(&model, 0, 2 * x, 2 * y) : models_vertex(&model, x, y, 0);
        }
        models_polygon(&model, v, 4);
    }
    options.select = BSP_EXHAUSTIVE;
    compile_and_open(&blob, &stats, &tree, &model, &options);
    assert_int_equal(tree.polygon_count, 3);
    uint32_t at = tree.polygons_at;
    uint32_t marked = 0;
    for (uint32_t i = 0; i < 3; i++) {
        struct models_record record;
        at = models_read_record(&tree, at, &record);
        for (uint32_t k = 0; k < record.count; k++) {
            int32_t p[3];
            int32_t q[3];
            models_read_vertex(&tree, record.corners[k], p);
            models_read_vertex(&tree, record.corners[(k + 1) % record.count], q);
            bool cut = (p[0] == 0 && q[0] == 0 && abs(p[1]) < 20000) ||
                       (p[2] == 0 && q[2] == 0 && abs(p[1]) == 32767 && abs(q[1]) == 32767);
            assert_int_equal(record.marks[k], cut);
            marked += record.marks[k];
        }
    }
    assert_int_equal(marked, 2);
    blob_free(&blob);
    import_free(&model);
}

/* Vertex normals: kept where asked for, one vertex for each normal, between the corners' at cuts. */
static void test_vertex_normals(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob blob;
    struct ow_tree tree;
    make_two_boxes(&model);
    for (size_t i = 0; i < model.vertex_count; i++) { /* away from the middle of the first box */
        double square = 0;
        for (int k = 0; k < 3; k++) {
            double d = model.vertices[i][k] - 5 - k;
            square += d * d;
        }
        for (int k = 0; k < 3; k++) {
            model.normals[i][k] = (float)((model.vertices[i][k] - 5 - k) / sqrt(square));
        }
    }
    compile_and_open(&blob, &stats, &tree, &model, &options);
    assert_int_equal(tree.normals_at, tree.colours_at);
    uint32_t plain = tree.vertex_count;
    blob_free(&blob);
    options.keep_normals = true;
    compile_and_open(&blob, &stats, &tree, &model, &options);
    assert_true(tree.flags & OW_TREE_NORMALS);
    assert_int_equal(models_open_edges(&tree) > 0, tree.vertex_count > plain);
    for (uint32_t i = 0; i < tree.vertex_count; i++) {
        double length = 0;
        for (uint32_t k = 0; k < 3; k++) {
            int32_t n = ow_read_i8(tree.bytes, tree.normals_at + 3 * i + k);
            length += n * n;
        }
        assert_true(fabs(sqrt(length) - 127) < 1);
    }
    blob_free(&blob);
    import_free(&model);
}

/* Beyond 65536 vertices corners take 32 bits. */
static void test_wide_corners(void **state)
{
    (void)state;
    enum { SIDE = 300 };
    struct model model = { 0 };
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob blob;
    struct ow_tree tree;
    for (uint32_t i = 0; i <= SIDE; i++) {
        for (uint32_t k = 0; k <= SIDE; k++) {
            models_vertex(&model, i, k, 0);
        }
    }
    for (uint32_t i = 0; i < SIDE; i++) {
        for (uint32_t k = 0; k < SIDE; k++) {
            uint32_t v = i * (SIDE + 1) + k;
            models_polygon(&model, (uint32_t[]){ v, v + SIDE + 1, v + SIDE + 2, v + 1 }, 4);
        }
    }
    compile_and_open(&blob, &stats, &tree, &model, &options);
    assert_true(tree.flags & OW_TREE_INDEX32);
    assert_int_equal(tree.vertex_count, (SIDE + 1) * (SIDE + 1));
    assert_int_equal(tree.polygon_count, SIDE * SIDE);
    assert_int_equal(tree.node_count, 1); /* all in one plane */
    struct models_record record;
    models_read_record(&tree, tree.polygons_at, &record);
    assert_int_equal(record.count, 4);
    assert_int_equal(record.corners[3], 3);
    blob_free(&blob);
    import_free(&model);
}

/* A polygon of several records, alone and as a switch's child: a switch in its plane holds them. */
static void test_long_leaf(void **state)
{
    (void)state;
    for (int alone = 0; alone < 2; alone++) {
        enum { CORNERS = 700 };
        struct model model = { 0 };
        struct compile_options options = models_options();
        struct compile_stats stats;
        struct blob blob;
        struct ow_tree tree;
        uint32_t v[CORNERS];
        for (uint32_t i = 0; i < CORNERS; i++) {
            double angle = 6.283185307179586 * i / CORNERS;
            v[i] = models_vertex(&model, cos(angle), sin(angle), 0);
        }
        if (!alone) {
            models_polygon(&model,
                           (uint32_t[]){ models_vertex(&model, 0, 0, 1),
                                         models_vertex(&model, 1, 0, 1),
                                         models_vertex(&model, 0, 1, 1) },
                           3);
        }
        models_polygon(&model, v, CORNERS);
        options.select = BSP_FIRST;
        options.sides = SIDES_ONE;
        compile_and_open(&blob, &stats, &tree, &model, &options);
        assert_int_equal(tree.polygon_count, 4 + !alone);
        assert_int_equal(tree.switch_count, 1 + !alone);
        assert_int_equal(tree.node_count, 1 + !alone);
        blob_free(&blob);
        import_free(&model);
    }
}

/* A plane's words: d beyond 32 bits and negative numbers come back as they were. */
static void test_plane_words(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob blob;
    struct ow_tree tree;
    for (int i = 0; i < 2; i++) { /* two triangles in the planes z = -2 and z = 2, and one aside */
        double z = i ? 2 : -2;
        models_polygon(&model,
                       (uint32_t[]){ models_vertex(&model, 0, 0, z), models_vertex(&model, 1, 0, z),
                                     models_vertex(&model, 0, 1, z) },
                       3);
    }
    options.sides = SIDES_ONE;
    compile_and_open(&blob, &stats, &tree, &model, &options);
    uint32_t at = tree.nodes_at + 4 + OW_SWITCH_CHILDREN_BYTES;
    int64_t high = 0;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t word = ow_read_u32(tree.bytes, at + 4 * k);
        assert_int_equal(word & 0xFFFFFF, k == 2 ? 8388607 : 0);
        high |= (int64_t)(word >> 24) << 8 * k;
    }
    assert_in_range(high, 0, 0xFFFF); /* the third word's high byte is 0 */
    uint64_t bits = (uint64_t)high << 32 | ow_read_u32(tree.bytes, at + 12);
    int64_t d = (int64_t)(bits << 16) >> 16;
    assert_int_equal(llabs(d), 8388607LL * 32767);
    blob_free(&blob);
    import_free(&model);
}

/* A tree may be as large as its limits; one that is larger says which, and what to do. */
static void test_limits(void **state)
{
    (void)state;
    static const char *const words[] = { "bytes or more", "levels", "vertices",
                                         "faces in one plane" };
    struct model model = { 0 };
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct ow_tree tree;
    struct blob blob;
    make_two_boxes(&model);
    compile_and_open(&blob, &stats, &tree, &model, &options);
    const uint32_t enough[4] = { blob.size, tree.depth, tree.vertex_count, tree.face_count };
    blob_free(&blob);
    for (int i = 0; i < 5; i++) {
        uint32_t most[4];
        struct problem problem;
        for (int k = 0; k < 4; k++) {
            most[k] = k != i ? enough[k] : k == 3 ? 1 : enough[k] - 1;
        }
        struct blob_limits limits = { most[0], most[1], most[2], most[3] };
        options.limits = &limits;
        assert_int_equal(compile_model(&blob, &stats, &model, &options, &problem), i == 4);
        if (i < 4) {
            assert_non_null(strstr(problem.text, words[i]));
            assert_non_null(strstr(problem.text, "can be: "));
        }
        blob_free(&blob);
    }
    import_free(&model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_counts),         cmocka_unit_test(test_limits),
        cmocka_unit_test(test_coordinates),    cmocka_unit_test(test_seeds),
        cmocka_unit_test(test_two_sides),      cmocka_unit_test(test_single),
        cmocka_unit_test(test_face_normals),   cmocka_unit_test(test_marks),
        cmocka_unit_test(test_vertex_normals), cmocka_unit_test(test_wide_corners),
        cmocka_unit_test(test_plane_words),    cmocka_unit_test(test_long_leaf),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
