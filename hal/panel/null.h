/* SPDX-License-Identifier: 0BSD */
/* The null panel: shows nothing, costs nothing. The template for a new panel. */
#ifndef OW_HAL_PANEL_NULL_H
#define OW_HAL_PANEL_NULL_H

#include "hal/panel.h"

/* A device's state. The board owns it and fills the first three before use. */
struct ow_null_panel {
    uint16_t width; /* pixels */
    uint16_t height;
    const struct ow_pixel_format *format;
    uint32_t frames; /* whole frames so far */
};

/* Use: struct ow_panel panel = { &ow_null_panel_ops, &device }; */
extern const struct ow_panel_ops ow_null_panel_ops;

#endif
