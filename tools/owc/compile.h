/* SPDX-License-Identifier: 0BSD */
/* From a model to a blob: the stages in their order. */
#ifndef OWC_COMPILE_H
#define OWC_COMPILE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "blob_write.h"
#include "bsp.h"
#include "check.h"
#include "model.h"
#include "problem.h"
#include "strategy.h"

enum sides { SIDES_ONE, SIDES_TWO, SIDES_AUTO };

struct compile_options {
    enum method method;
    enum bsp_select select;
    uint32_t candidates;
    double conflict_weight;
    const struct user_planes *dividing; /* NULL: none are given */
    bool dividing_axis;
    struct insertion *into; /* a tree to add to, NULL: none */
    bool check;             /* fill compile_stats.check */
    bool merge;             /* join coplanar neighbours first */
    bool repair;            /* turn over what looks inwards; implies check */
    FILE *explain;          /* where to say what was split; NULL: nowhere */
    uint64_t seed;
    uint32_t threads; /* 0: as many as there are processors */
    enum sides sides;
    uint32_t tolerance_q8; /* side tests: lattice steps with 8 fraction bits */
    bool keep_ids;
    bool keep_normals;
    bool compute_normals;             /* instead of the model's own */
    double crease;                    /* degrees; see normals_compute */
    const struct blob_limits *limits; /* of the tree; NULL: the format's */
    bool progress;
};

/* What the statistics tell; the rest is in the blob's header. */
struct compile_stats {
    uint32_t source_polygons;
    uint32_t input_polygons;
    uint32_t degenerate_dropped;
    uint32_t degenerate_kept;
    uint32_t repeated_dropped;
    uint32_t uneven_cut;
    uint64_t lines_dropped;
    uint32_t planes;
    uint32_t shared_planes;
    uint32_t merged; /* polygons that were joined to others */
    uint32_t splits;
    uint32_t vanished;
    uint32_t inserted;
    uint32_t uneven;
    uint32_t long_cut;
    uint32_t rounded_meetings;
    uint64_t relations;
    bool closed;
    bool two_sided;
    struct mesh_check check;
};

/* Free the blob in either case. */
bool compile_model(struct blob *blob, struct compile_stats *stats, const struct model *model,
                   const struct compile_options *options, struct problem *problem);

#endif
