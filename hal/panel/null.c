/* SPDX-License-Identifier: 0BSD */
/*
 * The null panel, the porting template. To port: copy this file and its
 * header, rename, and fill in what the comments say. hal/panel.h has the
 * contract of each function. No heap, no global that changes: all state is in
 * the device struct, so that two panels can run at once.
 */
#include "hal/panel/null.h"

static int null_info(void *device, struct ow_panel_info *info)
{
    const struct ow_null_panel *panel = device;
    info->width = panel->width;
    info->height = panel->height;
    info->format = panel->format; /* what the glass wants, byte order included */
    info->keep = 0;
    info->align_x = 1;    /* 2 for 4-bit pixels, 8 for 1-bit pixels in many controllers */
    info->align_y = 1;    /* 8 for controllers with pages of 8 lines */
    info->rect_bytes = 0; /* the window's commands: 11 bytes for column, row and write */
    info->buffers = 0;    /* it lends nothing: lend and show are missing below */
    return OW_OK;
}

/*
 * A real panel sets its window to *rect, then sends the lines, stride bytes
 * apart, and returns OW_BUS when the bus says so. A driver that sends by DMA
 * returns at once and has a `done`.
 */
static int null_write(void *device, const struct ow_panel_rect *rect, const void *pixels,
                      uint32_t stride, bool last)
{
    struct ow_null_panel *panel = device;
    (void)rect;
    (void)pixels;
    (void)stride;
    if (last) {
        panel->frames++;
    }
    return OW_OK;
}

/* Functions that are left out are NULL: their callers go on without. */
const struct ow_panel_ops ow_null_panel_ops = {
    .info = null_info,
    .write = null_write,
};
