/* SPDX-License-Identifier: 0BSD */
/* The views that owsim is to draw, from model units to the core's cameras. */
#ifndef OLDWELL_BOARDS_SIM_VIEWS_H
#define OLDWELL_BOARDS_SIM_VIEWS_H

#include <stdio.h>

#include "firmware/viewer/viewer.h"
#include "settings.h"
#include "tree_file.h"

struct views {
    struct ow_camera lens;  /* projection, fov or height, near */
    struct ow_camera *list; /* malloc; NULL: the orbit */
    uint32_t count;
};

/* A length in lattice units, 8 fraction bits; 0 where it is out of the core's range. */
ow_q8 length_q8(double length, const struct tree_file *tree);

/* Ends the program if a view cannot be made: status 2, or 1 for a wrong file of views. */
void views_make(struct views *views, const struct settings *settings, const struct tree_file *tree);
void views_free(struct views *views);

/* The viewer's callback; context: struct views. */
int views_give(void *context, uint32_t number, struct ow_camera *camera);

/* Writes one view's integers as a JSON object, without a line end. */
void views_dump(FILE *stream, uint32_t frame, const struct ow_view *view);

#endif
