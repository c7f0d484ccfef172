/* SPDX-License-Identifier: 0BSD */
/* The text of OBJ files: groups hidden from assimp, and numbers that are wrong found by line. */
#include "obj_text.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* A line that ends with a backslash goes on in the next one. */
static size_t next_line(const char *text, size_t size, size_t at, long *line)
{
    bool more = true;
    while (more && at < size) {
        const char *end = memchr(text + at, '\n', size - at);
        size_t length = end ? (size_t)(end - (text + at)) : size - at;
        size_t last = length;
        while (last > 0 && text[at + last - 1] == '\r') {
            last--;
        }
        more = last > 0 && text[at + last - 1] == '\\';
        at += length + (end ? 1 : 0);
        ++*line;
    }
    return at;
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t';
}

static size_t skip_blanks(const char *text, size_t at)
{
    while (is_blank(text[at])) {
        at++;
    }
    return at;
}

void obj_hide_groups(char *text, size_t size)
{
    long line = 0;
    for (size_t at = 0; at < size; at = next_line(text, size, at, &line)) {
        size_t word = skip_blanks(text, at);
        if (text[word] == 'g' || text[word] == 'o') {
            text[word] = '#';
        }
    }
}

/* The next word of a logical line; it may stand on the next physical one. */
static const char *next_word(const char *text)
{
    text += skip_blanks(text, 0);
    while (*text == '\\' && (text[1] == '\n' || text[1] == '\r')) {
        text += strcspn(text, "\n");
        text += *text == '\n';
        text += skip_blanks(text, 0);
    }
    return text;
}

static bool at_end(const char *text)
{
    return *text == '\0' || *text == '\n' || *text == '\r' || *text == '#';
}

static bool check_vertex(const char *text, long line, struct problem *problem)
{
    for (int i = 0; i < 3; i++) {
        text = next_word(text);
        char *end;
        double value = strtod(text, &end);
        if (at_end(text) || end == text) {
            return problem_set(problem, line, "a vertex needs three coordinates");
        }
        if (!isfinite((float)value)) {
            return problem_set(problem, line, "a coordinate is not a finite number");
        }
        text = end;
    }
    return true;
}

/* before: vertices above this line; all: vertices in the file. */
static bool check_corners(const char *text, long line, int64_t before, int64_t all,
                          struct problem *problem)
{
    for (;;) {
        text = next_word(text);
        if (at_end(text)) {
            return true;
        }
        char *end;
        long long number = strtoll(text, &end, 10);
        if (end == text) {
            return problem_set(problem, line, "a corner of a face is not a vertex number");
        }
        if (number == 0 || number > all || number < -before) {
            return problem_set(problem, line,
                               "a face refers to vertex %lld, but the file has %lld vertices",
                               number, (long long)all);
        }
        text = end + strcspn(end, " \t\r\n");
    }
}

bool obj_check(const char *text, size_t size, struct problem *problem)
{
    int64_t all = 0;
    long line = 1;
    for (size_t at = 0; at < size; at = next_line(text, size, at, &line)) {
        size_t word = skip_blanks(text, at);
        if (text[word] == 'v' && is_blank(text[word + 1])) {
            all++;
            if (!check_vertex(text + word + 1, line, problem)) {
                return false;
            }
        }
    }
    int64_t before = 0;
    line = 1;
    for (size_t at = 0; at < size; at = next_line(text, size, at, &line)) {
        size_t word = skip_blanks(text, at);
        bool follows = text[word] != '\0' && is_blank(text[word + 1]);
        before += text[word] == 'v' && follows;
        if (text[word] == 'f' && follows &&
            !check_corners(text + word + 1, line, before, all, problem)) {
            return false;
        }
    }
    return true;
}
