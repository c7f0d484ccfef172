/* SPDX-License-Identifier: 0BSD */
/* From a model to a blob: clean, plane records, tree, repair, blob, and the core's own check. */
#include "compile.h"

#include <stdlib.h>
#include <string.h>

#include "arrangement.h"
#include "clean.h"
#include "explain.h"
#include "insert_edges.h"
#include "merge.h"
#include "ow_tree.h"
#include "normals.h"
#include "pieces.h"
#include "plane.h"
#include "progress.h"
#include "repair.h"
#include "tools/common/xalloc.h"
#include "tree.h"

/* All that the stages hand on. */
struct compiler {
    const struct compile_options *options;
    struct mesh mesh;
    struct planes planes;
    struct arrangement arrangement;
    struct pieces pieces;
    struct tree tree;
    struct repaired repaired;
    uint32_t tree_pieces; /* pieces there were when the tree was built */
    uint32_t splits;
    uint32_t merged;
    bool two_sided;
};

static void build_tree(struct compiler *c)
{
    struct progress progress;
    const struct compile_options *options = c->options;
    struct strategy strategy = { .method = options->method,
                                 .select = options->select,
                                 .candidates = options->candidates,
                                 .conflict_weight = options->conflict_weight,
                                 .seed = options->seed,
                                 .threads = options->threads,
                                 .tolerance_q8 = options->tolerance_q8,
                                 .dividing = options->dividing,
                                 .dividing_axis = options->dividing_axis,
                                 .into = options->into,
                                 .two_sided = c->two_sided };
    progress_begin(&progress, options->progress);
    strategy_build(&c->tree, &c->arrangement, &c->planes, &c->pieces, &c->mesh, &strategy,
                   &progress);
    progress_end(&progress);
    if (options->explain != NULL) {
        explain_cuts(options->explain, &c->mesh, &c->arrangement, &c->pieces, c->pieces.splits);
    }
}

/* Which pieces are faces of the tree. */
static bool *find_drawn(const struct compiler *c)
{
    bool *drawn = xalloc_zero(c->pieces.count, sizeof *drawn);
    tree_item ends[3];
    for (size_t i = 0; i < c->tree.item_count; i++) {
        if (tree_item_tag(c->tree.items[i]) != OW_ITEM_NODE) {
            drawn[tree_item_value(c->tree.items[i])] = true;
        }
    }
    for (uint32_t i = 0; i <= c->tree.node_count; i++) {
        bool root = i == c->tree.node_count;
        ends[0] = root ? c->tree.root : c->tree.nodes[i].front;
        ends[1] = root ? OW_ITEM_NONE : c->tree.nodes[i].back;
        for (int k = 0; k < 2; k++) {
            if (ends[k] != OW_ITEM_NONE && tree_item_tag(ends[k]) != OW_ITEM_NODE) {
                drawn[tree_item_value(ends[k])] = true;
            }
        }
    }
    return drawn;
}

static void repair_and_prune(struct compiler *c)
{
    uint32_t count = c->pieces.count;
    bool *drawn = find_drawn(c);
    uint32_t *plane_of = xalloc(count, sizeof *plane_of);
    for (uint32_t i = 0; i < count; i++) {
        plane_of[i] = c->pieces.all[i].record;
    }
    c->tree_pieces = count;
    c->splits = c->pieces.splits;
    repair_pieces(&c->repaired, &c->arrangement, &c->planes, &c->pieces, &c->mesh, drawn);
    tree_prune(&c->tree, c->repaired.first, plane_of);
    free(drawn);
    free(plane_of);
}

static bool write_checked(struct compiler *c, struct blob *blob, const struct model *model,
                          struct problem *problem)
{
    struct blob_parts parts = { .mesh = &c->mesh,
                                .planes = &c->planes,
                                .pieces = &c->pieces,
                                .piece_count = c->tree_pieces,
                                .repaired = &c->repaired,
                                .tree = &c->tree,
                                .colours = model->colours,
                                .colour_count = (uint32_t)model->colour_count,
                                .tolerance_q8 = c->options->tolerance_q8,
                                .limits = c->options->limits,
                                .two_sided = c->two_sided,
                                .switch_only = c->options->method != METHOD_OBSTRUCTION &&
                                               tree_is_switch_only(&c->tree),
                                .keep_ids = c->options->keep_ids };
    if (!blob_write(blob, &parts, problem)) {
        return false;
    }
    struct ow_tree tree;
    enum ow_status status = ow_tree_open(&tree, blob->bytes, blob->size);
    return status == OW_OK ||
           problem_set(problem, 0, "a defect of this program: its tree was refused (%s)",
                       ow_status_text(status));
}

static void fill_stats(const struct compiler *c, const struct model *model,
                       struct compile_stats *stats)
{
    *stats = (struct compile_stats){
        .source_polygons = (uint32_t)model->polygon_count,
        .input_polygons = c->mesh.polygon_count,
        .degenerate_dropped = c->mesh.degenerate_dropped,
        .degenerate_kept = c->mesh.degenerate_kept,
        .repeated_dropped = c->mesh.repeated_dropped,
        .uneven_cut = c->mesh.uneven_cut,
        .lines_dropped = model->lines_dropped,
        .planes = c->planes.count,
        .shared_planes = c->planes.shared,
        .merged = c->merged,
        .splits = c->splits,
        .vanished = c->repaired.vanished,
        .inserted = c->repaired.inserted,
        .uneven = c->repaired.uneven,
        .long_cut = c->repaired.long_cut,
        .rounded_meetings = c->arrangement.rounded,
        .relations = c->tree.relations,
        .closed = c->mesh.closed,
        .two_sided = c->two_sided,
    };
}

/* On the model's own lattice, or on that of the tree that it is added to. */
static bool make_mesh(struct compiler *c, const struct model *model, struct problem *problem)
{
    bool normals = c->options->keep_normals;
    const struct insertion *into = c->options->into;
    if (into == NULL) {
        return clean_model(&c->mesh, model, normals, problem);
    }
    if (!clean_model_on(&c->mesh, model, &into->file->lattice, normals, problem)) {
        return false;
    }
    insert_edges(&c->mesh, &into->file->tree);
    return true;
}

/* Obstruction measures its tolerance itself: its planes cut as finely as can be. */
static uint32_t plane_tolerance(const struct compile_options *options)
{
    bool fine = options->method == METHOD_OBSTRUCTION && options->tolerance_q8 > 256;
    return fine ? 256 : options->tolerance_q8;
}

static bool run_stages(struct compiler *c, struct blob *blob, struct compile_stats *stats,
                       const struct model *model, struct problem *problem)
{
    if (!make_mesh(c, model, problem)) {
        return false;
    }
    struct mesh_check check = { 0 };
    if (c->options->check || c->options->repair) {
        check_mesh(&check, &c->mesh, c->options->repair);
    }
    if (c->options->compute_normals) {
        normals_compute(&c->mesh, c->options->crease);
    }
    c->two_sided =
        c->options->sides == SIDES_TWO || (c->options->sides == SIDES_AUTO && !c->mesh.closed);
    plane_group(&c->planes, &c->mesh, model, plane_tolerance(c->options));
    c->merged = c->options->merge ? merge_coplanar(&c->mesh) : 0;
    if (c->options->into != NULL) {
        insertion_join(c->options->into, &c->mesh, &c->planes);
    }
    arrangement_begin(&c->arrangement, &c->mesh, &c->planes);
    pieces_begin(&c->pieces, &c->mesh, &c->arrangement);
    build_tree(c);
    repair_and_prune(c);
    bool fine = write_checked(c, blob, model, problem);
    fill_stats(c, model, stats);
    stats->check = check;
    return fine;
}

bool compile_model(struct blob *blob, struct compile_stats *stats, const struct model *model,
                   const struct compile_options *options, struct problem *problem)
{
    struct compiler compiler;
    memset(&compiler, 0, sizeof compiler);
    compiler.options = options;
    *blob = (struct blob){ 0 };
    bool fine = run_stages(&compiler, blob, stats, model, problem);
    repaired_free(&compiler.repaired);
    tree_free(&compiler.tree);
    pieces_free(&compiler.pieces);
    arrangement_free(&compiler.arrangement);
    planes_free(&compiler.planes);
    mesh_discard(&compiler.mesh);
    return fine;
}
