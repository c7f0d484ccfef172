/* SPDX-License-Identifier: 0BSD */
/* --panel drm. */
#include <stdio.h>

#include "hal/linux/drm.h"
#include "output.h"

enum { CARDS = 8, PATH_BYTES = 32 };

static struct linux_drm the_drm = { .fd = -1 };

static void look_after(void *context)
{
    (void)context;
    linux_drm_ready(&the_drm);
}

/* Without a name: the first card that has a screen; otherwise what the most promising one said. */
static int open_any(struct linux_drm_config *config)
{
    static char path[PATH_BYTES];
    struct linux_fault best = { 0 };
    for (int i = 0; i < CARDS; i++) {
        snprintf(path, sizeof path, "/dev/dri/card%d", i);
        config->device = path;
        int status = linux_drm_open(&the_drm, config);
        if (status == OW_OK) {
            return OW_OK;
        }
        bool absent = status == OW_GONE && the_drm.fault.call[0] != '\0';
        if (best.status == OW_OK || (!absent && best.status == OW_GONE)) {
            best = the_drm.fault;
        }
    }
    the_drm.fault = best;
    return best.status;
}

static int open_drm(struct output *output, const struct oldwell_settings *settings,
                    const struct linux_system *system)
{
    struct linux_drm_config config = {
        .system = system,
        .calls = &linux_drm_calls,
        .device = settings->device,
        .connector = settings->connector,
        .mode = settings->mode,
        .bits = (uint32_t)settings->depth,
    };
    output->fault = &the_drm.fault;
    output->panel = (struct ow_panel){ &linux_drm_ops, &the_drm };
    output->ready = look_after;
    int status = config.device != NULL ? linux_drm_open(&the_drm, &config) : open_any(&config);
    output->fd = the_drm.fd;
    return status;
}

static void close_drm(struct output *output)
{
    (void)output;
    linux_drm_close(&the_drm);
}

static int finish_drm(struct output *output)
{
    (void)output;
    return linux_drm_finish(&the_drm);
}

static int look_drm(struct output *output)
{
    (void)output;
    return linux_drm_look(&the_drm);
}

static void examine_drm(const struct output *output, struct report *report)
{
    (void)output;
    report_note(report, "drm", "%s: %s at %u Hz, rows of %u bytes", the_drm.config.device,
                the_drm.mode.name, the_drm.mode.vrefresh, the_drm.buffers[0].pitch);
}

const struct output_kind output_drm = {
    .look = look_drm,
    .examine = examine_drm,
    .open = open_drm,
    .close = close_drm,
    .finish = finish_drm,
    .on_console = true,
};
