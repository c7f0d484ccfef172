/* SPDX-License-Identifier: 0BSD */
/* The system calls, as they are. */
#define _GNU_SOURCE /* ppoll */
#include "hal/linux/system.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

static int real_open(const char *path, int flags)
{
    return open(path, flags | O_CLOEXEC, 0666);
}

static int real_ioctl(int fd, unsigned long request, void *argument)
{
    return ioctl(fd, request, argument);
}

static void *real_mmap(size_t bytes, int fd, uint64_t offset)
{
    return mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd, (off_t)offset);
}

static int real_poll(struct pollfd *fds, size_t count, const struct timespec *timeout)
{
    return ppoll(fds, (nfds_t)count, timeout, NULL);
}

static int real_now(struct timespec *now)
{
    return clock_gettime(CLOCK_MONOTONIC, now);
}

static int real_sleep(const struct timespec *until)
{
    return clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, until, NULL);
}

const struct linux_system linux_system = {
    .open = real_open,
    .close = close,
    .ioctl = real_ioctl,
    .mmap = real_mmap,
    .munmap = munmap,
    .read = read,
    .write = write,
    .poll = real_poll,
    .now = real_now,
    .sleep = real_sleep,
};

int linux_ioctl(const struct linux_system *system, int fd, unsigned long request, void *argument)
{
    int result;
    do {
        result = system->ioctl(fd, request, argument);
    } while (result < 0 && errno == EINTR);
    return result;
}
