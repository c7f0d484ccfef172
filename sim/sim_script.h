/* SPDX-License-Identifier: 0BSD */
/*
 * Scripted input: the events of a text file, played on a clock. One event a
 * line, `#` begins a comment:
 *
 *     TIME CONTROL press
 *     TIME CONTROL release
 *     TIME CONTROL turn STEPS
 *     TIME CONTROL axis POSITION
 *
 * TIME: microseconds, never less than the line before. CONTROL: left right up
 * down in out select back knob1 knob2 knob3 axis-x axis-y axis-z, or a number
 * 0 .. 255. STEPS: -1000 .. 1000. POSITION: -32767 .. 32767.
 */
#ifndef OLDWELL_SIM_SCRIPT_H
#define OLDWELL_SIM_SCRIPT_H

#include <stdbool.h>
#include <stddef.h>

#include "hal/clock.h"
#include "hal/input.h"
#include "hal/wait.h"

#define SIM_SCRIPT_TIME_MAX UINT64_C(86400000000) /* a day */

struct sim_script {
    struct ow_input_event *events; /* malloc */
    size_t count;
    size_t next;                  /* the first one that was not given out yet */
    const struct ow_clock *clock; /* set by the caller before use; for waiting as well */
};

struct sim_script_error {
    long line; /* 0: of no line */
    char text[160];
};

/* Reads a script; false, and what is wrong where, if it is not one. */
bool sim_script_parse(struct sim_script *script, const char *text, size_t bytes,
                      struct sim_script_error *error);
void sim_script_free(struct sim_script *script);

/* Device of both: struct sim_script. Waiting ends at the next event. */
extern const struct ow_input_ops sim_script_input_ops;
extern const struct ow_wait_ops sim_script_wait_ops;

#endif
