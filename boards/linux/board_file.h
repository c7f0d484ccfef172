/* SPDX-License-Identifier: 0BSD */
/*
 * Board files: a setting a line, `name = value`; # begins a comment; blank
 * lines count for nothing. Names are those of the options. The last line of a
 * name counts.
 */
#ifndef OLDWELL_BOARDS_LINUX_BOARD_FILE_H
#define OLDWELL_BOARDS_LINUX_BOARD_FILE_H

#include <stdbool.h>
#include <stddef.h>

enum { BOARD_FILE_BYTES_MAX = 1 << 16 };

struct board_setting {
    const char *name; /* both end with a zero byte and lie in the text */
    const char *value;
    long line;
};

/*
 * Cuts the next setting out of a text: text[0 .. bytes-1], text[bytes] being
 * writable; it is changed. *at and *line begin with 0 and are moved on. True: a
 * setting is there. False: the end, or (*wrong not NULL) what is wrong in *line.
 */
bool board_file_next(char *text, size_t bytes, size_t *at, long *line,
                     struct board_setting *setting, const char **wrong);

#endif
