/* SPDX-License-Identifier: 0BSD */
/*
 * hal/panel.h on a frame buffer device (/dev/fb0): 16 bits 565 and 32 bits
 * 8888, either channel order. Two pages where panning works; otherwise frames
 * are drawn beside the screen's memory, and only what changed is copied there.
 */
#ifndef OW_HAL_LINUX_FBDEV_H
#define OW_HAL_LINUX_FBDEV_H

#include <linux/fb.h>
#include <stdbool.h>
#include <stddef.h>

#include "hal/linux/fault.h"
#include "hal/linux/system.h"
#include "hal/panel.h"

struct linux_fbdev_config {
    const struct linux_system *system;
    const char *device; /* its path; stays */
    uint32_t bits;      /* 16 or 32: the depth to set; 0: as it is */
    bool one_page;      /* do not try to pan */
};

/* Private but for fault. */
struct linux_fbdev {
    struct linux_fault fault;
    struct linux_fbdev_config config;
    struct ow_panel_info info;
    struct fb_var_screeninfo before; /* the mode as it was */
    struct fb_var_screeninfo mode;
    int fd;
    uint8_t *memory; /* what mmap gave */
    size_t mapped;
    uint8_t *screen; /* the first pixel of the first page */
    uint32_t stride;
    uint8_t *beside; /* one page: where frames are drawn */
    uint32_t beside_stride;
    uint32_t pages;
    uint32_t shown;       /* page on the screen */
    uint32_t frames;      /* shown so far */
    uint32_t drawn_at[2]; /* frame that each page holds; 0: unknown */
    bool waits;           /* FBIO_WAITFORVSYNC is offered */
    bool lent;
};

extern const struct ow_panel_ops linux_fbdev_ops;

/*
 * Opens the device. On failure nothing stays open and fbdev->fault says why:
 * OW_GONE, OW_DENIED, OW_BUSY, OW_UNSUPPORTED (a mode that is not drawn here, or
 * a depth that the driver does not take), OW_MEMORY, OW_BUS.
 */
int linux_fbdev_open(struct linux_fbdev *fbdev, const struct linux_fbdev_config *config);

/* Back to the mode and page of before; the last picture stays. Safe on one that is not open. */
void linux_fbdev_close(struct linux_fbdev *fbdev);

#endif
