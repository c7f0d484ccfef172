/* SPDX-License-Identifier: 0BSD */
/* Clocks on the host: virtual time, which passes only when somebody sleeps, and the host's own. */
#ifndef OLDWELL_SIM_CLOCK_H
#define OLDWELL_SIM_CLOCK_H

#include "hal/clock.h"

struct sim_clock {
    uint64_t now_us;
};

/* Device: struct sim_clock, which starts at any time. */
extern const struct ow_clock_ops sim_virtual_clock_ops;

/* Device: none (NULL). The host's monotonic clock. */
extern const struct ow_clock_ops sim_host_clock_ops;

/* The host's monotonic clock in nanoseconds, for measuring. */
uint64_t sim_host_ns(void);

#endif
