/* SPDX-License-Identifier: 0BSD */
/* Small models: several strategies are tried, and the tree with the fewest polygons is kept. */
#ifndef OWC_SMALLEST_H
#define OWC_SMALLEST_H

#include <stdint.h>

#include "strategy.h"

enum { SMALLEST_MODEL = 5000 }; /* polygons up to which this is done */

/* Like strategy_build with METHOD_OBSTRUCTION; planes are the arrangement's. */
void smallest_build(struct tree *tree, struct arrangement *arrangement, struct planes *planes,
                    struct pieces *pieces, const struct mesh *mesh, const struct strategy *strategy,
                    struct progress *progress);

#endif
