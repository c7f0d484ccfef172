/* SPDX-License-Identifier: 0BSD */
/*
 * A table for each model, a line for each strategy. Each entry is a run of owc
 * of its own, so that one that takes too long or fails spoils no other. Where
 * chance chooses, the run with the median of the polygons counts.
 */
#include "trees.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "child.h"
#include "papers.h"
#include "tools/common/fail.h"
#include "tools/common/xalloc.h"

enum { MOST_WORDS = 8, MOST_SEEDS = 100, PATH_BYTES = 4096 };

/* More or less than this share of the paper's growth gets a sentence. */
#define MUCH_MORE 1.3
#define MUCH_LESS 0.7

struct strategy {
    const char *name;
    bool by_chance;
    const char *words[MOST_WORDS];
};

static const struct strategy strategies[] = {
    { "bsp k=1", true, { "--method", "bsp", "--candidates", "1" } },
    { "bsp k=3", true, { "--method", "bsp", "--candidates", "3" } },
    { "bsp k=5", true, { "--method", "bsp", "--candidates", "5" } },
    { "bsp k=15", true, { "--method", "bsp", "--candidates", "15" } },
    { "exhaustive", false, { "--method", "bsp", "--select", "exhaustive" } },
    { "conflict", true, { "--method", "bsp", "--select", "conflict" } },
    { "online", false, { "--method", "online" } },
    { "feudal static", false, { "--method", "feudal-static" } },
    { "feudal dynamic", true, { "--method", "feudal-dynamic" } },
    { "obstruction, tolerance 0", false, { "--method", "obstruction", "--tolerance", "0" } },
    { "obstruction", false, { "--method", "obstruction" } },
};
enum { STRATEGIES = sizeof strategies / sizeof strategies[0] };

struct source {
    const char *name;
    const char *words[MOST_WORDS]; /* for owgen; none: a file of the folder of models */
};

/* Small ones first. */
static const struct source sources[] = {
    { "oldwell-low", { "oldwell", "--detail", "low" } },
    { "cubes", { "cubes" } },
    { "robot", { "robot" } },
    { "vise", { "vise" } },
    { "ribbon", { "ribbon" } },
    { "klein", { "klein" } },
    { "house", { "house" } },
    { "atoms", { "atoms" } },
    { "oldwell-high", { "oldwell", "--detail", "high" } },
    { "random", { "random", "--count", "100", "--size", "200", "--seed", "1" } },
    { "parallel", { "parallel", "--count", "1000", "--size", "500", "--seed", "1" } },
    { "suzanne", { NULL } },
    { "beetle", { NULL } },
    { "cow", { NULL } },
    { "spot", { NULL } },
    { "teapot", { NULL } },
    { "fandisk", { NULL } },
    { "stanford-bunny", { NULL } },
};
enum { SOURCES = sizeof sources / sizeof sources[0] };

/* What a run came to: of its statistics, and the means over models of growth. */
struct result {
    double input;
    double output;
    double splits;
    double switches;
    double connecting;
    double depth;
    double bytes;
    double relations;
    double seconds;
};

struct mean {
    double logarithms;
    unsigned count;
};

struct bench {
    const struct trees_options *options;
    char folder[1024];              /* of what lies around for a while */
    struct mean shared[STRATEGIES]; /* over the folder's models */
};

/* ---- runs ---- */

static char *read_text(const char *path)
{
    FILE *file = fopen(path, "r");
    char *text = NULL;
    size_t capacity = 0;
    size_t used = 0;
    size_t got = 1;
    while (file != NULL && got > 0) {
        text = xgrow(text, &capacity, used + 1024, 1);
        got = fread(text + used, 1, capacity - used - 1, file);
        used += got;
    }
    if (file != NULL) {
        text[used] = '\0';
        fclose(file);
    }
    return text;
}

static bool read_result(const char *path, struct result *result)
{
    static const char *const keys[] = { "input_polygons",    "output_polygons",   "splits",
                                        "switch_nodes",      "connecting_nodes",  "depth",
                                        "bytes_per_polygon", "one_way_relations", "seconds" };
    double *values[] = { &result->input,    &result->output,     &result->splits,
                         &result->switches, &result->connecting, &result->depth,
                         &result->bytes,    &result->relations,  &result->seconds };
    char *text = read_text(path);
    cJSON *object = text != NULL ? cJSON_Parse(text) : NULL;
    bool fine = object != NULL;
    for (size_t i = 0; fine && i < sizeof keys / sizeof keys[0]; i++) {
        const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, keys[i]);
        fine = cJSON_IsNumber(item);
        *values[i] = fine ? item->valuedouble : 0;
    }
    cJSON_Delete(object);
    free(text);
    return fine;
}

static double clock_now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

static bool run(const struct bench *b, const char *model, const struct strategy *strategy,
                unsigned seed, double seconds, struct result *result)
{
    char tree[PATH_BYTES];
    char stats[PATH_BYTES];
    char number[16];
    const char *words[MOST_WORDS + 8] = { model };
    size_t count = 1;
    for (size_t i = 0; i < MOST_WORDS && strategy->words[i] != NULL; i++) {
        words[count++] = strategy->words[i];
    }
    snprintf(tree, sizeof tree, "%s/tree.owt", b->folder);
    snprintf(stats, sizeof stats, "%s/stats.json", b->folder);
    snprintf(number, sizeof number, "%u", seed);
    const char *const rest[] = { "--seed", number, "-o", tree, "--stats", stats, NULL };
    memcpy(words + count, rest, sizeof rest);
    return child_run("owc", words, seconds) && read_result(stats, result);
}

static int compare_results(const void *left, const void *right)
{
    const struct result *a = left;
    const struct result *b = right;
    return (a->output > b->output) - (a->output < b->output);
}

/* The median of as many seeds as time allows. False: of none. */
static bool run_seeds(const struct bench *b, const char *model, const struct strategy *strategy,
                      struct result *median, unsigned *runs)
{
    struct result results[MOST_SEEDS];
    unsigned seeds = strategy->by_chance ? b->options->seeds : 1;
    double end = clock_now() + b->options->limit;
    *runs = 0;
    for (unsigned seed = 1; seed <= seeds; seed++) {
        double left = end - clock_now();
        if (left <= 0 || !run(b, model, strategy, seed, left, &results[*runs])) {
            break;
        }
        (*runs)++;
    }
    if (*runs == 0) {
        return false;
    }
    qsort(results, *runs, sizeof *results, compare_results);
    *median = results[(*runs - 1) / 2];
    return true;
}

/* ---- lines ---- */

static void print_optional(double value)
{
    if (value > 0) {
        printf(" %9.0f", value);
    } else {
        printf(" %9s", "");
    }
}

static void print_head(void)
{
    printf("%-25s %8s %6s %8s %8s %7s %6s %7s %11s %8s   %s\n", "", "output", "growth", "splits",
           "switches", "connect", "depth", "bytes/p", "relations", "seconds",
           "the paper: output    splits  switches relations");
}

static void print_line(const char *name, const struct result *r, const struct paper *paper)
{
    printf("%-25s %8.0f %6.2f %8.0f %8.0f %7.0f %6.0f %7.2f %11.0f %8.2f", name, r->output,
           r->output / r->input, r->splits, r->switches, r->connecting, r->depth, r->bytes,
           r->relations, r->seconds);
    if (paper != NULL) {
        printf("   %16.0f %9.0f", paper->output, paper->splits);
        print_optional(paper->switches);
        print_optional(paper->relations);
    }
    printf("\n");
}

/* A sentence where ours and the paper's are far apart. */
static void print_sentence(const char *model, const char *name, const struct result *r,
                           const struct paper *paper)
{
    double ours = r->output / r->input;
    double theirs = paper->output / paper->input;
    double share = ours / theirs;
    if (share > MUCH_MORE || share < MUCH_LESS) {
        printf("  %s, %s: our model, of %.0f polygons, grows to %.2f times its size, the paper's, "
               "of %.0f, to %.2f: %.2f of that.\n",
               model, name, r->input, ours, paper->input, theirs, share);
    }
}

static void print_table(struct bench *b, const char *name, const char *model, bool shared)
{
    struct result results[STRATEGIES];
    unsigned runs[STRATEGIES];
    printf("\n%s\n", name);
    print_head();
    for (size_t i = 0; i < STRATEGIES; i++) {
        const struct strategy *s = &strategies[i];
        if (!run_seeds(b, model, s, &results[i], &runs[i])) {
            printf("%-25s %8s\n", s->name, "-");
            continue;
        }
        print_line(s->name, &results[i], paper_find(name, s->name));
        if (s->by_chance && runs[i] < b->options->seeds) {
            printf("  (time for %u of %u seeds)\n", runs[i], b->options->seeds);
        }
        if (shared) {
            b->shared[i].logarithms += log(results[i].output / results[i].input);
            b->shared[i].count++;
        }
        fflush(stdout);
    }
    for (size_t i = 0; i < STRATEGIES; i++) {
        const struct paper *paper = paper_find(name, strategies[i].name);
        if (paper != NULL && runs[i] > 0) {
            print_sentence(name, strategies[i].name, &results[i], paper);
        }
    }
    fflush(stdout);
}

/* ---- models ---- */

static bool is_wanted(const struct bench *b, const struct source *source)
{
    const struct trees_options *options = b->options;
    for (size_t i = 0; i < options->only_count; i++) {
        if (strcmp(options->only[i], source->name) == 0) {
            return true;
        }
    }
    return options->only_count == 0 && (source->words[0] != NULL || !options->quick);
}

static void print_source(struct bench *b, const struct source *source)
{
    char path[PATH_BYTES];
    if (source->words[0] == NULL) {
        snprintf(path, sizeof path, "%s/%s.obj", b->options->models, source->name);
        if (access(path, R_OK) == 0) {
            print_table(b, source->name, path, true);
        } else {
            printf("\n%s: not in %s\n", source->name, b->options->models);
        }
        return;
    }
    snprintf(path, sizeof path, "%s/model.obj", b->folder);
    const char *words[MOST_WORDS + 3] = { NULL };
    size_t count = 0;
    for (; count < MOST_WORDS && source->words[count] != NULL; count++) {
        words[count] = source->words[count];
    }
    words[count++] = "-o";
    words[count] = path;
    if (!child_run("owgen", words, b->options->limit)) {
        fail(FAIL_INPUT, source->name, 0, "owgen does not make this model");
    }
    print_table(b, source->name, path, false);
}

static void print_means(const struct bench *b)
{
    for (size_t i = 0; i < STRATEGIES; i++) {
        const struct mean *mean = &b->shared[i];
        if (mean->count > 1) {
            printf("%s%-25s output/input, geometric mean over %u models of %s: %.3f\n",
                   i == 0 ? "\n" : "", strategies[i].name, mean->count, b->options->models,
                   exp(mean->logarithms / mean->count));
        }
    }
}

static void remove_folder(const struct bench *b)
{
    static const char *const names[] = { "tree.owt", "stats.json", "model.obj", "model.mtl" };
    char path[PATH_BYTES];
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        snprintf(path, sizeof path, "%s/%s", b->folder, names[i]);
        remove(path);
    }
    rmdir(b->folder);
}

void trees_print(const struct trees_options *options)
{
    struct bench b = { .options = options };
    const char *temporary = getenv("TMPDIR");
    snprintf(b.folder, sizeof b.folder, "%s/owbench-XXXXXX", temporary != NULL ? temporary : ".");
    if (mkdtemp(b.folder) == NULL) {
        fail(FAIL_INPUT, b.folder, 0, "cannot be made");
    }
    printf("Where chance chooses: the median of %u seeds. growth: output/input. bytes/p: of the "
           "tree's file.\n",
           options->seeds);
    for (size_t i = 0; i < SOURCES; i++) {
        if (is_wanted(&b, &sources[i])) {
            print_source(&b, &sources[i]);
        }
    }
    for (size_t i = 0; i < options->only_count; i++) {
        if (strchr(options->only[i], '.') != NULL) {
            print_table(&b, options->only[i], options->only[i], false);
        }
    }
    print_means(&b);
    remove_folder(&b);
}
