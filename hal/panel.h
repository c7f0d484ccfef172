/* SPDX-License-Identifier: 0BSD */
/*
 * The panel: whatever shows the picture. A driver fills a const struct
 * ow_panel_ops; hal/panel/null.c is the template to start from.
 *
 * A panel lends its own memory to draw in (frame buffers, page flips), or
 * takes pixels that were drawn elsewhere (SPI, I2C), or both. Every function
 * returns OW_OK or a negative ow_status: OW_GONE, OW_BUS, OW_TIMEOUT, OW_BUSY
 * and OW_DENIED speak of the device; after any of them the caller may try
 * again, and what the panel shows is undefined until a whole frame arrived.
 */
#ifndef OW_HAL_PANEL_H
#define OW_HAL_PANEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "ow_pixel.h"
#include "ow_status.h"

enum { OW_PANEL_SIZE_MAX = 4096 }; /* pixels, width and height */

struct ow_panel_info {
    uint16_t width; /* pixels as the rotation in force shows them, 1 .. OW_PANEL_SIZE_MAX */
    uint16_t height;
    const struct ow_pixel_format *format; /* channel order and byte order */
    uint32_t keep;       /* bits of a packed pixel that only their owner may write; 0: none */
    uint16_t align_x;    /* rectangles begin and end at multiples of these, in pixels, */
    uint16_t align_y;    /* or at the edge of the panel; at least 1 */
    uint32_t rect_bytes; /* what a rectangle costs on the wire beside its pixels, bytes */
    uint16_t buffers;    /* frames that lend takes turns with; 0: it does not lend */
};

/* Pixels x .. x+width-1, y .. y+height-1; never empty, inside the panel, aligned as info says. */
struct ow_panel_rect {
    uint16_t x;
    uint16_t y;
    uint16_t width;
    uint16_t height;
};

/* A frame of the panel's own memory. */
struct ow_panel_buffer {
    uint8_t *pixels; /* of the top left pixel; aligned to 4 bytes */
    uint32_t stride; /* bytes from a line to the next, a multiple of 4 */
    uint32_t age;    /* it holds what was shown so many frames ago; 0: its content is unknown */
};

enum ow_panel_setting {
    OW_PANEL_POWER,      /* 0 off, 1 on */
    OW_PANEL_BRIGHTNESS, /* 0 dark .. 255 */
    OW_PANEL_ROTATION    /* 0 .. 3 quarter turns clockwise of the picture; info changes with it */
};

struct ow_panel_ops {
    /* Fills *info. Mandatory. It stays the same until the rotation is set. */
    int (*info)(void *device, struct ow_panel_info *info);

    /*
     * Lends a frame to draw in. It is the caller's until the next show, which
     * must follow, whatever happened to the drawing. OW_AGAIN: all frames are
     * still on their way to the screen. With show: mandatory unless write is there.
     */
    int (*lend)(void *device, struct ow_panel_buffer *buffer);

    /*
     * Takes the lent frame back and shows it. count rectangles changed since
     * the frame shown last; 0: none, show nothing new. A failure takes the frame
     * back as well.
     */
    int (*show)(void *device, const struct ow_panel_rect *changed, uint32_t count);

    /*
     * Sends one rectangle. pixels: of its top left pixel, aligned to 4 bytes,
     * packed as the format says; stride: bytes, a multiple of 4. last: the frame
     * is whole now. pixels belong to the panel until done says otherwise.
     * Mandatory unless lend and show are there.
     */
    int (*write)(void *device, const struct ow_panel_rect *rect, const void *pixels,
                 uint32_t stride, bool last);

    /*
     * OW_OK: at most `pending` of the writes handed over still use their pixels
     * (0: none does); OW_AGAIN: not yet. An error of a transfer that was under
     * way is reported here, once, and all pixels are the caller's again.
     * Optional: without it write returns when the pixels are free.
     */
    int (*done)(void *device, uint32_t pending);

    /* Changes a setting; OW_ARGUMENT for a value out of range. Optional. */
    int (*set)(void *device, enum ow_panel_setting setting, int32_t value);
};

/* A driver and its device. The ops are constant; the device outlives its users. */
struct ow_panel {
    const struct ow_panel_ops *ops;
    void *device;
};

static inline bool ow_panel_lends(const struct ow_panel *panel)
{
    return panel->ops->lend != NULL && panel->ops->show != NULL;
}

static inline bool ow_panel_info_is_sound(const struct ow_panel_info *info)
{
    return info->width >= 1 && info->width <= OW_PANEL_SIZE_MAX && info->height >= 1 &&
           info->height <= OW_PANEL_SIZE_MAX && info->format != NULL && info->align_x >= 1 &&
           info->align_y >= 1;
}

/*
 * To be called once before a panel is used: are the mandatory functions there,
 * and is what info says sound? Fills *info. OW_UNSUPPORTED where a function is
 * missing or lend and info contradict each other, OW_ARGUMENT where a figure is
 * out of range, or what info itself reports.
 */
static inline int ow_panel_check(const struct ow_panel *panel, struct ow_panel_info *info)
{
    if (panel == NULL || panel->ops == NULL || panel->ops->info == NULL) {
        return OW_UNSUPPORTED;
    }
    const struct ow_panel_ops *ops = panel->ops;
    if ((ops->lend == NULL) != (ops->show == NULL) || (ops->lend == NULL && ops->write == NULL)) {
        return OW_UNSUPPORTED;
    }
    int status = ops->info(panel->device, info);
    if (status < 0) {
        return status;
    }
    if (!ow_panel_info_is_sound(info)) {
        return OW_ARGUMENT;
    }
    return (ops->lend != NULL) == (info->buffers > 0) ? OW_OK : OW_UNSUPPORTED;
}

/* The optional functions, where they may be missing. */
static inline int ow_panel_done(const struct ow_panel *panel, uint32_t pending)
{
    return panel->ops->done == NULL ? OW_OK : panel->ops->done(panel->device, pending);
}

static inline int ow_panel_set(const struct ow_panel *panel, enum ow_panel_setting setting,
                               int32_t value)
{
    return panel->ops->set == NULL ? OW_UNSUPPORTED
                                   : panel->ops->set(panel->device, setting, value);
}

#endif
