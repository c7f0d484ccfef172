/* SPDX-License-Identifier: 0BSD */
/* The text console that shares the screen: kept from drawing, and given back. */
#ifndef OW_HAL_LINUX_CONSOLE_H
#define OW_HAL_LINUX_CONSOLE_H

#include <stdbool.h>

#include "hal/linux/fault.h"
#include "hal/linux/system.h"

struct linux_console {
    struct linux_fault fault;
    const struct linux_system *system;
    int fd;     /* -1: there is none to look after */
    int before; /* KD_TEXT or KD_GRAPHICS */
};

/*
 * Finds the console and notes its mode; nothing changes yet. path: a terminal;
 * "auto": standard input if it is a virtual terminal, or else the one that is
 * seen; "none". OW_OK also where "auto" finds no console. OW_DENIED, OW_GONE,
 * OW_UNSUPPORTED (no virtual terminal), OW_BUS.
 */
int linux_console_open(struct linux_console *console, const struct linux_system *system,
                       const char *path);

/*
 * Takes an open console: no text is drawn and the cursor is hidden until it is
 * given back. OW_OK, or why not, as open does.
 */
int linux_console_take(struct linux_console *console);

/* As it was before. Any number of times, and by whichever process holds fd. */
void linux_console_give_back(struct linux_console *console);

#endif
