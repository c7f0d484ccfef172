/* SPDX-License-Identifier: 0BSD */
/* owgen: makes the models that the project is shown and measured with. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "tools/common/fail.h"
#include "tools/common/options.h"
#include "tools/common/outfile.h"
#include "tools/owgen/models.h"
#include "tools/owgen/write.h"

struct arguments {
    struct model_options model;
    int detail;
    const char *output;
    bool list;
    bool detail_given, count_given, size_given, seed_given;
};

static _Noreturn void print_list(void)
{
    for (size_t i = 0; i < model_kind_count; i++) {
        const struct model_kind *kind = &model_kinds[i];
        char polygons[32] = "N";
        if ((kind->traits & MODEL_DETAIL) != 0) {
            snprintf(polygons, sizeof polygons, "%zu|%zu", kind->polygons[0], kind->polygons[1]);
        } else if (kind->polygons[0] != 0) {
            snprintf(polygons, sizeof polygons, "%zu", kind->polygons[0]);
        }
        printf("%-9s %8s  %s\n", kind->name, polygons, kind->about);
    }
    outfile_commit(outfile_open("-"));
    exit(0);
}

/* The kind named on the command line; options that it does not take are wrong usage. */
static const struct model_kind *choose_kind(const struct option_table *table, const char *name,
                                            const struct arguments *given)
{
    const struct model_kind *kind = model_find(name);
    if (kind == NULL) {
        options_wrong(table, "unknown kind '%s', owgen --list names them", name);
    }
    if (given->detail_given && (kind->traits & MODEL_DETAIL) == 0) {
        options_wrong(table, "%s has no --detail", name);
    }
    if ((given->count_given || given->size_given || given->seed_given) &&
        (kind->traits & MODEL_RANDOM) == 0) {
        options_wrong(table, "%s has no --count, --size or --seed", name);
    }
    if (given->output == NULL) {
        options_wrong(table, "-o FILE.obj is missing");
    }
    return kind;
}

static void make_title(const struct model_kind *kind, const struct model_options *model,
                       char *title, size_t bytes)
{
    if ((kind->traits & MODEL_DETAIL) != 0) {
        snprintf(title, bytes, "owgen %s --detail %s", kind->name,
                 model->detail == DETAIL_HIGH ? "high" : "low");
    } else if ((kind->traits & MODEL_RANDOM) != 0) {
        snprintf(title, bytes, "owgen %s --count %" PRIu64 " --size %g --seed %" PRIu64, kind->name,
                 model->count, model->size, model->seed);
    } else {
        snprintf(title, bytes, "owgen %s", kind->name);
    }
}

static void run(const struct model_kind *kind, const struct model_options *model,
                const char *output)
{
    struct mesh mesh;
    char title[160];
    mesh_init(&mesh);
    kind->build(&mesh, model);
    make_title(kind, model, title, sizeof title);
    write_model(&mesh, title, output);
    mesh_free(&mesh);
}

int main(int argc, char **argv)
{
    static const char *const details[] = { "low", "high", NULL };
    struct arguments given = {
        .model = { .count = 500, .size = 500, .seed = 1 },
        .detail = DETAIL_HIGH,
    };
    const struct option_spec specs[] = {
        { "output", 'o', OPTION_STRING, &given.output, "FILE.obj",
          "the OBJ file; FILE.mtl goes beside it; - is standard output, without MTL",
          .no_default = true },
        { "detail", 0, OPTION_CHOICE, &given.detail, NULL, "of oldwell", .choices = details,
          .given = &given.detail_given },
        { "count", 0, OPTION_UNSIGNED, &given.model.count, "N", "triangles of random, parallel",
          .min = 1, .max = 1000000, .given = &given.count_given },
        { "size", 0, OPTION_DOUBLE, &given.model.size, "S",
          "side of the cube or square that holds a triangle", .min = 0.01, .max = 1000,
          .given = &given.size_given },
        { "seed", 0, OPTION_UNSIGNED, &given.model.seed, "K", "equal seeds give equal files",
          .given = &given.seed_given },
        { "list", 0, OPTION_FLAG, &given.list, .help = "list the kinds and their polygons" },
    };
    const struct option_table table = {
        .usage = "KIND [options] -o FILE.obj\n--list",
        .about = "Makes the models that Oldwell is shown and measured with.",
        .specs = specs,
        .count = sizeof specs / sizeof specs[0],
        .max_operands = 1,
    };
    const char *kind = NULL;
    fail_set_program("owgen");
    size_t operands = options_parse(&table, argc, argv, &kind);
    if (given.list) {
        print_list();
    }
    if (operands == 0) {
        options_wrong(&table, "KIND is missing, owgen --list names them");
    }
    given.model.detail = given.detail == 0 ? DETAIL_LOW : DETAIL_HIGH;
    run(choose_kind(&table, kind, &given), &given.model, given.output);
    return 0;
}
