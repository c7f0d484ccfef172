/* SPDX-License-Identifier: 0BSD */
/* On-line insertion: polygon by polygon, and into trees that were written and read back. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "ow_read.h"
#include "tests/unit/owc_models.h"
#include "tools/owc/blob_file.h"
#include "tools/owc/import.h"
#include "tools/owc/insert.h"
#include "tools/owc/random.h"

static struct compile_options online_options(void)
{
    struct compile_options options = models_options();
    options.method = METHOD_ONLINE;
    return options;
}

static void add_plate(struct model *model, double z, double size)
{
    uint32_t v[4];
    for (uint32_t i = 0; i < 4; i++) {
        v[i] = models_vertex(model, i == 1 || i == 2 ? size : -size, i > 1 ? size : -size, z);
    }
    models_polygon(model, v, 4);
}

/* Parallel plates in order make a chain: the n-th is compared with all before it. */
static void plates_make_a_chain(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct compile_options options = online_options();
    struct compile_stats stats;
    struct blob blob;
    for (int i = 0; i < 20; i++) {
        add_plate(&model, i, 10);
    }
    options.sides = SIDES_ONE;
    models_compile(&blob, &stats, &model, &options);
    assert_int_equal(stats.relations, 20 * 19 / 2);
    assert_int_equal(stats.splits, 0);
    assert_int_equal(blob.switches, 19); /* the last is a face */
    assert_int_equal(blob.switch_depth, 19);
    blob_free(&blob);
    import_free(&model);
}

/* The first polygon's plane is the root's, whatever it cuts; coplanar ones come to it in order. */
static void the_first_polygon_is_the_root(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct compile_options options = online_options();
    struct compile_stats stats;
    struct blob blob;
    struct ow_tree tree;
    add_plate(&model, 0, 1);
    models_box(&model, (double[]){ 4, 4, 4 }, 1, &(struct models_pose){ 0, 0, { 0, 0, 1 } });
    add_plate(&model, 0, 1.5);
    options.sides = SIDES_ONE;
    models_compile(&blob, &stats, &model, &options);
    assert_int_equal(stats.splits, 4); /* the box's upright sides */
    assert_int_equal(ow_tree_open(&tree, blob.bytes, blob.size), OW_OK);
    uint32_t word = ow_read_u32(tree.bytes, tree.nodes_at);
    assert_int_equal(word & OW_NODE_KIND_MASK, OW_NODE_SWITCH);
    assert_int_equal(word >> OW_NODE_COUNT_SHIFT, 2);
    uint32_t first_at =
        tree.nodes_at + OW_NODE_WORD_BYTES + OW_SWITCH_CHILDREN_BYTES + OW_SWITCH_PLANE_BYTES;
    for (uint32_t i = 0; i < 2; i++) {
        struct models_record record;
        uint32_t item = ow_read_u32(tree.bytes, first_at + 4 * i);
        models_read_record(&tree, tree.polygons_at + 2 * (item >> OW_ITEM_TAG_BITS), &record);
        assert_int_equal(record.source, i == 0 ? 1 : 8);
    }
    blob_free(&blob);
    import_free(&model);
}

/* ---- into a tree that is there ---- */

/* A blob as if it had been read from a file. */
static void reopen(struct blob_file *file, const struct blob *blob, const struct model *model)
{
    *file = (struct blob_file){ .bytes = blob->bytes, .tolerance_q8 = 256 };
    assert_int_equal(ow_tree_open(&file->tree, blob->bytes, blob->size), OW_OK);
    assert_true(lattice_of_model(&file->lattice, model));
}

static bool insert(struct blob *blob, struct compile_stats *stats, const struct blob_file *file,
                   struct model *more, struct problem *problem)
{
    struct insertion into;
    struct compile_options options = online_options();
    *blob = (struct blob){ 0 };
    options.sides = (file->tree.flags & OW_TREE_TWO_SIDED) ? SIDES_TWO : SIDES_ONE;
    options.into = &into;
    bool fine = insertion_begin(&into, file, problem) && insertion_take(&into, more, problem) &&
                compile_model(blob, stats, more, &options, problem);
    insertion_free(&into);
    return fine;
}

/* Every other polygon of a model, and the others. */
static void halve(const struct model *model, struct model *halves)
{
    for (uint32_t h = 0; h < 2; h++) {
        halves[h] = (struct model){ 0 };
        for (size_t i = 0; i < model->vertex_count; i++) {
            const double *v = model->vertices[i];
            models_vertex(&halves[h], v[0], v[1], v[2]);
        }
        for (size_t i = h; i < model->polygon_count; i += 2) {
            const struct model_polygon *polygon = &model->polygons[i];
            models_polygon(&halves[h], model->corners + polygon->first, polygon->count);
        }
    }
}

/*
 * Boxes that cross, half of their polygons added later: new polygons share edges
 * with old ones that were cut there, and the whole must have no gap.
 */
static void no_gap_opens_at_old_cuts(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct model halves[2];
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob first;
    struct blob both;
    struct blob_file file;
    struct problem problem;
    struct ow_tree tree;
    for (int i = 0; i < 4; i++) {
        models_box(&model, (double[]){ 2, 1, 1.5 }, 2,
                   &(struct models_pose){ 0.7 * i, 0.4 * i, { 0.5 * i, 0.2, 0.3 * i } });
    }
    halve(&model, halves);
    options.sides = SIDES_TWO;
    models_compile(&first, &stats, &halves[0], &options);
    assert_true(stats.splits > 20);
    assert_int_equal(ow_tree_open(&tree, first.bytes, first.size), OW_OK);
    assert_true(models_open_edges(&tree) > 0);
    reopen(&file, &first, &halves[0]);
    assert_true(insert(&both, &stats, &file, &halves[1], &problem));
    assert_int_equal(ow_tree_open(&tree, both.bytes, both.size), OW_OK);
    assert_int_equal(models_open_edges(&tree), 0);
    assert_true(tree.polygon_count > first.polygons + halves[1].polygon_count);
    blob_free(&first);
    blob_free(&both);
    for (int i = 0; i < 2; i++) {
        import_free(&halves[i]);
    }
    import_free(&model);
}

/* Numbers go on, colours are joined, the tree's kind stays, all faces are there. */
static void records_are_carried_over(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct model more = { 0 };
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob first;
    struct blob both;
    struct blob_file file;
    struct problem problem;
    struct ow_tree tree;
    uint32_t seen[13] = { 0 };
    models_box(&model, (double[]){ 8, 8, 8 }, 1, &(struct models_pose){ 0, 0, { 0, 0, 0 } });
    models_box(&more, (double[]){ 2, 2, 2 }, 1, &(struct models_pose){ 0.2, 0, { 0, 0, 0 } });
    model.colours[0] = 0x112233;
    more.colours[0] = 0x445566;
    models_compile(&first, &stats, &model, &options);
    reopen(&file, &first, &model);
    assert_true(insert(&both, &stats, &file, &more, &problem));
    assert_true(stats.closed);
    assert_int_equal(ow_tree_open(&tree, both.bytes, both.size), OW_OK);
    assert_int_equal(tree.flags, OW_TREE_SWITCH_ONLY | OW_TREE_CLOSED | OW_TREE_IDS);
    assert_int_equal(tree.colour_count, 2);
    assert_int_equal(tree.face_count, tree.polygon_count);
    uint32_t at = tree.polygons_at;
    for (uint32_t i = 0; i < tree.polygon_count; i++) {
        struct models_record record;
        at = models_read_record(&tree, at, &record);
        assert_in_range(record.source, 1, 12);
        uint32_t colour =
            ow_read_u32(tree.bytes, tree.colours_at + 4 * (record.look & OW_POLYGON_COLOUR_MASK));
        assert_int_equal(colour, record.source <= 6 ? 0x112233 : 0x445566);
        seen[record.source]++;
    }
    for (uint32_t i = 1; i <= 12; i++) {
        assert_true(seen[i] > 0);
    }
    blob_free(&first);
    blob_free(&both);
    import_free(&model);
    import_free(&more);
}

static void what_cannot_be_added_is_refused(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct model more = { 0 };
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob first;
    struct blob both;
    struct blob_file file;
    struct problem problem;
    models_box(&model, (double[]){ 8, 8, 8 }, 2, &(struct models_pose){ 0, 0, { 0, 0, 0 } });
    models_box(&more, (double[]){ 2, 2, 2 }, 1, &(struct models_pose){ 0, 0, { 3.2, 0, 0 } });
    models_compile(&first, &stats, &model, &options);
    reopen(&file, &first, &model);
    assert_false(insert(&both, &stats, &file, &more, &problem));
    assert_non_null(strstr(problem.text, "recompile"));
    blob_free(&first);
    /* A tree whose sequences order faces. */
    options.method = METHOD_FEUDAL_STATIC;
    models_compile(&first, &stats, &model, &options);
    reopen(&file, &first, &model);
    assert_false(insert(&both, &stats, &file, &more, &problem));
    assert_non_null(strstr(problem.text, "sequences"));
    blob_free(&first);
    import_free(&model);
    import_free(&more);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plates_make_a_chain),
        cmocka_unit_test(the_first_polygon_is_the_root),
        cmocka_unit_test(no_gap_opens_at_old_cuts),
        cmocka_unit_test(records_are_carried_over),
        cmocka_unit_test(what_cannot_be_added_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
