/* SPDX-License-Identifier: 0BSD */
/* Frames for a video output. */
#include "hal/linux/v4l2_out.h"

#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>

#include "hal/linux/v4l2_pixels.h"

enum { BUFFERS = 4, LIMIT_S = 1 };

int linux_v4l2_out_open(struct linux_v4l2_out *out, const struct linux_v4l2_config *config)
{
    *out = (struct linux_v4l2_out){ 0 };
    int status = linux_v4l2_open(&out->video, config, V4L2_BUF_TYPE_VIDEO_OUTPUT, BUFFERS);
    if (status < 0) {
        return status;
    }
    bool small = out->video.pixels == OW_VIDEO_RGB565;
    out->format = small ? &ow_format_rgb565 : &ow_format_xrgb8888;
    out->stride = (ow_row_bytes(out->format, out->video.width) + 3) / 4 * 4;
    out->frame = calloc(out->video.height, out->stride);
    if (out->frame == NULL) {
        linux_v4l2_out_close(out);
        return linux_fault_note(&out->video.fault, OW_MEMORY, config->device, NULL,
                                "not enough memory for a frame", "");
    }
    return OW_OK;
}

void linux_v4l2_out_close(struct linux_v4l2_out *out)
{
    linux_v4l2_close(&out->video);
    free(out->frame);
    out->frame = NULL;
}

/* ---- buffers ---- */

static void fill(const struct linux_v4l2_out *out, uint8_t *to)
{
    const struct linux_v4l2 *video = &out->video;
    if (video->pixels == OW_VIDEO_YUYV) {
        linux_rgb_to_yuyv(to, video->stride, out->frame, out->stride, video->width, video->height);
    } else if (video->pixels == OW_VIDEO_NV12) {
        linux_rgb_to_nv12(to, video->stride, out->frame, out->stride, video->width, video->height);
    } else {
        uint32_t bytes = ow_row_bytes(out->format, video->width);
        for (uint32_t y = 0; y < video->height; y++) {
            memcpy(to + (size_t)y * video->stride, out->frame + (size_t)y * out->stride, bytes);
        }
    }
}

static int unused(const struct linux_v4l2 *video)
{
    for (uint32_t i = 0; i < video->count; i++) {
        if (!video->buffers[i].queued) {
            return (int)i;
        }
    }
    return OW_AGAIN;
}

/* Takes back what the device is done with; a free buffer's number or a status. */
static int free_buffer(struct linux_v4l2 *video)
{
    uint64_t time_us;
    int number = OW_AGAIN;
    do {
        number = video->streaming ? linux_v4l2_take(video, &time_us) : OW_AGAIN;
    } while (number >= 0);
    return number == OW_AGAIN ? unused(video) : number;
}

static int wait_for_buffer(struct linux_v4l2 *video)
{
    const struct timespec limit = { .tv_sec = LIMIT_S };
    int number = free_buffer(video);
    for (int i = 0; number == OW_AGAIN && i < 2; i++) {
        struct pollfd ready = { .fd = video->fd, .events = POLLOUT };
        (void)video->config.system->poll(&ready, 1, &limit);
        number = free_buffer(video);
    }
    return number != OW_AGAIN
               ? number
               : linux_fault_note(&video->fault, OW_TIMEOUT, video->config.device, "VIDIOC_DQBUF",
                                  "the device took no frame within a second",
                                  "see that something shows or reads its pictures");
}

static int queue_frame(struct linux_v4l2_out *out, int number)
{
    if (number < 0) {
        return number;
    }
    fill(out, out->video.buffers[number].memory);
    return linux_v4l2_queue(&out->video, (uint32_t)number);
}

/* Devices begin when several frames are there: the first one comes so often. */
static int begin(struct linux_v4l2_out *out)
{
    int status = OW_OK;
    for (uint32_t i = 0; i + 1 < out->video.count && status == OW_OK; i++) {
        status = queue_frame(out, (int)i);
    }
    return status == OW_OK ? linux_v4l2_start(&out->video) : status;
}

int linux_v4l2_out_finish(struct linux_v4l2_out *out)
{
    const struct timespec frame = { .tv_nsec = 50 * 1000 * 1000 };
    uint64_t time_us;
    uint32_t queued = LINUX_V4L2_BUFFERS;
    for (int i = 0; queued > 1 && i < 20 * LIMIT_S; i++) { /* the last one stays on the screen */
        while (linux_v4l2_take(&out->video, &time_us) >= 0) {
        }
        queued = 0;
        for (uint32_t k = 0; k < out->video.count; k++) {
            queued += out->video.buffers[k].queued;
        }
        if (queued > 1) {
            struct pollfd ready = { .fd = out->video.fd, .events = POLLOUT };
            (void)out->video.config.system->poll(&ready, 1, &frame);
        }
    }
    return queued <= 1 ? OW_OK
                       : linux_fault_note(&out->video.fault, OW_TIMEOUT, out->video.config.device,
                                          "VIDIOC_DQBUF", "the device took no frame in time",
                                          "see that something shows or reads its pictures");
}

/* ---- the panel ---- */

static int out_info(void *device, struct ow_panel_info *info)
{
    const struct linux_v4l2_out *out = device;
    *info = (struct ow_panel_info){
        .width = (uint16_t)out->video.width,
        .height = (uint16_t)out->video.height,
        .format = out->format,
        .align_x = 1,
        .align_y = 1,
        .buffers = 1,
    };
    return OW_OK;
}

static int out_lend(void *device, struct ow_panel_buffer *buffer)
{
    const struct linux_v4l2_out *out = device;
    *buffer = (struct ow_panel_buffer){ out->frame, out->stride, out->known ? 1 : 0 };
    return OW_OK;
}

static int out_show(void *device, const struct ow_panel_rect *changed, uint32_t count)
{
    struct linux_v4l2_out *out = device;
    (void)changed;
    out->known = false;
    if (count == 0) {
        return OW_OK;
    }
    int status = out->video.streaming ? queue_frame(out, wait_for_buffer(&out->video)) : begin(out);
    out->known = status == OW_OK;
    return status;
}

const struct ow_panel_ops linux_v4l2_out_ops = {
    .info = out_info,
    .lend = out_lend,
    .show = out_show,
};
