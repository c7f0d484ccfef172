/* SPDX-License-Identifier: 0BSD */
/* The clock: microseconds since some fixed moment, never backwards. */
#ifndef OW_HAL_CLOCK_H
#define OW_HAL_CLOCK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "ow_status.h"

#define OW_TIME_NEVER UINT64_MAX /* as a time to wait for: no end */

struct ow_clock_ops {
    /* The time now, microseconds. Mandatory. */
    int (*now)(void *device, uint64_t *time_us);

    /* Sleeps until the time; returns at once if it is past. Not OW_TIME_NEVER. Mandatory. */
    int (*sleep)(void *device, uint64_t until_us);
};

struct ow_clock {
    const struct ow_clock_ops *ops;
    void *device;
};

/* OW_UNSUPPORTED where a mandatory function is missing. */
static inline int ow_clock_check(const struct ow_clock *clock)
{
    bool complete =
        clock != NULL && clock->ops != NULL && clock->ops->now != NULL && clock->ops->sleep != NULL;
    return complete ? OW_OK : OW_UNSUPPORTED;
}

#endif
