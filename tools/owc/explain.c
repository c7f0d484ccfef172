/* SPDX-License-Identifier: 0BSD */
/* Where polygons were split, and by what. */
#include "explain.h"

#include <stdlib.h>
#include <string.h>

#include "tools/common/xalloc.h"

void explain_cuts(FILE *out, const struct mesh *mesh, const struct pieces *pieces,
                  uint32_t cut_count, uint32_t plane_count)
{
    uint32_t *owner = xalloc_zero(plane_count, sizeof *owner); /* source numbers are from 1 */
    for (uint32_t i = mesh->polygon_count; i > 0; i--) {
        owner[mesh->polygons[i - 1].record] = mesh->polygons[i - 1].source;
    }
    for (uint32_t i = 0; i < cut_count; i++) {
        const struct piece_cut *cut = &pieces->cuts[i];
        uint32_t source = mesh->polygons[cut->polygon].source;
        if (owner[cut->plane] != 0) {
            fprintf(out, "polygon %u split by the plane of polygon %u\n", source,
                    owner[cut->plane]);
        } else {
            fprintf(out, "polygon %u split by a dividing plane\n", source);
        }
    }
    free(owner);
}
