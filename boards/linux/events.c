/* SPDX-License-Identifier: 0BSD */
/* Signals, changed files and seconds by signalfd, inotify and timerfd. */
#define _GNU_SOURCE
#include "events.h"

#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/inotify.h>
#include <sys/signalfd.h>
#include <sys/timerfd.h>
#include <unistd.h>

static void take_signals(void *context)
{
    struct events *events = context;
    struct signalfd_siginfo info;
    while (read(events->signals, &info, sizeof info) == (ssize_t)sizeof info) {
        if (info.ssi_signo == SIGHUP) {
            events->reload = true;
        } else {
            events->stop = true;
        }
    }
}

static void take_changes(void *context)
{
    struct events *events = context;
    _Alignas(struct inotify_event) char buffer[4096];
    ssize_t bytes;
    while ((bytes = read(events->watch, buffer, sizeof buffer)) > 0) {
        for (ssize_t at = 0; at < bytes;) {
            struct inotify_event event;
            memcpy(&event, buffer + at, sizeof event);
            const char *name = buffer + at + sizeof event;
            if ((event.mask & IN_Q_OVERFLOW) != 0 ||
                (event.len > 0 && strcmp(name, events->file) == 0)) {
                events->reload = true;
            }
            at += (ssize_t)(sizeof event + event.len);
        }
    }
}

static void take_second(void *context)
{
    struct events *events = context;
    uint64_t times;
    if (read(events->timer, &times, sizeof times) == (ssize_t)sizeof times) {
        events->second = true;
    }
}

bool events_open(struct events *events, struct linux_wait *wait)
{
    sigset_t set;
    *events = (struct events){ .wait = wait, .signals = -1, .watch = -1, .timer = -1 };
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    sigaddset(&set, SIGHUP);
    if (sigprocmask(SIG_BLOCK, &set, NULL) < 0) {
        return false;
    }
    signal(SIGPIPE, SIG_IGN);
    events->signals = signalfd(-1, &set, SFD_NONBLOCK | SFD_CLOEXEC);
    return events->signals >= 0 &&
           linux_wait_add(wait, events->signals, take_signals, events) == OW_OK;
}

void events_add_signals(struct events *events, struct linux_wait *wait)
{
    (void)linux_wait_add(wait, events->signals, take_signals, events);
}

bool events_watch(struct events *events, const char *path)
{
    char folder[PATH_MAX];
    const char *slash = strrchr(path, '/');
    size_t length = slash == NULL ? 0 : (size_t)(slash - path);
    if (length >= sizeof folder) {
        errno = ENAMETOOLONG;
        return false;
    }
    memcpy(folder, path, length);
    folder[length] = '\0';
    events->file = slash == NULL ? path : slash + 1;
    events->watch = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    if (events->watch < 0 || inotify_add_watch(events->watch,
                                               slash == NULL ? "."
                                               : length == 0 ? "/"
                                                             : folder,
                                               IN_CLOSE_WRITE | IN_MOVED_TO) < 0) {
        return false;
    }
    return linux_wait_add(events->wait, events->watch, take_changes, events) == OW_OK;
}

bool events_tick(struct events *events)
{
    const struct itimerspec each = { { 1, 0 }, { 1, 0 } };
    events->timer = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    return events->timer >= 0 && timerfd_settime(events->timer, 0, &each, NULL) == 0 &&
           linux_wait_add(events->wait, events->timer, take_second, events) == OW_OK;
}

void events_look(struct events *events)
{
    take_signals(events);
    if (events->watch >= 0) {
        take_changes(events);
    }
    if (events->timer >= 0) {
        take_second(events);
    }
}

static void end(struct events *events, int fd)
{
    if (fd >= 0) {
        linux_wait_remove(events->wait, fd);
        close(fd);
    }
}

void events_close(struct events *events)
{
    end(events, events->signals);
    end(events, events->watch);
    end(events, events->timer);
    events->signals = events->watch = events->timer = -1;
}
