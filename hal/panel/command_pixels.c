/* SPDX-License-Identifier: 0BSD */
/* Command panel: a rectangle's pixels cut to the bus's transfers, mono turned into pages. */
#include "command_stages.h"

/* Where pixels are put together for a transfer. */
struct packing {
    struct ow_command_panel *device;
    uint8_t *bytes;
    uint32_t room;
    uint32_t filled;
    uint32_t *calls;
};

static int send(struct ow_command_panel *device, const uint8_t *bytes, uint32_t count,
                uint32_t *calls)
{
    const struct ow_bus *bus = device->config.bus;
    while (count > 0) {
        uint32_t part = count < device->chunk ? count : device->chunk;
        int status = bus->ops->pixels(bus->device, bytes, part);
        if (status < 0) {
            return status;
        }
        ++*calls;
        device->counts.bytes += part;
        bytes += part;
        count -= part;
    }
    return OW_OK;
}

/* Sends what was put together, and waits: the same memory takes what comes next. */
static int flush(struct packing *packing)
{
    if (packing->filled == 0) {
        return OW_OK;
    }
    int status = send(packing->device, packing->bytes, packing->filled, packing->calls);
    packing->filled = 0;
    return status < 0 ? status : command_wait_bus(packing->device, 0);
}

static int put(struct packing *packing, const uint8_t *bytes, uint32_t count)
{
    int status = OW_OK;
    for (uint32_t i = 0; i < count && status >= 0; i++) {
        packing->bytes[packing->filled++] = bytes[i];
        if (packing->filled == packing->room) {
            status = flush(packing);
        }
    }
    return status;
}

static int put_lines(struct packing *packing, const uint8_t *pixels, uint32_t stride,
                     uint32_t row_bytes, uint32_t lines)
{
    int status = OW_OK;
    for (uint32_t y = 0; y < lines && status >= 0; y++) {
        status = put(packing, pixels + y * stride, row_bytes);
    }
    return status;
}

/* 8 x 8 pixels: from a byte a line, leftmost highest, to a byte a column, topmost lowest. */
static void turn_block(uint8_t columns[8], const uint8_t *pixels, uint32_t stride)
{
    for (uint32_t x = 0; x < 8; x++) {
        uint32_t column = 0;
        for (uint32_t y = 0; y < 8; y++) {
            column |= ((uint32_t)pixels[y * stride] >> (7 - x) & 1) << y;
        }
        columns[x] = (uint8_t)column;
    }
}

static uint8_t mirrored(uint8_t byte)
{
    uint32_t b = byte;
    b = (b & 0x55) << 1 | (b & 0xAA) >> 1;
    b = (b & 0x33) << 2 | (b & 0xCC) >> 2;
    return (uint8_t)(b << 4 | b >> 4);
}

/* Pages: upright, 8 lines become one; turned, a byte of a line is a byte of a page. */
static int put_pages(struct packing *packing, const uint8_t *pixels, uint32_t stride,
                     uint32_t row_bytes, uint32_t lines)
{
    uint8_t columns[8];
    int status = OW_OK;
    if (packing->device->swap) {
        for (uint32_t y = 0; y < lines; y++) {
            for (uint32_t x = 0; x < row_bytes && status >= 0; x++) {
                columns[0] = mirrored(pixels[y * stride + x]);
                status = put(packing, columns, 1);
            }
        }
        return status;
    }
    for (uint32_t y = 0; y < lines; y += 8) {
        for (uint32_t x = 0; x < row_bytes && status >= 0; x++) {
            turn_block(columns, pixels + y * stride + x, stride);
            status = put(packing, columns, 8);
        }
    }
    return status;
}

/* Memory to put pixels together in; free of transfers under way. */
static int begin_packing(struct packing *packing)
{
    const struct ow_command_panel *device = packing->device;
    uint32_t room = device->config.staging_bytes / device->whole * device->whole;
    packing->bytes = device->config.staging;
    if (packing->bytes == NULL || room == 0) {
        packing->bytes = packing->device->convert;
        room = OW_COMMAND_PANEL_CONVERT;
    }
    packing->room = room < device->chunk ? room : device->chunk;
    return command_wait_bus(packing->device, 0);
}

int command_send_pixels(struct ow_command_panel *device, const struct ow_panel_rect *rect,
                        const uint8_t *pixels, uint32_t stride, uint32_t *calls)
{
    uint32_t row_bytes = ow_row_bytes(device->config.format, rect->width);
    struct packing packing = { .device = device, .calls = calls };
    bool pages = device->config.controller->row_lines > 1;
    if (!pages && row_bytes == stride) {
        return send(device, pixels, row_bytes * rect->height, calls);
    }
    bool packs = pages || (device->config.staging != NULL && rect->height > 1);
    int status = OW_OK;
    if (!packs) {
        for (uint32_t y = 0; y < rect->height && status >= 0; y++) {
            status = send(device, pixels + y * stride, row_bytes, calls);
        }
        return status;
    }
    status = begin_packing(&packing);
    if (status >= 0) {
        status = pages ? put_pages(&packing, pixels, stride, row_bytes, rect->height)
                       : put_lines(&packing, pixels, stride, row_bytes, rect->height);
    }
    status = status < 0 ? status : flush(&packing);
    *calls = 0; /* the packed bytes have left, and the caller's are not in use */
    return status;
}
