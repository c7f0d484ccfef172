/* SPDX-License-Identifier: 0BSD */
/* hal/camera.h on a V4L2 capture device. */
#ifndef OW_HAL_LINUX_V4L2_CAMERA_H
#define OW_HAL_LINUX_V4L2_CAMERA_H

#include "hal/camera.h"
#include "hal/linux/v4l2.h"

/* Private but for video.fault and video.fd, which is readable when there is a frame. */
struct linux_v4l2_camera {
    struct linux_v4l2 video;
};

extern const struct ow_video_ops linux_v4l2_camera_ops;

/* As linux_v4l2_open; capturing begins at once. */
int linux_v4l2_camera_open(struct linux_v4l2_camera *camera,
                           const struct linux_v4l2_config *config);
void linux_v4l2_camera_close(struct linux_v4l2_camera *camera);

#endif
