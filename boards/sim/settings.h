/* SPDX-License-Identifier: 0BSD */
/* What owsim's command line asks for, checked as far as that is possible without the tree. */
#ifndef OLDWELL_BOARDS_SIM_SETTINGS_H
#define OLDWELL_BOARDS_SIM_SETTINGS_H

#include <stdbool.h>
#include <stdint.h>

#include "ow_draw.h"
#include "lights.h"
#include "sim/sim_panel.h"

struct settings {
    const char *tree; /* a file, or "-" */
    bool planes;      /* it is a plane image */
    uint32_t size[2]; /* pixels */
    bool has_size;

    /* Views: one by eye, a file of them, or the orbit. Model units and degrees. */
    double eye[3];
    double at[3];
    double up[3];
    bool has_eye;
    bool has_at;
    double fov;
    double parallel; /* 0: perspective */
    double near;     /* 0: the core's own */
    uint64_t orbit;  /* views of one turn */
    double elevation;
    const char *views;  /* file or NULL */
    const char *script; /* file or NULL */

    struct ow_look look;
    struct light_places light_places;
    double depth_cue[2]; /* model units; both 0: none */
    const struct ow_pixel_format *format;
    bool segments; /* the dynamic screen keeps lists, not bits */
    enum sim_panel_kind panel;
    uint32_t threads;
    bool cuts;
    double cut[4];       /* keeps where cut[0] x + cut[1] y + cut[2] z >= cut[3], model units */
    uint64_t band_lines; /* 0: all */

    const char *output; /* pattern, or "-", or NULL */
    const char *sheet;
    uint64_t columns;
    const char *gif;
    uint64_t interval_ms;
    bool stats;
    bool bench;
    uint64_t passes;     /* of the bench, 0: until the figures are steady */
    const char *compare; /* folder or NULL */
    const char *diff_dir;
    const char *dump_views;
};

/* The names that the options and --bench use. */
const char *order_name(enum ow_order order);
const char *shade_name(enum ow_shade shade);

/* Reads the command line; ends the program on wrong usage. */
void settings_read(struct settings *settings, int argc, char **argv);

/* Wrong usage that shows only when the tree is known: the line, the usage, exit status 2. */
_Noreturn void settings_wrong(const char *format, ...) __attribute__((format(printf, 1, 2)));

#endif
