/* SPDX-License-Identifier: 0BSD */
/* Pixel formats: what they share. */
#include "ow_pixel.h"

uint32_t ow_row_bytes(const struct ow_pixel_format *format, uint32_t width)
{
    return (width * format->bits + 7) / 8;
}
