/* SPDX-License-Identifier: 0BSD */
/*
 * Random faces in a fixed order, and what it takes to draw them: for tests that
 * hold the core's picture against a picture made of its single stages.
 */
#ifndef OLDWELL_TESTS_UNIT_RANDOM_SCENE_H
#define OLDWELL_TESTS_UNIT_RANDOM_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "ow_frame.h"

struct random_scene {
    uint8_t *blob;
    uint32_t blob_bytes;
    struct ow_tree tree;
    struct ow_workspace workspace;
    void *memory;
    uint32_t memory_bytes;
};

uint32_t random_below(uint32_t n);

/*
 * count faces of 3 to 6 corners, in any position, in one sequence: an order
 * that no scene in space need have, but that every surface must keep to. Some
 * edges are marked; normals: vertex normals that vary.
 */
void random_scene_make(struct random_scene *scene, uint32_t count, bool normals);

/* A workspace for this, with a guard behind it. */
void random_scene_place(struct random_scene *scene, const struct ow_workspace_config *config);

void random_scene_free(struct random_scene *scene);

/* A view that sees all of the scene, near or far, parallel or in perspective, by its number. */
struct ow_view random_scene_view(const struct random_scene *scene, uint32_t number, uint16_t width,
                                 uint16_t height);

/* A look with light, in the given shade. */
struct ow_look random_scene_look(enum ow_shade shade);

/*
 * The corners of a face on the screen and, for smooth shading, their lights, without the
 * workspace's cache. Returns their count; no corner needs the clipper.
 */
uint32_t random_scene_outline(const struct random_scene *scene, const struct ow_view *view,
                              const struct ow_face *face, struct ow_outline_point *points);

#endif
