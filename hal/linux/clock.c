/* SPDX-License-Identifier: 0BSD */
/* The monotonic clock in microseconds. */
#include "hal/linux/clock.h"

#include <errno.h>

enum { SECOND_US = 1000000, US_NS = 1000 };

static int clock_now(void *device, uint64_t *time_us)
{
    const struct linux_system *system = device;
    struct timespec now;
    if (system->now(&now) != 0) {
        return OW_UNSUPPORTED;
    }
    *time_us = (uint64_t)now.tv_sec * SECOND_US + (uint64_t)now.tv_nsec / US_NS;
    return OW_OK;
}

static int clock_sleep(void *device, uint64_t until_us)
{
    const struct linux_system *system = device;
    struct timespec until = { .tv_sec = (time_t)(until_us / SECOND_US),
                              .tv_nsec = (long)(until_us % SECOND_US) * US_NS };
    int error;
    if (until_us == OW_TIME_NEVER) {
        return OW_ARGUMENT;
    }
    do {
        error = system->sleep(&until);
    } while (error == EINTR);
    return error == 0 ? OW_OK : OW_UNSUPPORTED;
}

const struct ow_clock_ops linux_clock_ops = { clock_now, clock_sleep };
