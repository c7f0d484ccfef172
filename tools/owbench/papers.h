/* SPDX-License-Identifier: 0BSD */
/* What the papers' own trees came to [FAG83, CW96]. */
#ifndef OWBENCH_PAPERS_H
#define OWBENCH_PAPERS_H

struct paper {
    const char *model;
    const char *strategy;
    double input;
    double output;
    double splits;
    double switches;  /* 0: the paper does not say */
    double relations; /* likewise */
};

/* NULL: there is none. */
const struct paper *paper_find(const char *model, const char *strategy);

#endif
