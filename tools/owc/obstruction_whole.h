/* SPDX-License-Identifier: 0BSD */
/* Which faces that lie across a switch's plane may stay whole on one side of it. */
#ifndef OWC_OBSTRUCTION_WHOLE_H
#define OWC_OBSTRUCTION_WHOLE_H

#include <stdint.h>

#include "obstruction_hierarchy.h"

struct keeper_face;

/* What planes for one set have in common. */
struct keeper {
    struct obstruction_set *set;
    bool lenient; /* there is a tolerance beyond the step */
    bool searching;
    struct hierarchy hierarchy; /* only if searching */
    uint32_t (*witnesses)[2];   /* of each face: who forbade it last to stay behind, in front */
    struct keeper_face *across;
    double normal[3]; /* the plane in question */
    double offset;
    uint8_t *places;
};

void keeper_begin(struct keeper *keeper, struct obstruction_set *set);
void keeper_free(struct keeper *keeper);

/*
 * places[i]: where the plane n.x + offset = 0, n of length 1, puts face i.
 * Changes OBSTRUCTION_ACROSS to OBSTRUCTION_FRONT or OBSTRUCTION_BACK where
 * the face may stay whole there. Returns how many are left to cut; gives up
 * when there are more than most.
 */
uint32_t keeper_keep(struct keeper *keeper, const double normal[3], double offset, uint8_t *places,
                     uint32_t most);

#endif
