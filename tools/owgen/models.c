/* SPDX-License-Identifier: 0BSD */
/* The table of the models that the generator can make, with what each one promises. */
#include "tools/owgen/models.h"

#include <string.h>

#define OPEN (MODEL_FLAT | MODEL_CONVEX)
#define SOLIDS (MODEL_FLAT | MODEL_CONVEX | MODEL_CLOSED)
#define CONCAVE (MODEL_FLAT | MODEL_CLOSED | MODEL_APART)

/* Polygons at low and at high detail; the counts are those of [FAG83] and [CW96] where they have
   a model of the kind (atoms: about 1440 in the tree). */
/* clang-format off */
const struct model_kind model_kinds[] = {
    { "oldwell", model_oldwell, { 356, 1000 }, SOLIDS | MODEL_APART | MODEL_DETAIL,
      "the Old Well: a domed rotunda of eight columns around a well" },
    { "cubes", model_cubes, { 216, 216 }, SOLIDS | MODEL_APART,
      "three interlocking open cubes" },
    { "klein", model_klein, { 450, 450 }, 0,
      "the Klein bottle, of quadrilaterals that are bent" },
    { "ribbon", model_ribbon, { 368, 368 }, OPEN,
      "a plot of eight curves as ribbons, open and two-sided" },
    { "atoms", model_atoms, { 960, 960 }, SOLIDS,
      "three atoms of a molecule, overlapping" },
    { "robot", model_robot, { 258, 258 }, SOLIDS | MODEL_APART,
      "a robot arm with a gripper" },
    { "vise", model_vise, { 304, 304 }, CONCAVE,
      "a machinist's vise, with concave polygons and holes" },
    { "house", model_house, { 736, 736 }, CONCAVE,
      "a house, with concave polygons and holes cut through its walls" },
    { "random", model_random, { 0, 0 }, OPEN | MODEL_RANDOM,
      "random triangles in a cube of 1000 [GC91]" },
    { "parallel", model_parallel, { 0, 0 }, OPEN | MODEL_RANDOM,
      "random triangles in parallel planes in a cube of 1000 [GC91]" },
};
/* clang-format on */

const size_t model_kind_count = sizeof model_kinds / sizeof model_kinds[0];

const struct model_kind *model_find(const char *name)
{
    for (size_t i = 0; i < model_kind_count; i++) {
        if (strcmp(model_kinds[i].name, name) == 0) {
            return &model_kinds[i];
        }
    }
    return NULL;
}
