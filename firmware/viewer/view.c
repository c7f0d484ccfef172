/* SPDX-License-Identifier: 0BSD */
/* View: the camera of the moment, from the list or on the orbit, and the panel's rotation. */
#include "stages.h"

enum { ONE_Q16 = 1 << 16 };

/* (16/17)^level with 16 fraction bits: the share of its distance that the eye keeps. */
static uint32_t zoom_factor_q16(int32_t level)
{
    uint32_t factor = ONE_Q16;
    for (int32_t i = level; i > 0; i--) {
        factor = factor * 16 / 17;
    }
    for (int32_t i = level; i < 0; i++) {
        factor = factor * 17 / 16;
    }
    return factor;
}

static void zoom(struct ow_camera *camera, int32_t level)
{
    int64_t factor = zoom_factor_q16(level);
    if (camera->projection == OW_PARALLEL) {
        int64_t height = (camera->height * factor) >> 16;
        camera->height = height < 1 ? 1 : height > INT32_MAX ? INT32_MAX : (ow_q8)height;
        return;
    }
    for (int i = 0; i < 3; i++) {
        int64_t eye = camera->at[i] + (((int64_t)camera->eye[i] - camera->at[i]) * factor >> 16);
        camera->eye[i] = eye > OW_EYE_MAX    ? OW_EYE_MAX
                         : eye < -OW_EYE_MAX ? -OW_EYE_MAX
                                             : (ow_q8)eye;
    }
}

static int place_camera(const struct ow_viewer *viewer, struct ow_camera *camera)
{
    const struct ow_viewer_config *config = &viewer->config;
    if (config->view != NULL) {
        return config->view(config->view_context, viewer->number, camera);
    }
    ow_turn azimuth = ow_ratio(viewer->number, config->views, 32) + viewer->turn;
    ow_camera_orbit(camera, config->tree, azimuth, config->elevation + (ow_turn)viewer->tilt);
    if (viewer->zoom != 0) {
        zoom(camera, viewer->zoom);
    }
    return OW_OK;
}

/* A quarter turn clockwise: what went up goes right, what went right goes down. Exact. */
static void turn_view(struct ow_view *view)
{
    for (int i = 0; i < 3; i++) {
        ow_q30 right = view->right[i];
        view->right[i] = view->up[i];
        view->up[i] = -right;
    }
    int64_t offset = view->offset[0];
    view->offset[0] = view->offset[1];
    view->offset[1] = -offset;
    uint16_t width = view->width;
    view->width = view->height;
    view->height = width;
}

/* Lights that move with the viewer are given along the view's axes. */
static void turn_lights(struct ow_look *look)
{
    for (uint8_t i = 0; i < look->light_count; i++) {
        struct ow_light *light = &look->lights[i];
        if (!light->in_model_space) {
            int16_t right = light->direction_q14[0];
            light->direction_q14[0] = light->direction_q14[1];
            light->direction_q14[1] = (int16_t)-right;
            ow_q8 place = light->place[0];
            light->place[0] = light->place[1];
            light->place[1] = -place;
        }
    }
}

int viewer_make_view(struct ow_viewer *viewer)
{
    struct ow_camera camera = viewer->config.camera;
    bool sideways = viewer->turned & 1;
    camera.width_pixels = sideways ? viewer->panel.height : viewer->panel.width;
    camera.height_pixels = sideways ? viewer->panel.width : viewer->panel.height;
    int status = place_camera(viewer, &camera);
    if (status < 0) {
        return status;
    }
    status = ow_view_make(&viewer->view, &camera);
    viewer->look = viewer->config.look;
    for (uint8_t i = 0; status == OW_OK && i < viewer->turned; i++) {
        turn_view(&viewer->view);
        turn_lights(&viewer->look);
    }
    if (status == OW_OK && viewer->config.cuts) {
        status = ow_view_cut(&viewer->view, viewer->config.cut_normal, viewer->config.cut_distance);
    }
    return status;
}
