/* SPDX-License-Identifier: 0BSD */
/*
 * hal/panel.h on a display of the kernel's mode setting (/dev/dri/card0): two
 * dumb buffers and page flips. The first frame sets the mode.
 */
#ifndef OW_HAL_LINUX_DRM_H
#define OW_HAL_LINUX_DRM_H

#include <stdbool.h>
#include <stddef.h>

#include "hal/linux/drm_calls.h"
#include "hal/linux/fault.h"
#include "hal/linux/system.h"
#include "hal/panel.h"

enum { LINUX_DRM_BUFFERS = 2 };

struct linux_drm_config {
    const struct linux_system *system;
    const struct linux_drm_calls *calls;
    const char *device;    /* its path; stays */
    const char *connector; /* HDMI-A-1 for example; NULL: the first with a screen */
    const char *mode;      /* WxH or WxH@HZ; NULL: the screen's preferred one */
    uint32_t bits;         /* 16 or 32; 0 means 32 */
};

struct linux_drm_buffer {
    uint32_t handle;
    uint32_t id; /* of the frame buffer made of it */
    uint32_t pitch;
    size_t bytes;
    uint8_t *memory;
    uint32_t drawn_at; /* frame that it holds; 0: unknown */
};

/* Private but for fault and fd. */
struct linux_drm {
    struct linux_fault fault;
    int fd; /* readable when a flip is done: linux_drm_ready */
    struct linux_drm_config config;
    struct ow_panel_info info;
    uint32_t connector;
    uint32_t crtc;
    drmModeModeInfo mode;
    drmModeCrtcPtr before; /* the screen as it was; NULL: unknown */
    struct linux_drm_buffer buffers[LINUX_DRM_BUFFERS];
    uint32_t shown;  /* buffer on the screen, or on its way there */
    uint32_t frames; /* shown so far */
    bool mode_is_set;
    bool flipping; /* a flip is under way */
    bool lent;
    uint64_t flip_us; /* when it began */
};

extern const struct ow_panel_ops linux_drm_ops;

/*
 * Opens the device and makes the buffers; the screen changes with the first
 * frame. On failure nothing stays open and drm->fault says why: OW_GONE (no
 * device, connector or screen), OW_DENIED, OW_BUSY (another program shows
 * pictures), OW_UNSUPPORTED (no dumb buffers, no such mode), OW_MEMORY, OW_BUS.
 */
int linux_drm_open(struct linux_drm *drm, const struct linux_drm_config *config);

/* The screen as it was before. Safe on one that is not open. */
void linux_drm_close(struct linux_drm *drm);

/* Takes what fd has to say. */
void linux_drm_ready(struct linux_drm *drm);

/* Is the screen still connected, as far as the kernel knows? OW_OK or OW_GONE. */
int linux_drm_look(struct linux_drm *drm);

/* Returns when the last frame is on the screen: OW_OK or OW_TIMEOUT. */
int linux_drm_finish(struct linux_drm *drm);

#endif
