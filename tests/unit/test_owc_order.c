/* SPDX-License-Identifier: 0BSD */
/*
 * What a compiled tree is for: along any ray the first face that the walk
 * meets, nearest first, is the nearest one, but for what lies within the
 * tolerance of each other. Rays that pass within two steps of an edge are left out.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ow_view.h"
#include "ow_walk.h"
#include "tests/unit/owc_models.h"
#include "tools/common/xalloc.h"
#include "tools/owc/import.h"
#include "tools/owc/random.h"

enum { VIEWS = 40, RAYS = 60 };

/* Lattice steps that two faces may be apart and still come in either order. */
#define BOUND 4.0
#define EDGE_MARGIN 2.0

/* A face in walk order: an outline as doubles, its unit normal, the way it is seen. */
struct solid {
    uint32_t count;
    double (*at)[3];
    double normal[3];
    double distance;
    double sign; /* -1: the reverse is seen */
};

struct ray {
    double eye[3];
    double direction[3];
};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double random_share(struct random *random)
{
    return (double)(random_next(random) >> 11) * 0x1p-53;
}

static void read_solid(const struct ow_tree *tree, const struct ow_face *face, struct solid *solid)
{
    struct models_record record;
    models_read_record(tree, face->at, &record);
    solid->count = record.count;
    solid->at = xalloc(record.count, sizeof *solid->at);
    memset(solid->normal, 0, sizeof solid->normal);
    for (uint32_t i = 0; i < record.count; i++) {
        int32_t v[3];
        models_read_vertex(tree, record.corners[i], v);
        for (int k = 0; k < 3; k++) {
            solid->at[i][k] = v[k];
        }
    }
    for (uint32_t i = 1; i + 1 < record.count; i++) {
        const double *o = solid->at[0];
        for (int k = 0; k < 3; k++) {
            int a = (k + 1) % 3;
            int b = (k + 2) % 3;
            solid->normal[k] += (solid->at[i][a] - o[a]) * (solid->at[i + 1][b] - o[b]) -
                                (solid->at[i][b] - o[b]) * (solid->at[i + 1][a] - o[a]);
        }
    }
    double length = sqrt(dot(solid->normal, solid->normal));
    for (int k = 0; k < 3; k++) {
        solid->normal[k] /= length > 0 ? length : 1;
    }
    solid->distance = dot(solid->normal, solid->at[0]);
    solid->sign = face->reverse ? -1 : 1;
}

/* Distance of p from the segment a b. */
static double from_edge(const double p[3], const double a[3], const double b[3])
{
    double ab[3];
    double ap[3];
    for (int k = 0; k < 3; k++) {
        ab[k] = b[k] - a[k];
        ap[k] = p[k] - a[k];
    }
    double t = fmax(0, fmin(1, dot(ab, ap) / dot(ab, ab)));
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        sum += (ap[k] - t * ab[k]) * (ap[k] - t * ab[k]);
    }
    return sqrt(sum);
}

/* Does the ray pass through the face, seen from its front and well inside? */
static bool hits(const struct solid *solid, const struct ray *ray, double hit[3])
{
    double slope = dot(solid->normal, ray->direction) * solid->sign;
    double height = (dot(solid->normal, ray->eye) - solid->distance) * solid->sign;
    if (slope >= 0 || height <= 0) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        hit[k] = ray->eye[k] + ray->direction[k] * (height / -slope);
    }
    int axis = 0;
    for (int k = 1; k < 3; k++) {
        axis = fabs(solid->normal[k]) > fabs(solid->normal[axis]) ? k : axis;
    }
    int u = (axis + 1) % 3;
    int v = (axis + 2) % 3;
    int winding = 0;
    for (uint32_t i = 0; i < solid->count; i++) {
        const double *a = solid->at[i];
        const double *b = solid->at[(i + 1) % solid->count];
        if (from_edge(hit, a, b) < EDGE_MARGIN) {
            return false;
        }
        if ((a[v] <= hit[v]) != (b[v] <= hit[v])) {
            double at = a[u] + (hit[v] - a[v]) / (b[v] - a[v]) * (b[u] - a[u]);
            winding += at > hit[u] ? (b[v] > a[v] ? 1 : -1) : 0;
        }
    }
    return winding * (solid->normal[axis] > 0 ? 1 : -1) > 0;
}

/* The first hit in walk order and the nearest hit are the same, or as good as that. */
static bool ray_is_right(const struct solid *solids, size_t count, const struct ray *ray,
                         uint32_t *hits_met)
{
    const struct solid *first = NULL;
    const struct solid *nearest = NULL;
    double first_hit[3] = { 0, 0, 0 };
    double nearest_hit[3] = { 0, 0, 0 };
    double least = INFINITY;
    for (size_t i = 0; i < count; i++) {
        double hit[3];
        double square = 0;
        if (!hits(&solids[i], ray, hit)) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            square += (hit[k] - ray->eye[k]) * (hit[k] - ray->eye[k]);
        }
        if (first == NULL) {
            first = &solids[i];
            memcpy(first_hit, hit, sizeof hit);
        }
        if (square < least) {
            least = square;
            nearest = &solids[i];
            memcpy(nearest_hit, hit, sizeof hit);
        }
        ++*hits_met;
    }
    return nearest == first || fabs(dot(nearest->normal, first_hit) - nearest->distance) < BOUND ||
           fabs(dot(first->normal, nearest_hit) - first->distance) < BOUND;
}

static struct ow_camera random_camera(struct random *random)
{
    struct ow_camera camera = {
        .projection = OW_PERSPECTIVE, .fov = 0x20000000, .width_pixels = 64, .height_pixels = 64
    };
    double reach = random_below(random, 2) ? 32767 : 90000; /* inside, or around */
    for (int k = 0; k < 3; k++) {
        camera.eye[k] = (ow_q8)((2 * random_share(random) - 1) * reach * 256);
        camera.at[k] = (ow_q8)((2 * random_share(random) - 1) * 10000 * 256);
    }
    camera.up[1] = 256;
    camera.up[0] = 3;
    return camera;
}

/* All faces that the walk of a view meets, nearest first. */
static size_t walk_solids(const struct ow_tree *tree, const struct ow_view *view,
                          struct solid *solids)
{
    struct ow_walk walk;
    struct ow_face face;
    struct ow_walk_run *stack = xalloc(ow_walk_stack_bytes(tree), 1);
    size_t count = 0;
    assert_int_equal(ow_walk_begin(&walk, tree, view, OW_NEAREST_FIRST, OW_CULL_AUTO, stack),
                     OW_OK);
    while (ow_walk_next(&walk, &face)) {
        read_solid(tree, &face, &solids[count++]);
    }
    free(stack);
    return count;
}

static uint32_t wrong_rays(const struct ow_tree *tree, struct random *random, uint32_t *hits_met)
{
    struct solid *solids = xalloc(tree->face_count, sizeof *solids);
    uint32_t wrong = 0;
    for (int i = 0; i < VIEWS; i++) {
        struct ow_camera camera = random_camera(random);
        struct ow_view view;
        struct ray ray;
        assert_int_equal(ow_view_make(&view, &camera), OW_OK);
        size_t count = walk_solids(tree, &view, solids);
        for (int r = 0; r < RAYS; r++) {
            for (int k = 0; k < 3; k++) {
                double target = (2 * random_share(random) - 1) * 32767;
                ray.eye[k] = camera.eye[k] / 256.0;
                ray.direction[k] = target - ray.eye[k];
            }
            wrong += !ray_is_right(solids, count, &ray, hits_met);
        }
        for (size_t k = 0; k < count; k++) {
            free(solids[k].at);
        }
    }
    free(solids);
    return wrong;
}

static void assert_right(const struct model *model)
{
    struct random random = { 11 };
    for (int select = BSP_FIRST; select <= BSP_EXHAUSTIVE; select++) {
        for (int way = 0; way < 4; way++) {
            struct compile_options options = models_options();
            struct compile_stats stats;
            struct blob blob;
            struct ow_tree tree;
            uint32_t hits_met = 0;
            options.select = (enum bsp_select)select;
            options.sides = way % 2 ? SIDES_TWO : SIDES_AUTO;
            options.tolerance_q8 = way < 2 ? 0 : 256;
            models_compile(&blob, &stats, model, &options);
            assert_int_equal(ow_tree_open(&tree, blob.bytes, blob.size), OW_OK);
            assert_int_equal(wrong_rays(&tree, &random, &hits_met), 0);
            assert_true(hits_met > 500);
            blob_free(&blob);
        }
    }
}

static void test_boxes(void **state)
{
    (void)state;
    struct model model = { 0 };
    for (int i = 0; i < 4; i++) {
        models_box(&model, (double[]){ 2, 1, 1.5 }, 2,
                   &(struct models_pose){ 0.7 * i, 0.4 * i, { 0.5 * i, 0.2, 0.3 * i } });
    }
    assert_right(&model);
    import_free(&model);
}

static void test_triangles(void **state)
{
    (void)state;
    struct model model = { 0 };
    struct random random = { 12 };
    for (int i = 0; i < 60; i++) {
        uint32_t v[3];
        double middle[3];
        for (int k = 0; k < 3; k++) {
            middle[k] = random_share(&random);
        }
        for (int c = 0; c < 3; c++) {
            v[c] =
                models_vertex(&model, middle[0] + random_share(&random),
                              middle[1] + random_share(&random), middle[2] + random_share(&random));
        }
        models_polygon(&model, v, 3);
    }
    assert_right(&model);
    import_free(&model);
}

/* Concave walls that cut each other: stars on the axes' planes. */
static void test_stars(void **state)
{
    (void)state;
    struct model model = { 0 };
    for (int axis = 0; axis < 3; axis++) {
        uint32_t v[24];
        for (int i = 0; i < 24; i++) {
            double angle = 6.283185307179586 * i / 24 + axis;
            double at[3];
            at[axis] = 0.13 * axis;
            at[(axis + 1) % 3] = (i % 2 ? 1 : 0.4) * cos(angle);
            at[(axis + 2) % 3] = (i % 2 ? 1 : 0.4) * sin(angle);
            v[i] = models_vertex(&model, at[0], at[1], at[2]);
        }
        models_polygon(&model, v, 24);
    }
    models_box(&model, (double[]){ 1, 1, 1 }, 2, &(struct models_pose){ 0.5, 0.6, { 0, 0, 0 } });
    assert_right(&model);
    import_free(&model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_boxes),
        cmocka_unit_test(test_triangles),
        cmocka_unit_test(test_stars),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
