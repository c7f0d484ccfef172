/* SPDX-License-Identifier: 0BSD */
/* What is wrong with the input, as text. */
#include "problem.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>

_Bool problem_set(struct problem *problem, long line, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    problem->line = line;
    vsnprintf(problem->text, sizeof problem->text, format, arguments);
    va_end(arguments);
    return false;
}
