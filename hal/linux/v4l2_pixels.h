/* SPDX-License-Identifier: 0BSD */
/* From the core's pixels to those of video outputs. */
#ifndef OW_HAL_LINUX_V4L2_PIXELS_H
#define OW_HAL_LINUX_V4L2_PIXELS_H

#include <stdint.h>

/*
 * A frame of XRGB8888 words to another format, whole. width: even for YUYV and
 * NV12; height: even for NV12. Y, Cb and Cr are those of ITU-R BT.601 in limited
 * range; the colour of neighbours is their mean, rounded.
 */
void linux_rgb_to_yuyv(uint8_t *to, uint32_t to_stride, const uint8_t *from, uint32_t from_stride,
                       uint32_t width, uint32_t height);
void linux_rgb_to_nv12(uint8_t *to, uint32_t to_stride, const uint8_t *from, uint32_t from_stride,
                       uint32_t width, uint32_t height);

#endif
