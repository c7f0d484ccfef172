/* SPDX-License-Identifier: 0BSD */
/* What owsim makes of the frames: pictures, a sheet, an animation, a checksum. */
#ifndef OLDWELL_BOARDS_SIM_OUTPUT_H
#define OLDWELL_BOARDS_SIM_OUTPUT_H

#include <stdbool.h>
#include <stdint.h>

#include "settings.h"
#include "sim/image.h"
#include "sim/sim_panel.h"
#include "tools/common/outfile.h"

enum { PATTERN_BYTES = 4096, PATTERN_DIGITS_MAX = 9 };

/* A file name with at most one number in it; never given to printf. */
struct pattern {
    char before[PATTERN_BYTES];
    char after[PATTERN_BYTES];
    bool numbered;
    uint32_t digits; /* at least so many, with zeros in front */
};

/*
 * Takes a name apart: %d or %0Nd (N 1 .. PATTERN_DIGITS_MAX) once at most, %%
 * for a percent sign, no other percent sign.
 */
bool pattern_read(struct pattern *pattern, const char *text, struct image_error *error);

/* Writes frame's name; false if bytes are too few. */
bool pattern_name(const struct pattern *pattern, uint32_t frame, char *name, size_t bytes);

struct output {
    const struct settings *settings;
    struct pattern pattern;
    const struct image_format *format; /* of the pictures */
    struct outfile *stream;            /* of -o - */
    struct outfile *sheet;
    struct outfile *gif;
    struct image *frames; /* kept for sheet and animation */
    uint32_t kept;
    uint32_t room;
    uint32_t count;  /* frames seen */
    uint32_t crc;    /* of all of them */
    uint32_t differ; /* frames that --compare found different */
    bool off;        /* frames are not looked at: a bench repeats them */
};

/* Opens what can be opened before the first frame; frames: how many will come, 0: unknown. */
void output_begin(struct output *output, const struct settings *settings, uint32_t frames);

/* The panel's frame callback; context: struct output. */
int output_frame(void *context, const struct sim_panel *panel);

/* Writes sheet and animation, commits everything. */
void output_end(struct output *output);

/* ---- compare.c ---- */

/*
 * Compares a frame with the picture of its name in the folder, says how many
 * pixels differ, and if any do (or there is no picture) writes NAME-actual and
 * NAME-diff. True if they are equal.
 */
bool compare_frame(const struct settings *settings, const char *name, const struct image *actual);

/* ---- output.c, for compare.c ---- */

/* Writes one picture file, whole or not at all. */
void write_picture(const char *file, const struct image_format *format, const struct image *image);

#endif
