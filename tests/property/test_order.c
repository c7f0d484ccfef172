/* SPDX-License-Identifier: 0BSD */
/*
 * All strategies on random small scenes: crossing, touching and coplanar
 * polygons, concave ones and needles. Every pair of faces is judged for all
 * viewpoints at once by exact arithmetic (order_check.h), with exact corners
 * and as rounded; and of each polygon neither side is lost or met twice.
 *
 * In the environment: SCENES=N, so many scenes; FIRST=N, the first one's
 * number; WAY=N, only this way, of all scenes. A failure prints the scene.
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
#include "tests/property/order_check.h"
#include "tests/property/small_scene.h"
#include "tools/common/xalloc.h"
#include "tools/owc/clean.h"
#include "tools/owc/obstruction.h"
#include "tools/owc/plane.h"
#include "tools/owc/strategy.h"

enum { SCENES = 10000, STEP = 256, WIDE = 33 * 256 /* 0.0005 of the longest side */ };

/* ---- strategies ---- */

struct way {
    const char *name;
    enum method method;
    enum bsp_select select;
    uint32_t tolerance_q8; /* as --tolerance */
    unsigned what;
    uint32_t every; /* so many scenes, beginning with this one */
    uint32_t from;
};

/* What goes with a way. */
enum {
    EXACTLY = 1, /* no tolerance at all on scenes whose planes are exact */
    TWO_SIDED = 2,
    ALONE = 4, /* obstruction, not the smallest of several trees */
    PLANES_GIVEN = 8,
    PLANES_FOUND = 16
};

/* Obstruction tries many planes: its ways take turns. */
static const struct way ways[] = {
    { "bsp first", METHOD_BSP, BSP_FIRST, STEP, EXACTLY, 1, 0 },
    { "bsp random", METHOD_BSP, BSP_RANDOM, STEP, TWO_SIDED, 1, 0 },
    { "bsp kedem", METHOD_BSP, BSP_KEDEM, STEP, EXACTLY | TWO_SIDED, 1, 0 },
    { "bsp exhaustive", METHOD_BSP, BSP_EXHAUSTIVE, STEP, EXACTLY, 1, 0 },
    { "bsp conflict", METHOD_BSP, BSP_CONFLICT, STEP, EXACTLY, 1, 0 },
    { "planes given", METHOD_BSP, BSP_KEDEM, STEP, EXACTLY | PLANES_GIVEN, 1, 0 },
    { "planes found", METHOD_BSP, BSP_KEDEM, STEP, EXACTLY | TWO_SIDED | PLANES_FOUND, 1, 0 },
    { "online", METHOD_ONLINE, BSP_FIRST, STEP, EXACTLY, 1, 0 },
    { "feudal static", METHOD_FEUDAL_STATIC, BSP_FIRST, STEP, EXACTLY, 1, 0 },
    { "feudal static, two", METHOD_FEUDAL_STATIC, BSP_FIRST, STEP, EXACTLY | TWO_SIDED, 1, 0 },
    { "feudal dynamic", METHOD_FEUDAL_DYNAMIC, BSP_FIRST, STEP, EXACTLY, 1, 0 },
    { "feudal dynamic, two", METHOD_FEUDAL_DYNAMIC, BSP_FIRST, STEP, EXACTLY | TWO_SIDED, 1, 0 },
    { "obstruction", METHOD_OBSTRUCTION, BSP_FIRST, STEP, EXACTLY | ALONE, 5, 0 },
    { "obstruction, two", METHOD_OBSTRUCTION, BSP_FIRST, STEP, EXACTLY | ALONE | TWO_SIDED, 5, 1 },
    { "obstruction, step", METHOD_OBSTRUCTION, BSP_FIRST, STEP, ALONE, 5, 2 },
    { "obstruction, tolerance", METHOD_OBSTRUCTION, BSP_FIRST, WIDE, ALONE, 5, 3 },
    { "obstruction, tolerance, two", METHOD_OBSTRUCTION, BSP_FIRST, WIDE, ALONE | TWO_SIDED, 5, 4 },
    { "smallest", METHOD_OBSTRUCTION, BSP_FIRST, STEP, EXACTLY, 17, 0 },
};
enum { WAYS = sizeof ways / sizeof ways[0] };

/* What a strategy did in all scenes. */
struct tally {
    uint64_t trees;
    uint64_t faces;
    uint64_t pairs;
    uint64_t decisive;
    uint64_t splits;
    uint64_t strict; /* trees that were judged without any margin */
};

/* ---- one tree ---- */

struct compiled {
    struct mesh mesh;
    struct planes planes;
    struct arrangement arrangement;
    struct pieces pieces;
    struct tree tree;
    struct repaired repaired;
    uint32_t tolerance_q8;
    bool two_sided;
};

static void build(struct compiled *c, const struct way *way, uint64_t seed)
{
    static double given[2][4] = { { 0.3, 0, 1, -90 }, { 1, 1, 0, 50 } };
    bool two_sided = (way->what & TWO_SIDED) != 0;
    struct user_planes user = { given, 2, 2 };
    struct strategy strategy = { .method = way->method,
                                 .select = way->select,
                                 .candidates = 5,
                                 .conflict_weight = 1,
                                 .seed = seed,
                                 .tolerance_q8 = c->tolerance_q8,
                                 .dividing = (way->what & PLANES_GIVEN) ? &user : NULL,
                                 .dividing_axis = (way->what & PLANES_FOUND) != 0,
                                 .two_sided = two_sided };
    struct obstruction_options options = { .seed = seed,
                                           .tolerance_q8 = c->tolerance_q8,
                                           .two_sided = two_sided };
    if (way->what & ALONE) {
        assert_true(obstruction_build(&c->tree, &c->planes, &c->mesh, &c->arrangement, &c->pieces,
                                      &options, NULL));
    } else {
        strategy_build(&c->tree, &c->arrangement, &c->planes, &c->pieces, &c->mesh, &strategy,
                       NULL);
    }
}

/* False: nothing of the scene is left on the lattice. */
static bool compile(struct compiled *c, const struct small_scene *scene, const struct way *way,
                    uint64_t seed)
{
    struct problem problem;
    memset(c, 0, sizeof *c);
    if (!clean_model_on(&c->mesh, &scene->model, &scene->lattice, false, &problem)) {
        return false;
    }
    c->two_sided = (way->what & TWO_SIDED) != 0;
    c->tolerance_q8 = scene->exact && (way->what & EXACTLY) ? 0 : way->tolerance_q8;
    plane_group(&c->planes, &c->mesh, &scene->model,
                c->tolerance_q8 > STEP ? STEP : c->tolerance_q8);
    arrangement_begin(&c->arrangement, &c->mesh, &c->planes);
    pieces_begin(&c->pieces, &c->mesh, &c->arrangement);
    build(c, way, seed);
    return true;
}

static void free_compiled(struct compiled *c)
{
    repaired_free(&c->repaired);
    tree_free(&c->tree);
    pieces_free(&c->pieces);
    arrangement_free(&c->arrangement);
    planes_free(&c->planes);
    mesh_discard(&c->mesh);
}

/* ---- nothing is lost ---- */

static double area_of(const struct compiled *c, const struct piece *piece)
{
    const uint32_t *vertices = c->pieces.vertices + piece->first;
    const struct plane *plane = &c->planes.all[piece->record];
    const double *o = c->arrangement.at[vertices[0]];
    double length = 0;
    double sum = 0;
    for (uint32_t i = 1; i + 1 < piece->count; i++) {
        const double *p = c->arrangement.at[vertices[i]];
        const double *q = c->arrangement.at[vertices[i + 1]];
        for (int k = 0; k < 3; k++) {
            int y = (k + 1) % 3;
            int z = (k + 2) % 3;
            sum +=
                plane->normal[k] * ((p[y] - o[y]) * (q[z] - o[z]) - (p[z] - o[z]) * (q[y] - o[y]));
        }
    }
    for (int k = 0; k < 3; k++) {
        length += plane->normal[k] * plane->normal[k];
    }
    return sum / (2 * sqrt(length));
}

static double length_of(const struct compiled *c, const struct piece *piece)
{
    double length = 0;
    for (uint32_t i = 0; i < piece->count; i++) {
        uint32_t next = i + 1 < piece->count ? i + 1 : 0;
        const double *p = c->arrangement.at[c->pieces.vertices[piece->first + i]];
        const double *q = c->arrangement.at[c->pieces.vertices[piece->first + next]];
        length += fabs(p[0] - q[0]) + fabs(p[1] - q[1]) + fabs(p[2] - q[2]);
    }
    return length;
}

static void add_area(const struct compiled *c, tree_item item, double (*areas)[2], bool *drawn)
{
    if (item != OW_ITEM_NONE && tree_item_tag(item) != OW_ITEM_NODE) {
        const struct piece *piece = &c->pieces.all[tree_item_value(item)];
        areas[piece->polygon][tree_item_tag(item) == OW_ITEM_REVERSE] += area_of(c, piece);
        drawn[tree_item_value(item)] = true;
    }
}

static bool bent(const struct compiled *c)
{
    bool any = false;
    for (uint32_t i = 0; i < c->planes.count; i++) {
        any |= c->planes.all[i].reach > 0;
    }
    return any;
}

/* Each polygon's faces have its area, on each side that is placed. */
static bool areas_are_right(const struct compiled *c, bool *drawn)
{
    double(*areas)[2] = xalloc_zero(c->mesh.polygon_count, sizeof *areas);
    bool right = true;
    /* Tolerance, or corners beside their own plane: a cut may run beside its exact line. */
    double bend = c->tolerance_q8 > 0 ? 2 : c->arrangement.rounded > 0 || bent(c) ? 1 : 0;
    add_area(c, c->tree.root, areas, drawn);
    for (uint32_t i = 0; i < c->tree.node_count; i++) {
        const struct tree_node *node = &c->tree.nodes[i];
        add_area(c, node->front, areas, drawn);
        add_area(c, node->back, areas, drawn);
        for (uint32_t k = 0; k < node->count; k++) {
            add_area(c, c->tree.items[node->first + k], areas, drawn);
        }
    }
    for (uint32_t i = 0; i < c->mesh.polygon_count; i++) {
        double own = area_of(c, &c->pieces.all[i]); /* the first pieces are the polygons */
        double slack = 1e-6 * fabs(own) + 1e-2 + bend * length_of(c, &c->pieces.all[i]);
        right &= fabs(areas[i][0] - own) <= slack;
        right &= fabs(areas[i][1] - (c->two_sided ? own : 0)) <= slack;
    }
    free(areas);
    return right;
}

/* ---- judging ---- */

static void tell(const struct small_scene *scene, uint64_t number, const struct way *way,
                 const struct compiled *c, const struct order_check *check, const char *what)
{
    print_error("scene %llu, %s, tolerance %u/256, %u cuts rounded: %s\n",
                (unsigned long long)number, way->name, c->tolerance_q8, c->arrangement.rounded,
                what);
    if (check != NULL) {
        const struct piece *all = c->pieces.all;
        uint32_t p = all[tree_item_value(check->wrong[0])].polygon;
        uint32_t q = all[tree_item_value(check->wrong[1])].polygon;
        print_error("%s %u of polygon %u hides %s %u of polygon %u, but comes before it",
                    check->wrong[0] & 1 ? "reverse" : "face", tree_item_value(check->wrong[0]),
                    c->mesh.polygons[p].source, check->wrong[1] & 1 ? "reverse" : "face",
                    tree_item_value(check->wrong[1]), c->mesh.polygons[q].source);
        print_error(check->wrong_plane == MESH_NONE ? " in a sequence" : " at a switch");
        print_error(c->mesh.polygons[p].record == c->mesh.polygons[q].record ? ", coplanar\n"
                                                                             : "\n");
    }
    small_scene_print(stderr, scene);
}

static bool judge(const struct small_scene *scene, uint64_t number, const struct way *way,
                  struct tally *tally)
{
    struct compiled c;
    if (!compile(&c, scene, way, number)) {
        mesh_discard(&c.mesh);
        return true;
    }
    struct order_check check = { .mesh = &c.mesh,
                                 .arrangement = &c.arrangement,
                                 .pieces = &c.pieces,
                                 .tree = &c.tree,
                                 .tolerance_q8 = c.tolerance_q8 };
    bool *drawn = xalloc_zero(c.pieces.count, sizeof *drawn);
    bool whole = areas_are_right(&c, drawn);
    bool exact = order_is_right(&check);
    if (!whole || !exact) {
        tell(scene, number, way, &c, exact ? NULL : &check,
             exact ? "area was lost or is there twice" : "exact corners, wrong order");
    }
    tally->trees++;
    tally->faces += check.faces;
    tally->pairs += check.pairs;
    tally->decisive += check.decisive;
    tally->splits += c.pieces.splits;
    tally->strict += check.margin_q8 == 0;
    bool fine = whole && exact;
    if (fine) {
        repair_pieces(&c.repaired, &c.arrangement, &c.planes, &c.pieces, &c.mesh, drawn);
        check.repaired = &c.repaired;
        fine = order_is_right(&check);
        if (!fine) {
            tell(scene, number, way, &c, &check, "rounded corners, wrong order");
        }
    }
    free(drawn);
    free_compiled(&c);
    return fine;
}

static uint64_t number_from(const char *name, uint64_t otherwise)
{
    const char *text = getenv(name);
    return text != NULL ? strtoull(text, NULL, 10) : otherwise;
}

/* Scenes in which nothing is hidden or cut would hold nothing. */
static bool may_fail(const struct tally *tallies)
{
    bool fine = true;
    for (int w = 0; w < WAYS; w++) {
        const struct tally *t = &tallies[w];
        fine &= t->decisive > 20 * t->trees && t->splits > 2 * t->trees;
        fine &= !(ways[w].what & EXACTLY) || t->strict > t->trees / 3;
    }
    return fine;
}

static void hidden_before_hiding_from_everywhere(void **state)
{
    (void)state;
    uint64_t first = number_from("FIRST", 1);
    uint64_t scenes = number_from("SCENES", SCENES);
    uint64_t only = number_from("WAY", WAYS);
    uint32_t wrong = 0;
    struct tally tallies[WAYS];
    memset(tallies, 0, sizeof tallies);
    for (uint64_t i = first; i < first + scenes; i++) {
        struct small_scene scene;
        small_scene_make(&scene, i);
        for (uint64_t w = 0; w < WAYS && wrong < 10; w++) {
            bool turn = i % ways[w].every == ways[w].from;
            if (only == WAYS ? turn : only == w) {
                wrong += !judge(&scene, i, &ways[w], &tallies[w]);
            }
        }
    }
    for (int w = 0; w < WAYS; w++) {
        if (tallies[w].trees == 0) {
            continue;
        }
        print_message(
            "%s: %llu trees (%llu strictly), %llu faces, %llu splits, %llu pairs, %llu may hide\n",
            ways[w].name, (unsigned long long)tallies[w].trees,
            (unsigned long long)tallies[w].strict, (unsigned long long)tallies[w].faces,
            (unsigned long long)tallies[w].splits, (unsigned long long)tallies[w].pairs,
            (unsigned long long)tallies[w].decisive);
    }
    assert_int_equal(wrong, 0);
    assert_true(scenes < 100 || only != WAYS || may_fail(tallies));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hidden_before_hiding_from_everywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
