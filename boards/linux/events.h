/* SPDX-License-Identifier: 0BSD */
/*
 * What comes from outside while the program runs: signals, a changed tree, a
 * second that has passed. Each is a file descriptor that the wait looks after,
 * and a flag.
 */
#ifndef OLDWELL_BOARDS_LINUX_EVENTS_H
#define OLDWELL_BOARDS_LINUX_EVENTS_H

#include <stdbool.h>

#include "hal/linux/wait.h"

struct events {
    bool stop;   /* SIGINT or SIGTERM came */
    bool reload; /* SIGHUP came, or the file changed: whoever acts on it clears it */
    bool second; /* likewise */
    struct linux_wait *wait;
    int signals;
    int watch;
    int timer;
    const char *file; /* name of the watched file in its folder */
};

/* Blocks the signals and begins to wait for them. False: errno says why. */
bool events_open(struct events *events, struct linux_wait *wait);

/* Has another wait end with a signal too. */
void events_add_signals(struct events *events, struct linux_wait *wait);

/* Watches a file for being written or replaced. False: it cannot be watched, errno says why. */
bool events_watch(struct events *events, const char *path);

/* Sets the flag `second` each second. */
bool events_tick(struct events *events);

/* Notes what has come without waiting. */
void events_look(struct events *events);

void events_close(struct events *events);

#endif
