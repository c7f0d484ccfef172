/* SPDX-License-Identifier: 0BSD */
/* Memory of the host programs: allocation that ends the program when there is none. */
#include "tools/common/xalloc.h"

#include <stdint.h>
#include <stdlib.h>

#include "tools/common/fail.h"

static _Noreturn void out_of_memory(size_t count, size_t size)
{
    fail(FAIL_INPUT, NULL, 0, "out of memory (asked for %zu elements of %zu bytes)", count, size);
}

void *xresize(void *memory, size_t count, size_t size)
{
    if (size > 0 && count > PTRDIFF_MAX / size) {
        out_of_memory(count, size);
    }
    size_t bytes = count * size;
    void *result = realloc(memory, bytes > 0 ? bytes : 1);
    if (result == NULL) {
        out_of_memory(count, size);
    }
    return result;
}

void *xalloc(size_t count, size_t size)
{
    return xresize(NULL, count, size);
}

void *xalloc_zero(size_t count, size_t size)
{
    void *result = calloc(count > 0 ? count : 1, size > 0 ? size : 1);
    if (result == NULL) {
        out_of_memory(count, size);
    }
    return result;
}

void *xgrow(void *memory, size_t *capacity, size_t needed, size_t size)
{
    if (needed <= *capacity && memory != NULL) {
        return memory;
    }
    size_t more = *capacity + *capacity / 2 + 16;
    *capacity = needed > more ? needed : more;
    return xresize(memory, *capacity, size);
}
