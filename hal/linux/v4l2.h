/* SPDX-License-Identifier: 0BSD */
/* What video outputs and cameras have in common: a format, and mapped buffers in two queues. */
#ifndef OW_HAL_LINUX_V4L2_H
#define OW_HAL_LINUX_V4L2_H

#include <linux/videodev2.h>
#include <stdbool.h>
#include <stddef.h>

#include "hal/camera.h"
#include "hal/linux/fault.h"
#include "hal/linux/system.h"

enum { LINUX_V4L2_BUFFERS = 8 };

struct linux_v4l2_config {
    const struct linux_system *system;
    const char *device; /* its path; stays */
    uint32_t width;     /* pixels; 0: what the device has */
    uint32_t height;
    uint32_t pixels; /* OW_VIDEO_...; 0: what the device has, or the first that can be used */
};

struct linux_v4l2_buffer {
    uint8_t *memory;
    size_t bytes;
    bool queued; /* it is the driver's */
};

struct linux_v4l2 {
    struct linux_fault fault;
    struct linux_v4l2_config config;
    int fd;
    uint32_t type; /* V4L2_BUF_TYPE_... */
    uint32_t width;
    uint32_t height;
    uint32_t pixels; /* OW_VIDEO_... */
    uint32_t stride; /* bytes of a line, of the first plane */
    size_t frame_bytes;
    struct linux_v4l2_buffer buffers[LINUX_V4L2_BUFFERS];
    uint32_t count;
    bool streaming;
};

/*
 * Opens a device for V4L2_BUF_TYPE_VIDEO_OUTPUT or _CAPTURE, sets its format and
 * maps count buffers. On failure nothing stays open; fault says why: OW_GONE,
 * OW_DENIED, OW_BUSY, OW_UNSUPPORTED (no such device type, size or format), OW_BUS.
 */
int linux_v4l2_open(struct linux_v4l2 *video, const struct linux_v4l2_config *config, uint32_t type,
                    uint32_t count);
void linux_v4l2_close(struct linux_v4l2 *video);

/* Gives buffer number to the driver; the second plane's is in it. */
int linux_v4l2_queue(struct linux_v4l2 *video, uint32_t number);

/*
 * Takes a buffer back: its number, or OW_AGAIN where the driver has none ready.
 * *time_us: when it was captured. OW_GONE, OW_BUS.
 */
int linux_v4l2_take(struct linux_v4l2 *video, uint64_t *time_us);

int linux_v4l2_start(struct linux_v4l2 *video);

/* Bytes of a frame of this format with a stride; 0: a format that is not known here. */
size_t linux_v4l2_frame_bytes(uint32_t pixels, uint32_t stride, uint32_t height);

#endif
