/* SPDX-License-Identifier: 0BSD */
/* owbench: measures the compiler's strategies side by side. */
#include <stdint.h>
#include <string.h>

#include "child.h"
#include "tools/common/fail.h"
#include "tools/common/options.h"
#include "trees.h"

enum { MOST_NAMES = 33, QUICK_SEEDS = 3, QUICK_LIMIT = 3 };

static const char notes[] =
    "MODEL is oldwell-low, cubes, robot, vise, ribbon, klein, house, atoms, oldwell-high, random,\n"
    "parallel, one of the folder --models, or a file; without any, all. An entry that ran out of\n"
    "time or failed says -. Runs owgen and owc, which lie beside this program.\n";

int main(int argc, char **argv)
{
    const char *operands[MOST_NAMES];
    struct trees_options options = { .models = "../shared/models", .limit = 60 };
    uint64_t seeds = 9;
    bool seeds_given = false;
    bool limit_given = false;
    const struct option_spec specs[] = {
        { "quick", 0, OPTION_FLAG, &options.quick, NULL,
          "small generated models, 3 seeds, 3 s an entry", .choices = NULL },
        { "limit", 0, OPTION_DOUBLE, &options.limit, "SECONDS", "for each entry of a table",
          .min = 0.1, .max = 1e6, .given = &limit_given },
        { "seeds", 0, OPTION_UNSIGNED, &seeds, "N", "runs where chance chooses: the median counts",
          .min = 1, .max = 99, .given = &seeds_given },
        { "models", 0, OPTION_STRING, &options.models, "FOLDER", "more models", .choices = NULL },
    };
    const struct option_table table = {
        .usage = "trees [MODEL...] [options]",
        .about = "Compiles models with every strategy and prints what came of it, the papers' "
                 "figures beside.",
        .specs = specs,
        .count = sizeof specs / sizeof specs[0],
        .min_operands = 1,
        .max_operands = MOST_NAMES,
        .notes = notes,
    };
    fail_set_program("owbench");
    size_t count = options_parse(&table, argc, argv, operands);
    if (strcmp(operands[0], "trees") != 0) {
        options_wrong(&table, "%s is nothing to measure, only trees is", operands[0]);
    }
    if (options.quick) {
        seeds = seeds_given ? seeds : QUICK_SEEDS;
        options.limit = limit_given ? options.limit : QUICK_LIMIT;
    }
    options.seeds = (unsigned)seeds;
    options.only = operands + 1;
    options.only_count = count - 1;
    child_set_folder(argv[0]);
    trees_print(&options);
    return 0;
}
