/* SPDX-License-Identifier: 0BSD */
/* Looking ahead: into which components a switch's halves would fall. */
#ifndef OWC_OBSTRUCTION_AHEAD_H
#define OWC_OBSTRUCTION_AHEAD_H

#include <stdint.h>

#include "obstruction_faces.h"

/*
 * The sum of n log2 n over the components, of n faces each, into which the
 * faces fall on both sides of the plane n.x + offset = 0, n of length 1.
 * places[i]: where face i goes.
 */
double obstruction_bits_ahead(const struct obstruction_set *set, const double normal[3],
                              double offset, const uint8_t *places);

#endif
