/* SPDX-License-Identifier: 0BSD */
/* Work shared among threads. */
#ifndef OWC_WORKERS_H
#define OWC_WORKERS_H

#include <stdint.h>

enum { WORKERS_MOST = 64 };

/*
 * Does jobs 0 .. count - 1, each once, in up to so many threads; the caller's
 * is thread 0. job(context, number, thread) must not depend on the others.
 */
void workers_run(uint32_t threads, uint32_t count,
                 void (*job)(void *context, uint32_t number, uint32_t thread), void *context);

/* The processors that there are, 1 .. WORKERS_MOST. */
uint32_t workers_processors(void);

#endif
