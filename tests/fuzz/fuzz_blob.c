/* SPDX-License-Identifier: 0BSD */
/*
 * Fuzz target: any bytes as a blob. They get the right checksum, so that the
 * fuzzer reaches what lies behind it; the blob is then opened, walked and drawn.
 */
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

#include "ow_blob.h"
#include "tests/property/blob_builder.h"
#include "tests/property/blob_exercise.h"

enum { MOST_BYTES = 1 << 16 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size > MOST_BYTES) {
        return 0;
    }
    uint8_t *bytes = calloc(size ? size : 1, 1);
    if (bytes == NULL) {
        return 0;
    }
    if (size > 0) {
        memcpy(bytes, data, size);
    }
    (void)blob_exercise(bytes, (uint32_t)size); /* as it is: the checksum first */
    if (size >= sizeof(struct ow_disk_header)) {
        blob_seal(bytes, (uint32_t)size);
        (void)blob_exercise(bytes, (uint32_t)size);
    }
    free(bytes);
    return 0;
}
