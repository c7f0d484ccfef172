/* SPDX-License-Identifier: 0BSD */
/* Trees read back from files. */
#include "blob_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ow_read.h"
#include "tools/common/fail.h"
#include "tools/common/xalloc.h"

static uint8_t *read_bytes(const char *path, uint32_t *size)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        fail(FAIL_INPUT, path, 0, "cannot be read: %s", strerror(errno));
    }
    uint8_t *bytes = NULL;
    size_t capacity = 0;
    size_t used = 0;
    size_t got;
    do {
        bytes = xgrow(bytes, &capacity, used + 65536, 1);
        got = fread(bytes + used, 1, capacity - used, file);
        used += got;
    } while (got > 0 && used <= OW_MAX_BLOB_BYTES);
    if (ferror(file)) {
        fail(FAIL_INPUT, path, 0, "cannot be read: %s", strerror(errno));
    }
    fclose(file);
    if (used > OW_MAX_BLOB_BYTES) {
        fail(FAIL_INPUT, path, 0, "is larger than a tree can be (%d bytes)", OW_MAX_BLOB_BYTES);
    }
    *size = (uint32_t)used;
    return bytes;
}

static double read_double(const uint8_t *bytes, size_t at)
{
    uint32_t where = (uint32_t)at;
    uint64_t bits = ow_read_u32(bytes, where) | (uint64_t)ow_read_u32(bytes, where + 4) << 32;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

void blob_file_open(struct blob_file *file, const char *path)
{
    uint32_t size;
    file->bytes = read_bytes(path, &size);
    enum ow_status status = ow_tree_open(&file->tree, file->bytes, size);
    if (status != OW_OK) {
        fail(FAIL_INPUT, path, 0, "%s", ow_status_text(status));
    }
    for (size_t i = 0; i < 3; i++) {
        file->lattice.origin[i] =
            read_double(file->bytes, offsetof(struct ow_disk_header, origin_bits) + 8 * i);
    }
    file->lattice.step = read_double(file->bytes, offsetof(struct ow_disk_header, step_bits));
    file->tolerance_q8 =
        ow_read_u32(file->bytes, (uint32_t)offsetof(struct ow_disk_header, tolerance_q8));
    if (!(file->lattice.step > 0)) {
        fail(FAIL_INPUT, path, 0, "does not say how long a lattice step is");
    }
}

void blob_file_close(struct blob_file *file)
{
    free(file->bytes);
    file->bytes = NULL;
}
