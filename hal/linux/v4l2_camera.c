/* SPDX-License-Identifier: 0BSD */
/* Pictures from a camera: the newest counts, older ones go back to the driver. */
#include "hal/linux/v4l2_camera.h"

#include <stddef.h>

enum { BUFFERS = 4, HELD = 2 }; /* two stay with the driver, so that it never stops */

int linux_v4l2_camera_open(struct linux_v4l2_camera *camera, const struct linux_v4l2_config *config)
{
    struct linux_v4l2 *video = &camera->video;
    int status = linux_v4l2_open(video, config, V4L2_BUF_TYPE_VIDEO_CAPTURE, BUFFERS);
    for (uint32_t i = 0; i < video->count && status == OW_OK; i++) {
        status = linux_v4l2_queue(video, i);
    }
    if (status == OW_OK) {
        status = linux_v4l2_start(video);
    }
    if (status < 0) {
        linux_v4l2_close(video);
    }
    return status;
}

void linux_v4l2_camera_close(struct linux_v4l2_camera *camera)
{
    linux_v4l2_close(&camera->video);
}

static int camera_info(void *device, struct ow_video_info *info)
{
    const struct linux_v4l2 *video = &((struct linux_v4l2_camera *)device)->video;
    *info = (struct ow_video_info){
        .width = (uint16_t)video->width,
        .height = (uint16_t)video->height,
        .format = video->pixels,
        .buffers = HELD,
    };
    return OW_OK;
}

static uint32_t held(const struct linux_v4l2 *video)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < video->count; i++) {
        count += !video->buffers[i].queued;
    }
    return count;
}

static void describe(const struct linux_v4l2 *video, uint32_t number, uint64_t time_us,
                     struct ow_video_frame *frame)
{
    const uint8_t *pixels = video->buffers[number].memory;
    bool two = video->pixels == OW_VIDEO_NV12;
    *frame = (struct ow_video_frame){
        .planes = { pixels, two ? pixels + (size_t)video->stride * video->height : NULL },
        .strides = { video->stride, two ? video->stride : 0 },
        .time_us = time_us,
        .number = number,
    };
}

static int camera_acquire(void *device, struct ow_video_frame *frame)
{
    struct linux_v4l2 *video = &((struct linux_v4l2_camera *)device)->video;
    uint64_t time_us = 0;
    uint64_t newest_us = 0;
    int newest = OW_AGAIN;
    if (held(video) >= HELD) {
        return OW_CAPACITY;
    }
    for (uint32_t i = 0; i <= video->count; i++) { /* a fast camera does not keep us here */
        int number = linux_v4l2_take(video, &time_us);
        if (number == OW_AGAIN) {
            break;
        }
        if (newest >= 0) {
            int status = linux_v4l2_queue(video, (uint32_t)newest);
            number = status < 0 ? status : number;
        }
        if (number < 0) {
            return number;
        }
        newest = number;
        newest_us = time_us;
    }
    if (newest >= 0) {
        describe(video, (uint32_t)newest, newest_us, frame);
        return OW_OK;
    }
    return newest;
}

static int camera_release(void *device, uint32_t number)
{
    struct linux_v4l2 *video = &((struct linux_v4l2_camera *)device)->video;
    if (number >= video->count || video->buffers[number].queued) {
        return OW_ARGUMENT;
    }
    return linux_v4l2_queue(video, number);
}

const struct ow_video_ops linux_v4l2_camera_ops = {
    .info = camera_info,
    .acquire = camera_acquire,
    .release = camera_release,
};
