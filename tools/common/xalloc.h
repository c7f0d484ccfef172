/* SPDX-License-Identifier: 0BSD */
/*
 * Memory of the host programs. Nothing here returns NULL: when memory runs
 * out the program prints one line, removes unfinished files and exits with 1.
 */
#ifndef OLDWELL_TOOLS_COMMON_XALLOC_H
#define OLDWELL_TOOLS_COMMON_XALLOC_H

#include <stddef.h>

/* Memory for count elements of size bytes, not set. Never NULL, also for 0 elements. */
void *xalloc(size_t count, size_t size) __attribute__((returns_nonnull));

/* The same, all bytes zero. */
void *xalloc_zero(size_t count, size_t size) __attribute__((returns_nonnull));

/* Memory of another size with the old content; memory may be NULL. */
void *xresize(void *memory, size_t count, size_t size) __attribute__((returns_nonnull));

/*
 * An array that grows: makes room for needed elements, more than that when it
 * has to move, and keeps *capacity. Start with NULL and 0.
 */
void *xgrow(void *memory, size_t *capacity, size_t needed, size_t size)
    __attribute__((returns_nonnull));

#endif
