/* SPDX-License-Identifier: 0BSD */
/* Command lines of the host programs: parsing, ranges, help and usage from one table. */
#include "tools/common/options.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/common/fail.h"
#include "tools/common/outfile.h"
#include "tools/common/version.h"

enum { HELP_COLUMN = 28, SIZE_LIMIT = 65535 };

/* Where options_take reads; NULL: the command line. */
static const char *place_file;
static long place_line;

static void print_usage(const struct option_table *table, FILE *stream)
{
    const char *line = table->usage;
    const char *lead = "usage:";
    while (*line != '\0') {
        size_t length = strcspn(line, "\n");
        fprintf(stream, "%s %s %.*s\n", lead, fail_program(), (int)length, line);
        lead = "      ";
        line += length + (line[length] == '\n');
    }
}

void options_wrong(const struct option_table *table, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (place_file != NULL) {
        fail(FAIL_INPUT, place_file, place_line, "%s", text);
    }
    outfile_discard_all();
    warn_line(NULL, 0, "%s", text);
    print_usage(table, stderr);
    fprintf(stderr, "       %s --help lists the options\n", fail_program());
    exit(FAIL_USAGE);
}

/* ---- help ---- */

static void print_default(const struct option_spec *spec)
{
    if (spec->no_default || spec->kind == OPTION_FLAG) {
        return;
    }
    const double *vector = spec->value;
    const uint32_t *size = spec->value;
    switch (spec->kind) {
    case OPTION_STRING:
        if (*(const char **)spec->value != NULL) {
            printf(" (%s)", *(const char **)spec->value);
        }
        break;
    case OPTION_UNSIGNED:
        printf(" (%" PRIu64 ")", *(const uint64_t *)spec->value);
        break;
    case OPTION_DOUBLE:
        printf(" (%g)", *(const double *)spec->value);
        break;
    case OPTION_CHOICE:
        if (*(const int *)spec->value >= 0) {
            printf(" (%s)", spec->choices[*(const int *)spec->value]);
        }
        break;
    case OPTION_VECTOR:
        printf(" (%g,%g,%g)", vector[0], vector[1], vector[2]);
        break;
    case OPTION_SIZE:
        printf(" (%" PRIu32 "x%" PRIu32 ")", size[0], size[1]);
        break;
    case OPTION_FLAG:
    case OPTION_LIST:
        break;
    }
}

/* Writes the choices as a|b|c, cut at the buffer's end. */
static void join_choices(const struct option_spec *spec, char *text, size_t bytes)
{
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; spec->choices[i] != NULL && used < bytes; i++) {
        int length =
            snprintf(text + used, bytes - used, "%s%s", i == 0 ? "" : "|", spec->choices[i]);
        used += length > 0 ? (size_t)length : 0;
    }
}

static void print_option(const struct option_spec *spec)
{
    char left[256];
    char what[160] = "";
    if (spec->kind == OPTION_CHOICE) {
        join_choices(spec, what, sizeof what);
    } else if (spec->argument != NULL) {
        snprintf(what, sizeof what, "%s", spec->argument);
    }
    char letter[5] = "    ";
    if (spec->letter != 0) {
        snprintf(letter, sizeof letter, "-%c, ", spec->letter);
    }
    int width = snprintf(left, sizeof left, "  %s--%s%s%s", letter, spec->name,
                         what[0] != '\0' ? " " : "", what);
    if (width < HELP_COLUMN) {
        printf("%-*s%s", HELP_COLUMN, left, spec->help);
    } else {
        printf("%s\n%*s%s", left, HELP_COLUMN, "", spec->help);
    }
    print_default(spec);
    putchar('\n');
}

/* Ends the program; standard output may be a full disk too. */
static _Noreturn void finish_output(void)
{
    outfile_commit(outfile_open("-"));
    exit(0);
}

static _Noreturn void print_help(const struct option_table *table)
{
    static const struct option_spec common[] = {
        { .name = "help", .kind = OPTION_FLAG, .help = "print this text" },
        { .name = "version", .kind = OPTION_FLAG, .help = "print the version" },
    };
    print_usage(table, stdout);
    if (table->about != NULL) {
        printf("\n%s\n", table->about);
    }
    printf("\nOptions (defaults in brackets):\n");
    for (size_t i = 0; i < table->count; i++) {
        print_option(&table->specs[i]);
    }
    print_option(&common[0]);
    print_option(&common[1]);
    if (table->notes != NULL) {
        printf("\n%s", table->notes);
    }
    finish_output();
}

/* ---- values ---- */

static bool read_unsigned(const char *text, char **end, uint64_t *value)
{
    if (text[0] < '0' || text[0] > '9') {
        return false;
    }
    errno = 0;
    unsigned long long number = strtoull(text, end, 10);
    *value = (uint64_t)number;
    return errno == 0 && number <= UINT64_MAX;
}

static bool read_double(const char *text, char **end, double *value)
{
    if (text[0] == '\0' || strchr("0123456789+-.", text[0]) == NULL) {
        return false;
    }
    *value = strtod(text, end);
    return *end != text && isfinite(*value);
}

static void take_unsigned(const struct option_table *table, const struct option_spec *spec,
                          const char *text)
{
    char *end;
    uint64_t value;
    double max = spec->max > 0 ? spec->max : 18446744073709551615.0;
    if (!read_unsigned(text, &end, &value) || *end != '\0' || (double)value < spec->min ||
        (double)value > max) {
        if (spec->max > 0) {
            options_wrong(table, "--%s takes a whole number from %.0f to %.0f, not '%s'",
                          spec->name, spec->min, spec->max, text);
        }
        options_wrong(table, "--%s takes a whole number from %.0f, not '%s'", spec->name, spec->min,
                      text);
    }
    *(uint64_t *)spec->value = value;
}

static void take_double(const struct option_table *table, const struct option_spec *spec,
                        const char *text)
{
    char *end;
    double value;
    bool limited = spec->min < spec->max;
    bool good = read_double(text, &end, &value) && *end == '\0';
    if (limited && (!good || value < spec->min || value > spec->max)) {
        options_wrong(table, "--%s takes a number from %g to %g, not '%s'", spec->name, spec->min,
                      spec->max, text);
    }
    if (!good) {
        options_wrong(table, "--%s takes a number, not '%s'", spec->name, text);
    }
    *(double *)spec->value = value;
}

static void take_choice(const struct option_table *table, const struct option_spec *spec,
                        const char *text)
{
    char all[512];
    for (int i = 0; spec->choices[i] != NULL; i++) {
        if (strcmp(text, spec->choices[i]) == 0) {
            *(int *)spec->value = i;
            return;
        }
    }
    join_choices(spec, all, sizeof all);
    options_wrong(table, "--%s takes one of %s, not '%s'", spec->name, all, text);
}

static void take_vector(const struct option_table *table, const struct option_spec *spec,
                        const char *text)
{
    double *vector = spec->value;
    const char *at = text;
    for (int i = 0; i < 3; i++) {
        char *end;
        double number;
        if (!read_double(at, &end, &number) || *end != (i < 2 ? ',' : '\0')) {
            options_wrong(table, "--%s takes three numbers x,y,z, not '%s'", spec->name, text);
        }
        vector[i] = number;
        at = end + 1;
    }
}

static void take_size(const struct option_table *table, const struct option_spec *spec,
                      const char *text)
{
    uint32_t *size = spec->value;
    const char *at = text;
    double min = spec->min > 1 ? spec->min : 1;
    double max = spec->max > 0 ? spec->max : SIZE_LIMIT;
    for (int i = 0; i < 2; i++) {
        char *end;
        uint64_t number;
        if (!read_unsigned(at, &end, &number) || *end != (i == 0 ? 'x' : '\0') ||
            (double)number < min || (double)number > max) {
            options_wrong(table, "--%s takes a size WxH from %.0f to %.0f each, not '%s'",
                          spec->name, min, max, text);
        }
        size[i] = (uint32_t)number;
        at = end + 1;
    }
}

static void take_item(const struct option_table *table, const struct option_spec *spec,
                      const char *text)
{
    struct option_list *list = spec->value;
    size_t most = spec->max > 0 ? (size_t)spec->max : OPTION_LIST_MOST;
    if (list->count == most) {
        options_wrong(table, "--%s can be given %zu times", spec->name, most);
    }
    list->text[list->count++] = text;
}

static void take_value(const struct option_table *table, const struct option_spec *spec,
                       const char *text)
{
    switch (spec->kind) {
    case OPTION_FLAG:
        *(bool *)spec->value = true;
        break;
    case OPTION_STRING:
        *(const char **)spec->value = text;
        break;
    case OPTION_UNSIGNED:
        take_unsigned(table, spec, text);
        break;
    case OPTION_DOUBLE:
        take_double(table, spec, text);
        break;
    case OPTION_CHOICE:
        take_choice(table, spec, text);
        break;
    case OPTION_VECTOR:
        take_vector(table, spec, text);
        break;
    case OPTION_SIZE:
        take_size(table, spec, text);
        break;
    case OPTION_LIST:
        take_item(table, spec, text);
        break;
    }
    if (spec->given != NULL) {
        *spec->given = true;
    }
}

/* ---- the arguments ---- */

static const struct option_spec *find_long(const struct option_table *table, const char *name,
                                           size_t length)
{
    for (size_t i = 0; i < table->count; i++) {
        const char *candidate = table->specs[i].name;
        if (strlen(candidate) == length && strncmp(candidate, name, length) == 0) {
            return &table->specs[i];
        }
    }
    return NULL;
}

static const struct option_spec *find_letter(const struct option_table *table, char letter)
{
    for (size_t i = 0; i < table->count; i++) {
        if (table->specs[i].letter == letter) {
            return &table->specs[i];
        }
    }
    return NULL;
}

/* Takes the option at argv[at]; returns the index of the next argument. */
static int take_option(const struct option_table *table, int argc, char **argv, int at)
{
    const char *argument = argv[at];
    bool is_long = argument[1] == '-';
    size_t length = is_long ? strcspn(argument + 2, "=") : 1;
    const struct option_spec *spec;
    const char *value = NULL;
    if (is_long) {
        spec = find_long(table, argument + 2, length);
        value = argument[2 + length] == '=' ? argument + 3 + length : NULL;
    } else {
        spec = find_letter(table, argument[1]);
        value = argument[2] != '\0' ? argument + 2 : NULL;
    }
    if (spec == NULL) {
        options_wrong(table, "unknown option '%s'", argument);
    }
    if (spec->kind == OPTION_FLAG) {
        if (value != NULL) {
            options_wrong(table, "--%s takes no value", spec->name);
        }
    } else if (value == NULL) {
        if (at + 1 >= argc) {
            options_wrong(table, "--%s needs a value", spec->name);
        }
        value = argv[++at];
    }
    take_value(table, spec, value);
    return at + 1;
}

void options_take(const struct option_table *table, const char *file, long line, const char *name,
                  const char *value)
{
    place_file = file;
    place_line = line;
    const struct option_spec *spec = find_long(table, name, strlen(name));
    if (spec == NULL) {
        options_wrong(table, "there is no setting '%s'", name);
    }
    if (spec->kind != OPTION_FLAG) {
        take_value(table, spec, value);
    } else if (strcmp(value, "yes") == 0 || strcmp(value, "no") == 0) {
        *(bool *)spec->value = value[0] == 'y';
    } else {
        options_wrong(table, "%s takes yes or no, not '%s'", name, value);
    }
    place_file = NULL;
}

size_t options_parse(const struct option_table *table, int argc, char **argv, const char **operands)
{
    size_t count = 0;
    bool options_end = false;
    int at = 1;
    while (at < argc) {
        const char *argument = argv[at];
        if (options_end || argument[0] != '-' || argument[1] == '\0') {
            if (count >= table->max_operands) {
                options_wrong(table, "unexpected argument '%s'", argument);
            }
            operands[count++] = argument;
            at++;
        } else if (strcmp(argument, "--") == 0) {
            options_end = true;
            at++;
        } else if (strcmp(argument, "--help") == 0) {
            print_help(table);
        } else if (strcmp(argument, "--version") == 0) {
            printf("%s %s\n", fail_program(), OLDWELL_VERSION);
            finish_output();
        } else {
            at = take_option(table, argc, argv, at);
        }
    }
    if (count < table->min_operands) {
        options_wrong(table, "an argument is missing");
    }
    return count;
}
