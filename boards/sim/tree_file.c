/* SPDX-License-Identifier: 0BSD */
/* Reading and opening a tree's file. */
#include "tree_file.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ow_read.h"
#include "planes_file.h"
#include "tools/common/fail.h"

enum { FIRST_BYTES = 1 << 16 };

/* Reads to the end; one byte more than max_bytes shows that the file is too large. */
static char *read_stream(FILE *stream, const char *name, size_t max_bytes, size_t *bytes)
{
    size_t capacity = FIRST_BYTES;
    char *memory = malloc(capacity);
    *bytes = 0;
    while (memory != NULL) {
        *bytes += fread(memory + *bytes, 1, capacity - *bytes, stream);
        if (ferror(stream)) {
            int error = errno;
            free(memory);
            fail(FAIL_INPUT, name, 0, "cannot read: %s", strerror(error));
        }
        if (*bytes > max_bytes) {
            free(memory);
            fail(FAIL_INPUT, name, 0, "the file is larger than %zu bytes", max_bytes);
        }
        if (*bytes < capacity) {
            return memory;
        }
        capacity *= 2;
        char *larger = realloc(memory, capacity);
        if (larger == NULL) {
            free(memory);
        }
        memory = larger;
    }
    fail(FAIL_INPUT, name, 0, "not enough memory to read the file");
}

void *read_whole_file(const char *file, const char *name, size_t max_bytes, size_t *bytes)
{
    bool standard = strcmp(file, "-") == 0;
    FILE *stream = standard ? stdin : fopen(file, "rb");
    if (stream == NULL) {
        fail(FAIL_INPUT, name, 0, "cannot read: %s", strerror(errno));
    }
    char *memory = read_stream(stream, name, max_bytes, bytes);
    if (!standard) {
        fclose(stream);
    }
    return memory;
}

static double read_double(const uint8_t *bytes, size_t at)
{
    uint64_t low = ow_read_u32(bytes, (uint32_t)at);
    uint64_t high = ow_read_u32(bytes, (uint32_t)at + 4);
    uint64_t bits = high << 32 | low;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* The core has no floating point and does not look at these fields. */
static void read_lattice(struct tree_file *file, const uint8_t *blob)
{
    bool good = true;
    for (size_t i = 0; i < 3; i++) {
        file->origin[i] = read_double(blob, offsetof(struct ow_disk_header, origin_bits) + 8 * i);
        good = good && isfinite(file->origin[i]);
    }
    file->step = read_double(blob, offsetof(struct ow_disk_header, step_bits));
    if (!good || !isfinite(file->step) || !(file->step > 0)) {
        fail(FAIL_INPUT, file->name, 0,
             "the header's origin or step is not a sound number, "
             "compile the model again");
    }
}

static const char *remedy(enum ow_status status)
{
    switch (status) {
    case OW_MAGIC:
        return ", compile the model with owc first";
    case OW_TRUNCATED:
    case OW_CHECKSUM:
    case OW_CORRUPT:
        return ", copy or compile it again";
    default:
        return "";
    }
}

/* Opens the tree in these bytes. */
static void open_blob(struct tree_file *file, const uint8_t *blob, uint32_t bytes)
{
    enum ow_status status = ow_tree_open(&file->tree, blob, bytes);
    if (status != OW_OK) {
        fail(FAIL_INPUT, file->name, 0, "%s%s", ow_status_text(status), remedy(status));
    }
    read_lattice(file, blob);
}

static size_t read_file(struct tree_file *file, const char *name)
{
    size_t bytes;
    *file = (struct tree_file){ .name = strcmp(name, "-") == 0 ? "standard input" : name };
    file->bytes = read_whole_file(name, file->name, OW_MAX_BLOB_BYTES, &bytes);
    if (bytes == 0) {
        fail(FAIL_INPUT, file->name, 0, "the file is empty");
    }
    return bytes;
}

void tree_file_open(struct tree_file *file, const char *name)
{
    size_t bytes = read_file(file, name);
    open_blob(file, file->bytes, (uint32_t)bytes);
}

void tree_file_open_planes(struct tree_file *file, const char *name)
{
    size_t bytes = read_file(file, name);
    size_t head = planes_file_head(file->bytes, bytes, file->planes_size);
    if (head == 0) {
        fail(FAIL_INPUT, file->name, 0,
             "this is no whole plane image (a binary PGM), make one with owc --planes");
    }
    file->planes = (const uint8_t *)file->bytes + head;
    open_blob(file, file->planes, file->planes_size[0] * file->planes_size[1]);
}

void tree_file_close(struct tree_file *file)
{
    free(file->bytes);
    *file = (struct tree_file){ 0 };
}
