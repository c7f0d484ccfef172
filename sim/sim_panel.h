/* SPDX-License-Identifier: 0BSD */
/*
 * The simulator's panel: keeps what a glass would show, checks that its user
 * keeps to hal/panel.h, and fails when it is told to.
 */
#ifndef OLDWELL_SIM_PANEL_H
#define OLDWELL_SIM_PANEL_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/panel.h"
#include "image.h"

enum { SIM_PANEL_BUFFERS = 3, SIM_PANEL_QUEUE = 2 };

enum sim_panel_kind {
    SIM_PANEL_LENDS, /* lend and show */
    SIM_PANEL_TAKES, /* write and done */
    SIM_PANEL_BOTH
};

struct sim_panel;

struct sim_panel_config {
    uint16_t width; /* pixels */
    uint16_t height;
    const struct ow_pixel_format *format;
    enum sim_panel_kind kind;
    uint16_t align_x; /* 0 means 1 */
    uint16_t align_y;
    uint16_t buffers; /* lent in turn, 1 .. SIM_PANEL_BUFFERS; 0 means 1 */
    bool rotates;     /* can set the rotation */
    /*
     * Lending, one buffer: the last byte of each pixel holds these, line by line, and is only
     * to be read; the format says so. Lines are not padded then. NULL: nothing is kept.
     */
    const uint8_t *kept;
    uint32_t delay; /* a write is through after `done` was asked so often; 0: at once */
    /* Faults: every n-th call, and the n-th call, fail with fail_status; 0: none does. */
    uint32_t fail_every;
    uint32_t fail_at;
    int fail_status;
    /* Called for each whole frame; what it returns is what the last show or write returns. */
    int (*frame)(void *context, const struct sim_panel *panel);
    void *context;
};

struct sim_pending {
    struct ow_panel_rect rect;
    const uint8_t *pixels;
    uint32_t stride;
    bool last;
};

/* To be read by tests; only the config's faults and frame may be changed. */
struct sim_panel {
    struct sim_panel_config config;
    struct ow_panel panel; /* what the viewer is given */
    uint16_t width;        /* as the rotation has them */
    uint16_t height;
    uint8_t *screen; /* what is seen: packed rows without padding */
    uint32_t row_bytes;
    uint32_t calls;       /* of all functions */
    uint32_t failed;      /* calls that failed because they were told to */
    uint32_t frames;      /* whole frames shown */
    uint64_t pixels_sent; /* in rectangles shown or written */
    const char *wrong;    /* the first thing that its user did against the contract, or NULL */
    /* Lending. */
    uint8_t *buffers[SIM_PANEL_BUFFERS];
    uint32_t shown_at[SIM_PANEL_BUFFERS]; /* frame that each holds, 0: unknown */
    uint32_t buffer_stride;
    uint32_t next;
    bool lent;
    /* Writes that are not through. */
    struct sim_pending queue[SIM_PANEL_QUEUE];
    uint32_t pending;
    uint32_t asked;
};

/* False: out of memory, or sizes out of range. */
bool sim_panel_open(struct sim_panel *panel, const struct sim_panel_config *config);
void sim_panel_close(struct sim_panel *panel);

/* What is seen, as a picture. */
bool sim_panel_image(const struct sim_panel *panel, struct image *image, struct image_error *error);

/* With kept bytes: where the first of them lies, and how far apart they are. */
const uint8_t *sim_panel_kept(const struct sim_panel *panel, uint32_t *stride);

/* zlib's CRC-32 of what is seen, continued: packed rows, spare bits 0. */
uint32_t sim_panel_crc(const struct sim_panel *panel, uint32_t crc);

#endif
