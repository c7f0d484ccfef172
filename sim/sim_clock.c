/* SPDX-License-Identifier: 0BSD */
/* Clocks on the host. */
#include "sim_clock.h"

#include <errno.h>
#include <time.h>

static int virtual_now(void *device, uint64_t *time_us)
{
    const struct sim_clock *clock = device;
    *time_us = clock->now_us;
    return OW_OK;
}

static int virtual_sleep(void *device, uint64_t until_us)
{
    struct sim_clock *clock = device;
    if (until_us == OW_TIME_NEVER) {
        return OW_ARGUMENT;
    }
    if (until_us > clock->now_us) {
        clock->now_us = until_us;
    }
    return OW_OK;
}

const struct ow_clock_ops sim_virtual_clock_ops = { virtual_now, virtual_sleep };

uint64_t sim_host_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
}

static int host_now(void *device, uint64_t *time_us)
{
    (void)device;
    *time_us = sim_host_ns() / 1000;
    return OW_OK;
}

static int host_sleep(void *device, uint64_t until_us)
{
    (void)device;
    if (until_us == OW_TIME_NEVER) {
        return OW_ARGUMENT;
    }
    struct timespec until = {
        .tv_sec = (time_t)(until_us / 1000000),
        .tv_nsec = (long)(until_us % 1000000) * 1000,
    };
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL) == EINTR) {
    }
    return OW_OK;
}

const struct ow_clock_ops sim_host_clock_ops = { host_now, host_sleep };
