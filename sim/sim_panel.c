/* SPDX-License-Identifier: 0BSD */
/* The simulator's panel. */
#include "sim_panel.h"

#include <stdlib.h>
#include <string.h>

#include "ow_tree.h"

enum { POISON = 0xA5 }; /* what memory with unknown content holds */

/* Notes what the caller did wrong, once. */
static int refuse(struct sim_panel *panel, const char *what)
{
    if (panel->wrong == NULL) {
        panel->wrong = what;
    }
    return OW_ARGUMENT;
}

/* Counts a call; a status if it is one that is to fail. */
static int count_call(struct sim_panel *panel)
{
    const struct sim_panel_config *config = &panel->config;
    panel->calls++;
    if ((config->fail_every != 0 && panel->calls % config->fail_every == 0) ||
        panel->calls == config->fail_at) {
        panel->failed++;
        return config->fail_status;
    }
    return OW_OK;
}

static size_t screen_bytes(const struct sim_panel *panel)
{
    return (size_t)panel->row_bytes * panel->height;
}

static uint32_t edge(const struct sim_panel *panel, uint32_t x)
{
    return x * panel->config.format->bits / 8;
}

static void copy_rect(struct sim_panel *panel, const struct ow_panel_rect *rect,
                      const uint8_t *pixels, uint32_t stride, uint32_t lines)
{
    panel->pixels_sent += (uint64_t)rect->width * lines;
    uint32_t left = edge(panel, rect->x);
    uint32_t right = rect->x + rect->width == panel->width ? panel->row_bytes
                                                           : edge(panel, rect->x + rect->width);
    for (uint32_t y = 0; y < lines; y++) {
        memcpy(panel->screen + (size_t)(rect->y + y) * panel->row_bytes + left,
               pixels + (size_t)y * stride, right - left);
    }
}

static bool aligned(uint32_t from, uint32_t size, uint32_t step, uint32_t end)
{
    return from % step == 0 && ((from + size) % step == 0 || from + size == end);
}

static bool rect_is_good(const struct sim_panel *panel, const struct ow_panel_rect *rect)
{
    return rect->width > 0 && rect->height > 0 && rect->x + rect->width <= panel->width &&
           rect->y + rect->height <= panel->height &&
           aligned(rect->x, rect->width, panel->config.align_x, panel->width) &&
           aligned(rect->y, rect->height, panel->config.align_y, panel->height);
}

static int frame_is_whole(struct sim_panel *panel)
{
    panel->frames++;
    return panel->config.frame == NULL ? OW_OK : panel->config.frame(panel->config.context, panel);
}

/* The last byte of a pixel. */
static uint32_t kept_mask(const struct sim_panel *panel)
{
    return 0xFFu << (panel->config.format->bits - 8);
}

static int sim_info(void *device, struct ow_panel_info *info)
{
    struct sim_panel *panel = device;
    int status = count_call(panel);
    if (status < 0) {
        return status;
    }
    *info = (struct ow_panel_info){
        .width = panel->width,
        .height = panel->height,
        .format = panel->config.format,
        .align_x = panel->config.align_x,
        .align_y = panel->config.align_y,
        .keep = panel->config.kept != NULL ? kept_mask(panel) : 0,
        .buffers = panel->config.kind == SIM_PANEL_TAKES ? 0 : panel->config.buffers,
    };
    return OW_OK;
}

/* ---- lending ---- */

static int sim_lend(void *device, struct ow_panel_buffer *buffer)
{
    struct sim_panel *panel = device;
    if (panel->lent) {
        return refuse(panel, "lend without show before it");
    }
    int status = count_call(panel);
    if (status < 0) {
        return status;
    }
    uint32_t held = panel->shown_at[panel->next];
    panel->lent = true;
    buffer->pixels = panel->buffers[panel->next];
    buffer->stride = panel->buffer_stride;
    buffer->age = held == 0 ? 0 : panel->frames + 1 - held;
    return OW_OK;
}

/* Fills a buffer with what nobody drew; the kept bytes stay. */
static void poison_buffer(struct sim_panel *panel, uint32_t number)
{
    uint8_t *buffer = panel->buffers[number];
    memset(buffer, POISON, (size_t)panel->buffer_stride * panel->height);
    uint32_t pixel_bytes = panel->config.format->bits / 8;
    size_t count = panel->config.kept != NULL ? (size_t)panel->width * panel->height : 0;
    for (size_t i = 0; i < count; i++) {
        buffer[(i + 1) * pixel_bytes - 1] = panel->config.kept[i];
    }
}

static void lose_buffer(struct sim_panel *panel)
{
    poison_buffer(panel, panel->next);
    panel->shown_at[panel->next] = 0;
}

/* Whether the kept bytes are what they were. */
static bool kept_is_intact(const struct sim_panel *panel)
{
    uint32_t pixel_bytes = panel->config.format->bits / 8;
    size_t count = panel->config.kept != NULL ? (size_t)panel->width * panel->height : 0;
    for (size_t i = 0; i < count; i++) {
        if (panel->buffers[0][(i + 1) * pixel_bytes - 1] != panel->config.kept[i]) {
            return false;
        }
    }
    return true;
}

static int sim_show(void *device, const struct ow_panel_rect *changed, uint32_t count)
{
    struct sim_panel *panel = device;
    if (!panel->lent) {
        return refuse(panel, "show without lend");
    }
    panel->lent = false;
    if (!kept_is_intact(panel)) {
        return refuse(panel, "show: bits were written that only their owner may write");
    }
    for (uint32_t i = 0; i < count; i++) {
        if (!rect_is_good(panel, &changed[i])) {
            return refuse(panel, "show: a rectangle is empty, outside or not aligned");
        }
    }
    int status = count_call(panel);
    if (status < 0) {
        memset(panel->screen, POISON, screen_bytes(panel));
        lose_buffer(panel);
        return status;
    }
    if (count == 0) {
        lose_buffer(panel); /* something may have been drawn into it */
        return OW_OK;
    }
    for (uint32_t i = 0; i < count; i++) {
        const uint8_t *corner = panel->buffers[panel->next] +
                                (size_t)changed[i].y * panel->buffer_stride +
                                edge(panel, changed[i].x);
        copy_rect(panel, &changed[i], corner, panel->buffer_stride, changed[i].height);
    }
    panel->shown_at[panel->next] = panel->frames + 1;
    panel->next = (panel->next + 1) % panel->config.buffers;
    return frame_is_whole(panel);
}

/* ---- taking ---- */

/* The oldest write comes through. */
static int finish_write(struct sim_panel *panel)
{
    struct sim_pending write = panel->queue[0];
    panel->queue[0] = panel->queue[1];
    panel->pending--;
    copy_rect(panel, &write.rect, write.pixels, write.stride, write.rect.height);
    return write.last ? frame_is_whole(panel) : OW_OK;
}

static int sim_write(void *device, const struct ow_panel_rect *rect, const void *pixels,
                     uint32_t stride, bool last)
{
    struct sim_panel *panel = device;
    if (!rect_is_good(panel, rect)) {
        return refuse(panel, "write: the rectangle is empty, outside or not aligned");
    }
    if (stride % 4 != 0 || (uintptr_t)pixels % 4 != 0) {
        return refuse(panel, "write: pixels or stride are not aligned");
    }
    if (panel->pending == SIM_PANEL_QUEUE) {
        return refuse(panel, "write: two are under way, done was not asked");
    }
    int status = count_call(panel);
    if (status < 0) { /* half of it came through */
        copy_rect(panel, rect, pixels, stride, rect->height / 2u);
        return status;
    }
    panel->queue[panel->pending++] = (struct sim_pending){ *rect, pixels, stride, last };
    return panel->config.delay == 0 ? finish_write(panel) : OW_OK;
}

static int sim_done(void *device, uint32_t pending)
{
    struct sim_panel *panel = device;
    int status = count_call(panel);
    if (status < 0) {
        if (status != OW_AGAIN) {
            panel->pending = 0;
        }
        return status;
    }
    while (panel->pending > pending && status >= 0) {
        if (++panel->asked < panel->config.delay) {
            return OW_AGAIN;
        }
        panel->asked = 0;
        status = finish_write(panel);
    }
    return status;
}

/* ---- settings ---- */

static uint32_t stride_of(const struct sim_panel *panel)
{
    uint32_t padded = (panel->row_bytes + 3) / 4 * 4;
    return panel->config.kept != NULL ? padded : padded + 4; /* else never without padding */
}

static int sim_set(void *device, enum ow_panel_setting setting, int32_t value)
{
    struct sim_panel *panel = device;
    int status = count_call(panel);
    if (status < 0) {
        return status;
    }
    if (setting != OW_PANEL_ROTATION || !panel->config.rotates) {
        return OW_UNSUPPORTED;
    }
    if (value < 0 || value > 3) {
        return OW_ARGUMENT;
    }
    bool sideways = value & 1;
    panel->width = sideways ? panel->config.height : panel->config.width;
    panel->height = sideways ? panel->config.width : panel->config.height;
    panel->row_bytes = ow_row_bytes(panel->config.format, panel->width);
    panel->buffer_stride = stride_of(panel);
    return OW_OK;
}

/* By kind. */
static const struct ow_panel_ops sim_ops[] = {
    [SIM_PANEL_LENDS] = { .info = sim_info, .lend = sim_lend, .show = sim_show, .set = sim_set },
    [SIM_PANEL_TAKES] = { .info = sim_info, .write = sim_write, .done = sim_done, .set = sim_set },
    [SIM_PANEL_BOTH] = { .info = sim_info,
                         .lend = sim_lend,
                         .show = sim_show,
                         .write = sim_write,
                         .done = sim_done,
                         .set = sim_set },
};

/* ---- the host's side ---- */

static bool make_buffers(struct sim_panel *panel)
{
    /* Room for either way up: a turned panel's rows may need more padding. */
    size_t lines = (size_t)panel->width + panel->height;
    size_t bytes = (size_t)(panel->buffer_stride + 4) * panel->height + 16 * lines;
    panel->screen = malloc(bytes);
    if (panel->screen == NULL) {
        return false;
    }
    memset(panel->screen, POISON, bytes);
    for (uint32_t i = 0; i < panel->config.buffers && panel->config.kind != SIM_PANEL_TAKES; i++) {
        panel->buffers[i] = malloc(bytes);
        if (panel->buffers[i] == NULL) {
            return false;
        }
        poison_buffer(panel, i);
    }
    return true;
}

bool sim_panel_open(struct sim_panel *panel, const struct sim_panel_config *config)
{
    *panel =
        (struct sim_panel){ .config = *config, .width = config->width, .height = config->height };
    struct sim_panel_config *own = &panel->config;
    own->align_x = own->align_x == 0 ? 1 : own->align_x;
    own->align_y = own->align_y == 0 ? 1 : own->align_y;
    own->buffers = own->buffers == 0 ? 1 : own->buffers;
    if (own->width < 1 || own->width > OW_PANEL_SIZE_MAX || own->height < 1 ||
        own->height > OW_PANEL_SIZE_MAX || own->buffers > SIM_PANEL_BUFFERS) {
        return false;
    }
    panel->panel = (struct ow_panel){ &sim_ops[own->kind], panel };
    panel->row_bytes = ow_row_bytes(own->format, own->width);
    panel->buffer_stride = stride_of(panel);
    if (own->kept != NULL && (own->kind != SIM_PANEL_LENDS || own->buffers != 1 || own->rotates ||
                              panel->buffer_stride != panel->row_bytes)) {
        return false;
    }
    if (!make_buffers(panel)) {
        sim_panel_close(panel);
        return false;
    }
    return true;
}

void sim_panel_close(struct sim_panel *panel)
{
    free(panel->screen);
    for (uint32_t i = 0; i < SIM_PANEL_BUFFERS; i++) {
        free(panel->buffers[i]);
    }
    *panel = (struct sim_panel){ 0 };
}

bool sim_panel_image(const struct sim_panel *panel, struct image *image, struct image_error *error)
{
    const struct ow_pixel_format *format = panel->config.format;
    if (!image_make(image, panel->width, panel->height, error)) {
        return false;
    }
    for (uint32_t y = 0; y < panel->height; y++) {
        const uint8_t *row = panel->screen + (size_t)y * panel->row_bytes;
        for (uint32_t x = 0; x < panel->width; x++) {
            image_set_pixel(image, x, y, format->unpack(format->get(row, x) & format->used));
        }
    }
    return true;
}

uint32_t sim_panel_crc(const struct sim_panel *panel, uint32_t crc)
{
    const struct ow_pixel_format *format = panel->config.format;
    uint8_t row[4 * OW_PANEL_SIZE_MAX];
    uint32_t pixel_bytes = format->bits / 8;
    bool spare = pixel_bytes >= 3; /* 24 and 32 bits have a byte that does not show */
    uint32_t tail = panel->width * format->bits % 8; /* bits of the last byte, if it is not full */
    for (uint32_t y = 0; y < panel->height; y++) {
        memcpy(row, panel->screen + (size_t)y * panel->row_bytes, panel->row_bytes);
        if (tail != 0) {
            row[panel->row_bytes - 1] &= (uint8_t)(0xFF00u >> tail);
        }
        for (uint32_t x = 0; spare && x < panel->width; x++) {
            for (uint32_t i = 0; i < pixel_bytes; i++) { /* they are little-endian */
                row[pixel_bytes * x + i] &= (uint8_t)(format->used >> (8 * i));
            }
        }
        crc = ow_crc32(crc, row, panel->row_bytes);
    }
    return crc;
}

const uint8_t *sim_panel_kept(const struct sim_panel *panel, uint32_t *stride)
{
    *stride = panel->config.format->bits / 8;
    return panel->config.kept != NULL ? panel->buffers[0] + *stride - 1 : NULL;
}
