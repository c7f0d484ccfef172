/* SPDX-License-Identifier: 0BSD */
/*
 * Waiting: the one place where a loop sleeps. The board, which made the
 * devices, tells the waiting device their sources (file descriptors,
 * interrupts); who waits need not know them.
 */
#ifndef OW_HAL_WAIT_H
#define OW_HAL_WAIT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "ow_status.h"

struct ow_wait_ops {
    /*
     * Sleeps until a source is ready or until the time on the clock of
     * hal/clock.h (OW_TIME_NEVER: no end). Returns how many sources are ready, 0
     * when the time came. It may wake without reason: a positive count promises
     * nothing. OW_GONE: no source is left and no end was given. Mandatory.
     */
    int (*wait)(void *device, uint64_t until_us);
};

struct ow_wait {
    const struct ow_wait_ops *ops;
    void *device;
};

/* OW_UNSUPPORTED where a mandatory function is missing. */
static inline int ow_wait_check(const struct ow_wait *wait)
{
    bool complete = wait != NULL && wait->ops != NULL && wait->ops->wait != NULL;
    return complete ? OW_OK : OW_UNSUPPORTED;
}

#endif
