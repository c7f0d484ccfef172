/* SPDX-License-Identifier: 0BSD */
/* A progress bar on standard error. */
#include "progress.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

enum { BAR_WIDTH = 40, CALLS_BETWEEN_CLOCKS = 64 };

double progress_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

void progress_begin(struct progress *progress, bool wanted)
{
    *progress =
        (struct progress){ .enabled = wanted && isatty(STDERR_FILENO), .begin = progress_clock() };
}

void progress_show(struct progress *progress, const char *what, uint64_t done, uint64_t all)
{
    if (!progress->enabled || progress->calls++ % CALLS_BETWEEN_CLOCKS != 0) {
        return;
    }
    double now = progress_clock();
    if (now - progress->begin < 1 || now - progress->last < 0.1) {
        return;
    }
    double share = all > 0 ? (double)done / (double)all : 0;
    int full = (int)(share * BAR_WIDTH);
    fprintf(stderr, "\r%s [", what);
    for (int i = 0; i < BAR_WIDTH; i++) {
        fputc(i < full ? '#' : '.', stderr);
    }
    fprintf(stderr, "] %3d %%", (int)(share * 100));
    fflush(stderr);
    progress->last = now;
    progress->shown = true;
}

void progress_end(struct progress *progress)
{
    if (progress->shown) {
        fprintf(stderr, "\r\033[K");
        progress->shown = false;
    }
}
