/* SPDX-License-Identifier: 0BSD */
/* Runs a function in a child process and catches how it ends and what it prints. */
#define _XOPEN_SOURCE 700 /* mkdtemp, lstat */
#include "tests/unit/child.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static _Noreturn void broken(const char *what)
{
    perror(what);
    abort();
}

static void read_back(FILE *stream, char *text)
{
    rewind(stream);
    size_t length = fread(text, 1, CHILD_TEXT - 1, stream);
    text[length] = '\0';
    fclose(stream);
}

struct child_result child_run(void (*body)(void *context), void *context)
{
    struct child_result result = { .status = -1 };
    FILE *out = tmpfile();
    FILE *err = tmpfile();
    if (out == NULL || err == NULL) {
        broken("tmpfile");
    }
    fflush(NULL);
    pid_t child = fork();
    if (child < 0) {
        broken("fork");
    }
    if (child == 0) {
        dup2(fileno(out), STDOUT_FILENO);
        dup2(fileno(err), STDERR_FILENO);
        body(context);
        exit(0);
    }
    int status;
    if (waitpid(child, &status, 0) != child) {
        broken("waitpid");
    }
    if (WIFEXITED(status)) {
        result.status = WEXITSTATUS(status);
    } else {
        result.signal = WTERMSIG(status);
    }
    read_back(out, result.out);
    read_back(err, result.err);
    return result;
}

size_t child_lines(const char *text)
{
    size_t lines = 0;
    for (const char *at = text; *at != '\0'; at++) {
        lines += *at == '\n';
    }
    return lines;
}

void folder_make(char *path)
{
    const char *base = getenv("TMPDIR");
    int length = snprintf(path, CHILD_PATH, "%s/oldwell-test-XXXXXX", base != NULL ? base : "/tmp");
    if (length < 0 || length >= CHILD_PATH || mkdtemp(path) == NULL) {
        broken("mkdtemp");
    }
}

void folder_path(char *path, const char *folder, const char *name)
{
    if (snprintf(path, CHILD_PATH, "%s/%s", folder, name) >= CHILD_PATH) {
        broken("path");
    }
}

/* Calls unlink on each entry if asked to; returns how many there were. */
static size_t visit(const char *path, bool remove_them)
{
    DIR *folder = opendir(path);
    size_t count = 0;
    if (folder == NULL) {
        broken("opendir");
    }
    for (struct dirent *entry; (entry = readdir(folder)) != NULL;) {
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) {
            char name[CHILD_PATH];
            folder_path(name, path, entry->d_name);
            count++;
            if (remove_them && unlink(name) != 0) {
                (void)rmdir(name);
            }
        }
    }
    closedir(folder);
    return count;
}

void folder_remove(const char *path)
{
    visit(path, true);
    rmdir(path);
}

size_t folder_entries(const char *path)
{
    return visit(path, false);
}

bool folder_has(const char *path, const char *name)
{
    char full[CHILD_PATH];
    struct stat status;
    folder_path(full, path, name);
    return lstat(full, &status) == 0;
}
