/* SPDX-License-Identifier: 0BSD */
/* The papers' figures: [FAG83] table 1, [CW96] table 7 and text. */
#include "papers.h"

#include <stddef.h>
#include <string.h>

static const struct paper papers[] = {
    { "oldwell-low", "bsp k=1", 356, 1125, 769, 0, 0 },
    { "oldwell-low", "bsp k=3", 356, 384, 28, 0, 0 },
    { "oldwell-low", "bsp k=5", 356, 378, 22, 0, 0 },
    { "oldwell-low", "bsp k=15", 356, 356, 0, 0, 0 },
    { "oldwell-high", "bsp k=1", 1000, 2426, 1426, 0, 0 },
    { "oldwell-high", "bsp k=3", 1000, 1304, 304, 0, 0 },
    { "oldwell-high", "bsp k=5", 1000, 1176, 176, 0, 0 },
    { "oldwell-high", "bsp k=15", 1000, 1032, 32, 0, 0 },
    { "cubes", "bsp k=1", 216, 402, 186, 0, 0 },
    { "cubes", "bsp k=3", 216, 279, 63, 0, 0 },
    { "cubes", "bsp k=5", 216, 263, 47, 0, 0 },
    { "cubes", "bsp k=15", 216, 240, 24, 0, 0 },
    { "ribbon", "bsp k=1", 368, 1478, 1110, 0, 0 },
    { "ribbon", "bsp k=3", 368, 929, 561, 0, 0 },
    { "ribbon", "bsp k=5", 368, 797, 429, 0, 0 },
    { "ribbon", "bsp k=15", 368, 860, 492, 0, 0 },
    { "klein", "bsp k=1", 450, 1475, 1025, 0, 0 },
    { "klein", "bsp k=3", 450, 1118, 668, 0, 0 },
    { "klein", "bsp k=5", 450, 1035, 585, 0, 0 },
    { "klein", "bsp k=15", 450, 990, 540, 0, 0 },
    { "robot", "bsp k=1", 258, 975, 717, 0, 0 },
    { "robot", "bsp k=3", 258, 650, 392, 0, 0 },
    { "robot", "bsp k=5", 258, 587, 329, 0, 0 },
    { "robot", "bsp k=15", 258, 440, 182, 0, 0 },
    { "vise", "bsp k=5", 304, 579, 275, 441, 28636 },
    { "vise", "feudal static", 304, 324, 20, 35, 63162 },
    { "vise", "feudal dynamic", 304, 324, 20, 70, 14234 },
    { "house", "bsp k=5", 736, 1290, 554, 1013, 84596 },
    { "house", "feudal static", 736, 741, 5, 55, 141942 },
    { "house", "feudal dynamic", 736, 741, 5, 135, 45744 },
};

const struct paper *paper_find(const char *model, const char *strategy)
{
    for (size_t i = 0; i < sizeof papers / sizeof papers[0]; i++) {
        if (strcmp(papers[i].model, model) == 0 && strcmp(papers[i].strategy, strategy) == 0) {
            return &papers[i];
        }
    }
    return NULL;
}
