/* SPDX-License-Identifier: 0BSD */
/*
 * The run: a tree on a display until somebody stops it. Holds the viewer, and
 * what happens around it: new trees, failing devices, statistics.
 */
#ifndef OLDWELL_BOARDS_LINUX_RUN_H
#define OLDWELL_BOARDS_LINUX_RUN_H

#include "camera.h"
#include "controls.h"
#include "events.h"
#include "firmware/viewer/viewer.h"
#include "hal/linux/wait.h"
#include "output.h"
#include "settings.h"
#include "stats.h"
#include "tree.h"

struct run {
    const struct oldwell_settings *settings;
    const struct linux_system *system;
    struct linux_wait waiting;
    struct linux_wait quiet; /* signals alone: to sleep through all else */
    struct ow_wait wait;
    struct ow_clock clock;
    struct controls controls;
    struct events events;
    struct output output;
    struct camera camera;
    struct loaded_tree tree;
    struct ow_viewer viewer;
    void *memory; /* the viewer's; malloc */
    struct stats stats;
    uint64_t frame_us; /* the shortest time between two frames */
    uint64_t next_us;  /* no frame before that */
};

/* All of it: returns the program's exit status. */
int run_main(struct run *run, const struct oldwell_settings *settings,
             const struct linux_system *system);

/*
 * Reads the tree's file again and goes on with it where the eye is now. A bad
 * file is told and changes nothing. True: the new tree is in place.
 */
bool run_reload(struct run *run);

/* The exit status for a device's status. */
int run_exit_status(int status);

#endif
