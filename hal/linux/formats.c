/* SPDX-License-Identifier: 0BSD */
/* The core's formats with red and blue exchanged. */
#include "hal/linux/formats.h"

#include <string.h>

static uint32_t exchanged(uint32_t rgb)
{
    return (rgb & 0x00FF00u) | (rgb >> 16 & 0xFFu) | (rgb & 0xFFu) << 16;
}

static uint32_t bgr565_pack(uint32_t rgb)
{
    return ow_format_rgb565.pack(exchanged(rgb));
}

static uint32_t bgr565_unpack(uint32_t value)
{
    return exchanged(ow_format_rgb565.unpack(value));
}

static uint32_t bgr565_dither(uint32_t rgb, uint32_t threshold)
{
    return ow_format_rgb565.dither(exchanged(rgb), threshold);
}

static void bgr565_fill(uint8_t *row, uint32_t first, uint32_t end, uint32_t value)
{
    ow_format_rgb565.fill(row, first, end, value);
}

static void bgr565_store(uint8_t *row, uint32_t first, uint32_t end, const uint32_t *rgb)
{
    for (uint32_t x = first; x < end; x++) {
        uint16_t value = (uint16_t)bgr565_pack(rgb[x - first]);
        memcpy(row + (size_t)2 * x, &value, sizeof value);
    }
}

static uint32_t bgr565_get(const uint8_t *row, uint32_t x)
{
    return ow_format_rgb565.get(row, x);
}

const struct ow_pixel_format linux_format_bgr565 = {
    .name = "bgr565",
    .bits = 16,
    .used = 0xFFFF,
    .pack = bgr565_pack,
    .unpack = bgr565_unpack,
    .dither = bgr565_dither,
    .fill = bgr565_fill,
    .store = bgr565_store,
    .get = bgr565_get,
};

static void xbgr8888_fill(uint8_t *row, uint32_t first, uint32_t end, uint32_t value)
{
    ow_format_xrgb8888.fill(row, first, end, value);
}

static void xbgr8888_store(uint8_t *row, uint32_t first, uint32_t end, const uint32_t *rgb)
{
    for (uint32_t x = first; x < end; x++) {
        uint32_t value = exchanged(rgb[x - first]);
        memcpy(row + (size_t)4 * x, &value, sizeof value);
    }
}

static uint32_t xbgr8888_get(const uint8_t *row, uint32_t x)
{
    return ow_format_xrgb8888.get(row, x);
}

const struct ow_pixel_format linux_format_xbgr8888 = {
    .name = "xbgr8888",
    .bits = 32,
    .used = 0x00FFFFFF,
    .pack = exchanged,
    .unpack = exchanged,
    .fill = xbgr8888_fill,
    .store = xbgr8888_store,
    .get = xbgr8888_get,
};
