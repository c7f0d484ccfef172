/* SPDX-License-Identifier: 0BSD */
/* The camera behind the model. It may go away and come back: without it the background is plain. */
#ifndef OLDWELL_BOARDS_LINUX_CAMERA_H
#define OLDWELL_BOARDS_LINUX_CAMERA_H

#include "firmware/viewer/video_backdrop.h"
#include "hal/linux/v4l2_camera.h"
#include "hal/linux/wait.h"
#include "settings.h"

struct camera {
    struct linux_v4l2_camera device;
    struct linux_v4l2_config config;
    struct linux_wait *wait;
    struct ow_video_backdrop video;
    struct ow_backdrop backdrop; /* for the look */
    bool is_wanted;
    bool is_open;
    bool was_told; /* that it is missing */
};

/* Without --camera nothing happens. A status as of linux_v4l2_open. */
int camera_start(struct camera *camera, const struct oldwell_settings *settings,
                 const struct linux_system *system, struct linux_wait *wait);

/* The backdrop for a panel of this size; a frame that is shown stays. */
void camera_fit(struct camera *camera, uint16_t width, uint16_t height, uint8_t quarter_turns);

/* Takes the newest frame, if there is one. True: the picture has changed. */
bool camera_look(struct camera *camera);

/* Waits for the first frame, a second at most. */
void camera_wait(struct camera *camera);

/* Once a second: a camera that is gone is looked for. */
void camera_second(struct camera *camera);

void camera_stop(struct camera *camera);

#endif
