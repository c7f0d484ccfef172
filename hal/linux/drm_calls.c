/* SPDX-License-Identifier: 0BSD */
/* libdrm's functions. */
#include "hal/linux/drm_calls.h"

const struct linux_drm_calls linux_drm_calls = {
    .get_cap = drmGetCap,
    .is_master = drmIsMaster,
    .set_master = drmSetMaster,
    .drop_master = drmDropMaster,
    .get_resources = drmModeGetResources,
    .free_resources = drmModeFreeResources,
    .get_connector = drmModeGetConnector,
    .get_connector_current = drmModeGetConnectorCurrent,
    .free_connector = drmModeFreeConnector,
    .get_encoder = drmModeGetEncoder,
    .free_encoder = drmModeFreeEncoder,
    .get_crtc = drmModeGetCrtc,
    .free_crtc = drmModeFreeCrtc,
    .set_crtc = drmModeSetCrtc,
    .create_dumb = drmModeCreateDumbBuffer,
    .destroy_dumb = drmModeDestroyDumbBuffer,
    .map_dumb = drmModeMapDumbBuffer,
    .add_fb2 = drmModeAddFB2,
    .rm_fb = drmModeRmFB,
    .page_flip = drmModePageFlip,
    .handle_event = drmHandleEvent,
};
