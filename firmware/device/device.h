/* SPDX-License-Identifier: 0BSD */
/*
 * A device that shows a tree: the viewer's loop, a message on the panel where
 * there is no picture, and new trees over a stream. It never gives up: whatever
 * fails, the loop goes on and takes a new tree. No heap; the board gives memory
 * and devices.
 *
 * The stream takes the bytes of a .owt file as they are, and between files
 * commands of one letter:
 *   ?  print what is shown and what memory is used
 *   s  stop time; n: on to the next moment at which something happens; g: go on
 *   b  the built-in tree again
 */
#ifndef OW_DEVICE_H
#define OW_DEVICE_H

#include "firmware/viewer/viewer.h"
#include "hal/board.h"
#include "receive.h"

struct ow_device_config {
    /* The look, the orbit and the devices. tree is set by the device; clock, wait and panel
     * are mandatory. interval_us should not be 0. */
    struct ow_viewer_config viewer;
    const struct ow_board *board;   /* NULL: no log, no watchdog */
    const struct ow_stream *stream; /* NULL: no trees come */
    uint32_t watchdog_us;           /* 0: none */

    const void *tree; /* the built-in one */
    uint32_t tree_bytes;
    uint8_t *arena; /* for a tree that comes; aligned to 4 bytes */
    uint32_t arena_bytes;
    /*
     * Brings a tree, of the built-in one's or the arena's bytes, to where it is read, and returns
     * that place, or NULL if there is no room: for trees in bit planes. NULL: trees are read where
     * they are.
     */
    const void *(*place)(const void *tree, uint32_t bytes);
    void *memory; /* for the viewer and for messages; aligned to 8 bytes */
    uint32_t memory_bytes;

    uint32_t (*stack_used)(void); /* bytes; NULL: not known */
    uint32_t stack_bytes;
};

enum ow_device_state {
    OW_DEVICE_SHOWS,    /* the viewer runs */
    OW_DEVICE_RECEIVES, /* a tree is coming */
    OW_DEVICE_SAYS      /* a message says why nothing is shown */
};

/* Fields down to `status` are for reading, the rest is private. */
struct ow_device {
    enum ow_device_state state;
    int status; /* why, if it says something; or of the step before */

    struct ow_device_config config;
    struct ow_tree tree;
    struct ow_viewer viewer;
    struct receiver receiver;
    struct ow_clock clock; /* the viewer's: the board's, unless time is stopped */
    struct ow_wait wait;
    struct ow_input input;
    bool time_stopped;
    uint32_t moments; /* to go on to while time is stopped */
    uint64_t stopped_us;
    uint64_t behind_us; /* what the viewer's time is behind the board's */
    uint64_t again_us;  /* when a panel that failed is tried again */
    bool failed;        /* it did */
};

/* Starts with the built-in tree. The configuration is copied; what it points to stays. */
void ow_device_start(struct ow_device *device, const struct ow_device_config *config);

/* One round of the loop: takes bytes, draws, or sleeps. To be called for ever. */
void ow_device_step(struct ow_device *device);

#endif
