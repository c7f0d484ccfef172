/* SPDX-License-Identifier: 0BSD */
/* Writing the plane image. */
#include "planes.h"

#include <inttypes.h>

#include "tools/common/fail.h"

void planes_check(const struct blob *blob, const uint32_t size[2], const char *model)
{
    uint64_t room = (uint64_t)size[0] * size[1];
    if (blob->size > room) {
        fail(FAIL_INPUT, model, 0,
             "the tree has %" PRIu32 " bytes, planes of %" PRIu32 "x%" PRIu32 " hold %" PRIu64
             ": take larger ones, or a model with fewer polygons",
             (uint32_t)blob->size, size[0], size[1], room);
    }
}

void planes_write(FILE *stream, const struct blob *blob, const uint32_t size[2])
{
    uint64_t rest = (uint64_t)size[0] * size[1] - blob->size;
    fprintf(stream, "P5\n%" PRIu32 " %" PRIu32 "\n255\n", size[0], size[1]);
    fwrite(blob->bytes, 1, blob->size, stream);
    while (rest-- > 0) {
        fputc(0, stream);
    }
}
