/* SPDX-License-Identifier: 0BSD */
/* Board files, line by line. */
#include "board_file.h"

#include <string.h>

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/* Cuts blanks off both ends; the text ends where `end` is. */
static char *trim(char *text, char *end)
{
    while (text < end && is_blank(*text)) {
        text++;
    }
    while (end > text && is_blank(end[-1])) {
        end--;
    }
    *end = '\0';
    return text;
}

static bool name_is_sound(const char *name)
{
    return name[0] != '\0' && strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789-") == strlen(name);
}

/* What is wrong with a line that is not empty; NULL: nothing. */
static const char *cut_line(char *text, char *end, struct board_setting *setting)
{
    char *equals = memchr(text, '=', (size_t)(end - text));
    if (equals == NULL) {
        return "a setting is a line `name = value`";
    }
    setting->name = trim(text, equals);
    setting->value = trim(equals + 1, end);
    if (!name_is_sound(setting->name)) {
        return "a setting's name has small letters, digits and '-'";
    }
    return setting->value[0] == '\0' ? "the value is missing" : NULL;
}

bool board_file_next(char *text, size_t bytes, size_t *at, long *line,
                     struct board_setting *setting, const char **wrong)
{
    *wrong = NULL;
    while (*at < bytes) {
        char *start = text + *at;
        char *end = memchr(start, '\n', bytes - *at);
        end = end != NULL ? end : text + bytes;
        *at = (size_t)(end - text) + 1;
        (*line)++;
        if (memchr(start, '\0', (size_t)(end - start)) != NULL) {
            *wrong = "there is a zero byte, this is no text";
            return false;
        }
        char *comment = memchr(start, '#', (size_t)(end - start));
        end = comment != NULL ? comment : end;
        start = trim(start, end);
        if (*start == '\0') {
            continue;
        }
        *wrong = cut_line(start, start + strlen(start), setting);
        setting->line = *line;
        return *wrong == NULL;
    }
    return false;
}
