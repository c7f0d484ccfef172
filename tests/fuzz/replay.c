/* SPDX-License-Identifier: 0BSD */
/*
 * Replays files through a fuzz target without libFuzzer: replay FILE-OR-FOLDER...
 * One `ok` line an operand; a target that finds something aborts. Status 1 if
 * an operand cannot be read or holds no file.
 */
#include <dirent.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "tests/fuzz/fuzz.h"

static bool replay_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    uint8_t *data = NULL;
    size_t size = 0, room = 0, got = 0;
    do {
        size += got;
        if (size == room) {
            room = 2 * room + 4096;
            data = realloc(data, room);
        }
        got = file && data ? fread(data + size, 1, room - size, file) : 0;
    } while (got > 0);
    bool good = file && data && !ferror(file);
    if (file) {
        fclose(file);
    }
    /* The target gets a block of exactly the file's size. */
    uint8_t *exact = good ? malloc(size ? size : 1) : NULL;
    if (exact) {
        memcpy(exact, data, size);
        printf("# %s\n", path);
        fflush(stdout); /* so that the last line names the file that aborts */
        (void)LLVMFuzzerTestOneInput(exact, size);
    }
    free(exact);
    free(data);
    return good;
}

/* Number of files replayed; -1 if something could not be read. */
static long replay(const char *path)
{
    struct stat info;
    if (stat(path, &info) != 0) {
        return -1;
    }
    if (!S_ISDIR(info.st_mode)) {
        return replay_file(path) ? 1 : -1;
    }
    DIR *folder = opendir(path);
    long count = folder ? 0 : -1;
    const struct dirent *entry;
    while (count >= 0 && (entry = readdir(folder)) != NULL) {
        char name[4096];
        int length = snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
        if (entry->d_name[0] == '.' || length < 0 || (size_t)length >= sizeof name) {
            continue;
        }
        count = replay_file(name) ? count + 1 : -1;
    }
    if (folder) {
        closedir(folder);
    }
    return count;
}

int main(int argc, char **argv)
{
    int status = argc < 2;
    for (int i = 1; i < argc; i++) {
        long count = replay(argv[i]);
        if (count > 0) {
            printf("ok %s: %ld files\n", argv[i], count);
        } else {
            printf("not ok %s: %s\n", argv[i], count == 0 ? "no files" : "cannot be read");
            status = 1;
        }
    }
    return status;
}
