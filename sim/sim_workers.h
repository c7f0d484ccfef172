/* SPDX-License-Identifier: 0BSD */
/* Workers on a host: a pool of POSIX threads that sleep between jobs. */
#ifndef SIM_WORKERS_H
#define SIM_WORKERS_H

#include <stdint.h>

#include "hal/workers.h"

struct sim_workers;

/* Starts count - 1 threads; the caller's is the first worker. NULL if the system refuses. */
struct sim_workers *sim_workers_start(uint32_t count);

/* The seam of a started pool. */
struct ow_workers sim_workers_seam(struct sim_workers *workers);

/* Ends the threads; none may be at work. NULL is nothing. */
void sim_workers_stop(struct sim_workers *workers);

#endif
