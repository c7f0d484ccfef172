/* SPDX-License-Identifier: 0BSD */
/* The doctor's lines. */
#include "report.h"

#include <stdarg.h>

enum { TEXT_BYTES = 600 };

static void print(const struct report *report, const char *mark, const char *item,
                  const char *format, va_list arguments) __attribute__((format(printf, 4, 0)));

static void print(const struct report *report, const char *mark, const char *item,
                  const char *format, va_list arguments)
{
    fprintf(report->stream, "%s %s: ", mark, item);
    vfprintf(report->stream, format, arguments);
    fputc('\n', report->stream);
    fflush(report->stream);
}

void report_good(struct report *report, const char *item, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print(report, "ok", item, format, arguments);
    va_end(arguments);
    report->good++;
}

void report_note(struct report *report, const char *item, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print(report, "--", item, format, arguments);
    va_end(arguments);
}

void report_bad(struct report *report, int status, const char *item, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print(report, "not ok", item, format, arguments);
    va_end(arguments);
    report->bad++;
    report->worst = report->worst == OW_OK ? status : report->worst;
}

void report_fault(struct report *report, const char *item, const struct linux_fault *fault)
{
    char text[TEXT_BYTES];
    linux_fault_text(fault, text, sizeof text);
    report_bad(report, fault->status, item, "%s", text);
}
