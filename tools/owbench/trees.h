/* SPDX-License-Identifier: 0BSD */
/* What every strategy makes of every model, as tables. */
#ifndef OWBENCH_TREES_H
#define OWBENCH_TREES_H

#include <stdbool.h>
#include <stddef.h>

struct trees_options {
    bool quick;              /* models of the papers' kinds alone, few seeds */
    double limit;            /* seconds for each entry of a table, all seeds together */
    unsigned seeds;          /* strategies that choose at random: the median of so many */
    const char *models;      /* the folder of other models */
    const char *const *only; /* names of models, or files; all if there are none */
    size_t only_count;
};

void trees_print(const struct trees_options *options);

#endif
