/* SPDX-License-Identifier: 0BSD */
/*
 * Reading the blob: the only place that knows how its bytes lie in memory.
 * Numbers may lie at any address. Where the machine has the blob's byte order,
 * a copy of known length says so best: it becomes one load.
 */
#ifndef OW_READ_H
#define OW_READ_H

#include <stdint.h>

#if defined(__GNUC__) && defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
#define OW_READ_COPIES
#endif

static inline uint32_t ow_read_u8(const uint8_t *bytes, uint32_t at)
{
    return bytes[at];
}

static inline int32_t ow_read_i8(const uint8_t *bytes, uint32_t at)
{
    return (int8_t)bytes[at];
}

static inline uint32_t ow_read_u16(const uint8_t *bytes, uint32_t at)
{
    const uint8_t *p = bytes + at; /* not at + 1: that could wrap, and the loads would not join */
#ifdef OW_READ_COPIES
    uint16_t value;
    __builtin_memcpy(&value, p, sizeof value);
    return value;
#else
    return (uint32_t)p[0] | (uint32_t)p[1] << 8;
#endif
}

static inline int32_t ow_read_i16(const uint8_t *bytes, uint32_t at)
{
    return (int16_t)ow_read_u16(bytes, at);
}

static inline uint32_t ow_read_u32(const uint8_t *bytes, uint32_t at)
{
    const uint8_t *p = bytes + at;
#ifdef OW_READ_COPIES
    uint32_t value;
    __builtin_memcpy(&value, p, sizeof value);
    return value;
#else
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
#endif
}

#endif
