/* SPDX-License-Identifier: 0BSD */
/*
 * The store: a few slots of equal size that keep their bytes without power
 * (flash, a file). Erased bytes read as 0xFF. A byte is programmed at most once
 * between two erasures of its block. Power may fail during any call: then the
 * bytes that the call was to change are undefined, and no others.
 */
#ifndef OW_HAL_STORE_H
#define OW_HAL_STORE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "ow_status.h"

struct ow_store_slots {
    uint32_t count;         /* slots are numbered 0 .. count-1 */
    uint32_t slot_bytes;    /* a multiple of erase_bytes */
    uint32_t erase_bytes;   /* what is erased at once */
    uint32_t program_bytes; /* programming starts and ends at multiples of this, >= 1 */
    const uint8_t *mapped;  /* slot 0 in the address space, the others behind it; NULL: use read */
};

struct ow_store_ops {
    /* Fills *slots, which stay. Mandatory. */
    int (*slots)(void *device, struct ow_store_slots *slots);

    /* Erases bytes at .. at+count-1 of a slot, both multiples of erase_bytes. Mandatory. */
    int (*erase)(void *device, uint32_t slot, uint32_t at, uint32_t count);

    /*
     * Programs erased bytes; at and count are multiples of program_bytes. The
     * bytes are the caller's again when it returns. OW_FULL: the disk is full;
     * OW_BUS: the device says that it failed. Mandatory.
     */
    int (*program)(void *device, uint32_t slot, uint32_t at, const void *bytes, uint32_t count);

    /* Reads bytes at .. at+count-1 of a slot. Mandatory. */
    int (*read)(void *device, uint32_t slot, uint32_t at, void *bytes, uint32_t count);

    /* Returns when all that was programmed and erased will outlast a power failure. Mandatory. */
    int (*sync)(void *device);
};

struct ow_store {
    const struct ow_store_ops *ops;
    void *device;
};

/* OW_UNSUPPORTED where a mandatory function is missing. */
static inline int ow_store_check(const struct ow_store *store)
{
    bool complete = store != NULL && store->ops != NULL && store->ops->slots != NULL &&
                    store->ops->erase != NULL && store->ops->program != NULL &&
                    store->ops->read != NULL && store->ops->sync != NULL;
    return complete ? OW_OK : OW_UNSUPPORTED;
}

#endif
