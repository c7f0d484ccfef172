/* SPDX-License-Identifier: 0BSD */
/* CRC-32 as zlib computes it, four bits at a time: the table is 64 bytes of flash. */
#include "ow_tree.h"

static const uint32_t nibble_crc[16] = {
    0x00000000, 0x1DB71064, 0x3B6E20C8, 0x26D930AC, 0x76DC4190, 0x6B6B51F4, 0x4DB26158, 0x5005713C,
    0xEDB88320, 0xF00F9344, 0xD6D6A3E8, 0xCB61B38C, 0x9B64C2B0, 0x86D3D2D4, 0xA00AE278, 0xBDBDF21C,
};

static inline uint32_t add_byte(uint32_t crc, uint32_t byte)
{
    crc ^= byte;
    crc = (crc >> 4) ^ nibble_crc[crc & 15];
    return (crc >> 4) ^ nibble_crc[crc & 15];
}

uint32_t ow_crc32(uint32_t crc, const void *bytes, uint32_t size)
{
    const uint8_t *p = bytes;
    crc = ~crc;
    for (uint32_t i = 0; i < size; i++) {
        crc = add_byte(crc, p[i]);
    }
    return ~crc;
}

#if OW_STRIDE == 1
uint32_t ow_crc32_blob(uint32_t crc, const ow_byte *bytes, uint32_t size)
{
    return ow_crc32(crc, bytes, size);
}
#else
uint32_t ow_crc32_blob(uint32_t crc, const ow_byte *bytes, uint32_t size)
{
    crc = ~crc;
    for (uint32_t i = 0; i < size; i++) {
        crc = add_byte(crc, ow_read_u8(bytes, i));
    }
    return ~crc;
}
#endif
