/* SPDX-License-Identifier: 0BSD */
/* --bench: how long drawing takes, and what was drawn. */
#ifndef OLDWELL_BOARDS_SIM_BENCH_H
#define OLDWELL_BOARDS_SIM_BENCH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "firmware/viewer/viewer.h"
#include "settings.h"

enum { BENCH_PASSES_MAX = 1000 };

/* A pass draws every view once. */
struct bench {
    uint64_t begun_ns;
    uint64_t pass_ns; /* of drawing alone, in this pass */
    uint64_t started_ns;
    double ms_per_frame[BENCH_PASSES_MAX];
    double ms_memset[BENCH_PASSES_MAX]; /* of yard_bytes, after each pass */
    uint8_t *yard;
    size_t yard_bytes; /* of a frame */
    uint32_t passes;
};

/* The viewer's probe; context: struct bench. */
void bench_probe(void *context, enum ow_probe point);

/* Ends a pass of so many frames; true if another one is wanted (0: until a second is over). */
bool bench_end_pass(struct bench *bench, uint32_t frames, uint64_t wanted);

/* Prints the line of JSON on standard output. sum: counts of all frames of one pass. */
void bench_print(struct bench *bench, const struct settings *settings, uint32_t frames,
                 const struct ow_stats *sum, uint32_t crc);

#endif
