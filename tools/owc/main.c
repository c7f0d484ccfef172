/* SPDX-License-Identifier: 0BSD */
/* owc: compiles a model into a tree. Options, files and messages. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "blob_file.h"
#include "compile.h"
#include "import.h"
#include "info.h"
#include "locate_print.h"
#include "ow_blob.h"
#include "ow_view.h"
#include "planes.h"
#include "plot.h"
#include "progress.h"
#include "stats.h"
#include "workers.h"
#include "tools/common/fail.h"
#include "tools/common/options.h"
#include "tools/common/outfile.h"

static const char *const methods[] = { "bsp",         "online", "feudal-static", "feudal-dynamic",
                                       "obstruction", NULL };
/* In the order of enum bsp_select. */
static const char *const selects[] = { "first", "random", "kedem", "exhaustive", "conflict", NULL };
static const char *const sides[] = { "one", "two", "auto", NULL };
static const char *const normals[] = { "none", "keep", "compute", NULL };
static const char *const dividings[] = { "none", "axis", NULL };

struct command {
    const char *model;
    const char *output;
    const char *stats;
    const char *info;
    const char *insert;
    const char *planes_file;
    const char *plot;
    double locate[3];
    uint32_t planes[2]; /* pixels */
    double conflict_weight;
    int method;
    int select;
    int sides;
    int normals;
    double crease;
    uint64_t candidates;
    uint64_t seed;
    uint64_t threads;
    double tolerance;
    int dividing;
    bool repair;
    bool merge;
    bool explain;
    bool locate_given;
    bool planes_given;
    bool weight_given;
    bool strict;
    bool keep_ids;
    bool method_given;
    bool select_given;
    bool candidates_given;
    bool tolerance_given;
};

#define DEFAULT_TOLERANCE 0.0005 /* with METHOD_OBSTRUCTION; with the papers' methods 0 */

static const char notes[] =
    "MODEL is any file that assimp reads. FILE '-' is standard output.\n"
    "--tolerance 0 is one lattice step, 1/65534 of the longest side, the finest distance there\n"
    "is; --strict counts only what is exactly on a plane.\n"
    "--planes-file has a line a,b,c,d for each plane ax + by + cz + d = 0, in model units; with\n"
    "--dividing axis, planes along the axes are found at gaps. Both divide before polygons do.\n"
    "--insert adds polygons one after the other to a tree of --method bsp or online, with the\n"
    "tolerance, sides and kinds of records that the tree has.\n"
    "--merge joins neighbours of one plane and colour into convex polygons; each has the number "
    "of\n"
    "its first one in the file, and edges inside are not drawn by --shade lines.\n"
    "--locate says in which convex region of a tree of switches a point lies.\n"
    "Without --method, an option of bsp alone chooses bsp, all else obstruction. The default\n"
    "tolerance of obstruction is 0.0005, that of the others 0.\n";

/* Only one of the outputs can be standard output. */
static void check_outputs(const struct option_table *table, const struct command *c)
{
    const char *outputs[] = { c->output, c->stats, c->plot, c->explain ? "-" : NULL };
    int direct = 0;
    for (size_t i = 0; i < sizeof outputs / sizeof outputs[0]; i++) {
        direct += outputs[i] != NULL && strcmp(outputs[i], "-") == 0;
    }
    if (direct > 1) {
        options_wrong(table, "only one of the tree, the statistics, the picture and what "
                             "--explain says can be standard output");
    }
}

static void check_bsp_usage(const struct option_table *table, const struct command *c)
{
    bool bsp = c->method == METHOD_BSP && c->insert == NULL;
    if (c->candidates_given && c->select != BSP_KEDEM && c->select != BSP_CONFLICT) {
        options_wrong(table, "--candidates goes with --select kedem and conflict");
    }
    if (c->weight_given && c->select != BSP_CONFLICT) {
        options_wrong(table, "--conflict-weight goes with --select conflict");
    }
    if (!bsp && (c->planes_file != NULL || c->dividing != 0)) {
        options_wrong(table, "dividing planes go with --method bsp");
    }
    if (c->merge && c->insert != NULL) {
        options_wrong(table, "--merge does not go with --insert");
    }
}

static void check_usage(const struct option_table *table, const struct command *c)
{
    if (c->info != NULL) {
        if (c->model != NULL || c->output != NULL) {
            options_wrong(table, "--info takes no model and no output");
        }
        return;
    }
    if (c->model == NULL) {
        options_wrong(table, c->locate_given || c->insert != NULL ? "name a tree" : "name a model");
    }
    if (c->locate_given) {
        if (c->output != NULL || c->insert != NULL) {
            options_wrong(table, "--locate takes a tree and no output");
        }
        return;
    }
    if (c->output == NULL) {
        options_wrong(table, "name the output by -o FILE");
    }
    check_bsp_usage(table, c);
    if (c->strict && c->tolerance_given) {
        options_wrong(table, "--strict and --tolerance exclude each other");
    }
    check_outputs(table, c);
}

static void choose_method(struct command *c)
{
    bool bsp = c->select_given || c->candidates_given || c->weight_given || c->dividing != 0 ||
               c->planes_file != NULL;
    if (!c->method_given) {
        c->method = bsp ? METHOD_BSP : METHOD_OBSTRUCTION;
    }
}

static void parse(struct command *c, int argc, char **argv)
{
    const struct option_spec specs[] = {
        { "output", 'o', OPTION_STRING, &c->output, "TREE.owt", "where to write the tree",
          .choices = NULL },
        { "method", 0, OPTION_CHOICE, &c->method, NULL, "strategy", .choices = methods,
          .given = &c->method_given },
        { "select", 0, OPTION_CHOICE, &c->select, NULL, "whose plane divides", .choices = selects,
          .given = &c->select_given },
        { "candidates", 0, OPTION_UNSIGNED, &c->candidates, "K",
          "polygons that kedem and conflict try", .min = 1, .max = 1e9,
          .given = &c->candidates_given },
        { "conflict-weight", 0, OPTION_DOUBLE, &c->conflict_weight, "W",
          "of conflicts that stay, beside those that go", .max = 1e9, .given = &c->weight_given },
        { "planes-file", 0, OPTION_STRING, &c->planes_file, "FILE", "planes that divide first",
          .choices = NULL },
        { "dividing", 0, OPTION_CHOICE, &c->dividing, NULL, "planes to look for",
          .choices = dividings },
        { "tolerance", 0, OPTION_DOUBLE, &c->tolerance, "T",
          "share of the longest side that counts as nothing", .max = 1,
          .given = &c->tolerance_given },
        { "strict", 0, OPTION_FLAG, &c->strict, NULL, "no tolerance at all", .choices = NULL },
        { "sides", 0, OPTION_CHOICE, &c->sides, NULL, "auto: one if the model is closed",
          .choices = sides },
        { "seed", 0, OPTION_UNSIGNED, &c->seed, "N", "of random choices", .choices = NULL },
        { "threads", 0, OPTION_UNSIGNED, &c->threads, "N",
          "threads at work; 0: one for each processor", .max = WORKERS_MOST },
        { "keep-ids", 0, OPTION_FLAG, &c->keep_ids, NULL, "keep the source polygons' numbers",
          .choices = NULL },
        { "normals", 0, OPTION_CHOICE, &c->normals, NULL, "vertex normals, for smooth shading",
          .choices = normals },
        { "crease", 0, OPTION_DOUBLE, &c->crease, "DEG",
          "--normals compute: edges that turn by more stay sharp", .min = 0, .max = 180 },
        { "planes", 0, OPTION_SIZE, c->planes, "WxH",
          "write the tree as the bit planes of a frame buffer, a PGM", .max = OW_SCREEN_MAX,
          .given = &c->planes_given, .no_default = true },
        { "stats", 0, OPTION_STRING, &c->stats, "FILE", "write statistics as JSON",
          .choices = NULL },
        { "plot", 0, OPTION_STRING, &c->plot, "FILE.svg", "draw the tree", .choices = NULL },
        { "explain", 0, OPTION_FLAG, &c->explain, NULL, "print what was split by what",
          .choices = NULL },
        { "merge", 0, OPTION_FLAG, &c->merge, NULL, "join coplanar neighbours first",
          .choices = NULL },
        { "repair", 0, OPTION_FLAG, &c->repair, NULL, "turn closed parts that look inwards",
          .choices = NULL },
        { "insert", 0, OPTION_STRING, &c->insert, "MORE", "a model to add to TREE.owt",
          .choices = NULL },
        { "locate", 0, OPTION_VECTOR, c->locate, "x,y,z", "find a point's region in TREE.owt",
          .given = &c->locate_given, .no_default = true },
        { "info", 0, OPTION_STRING, &c->info, "TREE.owt", "check a tree and describe it",
          .choices = NULL },
    };
    const struct option_table table = {
        .usage = "MODEL -o TREE.owt [options]\n--insert MORE TREE.owt -o NEW.owt\n"
                 "--locate x,y,z TREE.owt\n--info TREE.owt",
        .about = "Compiles a model into a tree that the firmware draws.",
        .specs = specs,
        .count = sizeof specs / sizeof specs[0],
        .max_operands = 1,
        .notes = notes,
    };
    options_parse(&table, argc, argv, &c->model);
    choose_method(c);
    check_usage(&table, c);
}

/* In lattice steps with 8 fraction bits: at least one step, unless strict. */
static uint32_t tolerance_q8(const struct command *c)
{
    if (c->strict) {
        return 0;
    }
    double share = c->tolerance;
    if (!c->tolerance_given && c->method == METHOD_OBSTRUCTION) {
        share = DEFAULT_TOLERANCE;
    }
    double steps = fmax(1, share * (2 * OW_LATTICE_MAX));
    return (uint32_t)floor(steps * 256 + 0.5);
}

static void warn_about(const char *name, const struct model *model)
{
    if (model->colours_changed > 0) {
        warn_line(name, 0, "more than %d colours: %llu materials got the nearest one",
                  OW_MAX_COLOURS, (unsigned long long)model->colours_changed);
    }
}

static void draw_plot(struct outfile *out, const struct blob *blob)
{
    struct ow_tree tree;
    if (ow_tree_open(&tree, blob->bytes, blob->size) == OW_OK) { /* compile_model saw to that */
        plot_tree(outfile_stream(out), &tree);
    }
}

static void write_files(const struct command *c, const struct blob *blob,
                        const struct compile_stats *stats, double seconds)
{
    struct outfile *outs[3];
    size_t count = 0;
    outs[count++] = outfile_open(c->output);
    if (c->planes_given) {
        planes_write(outfile_stream(outs[0]), blob, c->planes);
    } else {
        fwrite(blob->bytes, 1, blob->size, outfile_stream(outs[0]));
    }
    if (c->stats != NULL) {
        outs[count] = outfile_open(c->stats);
        stats_write(outs[count++], blob, stats, seconds);
    }
    if (c->plot != NULL) {
        outs[count] = outfile_open(c->plot);
        draw_plot(outs[count++], blob);
    }
    outfile_commit_all(outs, count);
}

/* Compiles a model that was read; the model's name is for messages. */
static void compile(const struct command *c, const char *name, struct model *model,
                    struct compile_options *options, double begin)
{
    struct problem problem;
    struct blob blob;
    struct compile_stats stats;
    struct outfile *explained = c->explain ? outfile_open("-") : NULL;
    options->explain = explained != NULL ? outfile_stream(explained) : NULL;
    if (!compile_model(&blob, &stats, model, options, &problem)) {
        fail(FAIL_INPUT, name, problem.line, "%s", problem.text);
    }
    check_report(&stats.check, name);
    if (options->into != NULL && options->sides == SIDES_ONE && !stats.check.closed) {
        warn_line(name, 0,
                  "is open, but the tree is one-sided: backs are not drawn, compile the "
                  "tree with --sides two");
    }
    warn_about(name, model);
    if (c->planes_given) {
        planes_check(&blob, c->planes, name);
    }
    if (explained != NULL) {
        outfile_commit(explained);
    }
    write_files(c, &blob, &stats, progress_clock() - begin);
    blob_free(&blob);
    import_free(model);
}

static void compile_new(const struct command *c)
{
    double begin = progress_clock();
    struct problem problem;
    struct model model;
    struct user_planes planes = { 0 };
    struct compile_options options = {
        .method = (enum method)c->method,
        .select = (enum bsp_select)c->select,
        .candidates = (uint32_t)c->candidates,
        .conflict_weight = c->conflict_weight,
        .dividing = c->planes_file != NULL ? &planes : NULL,
        .dividing_axis = c->dividing == 1,
        .seed = c->seed,
        .threads = (uint32_t)c->threads,
        .sides = (enum sides)c->sides,
        .tolerance_q8 = tolerance_q8(c),
        .keep_ids = c->keep_ids,
        .keep_normals = c->normals == 1,
        .compute_normals = c->normals == 2,
        .crease = c->crease,
        .check = true,
        .repair = c->repair,
        .merge = c->merge,
        .progress = true,
    };
    if (c->planes_file != NULL && !user_planes_read_file(&planes, c->planes_file, &problem)) {
        fail(FAIL_INPUT, c->planes_file, problem.line, "%s", problem.text);
    }
    if (!import_file(&model, c->model, &problem)) {
        fail(FAIL_INPUT, c->model, problem.line, "%s", problem.text);
    }
    compile(c, c->model, &model, &options, begin);
    user_planes_free(&planes);
}

/* The new polygons are treated as the tree's own were. */
static void compile_into(const struct command *c)
{
    double begin = progress_clock();
    struct problem problem;
    struct model model;
    struct blob_file file;
    struct insertion into;
    blob_file_open(&file, c->model);
    if (!insertion_begin(&into, &file, &problem)) {
        fail(FAIL_INPUT, c->model, 0, "%s", problem.text);
    }
    struct compile_options options = {
        .method = METHOD_ONLINE,
        .into = &into,
        .sides = (file.tree.flags & OW_TREE_TWO_SIDED) ? SIDES_TWO : SIDES_ONE,
        .tolerance_q8 = file.tolerance_q8,
        .keep_ids = (file.tree.flags & OW_TREE_IDS) != 0,
        .keep_normals = (file.tree.flags & OW_TREE_NORMALS) != 0,
        .check = true,
        .repair = c->repair,
        .progress = true,
    };
    if (!import_file(&model, c->insert, &problem) || !insertion_take(&into, &model, &problem)) {
        fail(FAIL_INPUT, c->insert, problem.line, "%s", problem.text);
    }
    compile(c, c->insert, &model, &options, begin);
    insertion_free(&into);
    blob_file_close(&file);
}

int main(int argc, char **argv)
{
    struct command command = { .method = METHOD_BSP,
                               .select = BSP_KEDEM,
                               .sides = SIDES_AUTO,
                               .candidates = 5,
                               .conflict_weight = 16,
                               .crease = 40,
                               .seed = 1 };
    fail_set_program("owc");
    parse(&command, argc, argv);
    if (command.info != NULL) {
        info_print(command.info);
    } else if (command.locate_given) {
        locate_print(command.model, command.locate);
    } else if (command.insert != NULL) {
        compile_into(&command);
    } else {
        compile_new(&command);
    }
    return 0;
}
