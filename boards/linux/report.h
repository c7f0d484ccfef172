/* SPDX-License-Identifier: 0BSD */
/* The doctor's findings: a line an item on standard output. */
#ifndef OLDWELL_BOARDS_LINUX_REPORT_H
#define OLDWELL_BOARDS_LINUX_REPORT_H

#include <stdio.h>

#include "hal/linux/fault.h"

struct report {
    FILE *stream;
    unsigned good;
    unsigned bad;
    int worst; /* status of the first failure; OW_OK: none */
};

/* `ok ITEM: text` */
void report_good(struct report *report, const char *item, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* `-- ITEM: text`: worth knowing, neither right nor wrong. */
void report_note(struct report *report, const char *item, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* `not ok ITEM: text`, which says what to do. */
void report_bad(struct report *report, int status, const char *item, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* The same from a driver's fault. */
void report_fault(struct report *report, const char *item, const struct linux_fault *fault);

#endif
