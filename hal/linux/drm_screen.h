/* SPDX-License-Identifier: 0BSD */
/* Which connector, mode and CRTC: for drm.c. */
#ifndef OW_HAL_LINUX_DRM_SCREEN_H
#define OW_HAL_LINUX_DRM_SCREEN_H

#include "hal/linux/drm.h"

/*
 * Finds the connector, mode and CRTC that the configuration asks for, and sets
 * them with info's size. OW_GONE, OW_UNSUPPORTED, OW_BUS; drm->fault says more.
 */
int linux_drm_find_screen(struct linux_drm *drm);

#endif
