/* SPDX-License-Identifier: 0BSD */
/*
 * Error lines of the host programs.
 *
 * Every message is one line on standard error: `program: file:line: text`.
 * Parts that are missing are left out, control characters become '?'.
 * The text says what is wrong and, where it helps, what to do.
 */
#ifndef OLDWELL_TOOLS_COMMON_FAIL_H
#define OLDWELL_TOOLS_COMMON_FAIL_H

/* Exit statuses that all host programs share. */
enum fail_status {
    FAIL_INPUT = 1,   /* bad input or tree, output that cannot be written */
    FAIL_USAGE = 2,   /* wrong options */
    FAIL_ABSENT = 3,  /* device absent or busy */
    FAIL_DENIED = 4,  /* no permission for a device */
    FAIL_DEVICE = 5,  /* device failed after retries */
    FAIL_TIMEOUT = 6, /* time ran out */
    FAIL_REFUSED = 7  /* the other side refused: version, size, signature */
};

/* Sets the name that begins each line. The string must stay valid. Call it first in main. */
void fail_set_program(const char *name);

/* The name set last; "oldwell" before that. */
const char *fail_program(void);

/*
 * Discards all open output files, prints one line and exits with `status`.
 * `file` may be NULL; `line` 0 means that there is no line number.
 */
_Noreturn void fail(int status, const char *file, long line, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Prints one line in the same form and returns. */
void warn_line(const char *file, long line, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
