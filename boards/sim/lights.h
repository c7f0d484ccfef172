/* SPDX-License-Identifier: 0BSD */
/* owsim's --light: directions and points, as text and in lattice units. */
#ifndef OLDWELL_BOARDS_SIM_LIGHTS_H
#define OLDWELL_BOARDS_SIM_LIGHTS_H

#include "ow_draw.h"
#include "tools/common/options.h"
#include "tree_file.h"

/* Points of light as they were given, in model units: only the tree can bring them into lattice
 * units. */
struct light_places {
    double place[OW_LIGHTS_MAX][3];
};

/*
 * Fills the look's lights from the option's texts, "x,y,z[,SHARE]" or "at:x,y,z[,SHARE]"; none
 * given: the usual one. share: of a light that says none. Ends the program on wrong usage.
 */
void lights_read(struct ow_look *look, struct light_places *places, const struct option_list *list,
                 double share, bool in_model);

/* Brings points of light into lattice units. */
void lights_scale(struct ow_look *look, const struct light_places *places,
                  const struct tree_file *tree);

#endif
