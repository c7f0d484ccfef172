/* SPDX-License-Identifier: 0BSD */
/*
 * Reading the blob: the only place that knows how its bytes lie in memory.
 * Compilers join the byte loads into one where the machine allows it.
 */
#ifndef OW_READ_H
#define OW_READ_H

#include <stdint.h>

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
    return (uint32_t)p[0] | (uint32_t)p[1] << 8;
}

static inline int32_t ow_read_i16(const uint8_t *bytes, uint32_t at)
{
    return (int16_t)ow_read_u16(bytes, at);
}

static inline uint32_t ow_read_u32(const uint8_t *bytes, uint32_t at)
{
    const uint8_t *p = bytes + at;
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

#endif
