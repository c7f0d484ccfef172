/* SPDX-License-Identifier: 0BSD */
/* Runs a function in a child process and catches how it ends and what it prints. */
#ifndef OLDWELL_TESTS_UNIT_CHILD_H
#define OLDWELL_TESTS_UNIT_CHILD_H

#include <stdbool.h>
#include <stddef.h>

enum { CHILD_TEXT = 8192, CHILD_PATH = 512 };

struct child_result {
    int status;           /* exit status, or -1 if a signal ended it */
    int signal;           /* 0, or that signal */
    char out[CHILD_TEXT]; /* standard output, cut at the end, zero terminated */
    char err[CHILD_TEXT]; /* standard error */
};

/* Runs body(context), then exit(0), in a child; a failed set-up ends the test program. */
struct child_result child_run(void (*body)(void *context), void *context);

/* The number of '\n' in a text. */
size_t child_lines(const char *text);

/* A fresh folder for one test; `path` has room for CHILD_PATH bytes. */
void folder_make(char *path);

/* Removes the folder and the files in it (not folders below it). */
void folder_remove(const char *path);

/* The number of entries in the folder, hidden ones included. */
size_t folder_entries(const char *path);

/* True if the folder has an entry of this name; links are not followed. */
bool folder_has(const char *path, const char *name);

/* Writes folder/name into `path`. */
void folder_path(char *path, const char *folder, const char *name);

#endif
