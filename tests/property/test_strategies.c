/* SPDX-License-Identifier: 0BSD */
/*
 * The papers' strategies on random small scenes: triangles that cross, touch,
 * lie in one plane, are needles. From random eyes, whatever hides a part of a face
 * must come after it, farthest first; nothing may be met twice or be lost. Faces are
 * those of the compiled tree, rounded to the lattice: what hides by less than a
 * few steps is left out. SCENES=N in the environment: more scenes, or less.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ow_view.h"
#include "ow_walk.h"
#include "tests/unit/owc_models.h"
#include "tools/common/xalloc.h"
#include "tools/owc/import.h"
#include "tools/owc/random.h"

enum { SCENES = 5000, EYES = 4, MOST_TRIANGLES = 14, MOST_FACES = 4096, MOST_CORNERS = 64 };

/* Lattice steps: split corners are rounded, and one step of tolerance counts as nothing. */
#define MARGIN 4.0

static struct random source;

static double random_in(double low, double high)
{
    return low + (high - low) * (double)(random_next(&source) >> 11) * 0x1p-53;
}

/* ---- scenes ---- */

static uint32_t random_vertex(struct model *model, const double middle[3], double size)
{
    return models_vertex(model, middle[0] + random_in(-size, size),
                         middle[1] + random_in(-size, size), middle[2] + random_in(-size, size));
}

/* Kinds of triangles: anywhere, on a common plane, at an edge of the one before, a needle. */
static void add_triangle(struct model *model, uint32_t number)
{
    double middle[3];
    uint32_t v[3];
    for (int k = 0; k < 3; k++) {
        middle[k] = random_in(-1, 1);
    }
    double size = random_below(&source, 3) == 0 ? 1.5 : 0.6;
    for (int i = 0; i < 3; i++) {
        v[i] = random_vertex(model, middle, size);
    }
    switch (random_below(&source, 6)) {
    case 0:
        for (int i = 0; i < 3; i++) {
            model->vertices[v[i]][2] = 0.25;
        }
        break;
    case 1:
        if (number > 0) {
            v[0] = model->corners[3 * (number - 1)];
            v[1] = model->corners[3 * (number - 1) + 1];
        }
        break;
    case 2:
        for (int k = 0; k < 3; k++) {
            model->vertices[v[2]][k] = 0.5 * (model->vertices[v[0]][k] + model->vertices[v[1]][k]) +
                                       random_in(-0.01, 0.01);
        }
        break;
    default:
        break;
    }
    models_polygon(model, v, 3);
}

static void make_scene(struct model *model)
{
    uint32_t count = 3 + random_below(&source, MOST_TRIANGLES - 2);
    *model = (struct model){ 0 };
    for (uint32_t i = 0; i < count; i++) {
        add_triangle(model, i);
    }
}

/* ---- faces ---- */

struct face {
    uint32_t at; /* its record */
    bool reverse;
    uint32_t count;
    double corners[MOST_CORNERS][3];
    double normal[3]; /* the source triangle's plane on the lattice, towards the eye */
    double offset;
};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        int y = (k + 1) % 3;
        int z = (k + 2) % 3;
        out[k] = a[y] * b[z] - a[z] * b[y];
    }
}

/* The plane of a source triangle on the lattice, unit normal; false: it has no area. */
static bool source_plane(const struct model *model, const struct lattice *lattice, uint32_t number,
                         double normal[3], double *offset)
{
    double at[3][3];
    double u[3];
    double v[3];
    for (int i = 0; i < 3; i++) {
        int16_t snapped[3];
        lattice_snap(lattice, model->vertices[model->corners[3 * number + (uint32_t)i]], snapped);
        for (int k = 0; k < 3; k++) {
            at[i][k] = snapped[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        u[k] = at[1][k] - at[0][k];
        v[k] = at[2][k] - at[0][k];
    }
    cross(u, v, normal);
    double length = sqrt(dot(normal, normal));
    for (int k = 0; k < 3 && length > 0; k++) {
        normal[k] /= length;
    }
    *offset = -dot(normal, at[0]);
    return length > 0;
}

static void read_face(const struct ow_tree *tree, const struct ow_face *met,
                      const struct model *model, const struct lattice *lattice, const double eye[3],
                      struct face *face)
{
    struct models_record record;
    models_read_record(tree, met->at, &record);
    assert_true(record.count <= MOST_CORNERS);
    face->at = met->at;
    face->reverse = met->reverse;
    face->count = record.count;
    for (uint32_t i = 0; i < record.count; i++) {
        int32_t v[3];
        models_read_vertex(tree, record.corners[i], v);
        for (int k = 0; k < 3; k++) {
            face->corners[i][k] = v[k];
        }
    }
    bool whole = source_plane(model, lattice, record.source - 1, face->normal, &face->offset);
    double height = dot(face->normal, eye) + face->offset;
    double sign = height > 0 ? 1 : -1;
    if (!whole || fabs(height) < MARGIN || (sign < 0) != met->reverse) {
        face->count = 0; /* edge-on, or seen from the other side: it is not painted */
    }
    for (int k = 0; k < 3; k++) {
        face->normal[k] *= sign;
    }
    face->offset *= sign;
}

/* Cuts a convex outline by n.x + d > margin; returns the corners left. */
static uint32_t cut(double outline[MOST_CORNERS + 8][3], uint32_t count, const double n[3],
                    double d, double margin)
{
    double out[MOST_CORNERS + 8][3];
    uint32_t left = 0;
    for (uint32_t i = 0; i < count; i++) {
        const double *a = outline[i];
        const double *b = outline[(i + 1) % count];
        double va = dot(n, a) + d - margin;
        double vb = dot(n, b) + d - margin;
        if (va > 0 && left < MOST_CORNERS + 8) {
            memcpy(out[left++], a, sizeof out[0]);
        }
        if ((va > 0) != (vb > 0) && left < MOST_CORNERS + 8) {
            for (int k = 0; k < 3; k++) {
                out[left][k] = a[k] + (b[k] - a[k]) * va / (va - vb);
            }
            left++;
        }
    }
    memcpy(outline, out, left * sizeof out[0]);
    return left;
}

/* Does a hide a part of b? b is cut by the planes through the eye and a's edges, and by a's own. */
static bool hides(const struct face *a, const struct face *b, const double eye[3])
{
    double outline[MOST_CORNERS + 8][3];
    double n[3];
    uint32_t count = b->count;
    memcpy(outline, b->corners, count * sizeof outline[0]);
    for (int k = 0; k < 3; k++) {
        n[k] = -a->normal[k];
    }
    count = cut(outline, count, n, -a->offset, MARGIN);
    for (uint32_t i = 0; i < a->count && count > 2; i++) {
        const double *p = a->corners[i];
        const double *q = a->corners[(i + 1) % a->count];
        double u[3];
        double v[3];
        for (int k = 0; k < 3; k++) {
            u[k] = p[k] - eye[k];
            v[k] = q[k] - p[k];
        }
        cross(u, v, n);
        double size = sqrt(dot(n, n));
        if (!(size > 0)) {
            return false;
        }
        double towards = a->reverse ? 1 : -1; /* counter-clockwise, seen from the front */
        for (int k = 0; k < 3; k++) {
            n[k] *= towards / size;
        }
        count = cut(outline, count, n, -dot(n, eye), MARGIN);
    }
    return count > 2;
}

/* ---- walks ---- */

static bool random_view(struct ow_view *view, double eye[3])
{
    struct ow_camera camera = { .up = { 3, 250, 7 },
                                .projection = OW_PERSPECTIVE,
                                .fov = 1u << 29,
                                .near = 256,
                                .width_pixels = 64,
                                .height_pixels = 48 };
    double reach = random_below(&source, 2) ? 32767 : 150000;
    for (int k = 0; k < 3; k++) {
        camera.eye[k] = (ow_q8)(random_in(-reach, reach) * 256);
        camera.at[k] = (ow_q8)(random_in(-9000, 9000) * 256);
        eye[k] = camera.eye[k] / 256.0;
    }
    return ow_view_make(view, &camera) == OW_OK;
}

static uint64_t check_view(const struct ow_tree *tree, const struct model *model,
                           const struct lattice *lattice, struct face *faces)
{
    struct ow_view view;
    struct ow_walk walk;
    struct ow_face met;
    double eye[3];
    uint32_t count = 0;
    uint64_t pairs = 0;
    if (!random_view(&view, eye)) {
        return 0;
    }
    struct ow_walk_run *stack = xalloc(ow_walk_stack_bytes(tree), 1);
    assert_int_equal(ow_walk_begin(&walk, tree, &view, OW_FARTHEST_FIRST, OW_CULL_AUTO, stack),
                     OW_OK);
    while (ow_walk_next(&walk, &met)) {
        assert_true(count < MOST_FACES);
        read_face(tree, &met, model, lattice, eye, &faces[count]);
        count += faces[count].count > 0;
    }
    assert_int_equal(walk.faces_met, tree->face_count);
    free(stack);
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t k = i + 1; k < count; k++) {
            assert_false(faces[i].at == faces[k].at && faces[i].reverse == faces[k].reverse);
            assert_false(hides(&faces[i], &faces[k], eye));
            pairs += hides(&faces[k], &faces[i], eye);
        }
    }
    return pairs;
}

/* The area of all records, so that nothing is lost. */
static double area_of(const struct ow_tree *tree)
{
    double area = 0;
    uint32_t at = tree->polygons_at;
    for (uint32_t i = 0; i < tree->polygon_count; i++) {
        struct models_record record;
        double sum[3] = { 0, 0, 0 };
        at = models_read_record(tree, at, &record);
        for (uint32_t c = 1; c + 1 < record.count; c++) {
            int32_t p[3][3];
            double u[3];
            double v[3];
            double n[3];
            models_read_vertex(tree, record.corners[0], p[0]);
            models_read_vertex(tree, record.corners[c], p[1]);
            models_read_vertex(tree, record.corners[c + 1], p[2]);
            for (int k = 0; k < 3; k++) {
                u[k] = p[1][k] - p[0][k];
                v[k] = p[2][k] - p[0][k];
            }
            cross(u, v, n);
            for (int k = 0; k < 3; k++) {
                sum[k] += n[k];
            }
        }
        area += sqrt(dot(sum, sum)) / 2;
    }
    return area;
}

/* ---- the strategies ---- */

static const char planes_text[] = "0,0,1,0.1\n1,1,0,0.05 # slanting\n0,1,0,-9\n";

/* Number of the strategy: method, and what goes with it. */
enum { STRATEGIES = 8 };

static struct compile_options strategy(uint32_t number, const struct user_planes *planes)
{
    static const enum method methods[STRATEGIES] = {
        METHOD_ONLINE,         METHOD_FEUDAL_STATIC, METHOD_FEUDAL_STATIC, METHOD_FEUDAL_DYNAMIC,
        METHOD_FEUDAL_DYNAMIC, METHOD_BSP,           METHOD_BSP,           METHOD_BSP,
    };
    struct compile_options options = models_options();
    options.method = methods[number];
    options.sides = number == 2 || number == 3 || number == 5 ? SIDES_TWO : SIDES_ONE;
    options.select = number == 5 ? BSP_CONFLICT : BSP_KEDEM;
    options.conflict_weight = 1;
    options.dividing = number == 6 ? planes : NULL;
    options.dividing_axis = number == 7;
    options.tolerance_q8 = 256;
    return options;
}

static void hidden_before_hiding(void **state)
{
    (void)state;
    struct user_planes planes;
    struct problem problem;
    struct face *faces = xalloc(MOST_FACES, sizeof *faces);
    uint64_t pairs[STRATEGIES] = { 0 };
    uint64_t splits[STRATEGIES] = { 0 };
    const char *wanted = getenv("SCENES");
    uint32_t scenes = wanted != NULL ? (uint32_t)strtoul(wanted, NULL, 10) : SCENES;
    assert_true(user_planes_read(&planes, planes_text, &problem));
    for (uint32_t seed = 1; seed <= scenes; seed++) {
        struct model model;
        struct lattice lattice;
        double area = 0;
        source.state = seed;
        make_scene(&model);
        assert_true(lattice_of_model(&lattice, &model));
        for (uint32_t number = 0; number < STRATEGIES; number++) {
            struct compile_options options = strategy(number, &planes);
            struct compile_stats stats;
            struct blob blob;
            struct ow_tree tree;
            options.seed = seed;
            models_compile(&blob, &stats, &model, &options);
            assert_int_equal(ow_tree_open(&tree, blob.bytes, blob.size), OW_OK);
            for (int i = 0; i < EYES; i++) {
                pairs[number] += check_view(&tree, &model, &lattice, faces);
            }
            splits[number] += stats.splits;
            area = number == 0 ? area_of(&tree) : area;
            /* Rounding moves edges, as long as the cube at most, by half a step. */
            double rounding = 32767.0 * tree.polygon_count;
            if (fabs(area_of(&tree) - area) > 1e-3 * area + rounding) {
                print_error("seed %u, strategy %u: area %g, expected %g\n", seed, number,
                            area_of(&tree), area);
                fail();
            }
            blob_free(&blob);
        }
        import_free(&model);
    }
    for (uint32_t i = 0; i < STRATEGIES; i++) {
        print_message("strategy %u: %llu hidden pairs, %llu splits\n", i,
                      (unsigned long long)pairs[i], (unsigned long long)splits[i]);
        assert_true(pairs[i] > 4ull * scenes);
        assert_true(splits[i] > 2ull * scenes);
    }
    user_planes_free(&planes);
    free(faces);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hidden_before_hiding),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
