/* SPDX-License-Identifier: 0BSD */
/* Which strategy builds the tree. */
#include "strategy.h"

#include <stdlib.h>

#include "feudal_tree.h"
#include "obstruction.h"
#include "online.h"
#include "smallest.h"
#include "tools/common/xalloc.h"

static void build_bsp(struct tree *tree, struct arrangement *arrangement, struct planes *planes,
                      struct pieces *pieces, const struct mesh *mesh,
                      const struct strategy *strategy, struct progress *progress)
{
    struct bsp_options options = {
        .select = strategy->select,
        .candidates = strategy->candidates,
        .seed = strategy->seed,
        .two_sided = strategy->two_sided,
        .conflict_weight = strategy->conflict_weight,
        .axis_planes = strategy->dividing_axis ? planes : NULL,
    };
    uint32_t *dividing = NULL;
    if (strategy->dividing != NULL) {
        dividing = xalloc(strategy->dividing->count, sizeof *dividing);
        options.dividing = dividing;
        options.dividing_count =
            user_planes_add(strategy->dividing, &mesh->lattice, planes, dividing);
    }
    bsp_build(tree, arrangement, pieces, &options, progress);
    free(dividing);
}

void strategy_build(struct tree *tree, struct arrangement *arrangement, struct planes *planes,
                    struct pieces *pieces, const struct mesh *mesh, const struct strategy *strategy,
                    struct progress *progress)
{
    struct feudal_options feudal = { strategy->method == METHOD_FEUDAL_DYNAMIC, strategy->seed,
                                     strategy->two_sided };
    struct obstruction_options obstruction = { .seed = strategy->seed,
                                               .threads = strategy->threads,
                                               .tolerance_q8 = strategy->tolerance_q8,
                                               .two_sided = strategy->two_sided };
    if (strategy->into != NULL) {
        insertion_build(tree, strategy->into, arrangement, pieces, strategy->two_sided, progress);
        return;
    }
    switch (strategy->method) {
    case METHOD_FEUDAL_STATIC:
    case METHOD_FEUDAL_DYNAMIC:
        feudal_build(tree, arrangement, pieces, mesh, &feudal, progress);
        break;
    case METHOD_ONLINE:
        online_build(tree, arrangement, pieces, strategy->two_sided, progress);
        break;
    case METHOD_OBSTRUCTION:
        if (mesh->polygon_count <= SMALLEST_MODEL) {
            smallest_build(tree, arrangement, planes, pieces, mesh, strategy, progress);
        } else {
            obstruction_build(tree, planes, mesh, arrangement, pieces, &obstruction, progress);
        }
        break;
    case METHOD_BSP:
        build_bsp(tree, arrangement, planes, pieces, mesh, strategy, progress);
        break;
    }
}
