/* SPDX-License-Identifier: 0BSD */
/* The smallest of several trees. Each is built from the beginning, on its own copies. */
#include "smallest.h"

#include <stdlib.h>
#include <string.h>

#include "feudal_tree.h"
#include "obstruction.h"
#include "tools/common/xalloc.h"

/* A tree and what it was built with. */
struct attempt {
    struct planes planes;
    struct arrangement arrangement;
    struct pieces pieces;
    struct tree tree;
    uint32_t polygons;
};

static const double prices[] = { 0.5, 0.5, 0.25, 1 };
enum { PRICES = sizeof prices / sizeof prices[0] };

static void mark(bool *drawn, tree_item item)
{
    if (item != OW_ITEM_NONE && tree_item_tag(item) != OW_ITEM_NODE) {
        drawn[tree_item_value(item)] = true;
    }
}

static uint32_t count_polygons(const struct attempt *a)
{
    bool *drawn = xalloc_zero(a->pieces.count, sizeof *drawn);
    uint32_t count = 0;
    mark(drawn, a->tree.root);
    for (uint32_t i = 0; i < a->tree.node_count; i++) {
        const struct tree_node *node = &a->tree.nodes[i];
        mark(drawn, node->front);
        mark(drawn, node->back);
        for (uint32_t k = 0; k < node->count; k++) {
            mark(drawn, a->tree.items[node->first + k]);
        }
    }
    for (uint32_t i = 0; i < a->pieces.count; i++) {
        count += drawn[i];
    }
    free(drawn);
    return count;
}

static void attempt_begin(struct attempt *a, const struct planes *planes, const struct mesh *mesh)
{
    a->planes = *planes;
    a->planes.capacity = planes->count;
    a->planes.all = xalloc(planes->count, sizeof *a->planes.all);
    memcpy(a->planes.all, planes->all, planes->count * sizeof *planes->all);
    arrangement_begin(&a->arrangement, mesh, &a->planes);
    pieces_begin(&a->pieces, mesh, &a->arrangement);
    a->tree = (struct tree){ .root = OW_ITEM_NONE };
}

static void attempt_free(struct attempt *a)
{
    tree_free(&a->tree);
    pieces_free(&a->pieces);
    arrangement_free(&a->arrangement);
    planes_free(&a->planes);
}

/* Attempts 0 to 2 are cheap; then obstruction, each unless it gets larger than the best. */
static bool build(struct attempt *a, uint32_t number, uint32_t best, const struct mesh *mesh,
                  const struct strategy *strategy, struct progress *progress)
{
    struct bsp_options bsp = { .select = BSP_KEDEM,
                               .candidates = number == 0 ? 5 : 15,
                               .seed = strategy->seed,
                               .two_sided = strategy->two_sided };
    struct feudal_options feudal = { true, strategy->seed, strategy->two_sided };
    if (number < 2) {
        bsp_build(&a->tree, &a->arrangement, &a->pieces, &bsp, progress);
        return true;
    }
    if (number == 2) {
        feudal_build(&a->tree, &a->arrangement, &a->pieces, mesh, &feudal, progress);
        return true;
    }
    struct obstruction_options options = { .seed = strategy->seed + number - 3,
                                           .threads = strategy->threads,
                                           .tolerance_q8 = strategy->tolerance_q8,
                                           .two_sided = strategy->two_sided,
                                           .price = prices[number - 3],
                                           .most = (uint64_t)best * (strategy->two_sided ? 2 : 1) };
    return obstruction_build(&a->tree, &a->planes, mesh, &a->arrangement, &a->pieces, &options,
                             progress);
}

/* Obstruction, with the fewest switches, wins a tie. */
static bool is_better(const struct attempt *a, const struct attempt *b)
{
    return a->polygons != b->polygons ? a->polygons < b->polygons
                                      : a->tree.node_count < b->tree.node_count;
}

void smallest_build(struct tree *tree, struct arrangement *arrangement, struct planes *planes,
                    struct pieces *pieces, const struct mesh *mesh, const struct strategy *strategy,
                    struct progress *progress)
{
    struct attempt *best = NULL;
    bool fine = true;
    for (uint32_t i = 0; fine && i < 3 + PRICES; i++) { /* until obstruction is out of reach */
        struct attempt *a = xalloc_zero(1, sizeof *a);
        attempt_begin(a, planes, mesh);
        fine = build(a, i, best == NULL ? 0 : best->polygons, mesh, strategy, progress);
        a->polygons = fine ? count_polygons(a) : UINT32_MAX;
        if (best != NULL && !is_better(a, best)) {
            attempt_free(a);
            free(a);
            continue;
        }
        if (best != NULL) {
            attempt_free(best);
            free(best);
        }
        best = a;
    }
    pieces_free(pieces);
    arrangement_free(arrangement);
    planes_free(planes);
    *planes = best->planes;
    *arrangement = best->arrangement;
    arrangement->planes = planes;
    *pieces = best->pieces;
    *tree = best->tree;
    free(best);
}
