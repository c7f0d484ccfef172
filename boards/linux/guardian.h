/* SPDX-License-Identifier: 0BSD */
/*
 * The guardian: a process that does nothing but give the console back when the
 * one that draws has ended, in whatever way.
 */
#ifndef OLDWELL_BOARDS_LINUX_GUARDIAN_H
#define OLDWELL_BOARDS_LINUX_GUARDIAN_H

#include "hal/linux/console.h"

/*
 * Has a child take the open console and do the work, and returns its exit status
 * when the console has been given back. SIGINT, SIGTERM, SIGQUIT and SIGHUP go
 * on to the child; after five seconds without effect it is killed. A child that
 * a signal ended is reported as 128 + its number, the signal in *signal (0:
 * none). If the guardian itself is killed, the child stops and gives the console
 * back. To be called before there are threads.
 */
int guardian_run(struct linux_console *console, int (*work)(void *context), void *context,
                 int *signal);

#endif
