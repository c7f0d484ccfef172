/* SPDX-License-Identifier: 0BSD */
/* Frames from the camera to the backdrop. */
#include "camera.h"

#include <poll.h>

#include "tools/common/fail.h"

enum { TEXT_BYTES = 600 };

static int open_camera(struct camera *camera)
{
    int status = linux_v4l2_camera_open(&camera->device, &camera->config);
    if (status == OW_OK) {
        camera->is_open = true;
        status = linux_wait_add(camera->wait, camera->device.video.fd, NULL, NULL);
    }
    return status;
}

static void close_camera(struct camera *camera)
{
    if (camera->is_open) {
        linux_wait_remove(camera->wait, camera->device.video.fd);
        linux_v4l2_camera_close(&camera->device);
        camera->is_open = false;
        camera->video.has_frame = false;
    }
}

int camera_start(struct camera *camera, const struct oldwell_settings *settings,
                 const struct linux_system *system, struct linux_wait *wait)
{
    *camera = (struct camera){ .wait = wait, .is_wanted = settings->camera != NULL };
    if (!camera->is_wanted) {
        return OW_OK;
    }
    camera->config = (struct linux_v4l2_config){
        .system = system,
        .device = settings->camera,
        .width = settings->has_camera_size ? settings->camera_size[0] : 0,
        .height = settings->camera_size[1],
    };
    camera->video.colour = settings->look.background;
    camera->backdrop = ow_backdrop_of_video(&camera->video);
    return open_camera(camera);
}

void camera_fit(struct camera *camera, uint16_t width, uint16_t height, uint8_t quarter_turns)
{
    struct ow_video_info info;
    struct ow_video_frame frame = camera->video.frame;
    bool has_frame = camera->video.has_frame;
    if (camera->is_open && linux_v4l2_camera_ops.info(&camera->device, &info) == OW_OK &&
        ow_video_backdrop_begin(&camera->video, &info, width, height, quarter_turns) == OW_OK) {
        camera->video.frame = frame;
        camera->video.has_frame = has_frame;
    } else { /* kept for when it comes */
        camera->video.width = width;
        camera->video.height = height;
        camera->video.turns = quarter_turns;
    }
}

static void lose(struct camera *camera)
{
    char text[TEXT_BYTES];
    linux_fault_text(&camera->device.video.fault, text, sizeof text);
    if (!camera->was_told) {
        warn_line(NULL, 0, "%s; going on without the camera until it is back", text);
    }
    camera->was_told = true;
    close_camera(camera);
}

bool camera_look(struct camera *camera)
{
    struct ow_video_frame frame;
    if (!camera->is_open) {
        return false;
    }
    int status = linux_v4l2_camera_ops.acquire(&camera->device, &frame);
    if (status == OW_AGAIN) {
        return false;
    }
    if (status == OW_OK && camera->video.has_frame) {
        status = linux_v4l2_camera_ops.release(&camera->device, camera->video.frame.number);
    }
    if (status < 0) {
        lose(camera);
        return true;
    }
    camera->video.frame = frame;
    camera->video.has_frame = true;
    camera->was_told = false;
    return true;
}

void camera_wait(struct camera *camera)
{
    const struct timespec limit = { .tv_sec = 1 };
    struct pollfd ready = { .fd = camera->device.video.fd, .events = POLLIN };
    if (camera->is_open && !camera_look(camera) &&
        camera->config.system->poll(&ready, 1, &limit) > 0) {
        (void)camera_look(camera);
    }
}

void camera_second(struct camera *camera)
{
    if (camera->is_wanted && !camera->is_open && open_camera(camera) == OW_OK) {
        camera_fit(camera, camera->video.width, camera->video.height, camera->video.turns);
    }
}

void camera_stop(struct camera *camera)
{
    close_camera(camera);
    camera->is_wanted = false;
}
