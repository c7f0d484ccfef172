/* SPDX-License-Identifier: 0BSD */
/* A progress bar on standard error: on a terminal only, and after a second. */
#ifndef OWC_PROGRESS_H
#define OWC_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

struct progress {
    bool enabled;
    bool shown;
    double begin; /* seconds */
    double last;
    uint32_t calls;
};

/* Seconds on a clock that only goes forward. */
double progress_clock(void);

/* wanted: false keeps it quiet in any case. */
void progress_begin(struct progress *progress, bool wanted);

/* done of all; cheap enough to call for each node. */
void progress_show(struct progress *progress, const char *what, uint64_t done, uint64_t all);

/* Removes the bar. */
void progress_end(struct progress *progress);

#endif
