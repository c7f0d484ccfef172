/* SPDX-License-Identifier: 0BSD */
/* owc: compiles a model into a tree. Options, files and messages. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "compile.h"
#include "import.h"
#include "info.h"
#include "ow_blob.h"
#include "progress.h"
#include "stats.h"
#include "tools/common/fail.h"
#include "tools/common/options.h"
#include "tools/common/outfile.h"

enum method { METHOD_BSP };
static const char *const methods[] = { "bsp", "online", "feudal-static", "feudal-dynamic",
                                       "obstruction", NULL };
/* The first ones in the order of enum bsp_select. */
static const char *const selects[] = { "first", "random", "kedem", "exhaustive", "conflict",
                                       NULL };
static const char *const sides[] = { "one", "two", "auto", NULL };
static const char *const normals[] = { "none", "keep", NULL };

struct command {
    const char *model;
    const char *output;
    const char *stats;
    const char *info;
    int method;
    int select;
    int sides;
    int normals;
    uint64_t candidates;
    uint64_t seed;
    double tolerance;
    bool strict;
    bool keep_ids;
    bool candidates_given;
    bool tolerance_given;
};

static const char notes[] =
    "MODEL is any file that assimp reads. FILE '-' is standard output.\n"
    "--tolerance 0 is one lattice step, 1/65534 of the longest side, the finest distance there\n"
    "is; --strict counts only what is exactly on a plane.\n"
    "The methods online, feudal-static, feudal-dynamic and obstruction and the selection\n"
    "conflict are not there yet; until obstruction is, bsp is the default.\n";

static void check_usage(const struct option_table *table, const struct command *c)
{
    if (c->info != NULL) {
        if (c->model != NULL || c->output != NULL) {
            options_wrong(table, "--info takes no model and no output");
        }
        return;
    }
    if (c->model == NULL) {
        options_wrong(table, "name a model");
    }
    if (c->output == NULL) {
        options_wrong(table, "name the output by -o FILE");
    }
    if (c->method != METHOD_BSP) {
        options_wrong(table, "--method %s is not there yet, use bsp", methods[c->method]);
    }
    if (c->select > BSP_EXHAUSTIVE) {
        options_wrong(table, "--select %s is not there yet, use kedem", selects[c->select]);
    }
    if (c->candidates_given && c->select != BSP_KEDEM) {
        options_wrong(table, "--candidates goes with --select kedem");
    }
    if (c->strict && c->tolerance_given) {
        options_wrong(table, "--strict and --tolerance exclude each other");
    }
    if (c->stats != NULL && strcmp(c->stats, "-") == 0 && strcmp(c->output, "-") == 0) {
        options_wrong(table, "only one of the tree and the statistics can be standard output");
    }
}

static void parse(struct command *c, int argc, char **argv)
{
    const struct option_spec specs[] = {
        { "output", 'o', OPTION_STRING, &c->output, "TREE.owt", "where to write the tree",
          .choices = NULL },
        { "method", 0, OPTION_CHOICE, &c->method, NULL, "strategy", .choices = methods },
        { "select", 0, OPTION_CHOICE, &c->select, NULL, "whose plane divides",
          .choices = selects },
        { "candidates", 0, OPTION_UNSIGNED, &c->candidates, "K", "polygons that kedem tries",
          .min = 1, .max = 1e9, .given = &c->candidates_given },
        { "tolerance", 0, OPTION_DOUBLE, &c->tolerance, "T",
          "share of the longest side that counts as nothing", .max = 1,
          .given = &c->tolerance_given },
        { "strict", 0, OPTION_FLAG, &c->strict, NULL, "no tolerance at all",
          .choices = NULL },
        { "sides", 0, OPTION_CHOICE, &c->sides, NULL, "auto: one if the model is closed",
          .choices = sides },
        { "seed", 0, OPTION_UNSIGNED, &c->seed, "N", "of random choices",
          .choices = NULL },
        { "keep-ids", 0, OPTION_FLAG, &c->keep_ids, NULL, "keep the source polygons' numbers",
          .choices = NULL },
        { "normals", 0, OPTION_CHOICE, &c->normals, NULL, "vertex normals", .choices = normals },
        { "stats", 0, OPTION_STRING, &c->stats, "FILE", "write statistics as JSON",
          .choices = NULL },
        { "info", 0, OPTION_STRING, &c->info, "TREE.owt", "check a tree and describe it",
          .choices = NULL },
    };
    const struct option_table table = {
        .usage = "MODEL -o TREE.owt [options]\n--info TREE.owt",
        .about = "Compiles a model into a tree that the firmware draws.",
        .specs = specs,
        .count = sizeof specs / sizeof specs[0],
        .max_operands = 1,
        .notes = notes,
    };
    options_parse(&table, argc, argv, &c->model);
    check_usage(&table, c);
}

/* In lattice steps with 8 fraction bits: at least one step, unless strict. */
static uint32_t tolerance_q8(const struct command *c)
{
    if (c->strict) {
        return 0;
    }
    double steps = fmax(1, c->tolerance * (2 * OW_LATTICE_MAX));
    return (uint32_t)floor(steps * 256 + 0.5);
}

static void warn_about(const struct command *c, const struct model *model)
{
    if (model->colours_changed > 0) {
        warn_line(c->model, 0, "more than %d colours: %llu materials got the nearest one",
                  OW_MAX_COLOURS, (unsigned long long)model->colours_changed);
    }
}

static void write_files(const struct command *c, const struct blob *blob,
                        const struct compile_stats *stats, double seconds)
{
    struct outfile *outs[2];
    size_t count = 0;
    outs[count++] = outfile_open(c->output);
    fwrite(blob->bytes, 1, blob->size, outfile_stream(outs[0]));
    if (c->stats != NULL) {
        outs[count++] = outfile_open(c->stats);
        stats_write(outs[1], blob, stats, seconds);
    }
    outfile_commit_all(outs, count);
}

static void compile(const struct command *c)
{
    double begin = progress_clock();
    struct problem problem;
    struct model model;
    struct blob blob;
    struct compile_stats stats;
    struct compile_options options = {
        .select = (enum bsp_select)c->select,
        .candidates = (uint32_t)c->candidates,
        .seed = c->seed,
        .sides = (enum sides)c->sides,
        .tolerance_q8 = tolerance_q8(c),
        .keep_ids = c->keep_ids,
        .keep_normals = c->normals == 1,
        .progress = true,
    };
    if (!import_file(&model, c->model, &problem) ||
        !compile_model(&blob, &stats, &model, &options, &problem)) {
        fail(FAIL_INPUT, c->model, problem.line, "%s", problem.text);
    }
    warn_about(c, &model);
    write_files(c, &blob, &stats, progress_clock() - begin);
    blob_free(&blob);
    import_free(&model);
}

int main(int argc, char **argv)
{
    struct command command = { .method = METHOD_BSP,
                               .select = BSP_KEDEM,
                               .sides = SIDES_AUTO,
                               .candidates = 5,
                               .seed = 1 };
    fail_set_program("owc");
    parse(&command, argc, argv);
    if (command.info != NULL) {
        info_print(command.info);
    } else {
        compile(&command);
    }
    return 0;
}
