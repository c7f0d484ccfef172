/* SPDX-License-Identifier: 0BSD */
/* What the compiler tells: which polygons were split by what, and the picture of a tree. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/unit/owc_models.h"
#include "tools/owc/import.h"
#include "tools/owc/plot.h"

static char text[1 << 20];

/* What was written to a temporary file. */
static void read_back(FILE *file)
{
    rewind(file);
    size_t got = fread(text, 1, sizeof text - 1, file);
    text[got] = '\0';
    assert_true(got < sizeof text - 1);
    fclose(file);
}

static uint32_t count_of(const char *what)
{
    uint32_t count = 0;
    for (const char *at = strstr(text, what); at != NULL; at = strstr(at + 1, what)) {
        count++;
    }
    return count;
}

static void add_square(struct model *model, int axis, double at, double size)
{
    uint32_t v[4];
    for (int i = 0; i < 4; i++) {
        double p[3];
        p[axis] = at;
        p[(axis + 1) % 3] = i == 1 || i == 2 ? size : -size;
        p[(axis + 2) % 3] = i > 1 ? size : -size;
        v[i] = models_vertex(model, p[0], p[1], p[2]);
    }
    models_polygon(model, v, 4);
}

/* Three squares that cross: the first cuts both others, the second what is left of the third. */
static void cuts_are_explained(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct user_planes planes;
    struct problem problem;
    struct blob blob;
    for (int axis = 0; axis < 3; axis++) {
        add_square(&model, axis, 0.1 * axis, 2);
    }
    options.method = METHOD_ONLINE;
    options.explain = tmpfile();
    models_compile(&blob, &stats, &model, &options);
    read_back(options.explain);
    assert_string_equal(
        text, "polygon 2 split by the plane of polygon 1, from 0,0.0999786,2 to 0,0.0999786,-2\n"
              "polygon 3 split by the plane of polygon 1, from 0,-2,0.200018 to 0,2,0.200018\n"
              "polygon 3 split by the plane of polygon 2, from 0,0.0999786,0.200018 to "
              "-2,0.0999786,0.200018\n"
              "polygon 3 split by the plane of polygon 2, from 2,0.0999786,0.200018 to "
              "0,0.0999786,0.200018\n");
    blob_free(&blob);
    assert_true(user_planes_read(&planes, "0,1,0,1", &problem));
    options.method = METHOD_BSP;
    options.select = BSP_FIRST;
    options.dividing = &planes;
    options.explain = tmpfile();
    models_compile(&blob, &stats, &model, &options);
    read_back(options.explain);
    assert_int_equal(count_of("\n"), stats.splits);
    assert_int_equal(count_of(" by the dividing plane 0,1,0,1,"), 2); /* the squares across it */
    assert_int_equal(count_of("polygon 1 split by the dividing plane"), 1);
    blob_free(&blob);
    options = models_options();
    options.method = METHOD_OBSTRUCTION;
    options.explain = tmpfile();
    models_compile(&blob, &stats, &model, &options);
    read_back(options.explain);
    assert_true(stats.splits > 0);
    assert_int_equal(count_of("\n"), stats.splits);
    blob_free(&blob);
    user_planes_free(&planes);
    import_free(&model);
}

static void plot(const struct model *model, enum method method, struct ow_tree *tree)
{
    struct compile_options options = models_options();
    struct compile_stats stats;
    struct blob blob;
    FILE *file = tmpfile();
    options.method = method;
    options.sides = SIDES_ONE;
    models_compile(&blob, &stats, model, &options);
    assert_int_equal(ow_tree_open(tree, blob.bytes, blob.size), OW_OK);
    plot_tree(file, tree);
    read_back(file);
    blob_free(&blob);
    assert_memory_equal(text, "<svg ", 5);
    assert_non_null(strstr(text, "</svg>\n"));
    assert_int_equal(count_of("<title>"), count_of("</title>"));
}

/* Every switch is a circle, every sequence a box, every face a number's share or a dot. */
static void small_trees_are_drawn_whole(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct ow_tree tree;
    for (int i = 0; i < 5; i++) {
        models_box(&model, (double[]){ 2, 1, 1.5 }, 1,
                   &(struct models_pose){ 0.7 * i, 0.4 * i, { 0.5 * i, 0.2, 0.3 * i } });
    }
    for (int k = 0; k < 2; k++) {
        plot(&model, k ? METHOD_FEUDAL_STATIC : METHOD_BSP, &tree);
        assert_int_equal(count_of("class=\"switch\""), tree.switch_count);
        assert_int_equal(count_of("class=\"sequence\""), tree.node_count - tree.switch_count);
        assert_int_equal(count_of("class=\"more\""), 0);
        uint32_t faces = count_of("class=\"face\"");
        for (const char *at = strstr(text, "<text x"); at != NULL; at = strstr(at + 1, "<text x")) {
            faces += (uint32_t)strtoul(strchr(at, '>') + 1, NULL, 10);
        }
        assert_int_equal(faces, tree.face_count);
    }
    import_free(&model);
}

/* A chain of a thousand switches: some hundred are drawn, the triangles hold the rest. */
static void large_trees_are_summarised(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct ow_tree tree;
    for (int i = 0; i < 1000; i++) {
        add_square(&model, 2, i, 100);
    }
    plot(&model, METHOD_ONLINE, &tree);
    uint32_t drawn = count_of("class=\"switch\"");
    assert_in_range(drawn, 100, PLOT_MOST_NODES);
    uint32_t hidden = 0;
    for (const char *at = strstr(text, "class=\"more\""); at != NULL;
         at = strstr(at + 1, "class=\"more\"")) {
        hidden += (uint32_t)strtoul(strstr(at, "<title>") + 7, NULL, 10);
    }
    assert_int_equal(drawn + hidden, tree.node_count);
    import_free(&model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cuts_are_explained),
        cmocka_unit_test(small_trees_are_drawn_whole),
        cmocka_unit_test(large_trees_are_summarised),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
