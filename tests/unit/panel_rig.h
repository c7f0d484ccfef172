/* SPDX-License-Identifier: 0BSD */
/* A command panel on a simulated bus, with a frame of random pixels to be found on the glass. */
#ifndef OLDWELL_PANEL_RIG_H
#define OLDWELL_PANEL_RIG_H

#include "hal/panel/command_panel.h"
#include "sim/sim_bus.h"

enum { RIG_STAGING = 1000 };

/* What a test wants, zero for the usual. Names of the panel's config stand for themselves. */
struct rig_options {
    const char *controller;
    uint32_t rotation;  /* set through the panel, on top of the configuration's */
    uint32_t max_bytes; /* of a transfer */
    bool staging;
    uint32_t delay;
    bool no_reset;
    bool lends;
};

struct rig {
    struct sim_module module;
    struct sim_bus_config bus_config;
    struct ow_command_panel_config config;
    struct sim_bus bus;
    struct ow_command_panel device;
    struct ow_panel_info info;
    uint8_t *frame; /* what should be seen */
    uint8_t *lent;
    uint8_t *staging;
    uint32_t stride;
    uint32_t random;
};

/* Fills module, bus_config and config with the usual; the test may change them before it opens. */
void rig_begin(struct rig *rig, const struct rig_options *options);
/* Opens; fails the test on any error but those of injected faults. */
void rig_open(struct rig *rig, const struct rig_options *options);
void rig_close(struct rig *rig);

uint32_t rig_random(struct rig *rig, uint32_t below);

/* New random pixels inside a rectangle of the picture. */
void rig_scribble(struct rig *rig, const struct ow_panel_rect *rect);
struct ow_panel_rect rig_whole(const struct rig *rig);
/* A random rectangle that keeps to the panel's alignment. */
struct ow_panel_rect rig_rect(struct rig *rig);

/* Writes a rectangle of the picture in bands of so many lines (0: at once), waiting for each. */
int rig_write(struct rig *rig, const struct ow_panel_rect *rect, uint32_t lines);
/* Copies the picture to the lent frame and shows rectangles of it. */
int rig_show(struct rig *rig, const struct ow_panel_rect *rects, uint32_t count);

/* Fails unless the glass shows the picture, turned as it should be, and nobody complained. */
void rig_check(struct rig *rig);
/* Whether it does. */
bool rig_is_right(const struct rig *rig);

#endif
