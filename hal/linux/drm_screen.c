/* SPDX-License-Identifier: 0BSD */
/* Connectors, modes, CRTCs. */
#include "hal/linux/drm_screen.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_BYTES = 48, LIST_BYTES = 160 };

static int note(struct linux_drm *drm, int status, const char *why, const char *remedy)
{
    return linux_fault_note(&drm->fault, status, drm->config.device, NULL, why, remedy);
}

static void connector_name(const drmModeConnector *connector, char *name)
{
    const char *type = drmModeGetConnectorTypeName(connector->connector_type);
    snprintf(name, NAME_BYTES, "%s-%u", type != NULL ? type : "unknown",
             connector->connector_type_id);
}

/* ---- the mode ---- */

/* Reads WxH or WxH@HZ; hz 0 means any. */
static bool read_mode(const char *text, uint32_t *width, uint32_t *height, uint32_t *hz)
{
    char end;
    *hz = 0;
    return sscanf(text, "%ux%u@%u%c", width, height, hz, &end) == 3 ||
           sscanf(text, "%ux%u%c", width, height, &end) == 2;
}

static const drmModeModeInfo *preferred(const drmModeConnector *connector)
{
    for (int i = 0; i < connector->count_modes; i++) {
        if ((connector->modes[i].type & DRM_MODE_TYPE_PREFERRED) != 0) {
            return &connector->modes[i];
        }
    }
    return connector->count_modes > 0 ? &connector->modes[0] : NULL;
}

/* As many as there is room for. */
static void list_modes(const drmModeConnector *connector, char *names)
{
    size_t used = 0;
    names[0] = '\0';
    for (int i = 0; i < connector->count_modes; i++) {
        const drmModeModeInfo *mode = &connector->modes[i];
        int length = snprintf(names + used, LIST_BYTES - used, "%s%ux%u@%u", used == 0 ? "" : ", ",
                              mode->hdisplay, mode->vdisplay, mode->vrefresh);
        if (length < 0 || (size_t)length >= LIST_BYTES - used) {
            names[used] = '\0';
            return;
        }
        used += (size_t)length;
    }
}

static int choose_mode(struct linux_drm *drm, const drmModeConnector *connector)
{
    const drmModeModeInfo *mode = NULL;
    char names[LIST_BYTES];
    uint32_t width;
    uint32_t height;
    uint32_t hz;
    if (drm->config.mode == NULL) {
        mode = preferred(connector);
    } else if (!read_mode(drm->config.mode, &width, &height, &hz)) {
        return note(drm, OW_UNSUPPORTED, "a mode is WxH or WxH@HZ", "correct --mode");
    }
    for (int i = 0; i < connector->count_modes && mode == NULL; i++) {
        const drmModeModeInfo *offer = &connector->modes[i];
        if (offer->hdisplay == width && offer->vdisplay == height &&
            (hz == 0 || offer->vrefresh == hz)) {
            mode = offer;
        }
    }
    if (mode == NULL || mode->hdisplay < 1 || mode->hdisplay > OW_PANEL_SIZE_MAX ||
        mode->vdisplay < 1 || mode->vdisplay > OW_PANEL_SIZE_MAX) {
        int status = note(drm, OW_UNSUPPORTED, "the screen has no such mode", "");
        list_modes(connector, names);
        linux_fault_remedy(&drm->fault, "leave out --mode, or give one of %s", names);
        return status;
    }
    drm->mode = *mode;
    drm->info = (struct ow_panel_info){
        .width = mode->hdisplay, .height = mode->vdisplay, .align_x = 1, .align_y = 1
    };
    return OW_OK;
}

/* ---- the CRTC ---- */

static uint32_t crtc_of_encoder(const struct linux_drm *drm, const drmModeRes *resources,
                                uint32_t id)
{
    const struct linux_drm_calls *calls = drm->config.calls;
    drmModeEncoderPtr encoder = id == 0 ? NULL : calls->get_encoder(drm->fd, id);
    if (encoder == NULL) {
        return 0;
    }
    uint32_t crtc = encoder->crtc_id;
    for (int i = 0; i < resources->count_crtcs && crtc == 0; i++) {
        if ((encoder->possible_crtcs >> i & 1) != 0) {
            crtc = resources->crtcs[i];
        }
    }
    calls->free_encoder(encoder);
    return crtc;
}

static int choose_crtc(struct linux_drm *drm, const drmModeRes *resources,
                       const drmModeConnector *connector)
{
    drm->crtc = crtc_of_encoder(drm, resources, connector->encoder_id);
    for (int i = 0; i < connector->count_encoders && drm->crtc == 0; i++) {
        drm->crtc = crtc_of_encoder(drm, resources, connector->encoders[i]);
    }
    return drm->crtc != 0 ? OW_OK
                          : note(drm, OW_UNSUPPORTED, "no CRTC can drive this connector", "");
}

/* ---- the connector ---- */

/* The connector wanted, or NULL; names: of those there are, for the message. */
static drmModeConnectorPtr find_connector(const struct linux_drm *drm, const drmModeRes *resources,
                                          char *names)
{
    const struct linux_drm_calls *calls = drm->config.calls;
    size_t used = 0;
    names[0] = '\0';
    for (int i = 0; i < resources->count_connectors; i++) {
        char name[NAME_BYTES];
        drmModeConnectorPtr connector = calls->get_connector(drm->fd, resources->connectors[i]);
        if (connector == NULL) {
            continue;
        }
        bool has_screen = connector->connection == DRM_MODE_CONNECTED && connector->count_modes > 0;
        connector_name(connector, name);
        if (has_screen &&
            (drm->config.connector == NULL || strcmp(name, drm->config.connector) == 0)) {
            return connector;
        }
        calls->free_connector(connector);
        int length = snprintf(names + used, LIST_BYTES - used, "%s%s%s", used == 0 ? "" : ", ",
                              name, has_screen ? "" : " without a screen");
        used += length > 0 && (size_t)length < LIST_BYTES - used ? (size_t)length : 0;
    }
    return NULL;
}

int linux_drm_look(struct linux_drm *drm)
{
    const struct linux_drm_calls *calls = drm->config.calls;
    drmModeConnectorPtr connector = calls->get_connector_current(drm->fd, drm->connector);
    if (connector == NULL) {
        return linux_fault_errno(&drm->fault, drm->config.device, "MODE_GETCONNECTOR", errno);
    }
    bool connected = connector->connection != DRM_MODE_DISCONNECTED;
    calls->free_connector(connector);
    return connected ? OW_OK : note(drm, OW_GONE, "the screen was unplugged", "connect it again");
}

int linux_drm_find_screen(struct linux_drm *drm)
{
    const struct linux_drm_calls *calls = drm->config.calls;
    char names[LIST_BYTES];
    drmModeResPtr resources = calls->get_resources(drm->fd);
    if (resources == NULL) {
        return errno == EOPNOTSUPP || errno == EINVAL
                   ? note(drm, OW_UNSUPPORTED, "this device has no displays",
                          "name another one: /dev/dri/card1 for example")
                   : linux_fault_errno(&drm->fault, drm->config.device, "MODE_GETRESOURCES", errno);
    }
    int status;
    drmModeConnectorPtr connector = find_connector(drm, resources, names);
    if (connector == NULL) {
        status = note(drm, OW_GONE,
                      drm->config.connector != NULL ? "no screen at this connector"
                                                    : "no connector has a screen",
                      "");
        linux_fault_remedy(&drm->fault, "connect one; there is: %s",
                           names[0] != '\0' ? names : "no connector");
    } else {
        drm->connector = connector->connector_id;
        status = choose_mode(drm, connector);
        if (status == OW_OK) {
            status = choose_crtc(drm, resources, connector);
        }
        calls->free_connector(connector);
    }
    calls->free_resources(resources);
    return status;
}
