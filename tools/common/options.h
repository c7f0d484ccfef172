/* SPDX-License-Identifier: 0BSD */
/*
 * Command lines of the host programs, from one table of options per program.
 *
 * Accepted: `--name value`, `--name=value`, `-x value`, `-xvalue`, `--flag`; operands anywhere;
 * `--` ends the options; `-` is an operand or a value. A value may begin with '-'.
 * Names are written in full. If an option is given twice, the last one counts, but for lists.
 * `--help` and `--version` are always there: standard output, exit status 0.
 * Wrong options: one line and the usage on standard error, exit status 2.
 *
 *     static const char *const details[] = { "low", "high", NULL };
 *     const char *output = NULL;
 *     uint64_t count = 100;
 *     int detail = 0;
 *     const struct option_spec specs[] = {
 *         { "output", 'o', OPTION_STRING, &output, "FILE", "where to write" },
 *         { "count", 0, OPTION_UNSIGNED, &count, "N", "how many", .min = 1, .max = 1000 },
 *         { "detail", 0, OPTION_CHOICE, &detail, NULL, "how fine", .choices = details },
 *     };
 *
 * (One designator in each row keeps -Wmissing-field-initializers quiet.)
 */
#ifndef OLDWELL_TOOLS_COMMON_OPTIONS_H
#define OLDWELL_TOOLS_COMMON_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

/* What an option takes, and the type that `value` points to. */
enum option_kind {
    OPTION_FLAG,     /* nothing; bool, set to true */
    OPTION_STRING,   /* text; const char *; NULL is "none" */
    OPTION_UNSIGNED, /* decimal integer in [min, max]; uint64_t; max 0: no limit */
    OPTION_DOUBLE,   /* finite number in [min, max]; double; min = max = 0: no limits */
    OPTION_CHOICE,   /* one of `choices`; int, its index; -1 is "none" */
    OPTION_VECTOR,   /* x,y,z finite; double[3] */
    OPTION_LIST,     /* text, each time it is given; struct option_list; at most max, 0: all */
    OPTION_SIZE      /* WxH, both in [min, max] and at least 1; uint32_t[2]; max 0: 65535 */
};

enum { OPTION_LIST_MOST = 32 };

struct option_list {
    const char *text[OPTION_LIST_MOST];
    size_t count;
};

/*
 * One option. What *value holds before parsing is the default, and --help shows it; set
 * `no_default` where it means nothing.
 */
struct option_spec {
    const char *name; /* without the dashes */
    char letter;      /* short name, or 0 */
    enum option_kind kind;
    void *value;
    const char *argument;       /* what the help calls the value; NULL for flags and choices */
    const char *help;           /* one line, no final stop */
    const char *const *choices; /* ends with NULL */
    double min;                 /* integers up to 2^53 are exact */
    double max;
    bool *given; /* set to true if the option occurs; may be NULL */
    bool no_default;
};

/* A program's command line. */
struct option_table {
    const char *usage; /* what follows the program's name; lines are separated by '\n' */
    const char *about; /* printed above the table by --help; may be NULL */
    const struct option_spec *specs;
    size_t count;
    size_t min_operands;
    size_t max_operands;
    const char *notes; /* printed below the table by --help, ends with '\n'; may be NULL */
};

/*
 * Parses argv[1..]. Writes the operands (pointers into argv) to `operands`, which has room for
 * max_operands, and returns their number. Too many or too few operands are wrong usage.
 */
size_t options_parse(const struct option_table *table, int argc, char **argv,
                     const char **operands);

/*
 * Takes one setting of a file as the option of that name would, a flag with yes or no. Ends the
 * program with status 1 and a line that names the place if there is no such option or the value
 * is wrong. value is kept.
 */
void options_take(const struct option_table *table, const char *file, long line, const char *name,
                  const char *value);

/* Wrong usage that only the program can see: the line, the usage, exit status 2. */
_Noreturn void options_wrong(const struct option_table *table, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
