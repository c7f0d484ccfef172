/* SPDX-License-Identifier: 0BSD */
/* hal/wait.h by poll: file descriptors, each with a function that looks after it. */
#ifndef OW_HAL_LINUX_WAIT_H
#define OW_HAL_LINUX_WAIT_H

#include "hal/linux/system.h"
#include "hal/wait.h"

enum { LINUX_WAIT_SOURCES = 32 };

struct linux_wait_source {
    int fd;
    /* Called while waiting when fd is readable or broken; NULL: its owner will read it. */
    void (*ready)(void *context);
    void *context;
};

struct linux_wait {
    const struct linux_system *system;
    struct linux_wait_source sources[LINUX_WAIT_SOURCES];
    uint32_t count;
};

/* Device: struct linux_wait. A signal that is handled ends the wait. */
extern const struct ow_wait_ops linux_wait_ops;

void linux_wait_init(struct linux_wait *wait, const struct linux_system *system);

/* OW_CAPACITY: there are LINUX_WAIT_SOURCES already. A fd below 0 is not waited for. */
int linux_wait_add(struct linux_wait *wait, int fd, void (*ready)(void *context), void *context);

/* No more waiting for this one; to be called before it is closed. */
void linux_wait_remove(struct linux_wait *wait, int fd);

#endif
