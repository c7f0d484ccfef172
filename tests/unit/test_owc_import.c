/* SPDX-License-Identifier: 0BSD */
/* Reading models: the file's order and numbers, colours, normals, and what is wrong with a file. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#undef fail /* the helpers have a function of this name */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/unit/child.h"
#include "tools/common/xalloc.h"
#include "tools/owc/import.h"
#include "tools/owc/obj_text.h"

static void write_file(const char *folder, const char *name, const char *text, size_t size,
                       char *path)
{
    folder_path(path, folder, name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static bool import_text(struct model *model, const char *text, struct problem *problem)
{
    return import_memory(model, text, strlen(text), "obj", problem);
}

enum { FACES = 240 };

/*
 * Face i is a polygon of 3 to 8 corners around x = i. Materials, objects and
 * groups change at every turn and come back; points and lines lie between.
 */
static size_t write_interleaved(char *text, size_t bytes)
{
    size_t used = (size_t)snprintf(text, bytes, "mtllib interleaved.mtl\n");
    uint32_t vertices = 0;
    for (uint32_t i = 0; i < FACES; i++) {
        uint32_t corners = 3 + i * 5 % 6;
        if (i % 3 == 0) {
            used += (size_t)snprintf(text + used, bytes - used, "usemtl m%u\n", i / 3 * 7 % 4);
        }
        if (i % 4 == 1) {
            used += (size_t)snprintf(text + used, bytes - used, "g part%u\n", i % 5);
        }
        if (i % 7 == 2) {
            used += (size_t)snprintf(text + used, bytes - used, "o thing%u\ns 1\n", i % 3);
        }
        if (i % 9 == 4) {
            used +=
                (size_t)snprintf(text + used, bytes - used, "l %u %u\n", vertices, vertices - 1);
        }
        for (uint32_t k = 0; k < corners; k++) {
            used += (size_t)snprintf(text + used, bytes - used, "v %u %u %u\n", i, k * (8 - k), k);
        }
        used += (size_t)snprintf(text + used, bytes - used, "f");
        for (uint32_t k = 0; k < corners; k++) { /* by number, or counted back, by turns */
            int number = i % 2 ? (int)k - (int)corners : (int)(vertices + k + 1);
            used += (size_t)snprintf(text + used, bytes - used, " %d", number);
        }
        used += (size_t)snprintf(text + used, bytes - used, "\n");
        vertices += corners;
    }
    return used;
}

/* Polygons come in the file's order, whatever their material, object and group. */
static void test_order(void **state)
{
    (void)state;
    static const char materials[] = "newmtl m0\nKd 1 0 0\nnewmtl m1\nKd 0 1 0\n"
                                    "newmtl m2\nKd 0 0 1\nnewmtl m3\nKd 0.5 0.5 0.5\n";
    static const uint32_t colours[] = { 0xFF0000, 0x00FF00, 0x0000FF, 0x808080 };
    char folder[CHILD_PATH];
    char path[CHILD_PATH];
    size_t bytes = 1 << 18;
    char *text = xalloc(bytes, 1);
    struct model model;
    struct problem problem;
    folder_make(folder);
    write_file(folder, "interleaved.mtl", materials, strlen(materials), path);
    write_file(folder, "interleaved.obj", text, write_interleaved(text, bytes), path);
    assert_true(import_file(&model, path, &problem));
    assert_int_equal(model.polygon_count, FACES);
    for (uint32_t i = 0; i < FACES; i++) {
        const struct model_polygon *polygon = &model.polygons[i];
        assert_int_equal(polygon->count, 3 + i * 5 % 6);
        assert_int_equal(model.colours[polygon->colour], colours[i / 3 * 7 % 4]);
        for (uint32_t k = 0; k < polygon->count; k++) {
            const double *v = model.vertices[model.corners[polygon->first + k]];
            assert_true(v[0] == i && v[2] == k);
        }
    }
    assert_true(model.lines_dropped > 0);
    import_free(&model);
    free(text);
    folder_remove(folder);
}

/* Without groups hidden, assimp gathers by name: the test above would not hold by itself. */
static void test_hiding(void **state)
{
    (void)state;
    char text[] = "g a\no b\n  g c\nv 1 2 3 \\\ng x\ngroup\nf 1\n";
    obj_hide_groups(text, strlen(text));
    assert_string_equal(text, "# a\n# b\n  # c\nv 1 2 3 \\\ng x\n#roup\nf 1\n");
}

/* A file without materials is light grey; vertex normals come along. */
static void test_plain(void **state)
{
    (void)state;
    struct model model;
    struct problem problem;
    assert_true(import_text(&model,
                            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 2\nvn 0 1 0\n"
                            "f 1//1 2//1 3//2 4//2\n",
                            &problem));
    assert_int_equal(model.polygon_count, 1);
    assert_int_equal(model.polygons[0].count, 4);
    assert_int_equal(model.colours[model.polygons[0].colour], MODEL_DEFAULT_COLOUR);
    assert_true(model.normals[model.corners[0]][2] == 1);
    assert_true(model.normals[model.corners[3]][1] == 1);
    import_free(&model);
}

/* Each bad file is refused in words that name the line where there is one. */
static void test_bad(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        long line;
        const char *words;
    } cases[] = {
        { "", 0, "empty" },
        { "# nothing but a comment, and that is long enough for a file\n", 0, "no polygons" },
        { "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n", 2, "finite" },
        { "v 0 0 0\nv 1 0 0\nv 0 -inf 0\nf 1 2 3\n", 3, "finite" },
        { "v 0 0 0\nv 1 0 0\nv 0 1e39 0\nf 1 2 3\n", 3, "finite" },
        { "v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n", 2, "three coordinates" },
        { "v 0 0 0\nv 1 0 x\nv 0 1 0\nf 1 2 3\n", 2, "three coordinates" },
        { "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", 4, "vertex 4" },
        { "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", 4, "vertex 0" },
        { "v 0 0 0\nf -1 -1 -2\nv 1 0 0\nv 0 1 0\n", 2, "vertex -2" },
        { "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n", 4, "vertex" },
        { "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 two 3\n", 4, "not a vertex number" },
        { "v 0 0 0 \\\n\nv 1 0 0\nv 0 1 0\n\nf 1 2 \\\n4\n", 6, "vertex 4" },
        { "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//2\n", 5, "normal 2" },
        { "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/-2\n", 5, "texture coordinate -2" },
        { "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1/ 2/1/x 3/1/1\n", 5, "not a normal number" },
        { "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 9\nf 1 2 3\n", 4, "vertex 9" },
        { "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\np 1\n", 0, "no polygons" },
        { "v 0 0 0\nv 1 0 0\nv 0 1 0\n", 0, "no polygons" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct model model;
        struct problem problem = { -1, "" };
        assert_false(import_text(&model, cases[i].text, &problem));
        assert_int_equal(problem.line, cases[i].line);
        assert_non_null(strstr(problem.text, cases[i].words));
        import_free(&model);
    }
}

/* Missing files, folders, formats that nobody knows. */
static void test_unreadable(void **state)
{
    (void)state;
    char folder[CHILD_PATH];
    char path[CHILD_PATH];
    struct model model;
    struct problem problem;
    folder_make(folder);
    folder_path(path, folder, "missing.obj");
    assert_false(import_file(&model, path, &problem));
    assert_non_null(strstr(problem.text, "cannot be read: No such file"));
    import_free(&model);
    assert_false(import_file(&model, folder, &problem));
    assert_non_null(strstr(problem.text, "cannot be read: Is a directory"));
    import_free(&model);
    write_file(folder, "text.txt", "just a text\n", 12, path);
    assert_false(import_file(&model, path, &problem));
    assert_non_null(strstr(problem.text, "cannot be read as a model"));
    import_free(&model);
    folder_remove(folder);
}

/* Another format: an STL's triangles, in order. */
static void test_stl(void **state)
{
    (void)state;
    static const char text[] =
        "solid test\n"
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
        "endloop\nendfacet\n"
        "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n"
        "endloop\nendfacet\nendsolid test\n";
    struct model model;
    struct problem problem;
    assert_true(import_memory(&model, text, strlen(text), "stl", &problem));
    assert_int_equal(model.polygon_count, 2);
    assert_true(model.vertices[model.corners[0]][0] == 0);
    assert_true(model.vertices[model.corners[3]][0] == 1);
    import_free(&model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order),      cmocka_unit_test(test_hiding),
        cmocka_unit_test(test_plain),      cmocka_unit_test(test_bad),
        cmocka_unit_test(test_unreadable), cmocka_unit_test(test_stl),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
