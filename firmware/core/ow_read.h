/* SPDX-License-Identifier: 0BSD */
/*
 * Reading the blob: the only place that knows how its bytes lie in memory.
 * Numbers may lie at any address. Where the machine has the blob's byte order,
 * a copy of known length says so best: it becomes one load.
 */
#ifndef OW_READ_H
#define OW_READ_H

#include <stdint.h>

/*
 * A byte of the blob. OW_STRIDE, set for a whole program: the blob lies in bit
 * planes, its bytes so many bytes apart (4: the spare byte of 32-bit pixels; 3:
 * the third byte of 24-bit ones). Pointers to an ow_byte step over what lies
 * between, so the same source reads both.
 */
#ifndef OW_STRIDE
#define OW_STRIDE 1
#endif
#if OW_STRIDE == 1
typedef uint8_t ow_byte;
#define OW_VALUE(byte) (byte)
#else
typedef struct {
    uint8_t value[OW_STRIDE]; /* the first is the blob's */
} ow_byte;
#define OW_VALUE(byte) ((byte).value[0])
#endif

#if OW_STRIDE == 1 && defined(__GNUC__) && defined(__BYTE_ORDER__) && \
    __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
#define OW_READ_COPIES
#endif

static inline uint32_t ow_read_u8(const ow_byte *bytes, uint32_t at)
{
    return OW_VALUE(bytes[at]);
}

static inline int32_t ow_read_i8(const ow_byte *bytes, uint32_t at)
{
    return (int8_t)OW_VALUE(bytes[at]);
}

static inline uint32_t ow_read_u16(const ow_byte *bytes, uint32_t at)
{
    const ow_byte *p = bytes + at; /* not at + 1: that could wrap, and the loads would not join */
#ifdef OW_READ_COPIES
    uint16_t value;
    __builtin_memcpy(&value, p, sizeof value);
    return value;
#else
    return (uint32_t)OW_VALUE(p[0]) | (uint32_t)OW_VALUE(p[1]) << 8;
#endif
}

static inline int32_t ow_read_i16(const ow_byte *bytes, uint32_t at)
{
    return (int16_t)ow_read_u16(bytes, at);
}

static inline uint32_t ow_read_u32(const ow_byte *bytes, uint32_t at)
{
    const ow_byte *p = bytes + at;
#ifdef OW_READ_COPIES
    uint32_t value;
    __builtin_memcpy(&value, p, sizeof value);
    return value;
#else
    return (uint32_t)OW_VALUE(p[0]) | (uint32_t)OW_VALUE(p[1]) << 8 |
           (uint32_t)OW_VALUE(p[2]) << 16 | (uint32_t)OW_VALUE(p[3]) << 24;
#endif
}

#endif
