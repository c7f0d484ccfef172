/* SPDX-License-Identifier: 0BSD */
/* What went wrong last with a device: which one, in which call, why, and what to do. */
#ifndef OW_HAL_LINUX_FAULT_H
#define OW_HAL_LINUX_FAULT_H

#include <stddef.h>

#include "ow_status.h"

struct linux_fault {
    char device[128]; /* its path or name */
    char call[48];    /* open, FBIOPAN_DISPLAY, ... */
    char why[160];    /* the error in words */
    char remedy[200]; /* what to do; may be empty */
    int status;       /* OW_OK: nothing went wrong yet */
};

/* The status that an error number stands for; OW_BUS for all that are not known. */
int linux_status_of(int number);

/*
 * Notes that a call on a device failed with an error number, and the usual
 * remedy. Returns the status.
 */
int linux_fault_errno(struct linux_fault *fault, const char *device, const char *call, int number);

/* Notes a failure that has no error number. call may be NULL. Returns status. */
int linux_fault_note(struct linux_fault *fault, int status, const char *device, const char *call,
                     const char *why, const char *remedy);

/* Replaces the remedy. */
void linux_fault_remedy(struct linux_fault *fault, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* One line without a line end: `DEVICE: CALL: why, what to do`; cut at bytes. */
void linux_fault_text(const struct linux_fault *fault, char *text, size_t bytes);

#endif
