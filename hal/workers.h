/* SPDX-License-Identifier: 0BSD */
/*
 * Workers: threads or cores that draw bands at the same time. The core knows
 * nothing of them; the viewer gives each a workspace of its own.
 */
#ifndef OW_HAL_WORKERS_H
#define OW_HAL_WORKERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "ow_status.h"

enum { OW_WORKERS_MAX = 64 };

struct ow_workers_ops {
    /*
     * Calls job(context, worker) once for each worker 0 .. count-1, at the same
     * time, the caller's thread being one of them, and returns when all have
     * returned. What the jobs wrote is then seen by the caller. Mandatory.
     */
    int (*run)(void *device, void (*job)(void *context, uint32_t worker), void *context);
};

struct ow_workers {
    const struct ow_workers_ops *ops;
    void *device;
    uint32_t count; /* 1 .. OW_WORKERS_MAX */
};

/* OW_UNSUPPORTED where a mandatory function is missing, OW_ARGUMENT for a count out of range. */
static inline int ow_workers_check(const struct ow_workers *workers)
{
    if (workers == NULL || workers->ops == NULL || workers->ops->run == NULL) {
        return OW_UNSUPPORTED;
    }
    return workers->count >= 1 && workers->count <= OW_WORKERS_MAX ? OW_OK : OW_ARGUMENT;
}

#endif
