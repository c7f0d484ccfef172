/* SPDX-License-Identifier: 0BSD */
/* Which faces that lie across a switch's plane may stay whole on one side of it. */
#ifndef OWC_OBSTRUCTION_WHOLE_H
#define OWC_OBSTRUCTION_WHOLE_H

#include <stdint.h>

#include "obstruction_faces.h"
#include "obstruction_plane.h"

/*
 * places[i]: where the plane n.x + offset = 0, n of length 1, puts faces[i].
 * Changes OBSTRUCTION_ACROSS to OBSTRUCTION_FRONT or OBSTRUCTION_BACK where
 * the face may stay whole there. Returns how many are left to cut.
 */
uint32_t obstruction_keep_whole(struct obstruction_set *set, const double normal[3], double offset,
                                const uint32_t *faces, uint32_t count, uint8_t *places);

#endif
