/* SPDX-License-Identifier: 0BSD */
/*
 * hal/panel.h on a V4L2 output device: v4l2loopback, HDMI encoders, vivid.
 * Frames are drawn in memory of our own and go into the device's buffers as
 * RGB565, XRGB8888, YUYV or NV12.
 */
#ifndef OW_HAL_LINUX_V4L2_OUT_H
#define OW_HAL_LINUX_V4L2_OUT_H

#include "hal/linux/v4l2.h"
#include "hal/panel.h"

/* Private but for video.fault. */
struct linux_v4l2_out {
    struct linux_v4l2 video;
    const struct ow_pixel_format *format; /* of the frame */
    uint8_t *frame;
    uint32_t stride;
    bool known; /* frame holds what was shown last */
};

extern const struct ow_panel_ops linux_v4l2_out_ops;

/* As linux_v4l2_open, and OW_MEMORY. */
int linux_v4l2_out_open(struct linux_v4l2_out *out, const struct linux_v4l2_config *config);
void linux_v4l2_out_close(struct linux_v4l2_out *out);

/* Returns when the device has taken up what was shown last: OW_OK or OW_TIMEOUT. */
int linux_v4l2_out_finish(struct linux_v4l2_out *out);

#endif
