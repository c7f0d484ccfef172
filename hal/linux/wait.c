/* SPDX-License-Identifier: 0BSD */
/* Waiting by poll. A source that hangs up is dropped: it would wake us for ever. */
#include "hal/linux/wait.h"

#include <errno.h>

#include "hal/clock.h"

enum { SECOND_US = 1000000, US_NS = 1000 };

void linux_wait_init(struct linux_wait *wait, const struct linux_system *system)
{
    *wait = (struct linux_wait){ .system = system };
}

int linux_wait_add(struct linux_wait *wait, int fd, void (*ready)(void *context), void *context)
{
    if (fd < 0) {
        return OW_OK;
    }
    if (wait->count == LINUX_WAIT_SOURCES) {
        return OW_CAPACITY;
    }
    wait->sources[wait->count++] = (struct linux_wait_source){ fd, ready, context };
    return OW_OK;
}

void linux_wait_remove(struct linux_wait *wait, int fd)
{
    for (uint32_t i = 0; i < wait->count; i++) {
        if (wait->sources[i].fd == fd) {
            wait->sources[i] = wait->sources[--wait->count];
            return;
        }
    }
}

/* What is left until then; 0 when it is past. */
static int time_left(const struct linux_wait *wait, uint64_t until_us, struct timespec *left)
{
    struct timespec now;
    if (wait->system->now(&now) != 0) {
        return OW_UNSUPPORTED;
    }
    uint64_t now_us = (uint64_t)now.tv_sec * SECOND_US + (uint64_t)now.tv_nsec / US_NS;
    uint64_t left_us = until_us > now_us ? until_us - now_us : 0;
    left->tv_sec = (time_t)(left_us / SECOND_US);
    left->tv_nsec = (long)(left_us % SECOND_US) * US_NS;
    return OW_OK;
}

/* Calls those that are ready. Their functions may add and remove sources. */
static void serve(struct linux_wait *wait, const struct pollfd *fds, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (fds[i].revents == 0) {
            continue;
        }
        struct linux_wait_source source = { .fd = -1 };
        for (uint32_t k = 0; k < wait->count; k++) {
            if (wait->sources[k].fd == fds[i].fd) {
                source = wait->sources[k];
            }
        }
        bool broken = (fds[i].revents & (POLLERR | POLLHUP | POLLNVAL)) != 0;
        if (broken && (fds[i].revents & POLLIN) == 0) {
            linux_wait_remove(wait, fds[i].fd);
        }
        if (source.ready != NULL) {
            source.ready(source.context);
        }
    }
}

static int poll_wait(void *device, uint64_t until_us)
{
    struct linux_wait *wait = device;
    struct pollfd fds[LINUX_WAIT_SOURCES];
    struct timespec left;
    uint32_t count = wait->count;
    if (count == 0 && until_us == OW_TIME_NEVER) {
        return OW_GONE;
    }
    if (until_us != OW_TIME_NEVER) {
        int status = time_left(wait, until_us, &left);
        if (status < 0) {
            return status;
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        fds[i] = (struct pollfd){ .fd = wait->sources[i].fd, .events = POLLIN };
    }
    int ready = wait->system->poll(fds, count, until_us == OW_TIME_NEVER ? NULL : &left);
    if (ready < 0) {
        return errno == EINTR ? 0 : OW_BUS;
    }
    if (ready > 0) {
        serve(wait, fds, count);
    }
    return ready;
}

const struct ow_wait_ops linux_wait_ops = { poll_wait };
