/* SPDX-License-Identifier: 0BSD */
/* Dumb buffers and page flips. */
#include "hal/linux/drm.h"

#include <drm_fourcc.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <string.h>

#include "hal/linux/drm_screen.h"
#include "hal/linux/mapping.h"

enum { FLIP_LIMIT_US = 1000000, SECOND_US = 1000000, US_NS = 1000 };

static int failed(struct linux_drm *drm, const char *call)
{
    return linux_fault_errno(&drm->fault, drm->config.device, call, errno);
}

static uint64_t now_us(const struct linux_drm *drm)
{
    struct timespec now = { 0 };
    (void)drm->config.system->now(&now);
    return (uint64_t)now.tv_sec * SECOND_US + (uint64_t)now.tv_nsec / US_NS;
}

/* ---- buffers ---- */

static int make_buffer(struct linux_drm *drm, struct linux_drm_buffer *buffer)
{
    const struct linux_drm_calls *calls = drm->config.calls;
    uint32_t bits = drm->info.format->bits;
    uint64_t bytes;
    uint64_t offset;
    if (calls->create_dumb(drm->fd, drm->info.width, drm->info.height, bits, 0, &buffer->handle,
                           &buffer->pitch, &bytes) != 0) {
        return failed(drm, "MODE_CREATE_DUMB");
    }
    buffer->bytes = (size_t)bytes;
    uint32_t needed = ow_row_bytes(drm->info.format, drm->info.width);
    if (buffer->pitch < needed || buffer->pitch % 4 != 0 ||
        (uint64_t)buffer->pitch * drm->info.height > bytes) {
        return linux_fault_note(&drm->fault, OW_UNSUPPORTED, drm->config.device, "MODE_CREATE_DUMB",
                                "the driver gave a buffer that does not hold the mode", "");
    }
    const uint32_t handles[4] = { buffer->handle };
    const uint32_t pitches[4] = { buffer->pitch };
    const uint32_t offsets[4] = { 0 };
    uint32_t fourcc = bits == 16 ? DRM_FORMAT_RGB565 : DRM_FORMAT_XRGB8888;
    if (calls->add_fb2(drm->fd, drm->info.width, drm->info.height, fourcc, handles, pitches,
                       offsets, &buffer->id, 0) != 0) {
        return failed(drm, "MODE_ADDFB2");
    }
    if (calls->map_dumb(drm->fd, buffer->handle, &offset) != 0) {
        return failed(drm, "MODE_MAP_DUMB");
    }
    buffer->memory = linux_map(drm->config.system, buffer->bytes, drm->fd, offset);
    return buffer->memory != NULL ? OW_OK : failed(drm, "mmap");
}

static void free_buffer(struct linux_drm *drm, struct linux_drm_buffer *buffer)
{
    const struct linux_drm_calls *calls = drm->config.calls;
    if (buffer->memory != NULL) {
        linux_unmap(drm->config.system, buffer->memory, buffer->bytes);
    }
    if (buffer->id != 0) {
        (void)calls->rm_fb(drm->fd, buffer->id);
    }
    if (buffer->handle != 0) {
        (void)calls->destroy_dumb(drm->fd, buffer->handle);
    }
    *buffer = (struct linux_drm_buffer){ 0 };
}

/* ---- open and close ---- */

/* The first to open a card is its master; a later one may be when nobody is. */
static int become_master(struct linux_drm *drm)
{
    const struct linux_drm_calls *calls = drm->config.calls;
    if (calls->is_master(drm->fd) != 0 || calls->set_master(drm->fd) == 0) {
        return OW_OK;
    }
    return linux_fault_note(&drm->fault, OW_BUSY, drm->config.device, "SET_MASTER",
                            "another program shows pictures there",
                            "end it, or run on a console where none does");
}

static int prepare(struct linux_drm *drm)
{
    uint64_t dumb = 0;
    if (drm->config.calls->get_cap(drm->fd, DRM_CAP_DUMB_BUFFER, &dumb) != 0 || dumb == 0) {
        return linux_fault_note(&drm->fault, OW_UNSUPPORTED, drm->config.device,
                                "DRM_CAP_DUMB_BUFFER", "this device has no buffers to draw in",
                                "name another one: a display, not a renderer");
    }
    int status = linux_drm_find_screen(drm);
    if (status == OW_OK) {
        status = become_master(drm);
    }
    drm->info.format = drm->config.bits == 16 ? &ow_format_rgb565 : &ow_format_xrgb8888;
    drm->info.buffers = LINUX_DRM_BUFFERS;
    for (uint32_t i = 0; i < LINUX_DRM_BUFFERS && status == OW_OK; i++) {
        status = make_buffer(drm, &drm->buffers[i]);
    }
    if (status == OW_OK) {
        drm->before = drm->config.calls->get_crtc(drm->fd, drm->crtc);
    }
    return status;
}

int linux_drm_open(struct linux_drm *drm, const struct linux_drm_config *config)
{
    *drm = (struct linux_drm){ .config = *config };
    drm->fd = config->system->open(config->device, O_RDWR | O_NONBLOCK);
    if (drm->fd < 0) {
        return failed(drm, "open");
    }
    int status = prepare(drm);
    if (status < 0) {
        linux_drm_close(drm);
    }
    return status;
}

void linux_drm_close(struct linux_drm *drm)
{
    const struct linux_drm_calls *calls = drm->config.calls;
    if (drm->fd < 0 || calls == NULL) {
        return;
    }
    (void)linux_drm_finish(drm);
    if (drm->before != NULL) {
        if (drm->mode_is_set && drm->before->mode_valid != 0 && drm->before->buffer_id != 0) {
            (void)calls->set_crtc(drm->fd, drm->crtc, drm->before->buffer_id, drm->before->x,
                                  drm->before->y, &drm->connector, 1, &drm->before->mode);
        }
        calls->free_crtc(drm->before);
        drm->before = NULL;
    }
    for (uint32_t i = 0; i < LINUX_DRM_BUFFERS; i++) {
        free_buffer(drm, &drm->buffers[i]);
    }
    (void)calls->drop_master(drm->fd);
    (void)drm->config.system->close(drm->fd);
    drm->fd = -1;
}

/* ---- flips ---- */

static void on_flip(int fd, unsigned frame, unsigned seconds, unsigned us, void *context)
{
    struct linux_drm *drm = context;
    (void)fd;
    (void)frame;
    (void)seconds;
    (void)us;
    drm->flipping = false;
}

void linux_drm_ready(struct linux_drm *drm)
{
    drmEventContext context = { .version = 2, .page_flip_handler = on_flip };
    struct pollfd readable = { .fd = drm->fd, .events = POLLIN };
    const struct timespec at_once = { 0 };
    if (drm->fd >= 0 && drm->config.system->poll(&readable, 1, &at_once) > 0 &&
        (readable.revents & POLLIN) != 0) {
        (void)drm->config.calls->handle_event(drm->fd, &context);
    }
}

int linux_drm_finish(struct linux_drm *drm)
{
    const struct timespec limit = { .tv_nsec = 10 * 1000 * 1000 };
    while (drm->flipping) {
        struct pollfd readable = { .fd = drm->fd, .events = POLLIN };
        (void)drm->config.system->poll(&readable, 1, &limit);
        linux_drm_ready(drm);
        if (drm->flipping && now_us(drm) - drm->flip_us > FLIP_LIMIT_US) {
            drm->flipping = false;
            return linux_fault_note(&drm->fault, OW_TIMEOUT, drm->config.device, "MODE_PAGE_FLIP",
                                    "the screen did not take the frame within a second",
                                    "see what the kernel says about it (dmesg)");
        }
        if ((readable.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0) {
            drm->flipping = false;
        }
    }
    return OW_OK;
}

/* What a failed call means once the device was ours. */
static int lost(struct linux_drm *drm, const char *call)
{
    int number = errno;
    if (number == EACCES || number == EPERM) {
        return linux_fault_note(&drm->fault, OW_BUSY, drm->config.device, call,
                                "another program has taken the screen", "end it to get it back");
    }
    return linux_fault_errno(&drm->fault, drm->config.device, call, number);
}

static int set_mode(struct linux_drm *drm, uint32_t buffer)
{
    if (drm->config.calls->set_crtc(drm->fd, drm->crtc, drm->buffers[buffer].id, 0, 0,
                                    &drm->connector, 1, &drm->mode) != 0) {
        return lost(drm, "MODE_SETCRTC");
    }
    drm->mode_is_set = true;
    return OW_OK;
}

static int flip(struct linux_drm *drm, uint32_t buffer)
{
    if (!drm->mode_is_set) {
        return set_mode(drm, buffer);
    }
    if (drm->config.calls->page_flip(drm->fd, drm->crtc, drm->buffers[buffer].id,
                                     DRM_MODE_PAGE_FLIP_EVENT, drm) == 0) {
        drm->flipping = true;
        drm->flip_us = now_us(drm);
        return OW_OK;
    }
    return errno == EINVAL ? set_mode(drm, buffer) : lost(drm, "MODE_PAGE_FLIP");
}

/* ---- the panel ---- */

static int drm_info(void *device, struct ow_panel_info *info)
{
    const struct linux_drm *drm = device;
    *info = drm->info;
    return OW_OK;
}

static int drm_lend(void *device, struct ow_panel_buffer *buffer)
{
    struct linux_drm *drm = device;
    linux_drm_ready(drm);
    if (drm->flipping) {
        return now_us(drm) - drm->flip_us > FLIP_LIMIT_US ? linux_drm_finish(drm) : OW_AGAIN;
    }
    const struct linux_drm_buffer *next = &drm->buffers[1 - drm->shown];
    buffer->pixels = next->memory;
    buffer->stride = next->pitch;
    buffer->age = next->drawn_at == 0 ? 0 : drm->frames + 1 - next->drawn_at;
    drm->lent = true;
    return OW_OK;
}

static int drm_show(void *device, const struct ow_panel_rect *changed, uint32_t count)
{
    struct linux_drm *drm = device;
    uint32_t drawn = 1 - drm->shown;
    struct linux_drm_buffer *buffer = &drm->buffers[drawn];
    (void)changed;
    if (!drm->lent) {
        return OW_ARGUMENT;
    }
    drm->lent = false;
    buffer->drawn_at = 0;
    if (linux_map_is_lost(buffer->memory)) {
        return linux_fault_note(&drm->fault, OW_GONE, drm->config.device, NULL,
                                "the device's memory is gone, it was unplugged",
                                "connect it again");
    }
    if (count == 0) {
        return OW_OK;
    }
    int status = flip(drm, drawn);
    if (status == OW_OK) {
        drm->shown = drawn;
        buffer->drawn_at = ++drm->frames;
    }
    return status;
}

const struct ow_panel_ops linux_drm_ops = {
    .info = drm_info,
    .lend = drm_lend,
    .show = drm_show,
};
