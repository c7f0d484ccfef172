/* SPDX-License-Identifier: 0BSD */
/* Random small scenes on the lattice: crossing, touching, coplanar polygons and needles. */
#ifndef OLDWELL_TESTS_PROPERTY_SMALL_SCENE_H
#define OLDWELL_TESTS_PROPERTY_SMALL_SCENE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "tools/owc/lattice.h"
#include "tools/owc/model.h"

enum { SMALL_SCENE_POLYGONS = 12, SMALL_SCENE_CORNERS = 8 * SMALL_SCENE_POLYGONS };

/* Coordinates are lattice steps. */
struct small_scene {
    struct model model;
    struct lattice lattice;
    double vertices[SMALL_SCENE_CORNERS][3];
    float normals[SMALL_SCENE_CORNERS][3];
    uint32_t corners[SMALL_SCENE_CORNERS];
    struct model_polygon polygons[SMALL_SCENE_POLYGONS];
    /*
     * Coordinates are so small that each triangle's plane is exact, and
     * polygons that are near to coplanar are coplanar.
     */
    bool exact;
};

/* The same number gives the same scene. */
void small_scene_make(struct small_scene *scene, uint64_t number);

/* As an OBJ file. */
void small_scene_print(FILE *out, const struct small_scene *scene);

#endif
