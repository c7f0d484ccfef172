/* SPDX-License-Identifier: 0BSD */
/* Pixel formats that only Linux devices have: red and blue in each other's place. */
#ifndef OW_HAL_LINUX_FORMATS_H
#define OW_HAL_LINUX_FORMATS_H

#include "ow_pixel.h"

extern const struct ow_pixel_format linux_format_bgr565;   /* 16-bit little-endian words */
extern const struct ow_pixel_format linux_format_xbgr8888; /* 32-bit little-endian words */

#endif
