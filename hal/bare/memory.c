/* SPDX-License-Identifier: 0BSD */
/*
 * The three functions that compilers expect of any library, for boards without
 * one. Words where addresses allow it.
 */
#include <stddef.h>
#include <stdint.h>

typedef uint32_t __attribute__((__may_alias__)) word;

void *memcpy(void *restrict to, const void *restrict from, size_t bytes);
void *memmove(void *to, const void *from, size_t bytes);
void *memset(void *to, int value, size_t bytes);

/* Compilers must not make calls of themselves out of these loops. */
#define NO_CALLS __attribute__((optimize("no-tree-loop-distribute-patterns")))

NO_CALLS void *memcpy(void *restrict to, const void *restrict from, size_t bytes)
{
    uint8_t *t = to;
    const uint8_t *f = from;
    if ((((uintptr_t)t | (uintptr_t)f) & 3) == 0) {
        for (; bytes >= 4; bytes -= 4, t += 4, f += 4) {
            *(word *)(void *)t = *(const word *)(const void *)f;
        }
    }
    while (bytes-- > 0) {
        *t++ = *f++;
    }
    return to;
}

NO_CALLS void *memmove(void *to, const void *from, size_t bytes)
{
    uint8_t *t = to;
    const uint8_t *f = from;
    if ((uintptr_t)t <= (uintptr_t)f) {
        return memcpy(to, from, bytes); /* it goes upwards */
    }
    while (bytes-- > 0) {
        t[bytes] = f[bytes];
    }
    return to;
}

NO_CALLS void *memset(void *to, int value, size_t bytes)
{
    uint8_t *t = to;
    for (; bytes > 0 && ((uintptr_t)t & 3) != 0; bytes--) {
        *t++ = (uint8_t)value;
    }
    word all = (uint8_t)value * 0x01010101u;
    for (; bytes >= 4; bytes -= 4, t += 4) {
        *(word *)(void *)t = all;
    }
    while (bytes-- > 0) {
        *t++ = (uint8_t)value;
    }
    return to;
}
