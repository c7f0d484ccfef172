/* SPDX-License-Identifier: 0BSD */
/*
 * The obstruction tree, by sight lines. Random small scenes (crossing,
 * touching and coplanar triangles, needles) are compiled; then sight lines are
 * drawn through a point of one output face and a point of another, from eyes
 * that both faces look at, near and far. The walk from that eye must put the
 * face that the line meets first nearer. Nothing of the compiler's relation is
 * used: only split vertices, and heights above planes with a margin that
 * rounding cannot reach.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ow_blob.h"
#include "tools/owc/clean.h"
#include "tools/owc/obstruction.h"
#include "tools/owc/plane.h"
#include "tools/owc/random.h"

enum { SCENES = 1500, LINES = 300, MOST = 14 };

#define STEP 256u      /* tolerance: a lattice step */
#define EYE_MARGIN 1.5 /* lattice steps: the tolerance, and rounding */
#define MARGIN 2.5     /* lattice steps: the tolerance, and what coplanar polygons may be apart */

static struct random chance;

/* ---- scenes ---------------------------------------------------------------------------------- */

struct scene {
    struct model model;
    double vertices[3 * MOST][3];
    uint32_t corners[3 * MOST];
    struct model_polygon polygons[MOST];
    struct mesh mesh;
    struct planes planes;
    struct arrangement arrangement;
    struct pieces pieces;
    struct tree tree;
    bool two_sided;
    tree_item *faces;
    uint32_t face_count;
    uint32_t *rank; /* by face item: place in the walk from the eye, farthest first */
    uint32_t next_rank;
};

static double coordinate(uint32_t kind)
{
    double grid = random_below(&chance, kind == 0 ? 5 : 1000);
    if (kind == 2 && random_below(&chance, 3) == 0) { /* a needle's end, nearly on the grid */
        grid = random_below(&chance, 5) * 250.0;
        grid += random_below(&chance, 3) * 0.05; /* one after the other, for every compiler */
    }
    return kind == 0 ? grid * 250 : grid;
}

static void make_model(struct scene *s)
{
    uint32_t count = 3 + random_below(&chance, MOST - 2);
    uint32_t kind = random_below(&chance, 3);
    for (uint32_t i = 0; i < 3 * count; i++) {
        for (int k = 0; k < 3; k++) {
            s->vertices[i][k] = coordinate(kind);
        }
        if (i > 2 && random_below(&chance, 3) == 0) { /* touching */
            memcpy(s->vertices[i], s->vertices[random_below(&chance, i)], sizeof s->vertices[i]);
        }
        if (kind == 1 && random_below(&chance, 2) == 0) { /* coplanar */
            s->vertices[i][2] = 500;
        }
        s->corners[i] = i;
    }
    for (uint32_t i = 0; i < count; i++) {
        s->polygons[i] = (struct model_polygon){ 3 * i, 3, 0 };
    }
    s->model = (struct model){ .vertices = s->vertices,
                               .vertex_count = 3 * (size_t)count,
                               .corners = s->corners,
                               .corner_count = 3 * (size_t)count,
                               .polygons = s->polygons,
                               .polygon_count = count };
}

static void add_face(struct scene *s, tree_item item)
{
    if (item != OW_ITEM_NONE && tree_item_tag(item) != OW_ITEM_NODE) {
        s->faces[s->face_count++] = item;
    }
}

static void list_faces(struct scene *s)
{
    s->faces = calloc(s->tree.item_count + 2 * (size_t)s->tree.node_count + 1, sizeof *s->faces);
    s->rank = calloc((size_t)s->pieces.count << OW_ITEM_TAG_BITS, sizeof *s->rank);
    assert_non_null(s->faces);
    assert_non_null(s->rank);
    for (uint32_t i = 0; i < s->tree.node_count; i++) {
        const struct tree_node *node = &s->tree.nodes[i];
        for (uint32_t k = 0; k < node->count; k++) {
            add_face(s, s->tree.items[node->first + k]);
        }
        add_face(s, node->front);
        add_face(s, node->back);
    }
    add_face(s, s->tree.root);
}

/* False: nothing is left of it on the lattice. */
static bool make_scene(struct scene *s, uint32_t tolerance_q8)
{
    struct problem problem;
    memset(s, 0, sizeof *s);
    make_model(s);
    if (!clean_model(&s->mesh, &s->model, false, &problem)) {
        mesh_discard(&s->mesh);
        return false;
    }
    s->two_sided = random_below(&chance, 2) == 0;
    plane_group(&s->planes, &s->mesh, &s->model, tolerance_q8);
    arrangement_begin(&s->arrangement, &s->mesh, &s->planes);
    pieces_begin(&s->pieces, &s->mesh, &s->arrangement);
    struct obstruction_options options = { .seed = 1,
                                           .tolerance_q8 = tolerance_q8,
                                           .two_sided = s->two_sided };
    assert_true(obstruction_build(&s->tree, &s->planes, &s->mesh, &s->arrangement, &s->pieces,
                                  &options, NULL));
    list_faces(s);
    return true;
}

static void free_scene(struct scene *s)
{
    free(s->faces);
    free(s->rank);
    tree_free(&s->tree);
    pieces_free(&s->pieces);
    arrangement_free(&s->arrangement);
    planes_free(&s->planes);
    mesh_discard(&s->mesh);
}

/* ---- the walk -------------------------------------------------------------------------------- */

static double height(const struct plane *plane, const double at[3])
{
    double length = sqrt(plane->normal[0] * plane->normal[0] + plane->normal[1] * plane->normal[1] +
                         plane->normal[2] * plane->normal[2]);
    return (plane->normal[0] * at[0] + plane->normal[1] * at[1] + plane->normal[2] * at[2] +
            plane->offset) /
           length;
}

static void walk(struct scene *s, tree_item item, const double eye[3])
{
    if (item == OW_ITEM_NONE) {
        return;
    }
    if (tree_item_tag(item) != OW_ITEM_NODE) {
        s->rank[item] = ++s->next_rank;
        return;
    }
    const struct tree_node node = s->tree.nodes[tree_item_value(item)];
    bool front = node.plane != MESH_NONE && height(&s->planes.all[node.plane], eye) > 0;
    if (node.plane != MESH_NONE) {
        walk(s, front ? node.back : node.front, eye);
    }
    for (uint32_t i = 0; i < node.count; i++) {
        walk(s, s->tree.items[node.first + i], eye);
    }
    if (node.plane != MESH_NONE) {
        walk(s, front ? node.front : node.back, eye);
    }
}

/* ---- sight lines ----------------------------------------------------------------------------- */

static double share(void)
{
    return (random_below(&chance, 1u << 20) + 0.5) / (1u << 20);
}

/* Any point of a face, often near its edges. */
static void any_point(const struct scene *s, tree_item face, double at[3])
{
    const struct piece *piece = &s->pieces.all[tree_item_value(face)];
    double sum = 0;
    memset(at, 0, 3 * sizeof *at);
    for (uint32_t i = 0; i < piece->count; i++) {
        double weight = pow(share(), 4);
        const double *corner = s->arrangement.at[s->pieces.vertices[piece->first + i]];
        for (int k = 0; k < 3; k++) {
            at[k] += weight * corner[k];
        }
        sum += weight;
    }
    for (int k = 0; k < 3; k++) {
        at[k] /= sum;
    }
}

/* The height of a point above a face, positive where the face looks to. */
static double above(const struct scene *s, tree_item face, const double at[3])
{
    const struct piece *piece = &s->pieces.all[tree_item_value(face)];
    bool against =
        s->mesh.polygons[piece->polygon].reversed != (tree_item_tag(face) == OW_ITEM_REVERSE);
    double value = height(&s->planes.all[piece->record], at);
    return against ? -value : value;
}

/* True if the line tells something: then the nearer face must have the greater rank. */
static bool try_line(struct scene *s, tree_item far, tree_item near)
{
    double p[3];
    double q[3];
    double eye[3];
    any_point(s, far, p);
    any_point(s, near, q);
    double beyond = pow(10, 4 * share() - 3);
    for (int k = 0; k < 3; k++) {
        eye[k] = q[k] + beyond * (q[k] - p[k]);
    }
    if (above(s, far, q) < MARGIN || above(s, near, p) > -MARGIN || above(s, far, eye) <= 0 ||
        above(s, near, eye) <= 0) {
        return false;
    }
    for (uint32_t i = 0; i < s->planes.count; i++) {
        if (fabs(height(&s->planes.all[i], eye)) < EYE_MARGIN) {
            return false; /* so near to a plane the tolerance, not the tree, decides */
        }
    }
    s->next_rank = 0;
    walk(s, s->tree.root, eye);
    if (s->rank[near] <= s->rank[far]) {
        print_message("eye %.9g %.9g %.9g: face %u (polygon %u) hides face %u (polygon %u)\n",
                      eye[0], eye[1], eye[2], near, s->pieces.all[near >> 2].polygon, far,
                      s->pieces.all[far >> 2].polygon);
    }
    assert_true(s->rank[near] > s->rank[far]);
    return true;
}

static void try_scenes(uint32_t tolerance_q8, uint32_t seed)
{
    uint32_t told = 0;
    uint32_t made = 0;
    for (uint32_t i = 0; i < SCENES; i++) {
        struct scene s;
        chance = (struct random){ (uint64_t)seed << 32 | i };
        if (!make_scene(&s, tolerance_q8)) {
            continue;
        }
        made++;
        for (int k = 0; k < LINES && s.face_count > 1; k++) {
            uint32_t far = random_below(&chance, s.face_count);
            uint32_t near = random_below(&chance, s.face_count);
            told += try_line(&s, s.faces[far], s.faces[near]);
        }
        free_scene(&s);
    }
    assert_true(made > SCENES / 2);
    assert_true(told > SCENES * 10);
    print_message("%u scenes, %u sight lines\n", made, told);
}

static void nearer_faces_come_later(void **state)
{
    (void)state;
    try_scenes(STEP, 1);
}

static void nearer_faces_come_later_without_tolerance(void **state)
{
    (void)state;
    try_scenes(0, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nearer_faces_come_later),
        cmocka_unit_test(nearer_faces_come_later_without_tolerance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
