/* SPDX-License-Identifier: 0BSD */
/* Figures of the last second, as one line of JSON on standard error. */
#ifndef OLDWELL_BOARDS_LINUX_STATS_H
#define OLDWELL_BOARDS_LINUX_STATS_H

#include <stdint.h>

#include "firmware/viewer/viewer.h"
#include "hal/linux/system.h"

struct stats {
    const struct linux_system *system;
    uint64_t began_us; /* the second */
    uint64_t cpu_us;   /* used by the process when it began */
    uint64_t draw_us;  /* spent drawing since then */
    uint64_t probe_us;
    uint64_t step_us; /* of the rounds that showed a frame, drawing included */
    uint32_t frames;
    uint64_t polygons_painted;
    uint64_t pixels_written;
};

void stats_begin(struct stats *stats, const struct linux_system *system);

/* The viewer's probe; context: struct stats. */
void stats_probe(void *context, enum ow_probe point);

/* Counts a frame that took step_us from the start of its round until it was shown. */
void stats_frame(struct stats *stats, const struct ow_viewer *viewer, uint64_t step_us);

/* Prints the line and begins anew. */
void stats_print(struct stats *stats);

#endif
