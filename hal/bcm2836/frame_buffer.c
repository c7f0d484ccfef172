/* SPDX-License-Identifier: 0BSD */
/* The frame buffer: the firmware is asked for it through its mailbox and lends pages of it. */
#include "hal/bcm2836/cache.h"
#include "hal/bcm2836/chip.h"
#include "hal/bcm2836/registers.h"

enum {
    TAG_BUFFER = 0x40001,
    TAG_STRIDE = 0x40008,
    TAG_SIZE = 0x48003,
    TAG_VIRTUAL_SIZE = 0x48004,
    TAG_BITS = 0x48005,
    TAG_ORDER = 0x48006,
    TAG_ALPHA = 0x48007,
    TAG_OFFSET = 0x48009,
    ALPHA_IGNORED = 2,
    SPARE_PIXELS = 16, /* pages are turned only if lines are longer than the picture as well */
    WORDS = 48
};

/* A message: its bytes, its state, tags, 0. */
static uint32_t message[WORDS] __attribute__((aligned(64)));
static uint32_t words;

static void begin(void)
{
    words = 2;
    message[1] = 0;
}

/* A tag and its values; returns where the answers will be. */
static const volatile uint32_t *tag(uint32_t name, uint32_t first, uint32_t second, uint32_t count)
{
    message[words] = name;
    message[words + 1] = 4 * count;
    message[words + 2] = 0;
    message[words + 3] = first;
    message[words + 4] = second; /* the next tag, or the end, if count is 1 */
    words += 3 + count;
    return &message[words - count];
}

static bool answered(void)
{
    message[words] = 0;
    message[0] = 4 * (words + 1);
    cache_clean(message, sizeof message);
    while (MAILBOX_STATUS & MAILBOX_FULL) {
    }
    MAILBOX_WRITE = (uint32_t)(uintptr_t)message | MAILBOX_UNCACHED | MAILBOX_PROPERTIES;
    uint32_t answer;
    do {
        while (MAILBOX_STATUS & MAILBOX_EMPTY) {
        }
        answer = MAILBOX_READ;
    } while ((answer & 15) != MAILBOX_PROPERTIES);
    cache_clean(message, sizeof message); /* nothing is written back: none of it was written */
    return message[1] == 0x80000000u;
}

int chip_frame_buffer_open(struct chip_frame_buffer *device)
{
    uint32_t lines = (uint32_t)device->height * device->pages;
    uint32_t wide = device->width + (device->pages > 1 ? SPARE_PIXELS : 0u);
    /* In the firmware's words: of 32 bits by the bytes in memory, of 16 by the word. */
    uint32_t red_highest = device->format->bits == 16 ? 1 : 0;
    begin();
    const volatile uint32_t *size = tag(TAG_SIZE, device->width, device->height, 2);
    const volatile uint32_t *both = tag(TAG_VIRTUAL_SIZE, wide, lines, 2);
    const volatile uint32_t *bits = tag(TAG_BITS, device->format->bits, 0, 1);
    const volatile uint32_t *order = tag(TAG_ORDER, red_highest, 0, 1);
    (void)tag(TAG_ALPHA, ALPHA_IGNORED, 0, 1);
    (void)tag(TAG_OFFSET, 0, 0, 2);
    const volatile uint32_t *buffer = tag(TAG_BUFFER, 16, 0, 2);
    const volatile uint32_t *stride = tag(TAG_STRIDE, 0, 0, 1);
    if (!answered() || size[0] != device->width || size[1] != device->height || both[1] < lines ||
        bits[0] != device->format->bits || order[0] != red_highest || buffer[0] == 0) {
        return OW_UNSUPPORTED;
    }
    device->pixels = (uint8_t *)(uintptr_t)(buffer[0] & 0x3FFFFFFF);
    device->stride = stride[0];
    device->page = 0;
    device->shown = 0;
    cache_leave_out((uintptr_t)device->pixels, device->stride * lines);
    return OW_OK;
}

static int info(void *context, struct ow_panel_info *info)
{
    const struct chip_frame_buffer *device = context;
    *info = (struct ow_panel_info){
        .width = device->width,
        .height = device->height,
        .format = device->format,
        .keep = device->keep,
        .align_x = 1,
        .align_y = 1,
        .buffers = device->pages,
    };
    return device->pixels != NULL ? OW_OK : OW_GONE;
}

static int lend(void *context, struct ow_panel_buffer *buffer)
{
    const struct chip_frame_buffer *device = context;
    buffer->pixels = device->pixels + device->page * device->height * device->stride;
    buffer->stride = device->stride;
    buffer->age = device->shown >= device->pages ? device->pages : 0;
    return OW_OK;
}

static int show(void *context, const struct ow_panel_rect *changed, uint32_t count)
{
    struct chip_frame_buffer *device = context;
    (void)changed;
    __asm__ volatile("dsb" ::: "memory");
    if (count == 0) {
        return OW_OK;
    }
    device->shown++;
    if (device->pages == 1) {
        return OW_OK;
    }
    begin();
    (void)tag(TAG_OFFSET, 0, device->page * device->height, 2);
    device->page = (device->page + 1) % device->pages;
    return answered() ? OW_OK : OW_BUS;
}

const struct ow_panel_ops chip_frame_buffer_ops = { .info = info, .lend = lend, .show = show };
