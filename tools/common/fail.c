/* SPDX-License-Identifier: 0BSD */
/* Error lines of the host programs: one line on standard error, then exit. */
#include "tools/common/fail.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/common/outfile.h"

/* Long enough for a path and a sentence; what is longer is cut. */
enum { LINE_BYTES = 6144 };

static const char *program_name = "oldwell";

void fail_set_program(const char *name)
{
    program_name = name;
}

const char *fail_program(void)
{
    return program_name;
}

/* Appends to `line` at `*used`, never past LINE_BYTES - 1. */
static void append(char *line, size_t *used, const char *format, va_list arguments)
    __attribute__((format(printf, 3, 0)));

static void append(char *line, size_t *used, const char *format, va_list arguments)
{
    size_t room = LINE_BYTES - *used;
    int length = vsnprintf(line + *used, room, format, arguments);
    if (length > 0) {
        *used += (size_t)length < room ? (size_t)length : room - 1;
    }
}

static void append_text(char *line, size_t *used, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void append_text(char *line, size_t *used, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    append(line, used, format, arguments);
    va_end(arguments);
}

static void print_line(const char *file, long number, const char *format, va_list arguments)
    __attribute__((format(printf, 3, 0)));

static void print_line(const char *file, long number, const char *format, va_list arguments)
{
    char line[LINE_BYTES];
    size_t used = 0;
    append_text(line, &used, "%s: ", program_name);
    if (file != NULL && number > 0) {
        append_text(line, &used, "%s:%ld: ", file, number);
    } else if (file != NULL) {
        append_text(line, &used, "%s: ", file);
    }
    append(line, &used, format, arguments);
    for (size_t i = 0; i < used; i++) {
        unsigned char byte = (unsigned char)line[i];
        if (byte < 0x20 || byte == 0x7f) {
            line[i] = '?';
        }
    }
    fprintf(stderr, "%.*s\n", (int)used, line);
}

void fail(int status, const char *file, long line, const char *format, ...)
{
    va_list arguments;
    outfile_discard_all();
    va_start(arguments, format);
    print_line(file, line, format, arguments);
    va_end(arguments);
    exit(status);
}

void warn_line(const char *file, long line, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_line(file, line, format, arguments);
    va_end(arguments);
}
