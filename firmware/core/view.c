/* SPDX-License-Identifier: 0BSD */
/* The view: axes by integer root and quotient, once a frame. */
#include "ow_view.h"

#include <stdbool.h>

enum {
    FOV_MIN_DEGREES = 1,
    FOV_MAX_DEGREES = 170,
    GUARD_MARGIN = 4 * OW_SUB /* 4 pixels: what rounding may add to a clipped point, by far */
};

#define DEGREE 11930464u /* 2^32 / 360, rounded down */

static uint64_t magnitude(int64_t x)
{
    return x < 0 ? (uint64_t)-x : (uint64_t)x;
}

/* Scales v to unit length, 30 fraction bits, rounded towards 0. False for a zero vector. */
static bool make_unit(ow_q30 unit[3], const int64_t v[3])
{
    uint64_t largest = 0;
    for (int i = 0; i < 3; i++) {
        if (magnitude(v[i]) > largest) {
            largest = magnitude(v[i]);
        }
    }
    if (largest == 0) {
        return false;
    }
    int32_t up = 0; /* brings the largest component into 2^29 .. 2^30-1 */
    while (largest << up < (uint64_t)1 << 29) {
        up++;
    }
    int32_t down = 0;
    while (largest >> down >= (uint64_t)1 << 30) {
        down++;
    }
    uint32_t part[3];
    uint64_t squares = 0;
    for (int i = 0; i < 3; i++) {
        part[i] = (uint32_t)(magnitude(v[i]) >> down << up);
        squares += (uint64_t)part[i] * part[i];
    }
    uint32_t length = ow_sqrt64(squares);
    for (int i = 0; i < 3; i++) {
        int32_t size = part[i] >= length ? 1 << 30 : (int32_t)ow_ratio(part[i], length, 30);
        unit[i] = v[i] < 0 ? -size : size;
    }
    return true;
}

/* a x b of unit vectors, 60 fraction bits. */
static void cross(int64_t result[3], const ow_q30 a[3], const ow_q30 b[3])
{
    result[0] = (int64_t)a[1] * b[2] - (int64_t)a[2] * b[1];
    result[1] = (int64_t)a[2] * b[0] - (int64_t)a[0] * b[2];
    result[2] = (int64_t)a[0] * b[1] - (int64_t)a[1] * b[0];
}

static bool make_axes(struct ow_view *view, const struct ow_camera *camera)
{
    int64_t ahead[3];
    int64_t upward[3];
    for (int i = 0; i < 3; i++) {
        ahead[i] = (int64_t)camera->at[i] - camera->eye[i];
        upward[i] = camera->up[i];
    }
    ow_q30 up[3];
    int64_t product[3];
    if (!make_unit(view->forward, ahead) || !make_unit(up, upward)) {
        return false;
    }
    cross(product, view->forward, up);
    uint64_t size = magnitude(product[0]) | magnitude(product[1]) | magnitude(product[2]);
    if (size >> 40 == 0) { /* the angle's sine is below 2^-20: up is parallel to the view */
        return false;
    }
    (void)make_unit(view->right, product);
    cross(product, view->right, view->forward);
    for (int i = 0; i < 3; i++) {
        view->up[i] = (ow_q30)((product[i] + ((int64_t)1 << 29)) >> 30);
    }
    return true;
}

static bool within(const ow_q8 point[3])
{
    for (int i = 0; i < 3; i++) {
        if (point[i] < -OW_EYE_MAX || point[i] > OW_EYE_MAX) {
            return false;
        }
    }
    return true;
}

/* The camera units: the farthest point of the cube must fit 30 bits and a sign. */
static void make_units(struct ow_view *view)
{
    uint32_t farthest = 0;
    for (int i = 0; i < 3; i++) {
        uint32_t size = (uint32_t)magnitude(view->eye[i]);
        farthest = size > farthest ? size : farthest;
    }
    farthest += (OW_LATTICE_MAX + 1) << 8;
    view->camera_shift = (uint8_t)(32 - ow_leading_zeros(2 * farthest)); /* sqrt(3) < 2 */
    const ow_q30 *axes[3] = { view->right, view->up, view->forward };
    for (int a = 0; a < 3; a++) {
        int64_t sum = 0;
        for (int i = 0; i < 3; i++) {
            sum -= (int64_t)axes[a][i] * view->eye[i];
        }
        view->offset[a] = sum >> 8;
    }
}

/* scale * 2^shift as an integer of at most 31 bits. */
static int32_t clamp_scale(struct ow_scale scale, int32_t shift)
{
    int32_t right = scale.exponent - shift;
    if (right <= 0) {
        return INT32_MAX;
    }
    return right > 31 ? 1 : (int32_t)(scale.mantissa >> right) | 1;
}

static void make_perspective(struct ow_view *view, const struct ow_camera *camera)
{
    ow_turn half = camera->fov / 2;
    uint64_t cosine = (uint64_t)ow_cos(half);
    view->scale =
        ow_scale_of(cosine * (OW_SUB / 2) * camera->height_pixels, (uint64_t)ow_sin(half));
    struct ow_scale tangent = ow_scale_of(OW_GUARD - GUARD_MARGIN, view->scale.mantissa);
    view->limit = clamp_scale(tangent, 16 + view->scale.exponent);
    ow_q8 near = camera->near ? camera->near : OW_NEAR_DEFAULT;
    int64_t near_z = ((int64_t)near << 30) >> view->camera_shift;
    if (near_z < 1) {
        near_z = 1;
    }
    view->near_z = near_z > 1 << 30 ? 1 << 30 : (int32_t)near_z;
}

static void make_parallel(struct ow_view *view, const struct ow_camera *camera)
{
    view->scale = ow_scale_of((uint64_t)OW_SUB * camera->height_pixels, (uint64_t)camera->height);
    view->scale.exponent += 30 - view->camera_shift;
    struct ow_scale reach = ow_scale_of(OW_GUARD - GUARD_MARGIN, view->scale.mantissa);
    view->limit = clamp_scale(reach, view->scale.exponent);
    view->near_z = INT32_MIN;
}

enum ow_status ow_view_make(struct ow_view *view, const struct ow_camera *camera)
{
    bool perspective = camera->projection == OW_PERSPECTIVE;
    if (!within(camera->eye) || !within(camera->at) || camera->width_pixels < 1 ||
        camera->width_pixels > OW_SCREEN_MAX || camera->height_pixels < 1 ||
        camera->height_pixels > OW_SCREEN_MAX ||
        (perspective ? camera->fov < FOV_MIN_DEGREES * DEGREE ||
                           camera->fov > FOV_MAX_DEGREES * (DEGREE + 1) || camera->near < 0
                     : camera->height <= 0)) {
        return OW_ARGUMENT;
    }
    for (int i = 0; i < 3; i++) {
        view->eye[i] = camera->eye[i];
    }
    view->width = camera->width_pixels;
    view->height = camera->height_pixels;
    view->projection = (uint8_t)camera->projection;
    view->cuts = false;
    if (!make_axes(view, camera)) {
        return OW_ARGUMENT;
    }
    make_units(view);
    if (perspective) {
        make_perspective(view, camera);
    } else {
        make_parallel(view, camera);
    }
    return OW_OK;
}

enum ow_status ow_view_cut(struct ow_view *view, const int32_t normal[3], ow_q8 distance)
{
    int64_t given[3] = { normal[0], normal[1], normal[2] };
    if (distance < -OW_EYE_MAX || distance > OW_EYE_MAX || !make_unit(view->cut_axis, given)) {
        return OW_ARGUMENT;
    }
    const ow_q30 *axes[3] = { view->right, view->up, view->forward };
    int64_t ahead = -((int64_t)distance * (1 << 30)); /* normal.eye - distance, 38 fraction bits */
    for (int a = 0; a < 3; a++) {
        int64_t sum = 0;
        for (int i = 0; i < 3; i++) {
            sum += ((int64_t)axes[a][i] * view->cut_axis[i]) >> 10;
        }
        view->cut_q20[a] = (int32_t)(sum >> 30);
        ahead += (int64_t)view->cut_axis[a] * view->eye[a];
    }
    view->cut_offset = (ahead >> view->camera_shift) * (1 << 20);
    view->cuts = true;
    return OW_OK;
}

void ow_camera_orbit(struct ow_camera *camera, const struct ow_tree *tree, ow_turn azimuth,
                     ow_turn elevation)
{
    uint64_t squares = 0;
    for (int i = 0; i < 3; i++) {
        uint32_t side = (uint32_t)(tree->box_max[i] - tree->box_min[i]);
        squares += (uint64_t)side * side;
    }
    /* 2.5 times half the diagonal, 8 fraction bits: sqrt(squares) * 320. */
    int64_t radius = ow_sqrt64(squares * (320 * 320));
    int64_t across = (radius * ow_cos(elevation)) >> 30;
    int64_t arm[3] = { (across * ow_sin(azimuth)) >> 30, (radius * ow_sin(elevation)) >> 30,
                       (across * ow_cos(azimuth)) >> 30 };
    for (int i = 0; i < 3; i++) {
        camera->at[i] = (tree->box_min[i] + tree->box_max[i]) * 128;
        camera->eye[i] = camera->at[i] + (ow_q8)arm[i];
        camera->up[i] = i == 1 ? 256 : 0;
    }
}
