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

/* How many vertices, texture coordinates and normals there are, in the order of a/b/c. */
struct counts {
    int64_t of[3];
};

static const char *const count_names[] = { "vertex", "texture coordinate", "normal" };

/* Adds what a line that begins with this word declares. */
static void count_line(struct counts *counts, const char *word)
{
    int kind = word[0] != 'v'      ? -1
               : is_blank(word[1]) ? 0
               : word[1] == 't'    ? 1
               : word[1] == 'n'    ? 2
                                   : -1;
    if (kind == 0 || (kind > 0 && is_blank(word[2]))) {
        counts->of[kind]++;
    }
}

/* One corner a, a/b, a//c or a/b/c; *text moves behind it. */
static bool check_corner(const char **text, long line, const struct counts *before,
                         const struct counts *all, struct problem *problem)
{
    for (int kind = 0; kind < 3; kind++) {
        char *end;
        bool absent = kind > 0 && strchr("/ \t\r\n", **text) != NULL; /* also at the text's end */
        long long number = absent ? 0 : strtoll(*text, &end, 10);
        if (!absent && end == *text) {
            return problem_set(problem, line, "a corner of a face is not a %s number",
                               count_names[kind]);
        }
        if (!absent && (number == 0 || number > all->of[kind] || number < -before->of[kind])) {
            return problem_set(problem, line, "a face refers to %s %lld, but the file has %lld",
                               count_names[kind], number, (long long)all->of[kind]);
        }
        *text = absent ? *text : end;
        if (**text != '/') {
            break;
        }
        ++*text;
    }
    *text += strcspn(*text, " \t\r\n");
    return true;
}

/* A face, line or point: before: what stands above it; all: what there is in the file. */
static bool check_corners(const char *text, long line, const struct counts *before,
                          const struct counts *all, struct problem *problem)
{
    for (text = next_word(text); !at_end(text); text = next_word(text)) {
        if (!check_corner(&text, line, before, all, problem)) {
            return false;
        }
    }
    return true;
}

bool obj_check(const char *text, size_t size, struct problem *problem)
{
    struct counts all = { { 0, 0, 0 } };
    struct counts before = { { 0, 0, 0 } };
    long line = 1;
    for (size_t at = 0; at < size; at = next_line(text, size, at, &line)) {
        const char *word = text + skip_blanks(text, at);
        count_line(&all, word);
        if (word[0] == 'v' && is_blank(word[1]) && !check_vertex(word + 1, line, problem)) {
            return false;
        }
    }
    line = 1;
    for (size_t at = 0; at < size; at = next_line(text, size, at, &line)) {
        const char *word = text + skip_blanks(text, at);
        count_line(&before, word);
        if (word[0] != '\0' && strchr("flp", word[0]) != NULL && is_blank(word[1]) &&
            !check_corners(word + 1, line, &before, &all, problem)) {
            return false;
        }
    }
    return true;
}
