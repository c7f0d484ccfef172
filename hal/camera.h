/* SPDX-License-Identifier: 0BSD */
/*
 * The camera: a source of pictures to stand behind the model. (The view's own
 * camera is struct ow_camera in the core; the names here say ow_video.)
 */
#ifndef OW_HAL_CAMERA_H
#define OW_HAL_CAMERA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "ow_status.h"

/* A format's code: four characters as video drivers name it, first one lowest. */
#define OW_VIDEO_FORMAT(a, b, c, d) \
    ((uint32_t)(a) | (uint32_t)(b) << 8 | (uint32_t)(c) << 16 | (uint32_t)(d) << 24)
#define OW_VIDEO_RGB565 OW_VIDEO_FORMAT('R', 'G', 'B', 'P')   /* 16-bit little-endian words */
#define OW_VIDEO_XRGB8888 OW_VIDEO_FORMAT('X', 'R', '2', '4') /* 32-bit little-endian words */
#define OW_VIDEO_YUYV OW_VIDEO_FORMAT('Y', 'U', 'Y', 'V')     /* 4 bytes for 2 pixels */
#define OW_VIDEO_NV12 OW_VIDEO_FORMAT('N', 'V', '1', '2')     /* a plane of Y, then UV, halved */

struct ow_video_info {
    uint16_t width; /* pixels */
    uint16_t height;
    uint32_t format;   /* OW_VIDEO_... */
    uint32_t frame_us; /* time between frames, 0: unknown */
    uint16_t buffers;  /* frames that may be held at one time, >= 1 */
};

struct ow_video_frame {
    const uint8_t *planes[2]; /* the second for NV12 only, NULL otherwise */
    uint32_t strides[2];      /* bytes */
    uint64_t time_us;         /* when it was taken, on the clock of hal/clock.h */
    uint32_t number;          /* for release */
};

struct ow_video_ops {
    /* Fills *info. It may change after OW_GONE only. Mandatory. */
    int (*info)(void *device, struct ow_video_info *info);

    /*
     * The newest frame; older ones are dropped. It does not change until it is
     * released. OW_AGAIN: none since the last; OW_CAPACITY: all buffers are held;
     * OW_GONE. Never waits. Mandatory.
     */
    int (*acquire)(void *device, struct ow_video_frame *frame);

    /* Gives a frame back, in any order. Mandatory. */
    int (*release)(void *device, uint32_t number);
};

struct ow_video {
    const struct ow_video_ops *ops;
    void *device;
};

/* OW_UNSUPPORTED where a mandatory function is missing. */
static inline int ow_video_check(const struct ow_video *video)
{
    bool complete = video != NULL && video->ops != NULL && video->ops->info != NULL &&
                    video->ops->acquire != NULL && video->ops->release != NULL;
    return complete ? OW_OK : OW_UNSUPPORTED;
}

#endif
