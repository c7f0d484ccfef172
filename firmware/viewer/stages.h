/* SPDX-License-Identifier: 0BSD */
/* The viewer's stages, for each other: input.c -> view.c -> present.c, called by viewer.c. */
#ifndef OW_VIEWER_STAGES_H
#define OW_VIEWER_STAGES_H

#include "viewer.h"

enum {
    NAP_US = 1000,       /* between two questions to a device that says AGAIN */
    IDLE_US = 10000,     /* without a waiting device: between two looks at the input */
    TIMEOUT_US = 1000000 /* the default */
};

/* input.c: takes the events that are there and repeats held buttons up to now_us. */
int viewer_take_input(struct ow_viewer *viewer, uint64_t now_us);

/* view.c: fills viewer->view for the present number, turn, tilt and zoom. */
int viewer_make_view(struct ow_viewer *viewer);

/* present.c: draws viewer->view and shows it. */
int viewer_present(struct ow_viewer *viewer);

/* viewer.c: sleeps until the time or until a source is ready. */
int viewer_sleep_until(struct ow_viewer *viewer, uint64_t until_us);

#endif
