/* SPDX-License-Identifier: 0BSD */
/*
 * The system calls that the drivers in this folder make, as a table: a test
 * puts its own in the place of any of them. All behave as the calls that they
 * are named for: -1 and errno for a failure.
 */
#ifndef OW_HAL_LINUX_SYSTEM_H
#define OW_HAL_LINUX_SYSTEM_H

#include <poll.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>
#include <time.h>

struct linux_system {
    int (*open)(const char *path, int flags); /* O_CLOEXEC is added */
    int (*close)(int fd);
    int (*ioctl)(int fd, unsigned long request, void *argument);
    void *(*mmap)(size_t bytes, int fd, uint64_t offset); /* shared, to read and write */
    int (*munmap)(void *memory, size_t bytes);
    ssize_t (*read)(int fd, void *bytes, size_t count);
    ssize_t (*write)(int fd, const void *bytes, size_t count);
    int (*poll)(struct pollfd *fds, size_t count,
                const struct timespec *timeout); /* NULL: no end */
    int (*now)(struct timespec *now);            /* CLOCK_MONOTONIC */
    int (*sleep)(const struct timespec *until);  /* likewise; 0 or an error number */
};

/* The real ones. */
extern const struct linux_system linux_system;

/* ioctl, again where a signal came between. */
int linux_ioctl(const struct linux_system *system, int fd, unsigned long request, void *argument);

#endif
