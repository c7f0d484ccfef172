/* SPDX-License-Identifier: 0BSD */
/* The functions of libdrm that the driver uses, as a table: tests put their own there. */
#ifndef OW_HAL_LINUX_DRM_CALLS_H
#define OW_HAL_LINUX_DRM_CALLS_H

#include <stdint.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

struct linux_drm_calls {
    int (*get_cap)(int fd, uint64_t capability, uint64_t *value);
    int (*is_master)(int fd);
    int (*set_master)(int fd);
    int (*drop_master)(int fd);
    drmModeResPtr (*get_resources)(int fd);
    void (*free_resources)(drmModeResPtr resources);
    drmModeConnectorPtr (*get_connector)(int fd, uint32_t id);
    drmModeConnectorPtr (*get_connector_current)(int fd, uint32_t id); /* without looking anew */
    void (*free_connector)(drmModeConnectorPtr connector);
    drmModeEncoderPtr (*get_encoder)(int fd, uint32_t id);
    void (*free_encoder)(drmModeEncoderPtr encoder);
    drmModeCrtcPtr (*get_crtc)(int fd, uint32_t id);
    void (*free_crtc)(drmModeCrtcPtr crtc);
    int (*set_crtc)(int fd, uint32_t crtc, uint32_t buffer, uint32_t x, uint32_t y,
                    uint32_t *connectors, int count, drmModeModeInfoPtr mode);
    int (*create_dumb)(int fd, uint32_t width, uint32_t height, uint32_t bits, uint32_t flags,
                       uint32_t *handle, uint32_t *pitch, uint64_t *size);
    int (*destroy_dumb)(int fd, uint32_t handle);
    int (*map_dumb)(int fd, uint32_t handle, uint64_t *offset);
    int (*add_fb2)(int fd, uint32_t width, uint32_t height, uint32_t format,
                   const uint32_t handles[4], const uint32_t pitches[4], const uint32_t offsets[4],
                   uint32_t *buffer, uint32_t flags);
    int (*rm_fb)(int fd, uint32_t buffer);
    int (*page_flip)(int fd, uint32_t crtc, uint32_t buffer, uint32_t flags, void *context);
    int (*handle_event)(int fd, drmEventContextPtr context);
};

/* libdrm's. */
extern const struct linux_drm_calls linux_drm_calls;

#endif
