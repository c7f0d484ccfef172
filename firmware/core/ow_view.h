/* SPDX-License-Identifier: 0BSD */
/*
 * The view: where the eye is, where it looks, and how the screen is scaled.
 * All coordinates are lattice units; right-handed axes, y up.
 */
#ifndef OW_VIEW_H
#define OW_VIEW_H

#include <stdbool.h>
#include <stdint.h>

#include "ow_fixed.h"
#include "ow_status.h"
#include "ow_tree.h"

enum {
    OW_EYE_MAX = 1 << 29,    /* largest magnitude of an eye coordinate, ow_q8: 2,097,152 units */
    OW_SCREEN_MAX = 4096,    /* largest width and height, pixels */
    OW_GUARD = (1 << 20) - 1 /* projected coordinates stay within this of the screen's centre */
};

enum ow_projection {
    OW_PERSPECTIVE, /* the eye is a point */
    OW_PARALLEL     /* the eye is infinitely far against the view vector */
};

/*
 * Camera coordinates of a lattice point v: x = right.(v - eye), y = up.(v - eye),
 * z = forward.(v - eye), exact with 38 fraction bits, then shifted right (floor) by
 * camera_shift so that they fit 31 bits: that is a camera unit. Pixels (8 fraction
 * bits, y down): X = 128*width + x*scale/z, Y = 128*height - y*scale/z, rounded to the
 * nearest; without /z in parallel projection, where the scale counts 1/256 pixels a
 * camera unit. Perspective: scale is the focal length in 1/256 pixels.
 */
struct ow_view {
    ow_q8 eye[3];
    ow_q30 right[3];
    ow_q30 up[3];
    ow_q30 forward[3];
    int64_t offset[3]; /* -right.eye, -up.eye, -forward.eye; 30 fraction bits, floor */
    int32_t near_z;    /* perspective: camera units, at least 1 */
    int32_t limit;     /* clipping keeps |x| and |y| within this (perspective: z times this, Q16) */
    struct ow_scale scale;
    uint16_t width; /* pixels, 1 .. OW_SCREEN_MAX */
    uint16_t height;
    uint8_t camera_shift; /* 38 fraction bits less this are the camera units' fraction bits */
    uint8_t projection;   /* enum ow_projection */
    bool cuts;            /* ow_view_cut was called: the rest is set */
    ow_q30 cut_axis[3];   /* model axes: unit vector into what is kept */
    int32_t cut_q20[3];   /* the same in camera axes, 20 fraction bits */
    int64_t cut_offset;   /* a camera point p is kept if cut_q20.p + cut_offset >= 0 */
};

/* What the caller says of a view. */
struct ow_camera {
    ow_q8 eye[3]; /* within OW_EYE_MAX */
    ow_q8 at[3];  /* a point in the middle of the picture, not the eye; within OW_EYE_MAX */
    ow_q8 up[3];  /* any vector not parallel to the view; its length does not matter */
    enum ow_projection projection;
    ow_turn fov;  /* perspective: vertical field of view, 1/360 .. 170/360 turn */
    ow_q8 height; /* parallel: what the screen's height shows, > 0 */
    ow_q8 near;   /* perspective: distance of the near plane, > 0; 0: OW_NEAR_DEFAULT */
    uint16_t width_pixels;
    uint16_t height_pixels;
};

enum { OW_NEAR_DEFAULT = 16 * 256 };

/*
 * Makes the view. The axes' rounding is part of the result: the same input
 * gives the same bits on every machine. Errors: OW_ARGUMENT.
 */
enum ow_status ow_view_make(struct ow_view *view, const struct ow_camera *camera);

/*
 * Cuts the model open: from now on only points v with normal.v >= distance are
 * drawn [FAG83]. normal: any length; distance along the unit normal, lattice
 * steps, within OW_EYE_MAX. To be called after ow_view_make; the tree must order
 * back faces (ow_draw_begin says OW_SIDES if it does not). Errors: OW_ARGUMENT.
 */
enum ow_status ow_view_cut(struct ow_view *view, const int32_t normal[3], ow_q8 distance);

/*
 * Sets eye, at and up of a camera on the standard orbit: around the bounding
 * box's centre at 2.5 times half its diagonal, turned by azimuth from +z
 * towards +x, raised by elevation (within a quarter turn) above the horizon.
 */
void ow_camera_orbit(struct ow_camera *camera, const struct ow_tree *tree, ow_turn azimuth,
                     ow_turn elevation);

#endif
