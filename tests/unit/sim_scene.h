/* SPDX-License-Identifier: 0BSD */
/* A scene for tests of the viewer and the simulator: a cube, six colours, and all that it needs. */
#ifndef OLDWELL_TESTS_UNIT_SIM_SCENE_H
#define OLDWELL_TESTS_UNIT_SIM_SCENE_H

#include "firmware/viewer/viewer.h"
#include "sim/sim_clock.h"
#include "sim/sim_panel.h"

enum { SCENE_WIDTH = 61, SCENE_HEIGHT = 47, SCENE_FRAMES = 32, SCENE_CANARY = 64 };

struct scene {
    uint8_t *blob;
    uint32_t blob_bytes;
    struct ow_tree tree;
    struct sim_panel panel;
    struct sim_clock time;
    struct ow_clock clock;
    struct ow_viewer_config config;
    struct ow_viewer viewer;
    uint8_t *memory; /* SCENE_CANARY bytes more than the viewer was given */
    uint32_t memory_bytes;
    uint32_t crc[SCENE_FRAMES]; /* of what was seen after each step that showed a frame */
    uint32_t frames;
};

/* The cube's blob, malloc'ed: sides 1 to 6, +-20000 lattice units. */
uint8_t *scene_cube(uint32_t *size);

/* Cube, panel and a configuration of one orbit view, SCENE_WIDTH x SCENE_HEIGHT. */
void scene_open(struct scene *scene, const struct sim_panel_config *panel);

/* The viewer, in memory of exactly the size it needs. Returns ow_viewer_start's status. */
int scene_start(struct scene *scene);

/* One step; notes the checksum of what is seen if it showed a frame. */
int scene_step(struct scene *scene);

/* Steps to the end; fails the test on any error. */
void scene_run(struct scene *scene);

/* Checks the memory behind the viewer's and frees everything. */
void scene_close(struct scene *scene);

#endif
