/* SPDX-License-Identifier: 0BSD */
/* Formats and buffers of V4L2 devices. */
#include "hal/linux/v4l2.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>

#include "hal/linux/mapping.h"

enum { SECOND_US = 1000000 };

static const uint32_t known[] = { OW_VIDEO_RGB565, OW_VIDEO_XRGB8888, OW_VIDEO_YUYV,
                                  OW_VIDEO_NV12 };

static int failed(struct linux_v4l2 *video, const char *call)
{
    return linux_fault_errno(&video->fault, video->config.device, call, errno);
}

static int unsupported(struct linux_v4l2 *video, const char *call, const char *why,
                       const char *remedy)
{
    return linux_fault_note(&video->fault, OW_UNSUPPORTED, video->config.device, call, why, remedy);
}

static int control(const struct linux_v4l2 *video, unsigned long request, void *argument)
{
    return linux_ioctl(video->config.system, video->fd, request, argument);
}

static bool is_known(uint32_t pixels)
{
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (known[i] == pixels) {
            return true;
        }
    }
    return false;
}

static uint32_t least_stride(uint32_t pixels, uint32_t width)
{
    return pixels == OW_VIDEO_NV12 ? width : pixels == OW_VIDEO_XRGB8888 ? 4 * width : 2 * width;
}

size_t linux_v4l2_frame_bytes(uint32_t pixels, uint32_t stride, uint32_t height)
{
    size_t plane = (size_t)stride * height;
    return !is_known(pixels) ? 0 : pixels == OW_VIDEO_NV12 ? plane + plane / 2 : plane;
}

/* ---- the format ---- */

static int check_capabilities(struct linux_v4l2 *video)
{
    struct v4l2_capability all = { 0 };
    bool output = video->type == V4L2_BUF_TYPE_VIDEO_OUTPUT;
    if (control(video, VIDIOC_QUERYCAP, &all) < 0) {
        return errno == ENOTTY ? unsupported(video, "VIDIOC_QUERYCAP", "this is no video device",
                                             "name another one: /dev/video0 for example")
                               : failed(video, "VIDIOC_QUERYCAP");
    }
    uint32_t have =
        (all.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? all.device_caps : all.capabilities;
    if ((have & (output ? V4L2_CAP_VIDEO_OUTPUT : V4L2_CAP_VIDEO_CAPTURE)) == 0) {
        return unsupported(video, "VIDIOC_QUERYCAP",
                           output ? "this video device takes no pictures of one plane"
                                  : "this video device is no camera of one plane",
                           "name another one (v4l2-ctl --list-devices shows them)");
    }
    return (have & V4L2_CAP_STREAMING) != 0
               ? OW_OK
               : unsupported(video, "VIDIOC_QUERYCAP", "this device cannot map buffers", "");
}

/* The format wanted, or the device's own if it is known here, or the first such that it offers. */
static uint32_t choose_pixels(const struct linux_v4l2 *video, uint32_t own)
{
    if (video->config.pixels != 0) {
        return video->config.pixels;
    }
    struct v4l2_fmtdesc offer = { .type = video->type };
    while (!is_known(own) && control(video, VIDIOC_ENUM_FMT, &offer) == 0) {
        own = offer.pixelformat;
        offer.index++;
    }
    return own;
}

static int check_format(struct linux_v4l2 *video, const struct v4l2_pix_format *wanted,
                        const struct v4l2_pix_format *set)
{
    char why[128];
    if (set->pixelformat != wanted->pixelformat || !is_known(set->pixelformat)) {
        return unsupported(video, "VIDIOC_S_FMT", "the device has none of the formats known here",
                           "use one with RGBP, XR24, YUYV or NV12 (v4l2-ctl --list-formats)");
    }
    if (set->width != wanted->width || set->height != wanted->height) {
        snprintf(why, sizeof why, "the device takes %ux%u, not %ux%u", set->width, set->height,
                 wanted->width, wanted->height);
        return unsupported(video, "VIDIOC_S_FMT", why, "give that size");
    }
    uint32_t stride = set->bytesperline;
    bool halves = set->pixelformat == OW_VIDEO_NV12 || set->pixelformat == OW_VIDEO_YUYV;
    if (stride < least_stride(set->pixelformat, set->width) ||
        set->sizeimage < linux_v4l2_frame_bytes(set->pixelformat, stride, set->height) ||
        (halves && set->width % 2 != 0) ||
        (set->pixelformat == OW_VIDEO_NV12 && set->height % 2 != 0) || set->width > UINT16_MAX ||
        set->height > UINT16_MAX) {
        return unsupported(video, "VIDIOC_S_FMT", "size and format do not fit together",
                           "give an even size");
    }
    return OW_OK;
}

static int set_format(struct linux_v4l2 *video)
{
    struct v4l2_format format = { .type = video->type };
    if (control(video, VIDIOC_G_FMT, &format) < 0) {
        return failed(video, "VIDIOC_G_FMT");
    }
    struct v4l2_pix_format *set = &format.fmt.pix;
    if (video->config.width != 0) {
        set->width = video->config.width;
        set->height = video->config.height;
    }
    set->pixelformat = choose_pixels(video, set->pixelformat);
    bool rgb = set->pixelformat == OW_VIDEO_RGB565 || set->pixelformat == OW_VIDEO_XRGB8888;
    set->field = V4L2_FIELD_NONE;
    set->bytesperline = 0;
    set->sizeimage = 0;
    if (video->type == V4L2_BUF_TYPE_VIDEO_OUTPUT) {
        set->colorspace = rgb ? V4L2_COLORSPACE_SRGB : V4L2_COLORSPACE_SMPTE170M;
        set->quantization = V4L2_QUANTIZATION_DEFAULT;
        set->ycbcr_enc = V4L2_YCBCR_ENC_DEFAULT;
    }
    const struct v4l2_pix_format wanted = *set;
    if (control(video, VIDIOC_S_FMT, &format) < 0) {
        return failed(video, "VIDIOC_S_FMT");
    }
    video->width = set->width;
    video->height = set->height;
    video->pixels = set->pixelformat;
    video->stride = set->bytesperline;
    video->frame_bytes = set->sizeimage;
    return check_format(video, &wanted, set);
}

/* ---- buffers ---- */

static int map_buffers(struct linux_v4l2 *video, uint32_t count)
{
    struct v4l2_requestbuffers request = { .count = count,
                                           .type = video->type,
                                           .memory = V4L2_MEMORY_MMAP };
    if (control(video, VIDIOC_REQBUFS, &request) < 0) {
        return failed(video, "VIDIOC_REQBUFS");
    }
    video->count = request.count < LINUX_V4L2_BUFFERS ? request.count : LINUX_V4L2_BUFFERS;
    if (video->count < 2) {
        return unsupported(video, "VIDIOC_REQBUFS", "the device gives fewer than two buffers", "");
    }
    for (uint32_t i = 0; i < video->count; i++) {
        struct v4l2_buffer buffer = { .index = i, .type = video->type, .memory = V4L2_MEMORY_MMAP };
        if (control(video, VIDIOC_QUERYBUF, &buffer) < 0) {
            return failed(video, "VIDIOC_QUERYBUF");
        }
        if (buffer.length < linux_v4l2_frame_bytes(video->pixels, video->stride, video->height)) {
            return unsupported(video, "VIDIOC_QUERYBUF", "a buffer is too small for a frame", "");
        }
        video->buffers[i].bytes = buffer.length;
        video->buffers[i].memory =
            linux_map(video->config.system, buffer.length, video->fd, buffer.m.offset);
        if (video->buffers[i].memory == NULL) {
            return failed(video, "mmap");
        }
    }
    return OW_OK;
}

int linux_v4l2_open(struct linux_v4l2 *video, const struct linux_v4l2_config *config, uint32_t type,
                    uint32_t count)
{
    *video = (struct linux_v4l2){ .config = *config, .type = type };
    video->fd = config->system->open(config->device, O_RDWR | O_NONBLOCK);
    if (video->fd < 0) {
        return failed(video, "open");
    }
    int status = check_capabilities(video);
    if (status == OW_OK) {
        status = set_format(video);
    }
    if (status == OW_OK) {
        status = map_buffers(video, count);
    }
    if (status < 0) {
        linux_v4l2_close(video);
    }
    return status;
}

void linux_v4l2_close(struct linux_v4l2 *video)
{
    const struct linux_system *system = video->config.system;
    if (video->fd < 0 || system == NULL) {
        return;
    }
    if (video->streaming) {
        int type = (int)video->type;
        (void)control(video, VIDIOC_STREAMOFF, &type);
    }
    for (uint32_t i = 0; i < video->count; i++) {
        if (video->buffers[i].memory != NULL) {
            linux_unmap(system, video->buffers[i].memory, video->buffers[i].bytes);
        }
    }
    (void)system->close(video->fd);
    video->fd = -1;
    video->count = 0;
    video->streaming = false;
}

/* ---- the queues ---- */

int linux_v4l2_queue(struct linux_v4l2 *video, uint32_t number)
{
    struct v4l2_buffer buffer = {
        .index = number,
        .type = video->type,
        .memory = V4L2_MEMORY_MMAP,
        .bytesused = (uint32_t)video->frame_bytes,
        .field = V4L2_FIELD_NONE,
    };
    if (linux_map_is_lost(video->buffers[number].memory)) {
        return linux_fault_note(&video->fault, OW_GONE, video->config.device, NULL,
                                "the device's memory is gone, it was unplugged",
                                "connect it again");
    }
    if (control(video, VIDIOC_QBUF, &buffer) < 0) {
        return failed(video, "VIDIOC_QBUF");
    }
    video->buffers[number].queued = true;
    return OW_OK;
}

int linux_v4l2_take(struct linux_v4l2 *video, uint64_t *time_us)
{
    struct v4l2_buffer buffer = { .type = video->type, .memory = V4L2_MEMORY_MMAP };
    if (control(video, VIDIOC_DQBUF, &buffer) < 0) {
        return errno == EAGAIN ? OW_AGAIN : failed(video, "VIDIOC_DQBUF");
    }
    if (buffer.index >= video->count) {
        return linux_fault_note(&video->fault, OW_BUS, video->config.device, "VIDIOC_DQBUF",
                                "the driver names a buffer that it was never given", "");
    }
    video->buffers[buffer.index].queued = false;
    *time_us = (uint64_t)buffer.timestamp.tv_sec * SECOND_US + (uint64_t)buffer.timestamp.tv_usec;
    return (int)buffer.index;
}

int linux_v4l2_start(struct linux_v4l2 *video)
{
    int type = (int)video->type;
    if (control(video, VIDIOC_STREAMON, &type) < 0) {
        return failed(video, "VIDIOC_STREAMON");
    }
    video->streaming = true;
    return OW_OK;
}
