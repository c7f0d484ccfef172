/* SPDX-License-Identifier: 0BSD */
/*
 * The display that the settings ask for, as a panel. A kind of display is one
 * file output_NAME.c and a line in output.c.
 */
#ifndef OLDWELL_BOARDS_LINUX_OUTPUT_H
#define OLDWELL_BOARDS_LINUX_OUTPUT_H

#include <stdbool.h>

#include "hal/linux/fault.h"
#include "hal/linux/system.h"
#include "hal/panel.h"
#include "report.h"
#include "settings.h"

struct output;

struct output_kind {
    /*
     * Fills panel, fault and, where it has them, fd and ready. On failure
     * nothing stays open; fault says why in either case.
     */
    int (*open)(struct output *output, const struct oldwell_settings *settings,
                const struct linux_system *system);
    void (*close)(struct output *output);
    /* Returns when what was shown last is on the screen: OW_OK or a status. NULL: it is at once. */
    int (*finish)(struct output *output);
    /* Once a second: is it still there? OW_OK or a status. NULL: every show tells. */
    int (*look)(struct output *output);
    /* The doctor: more about an open display. May be NULL. */
    void (*examine)(const struct output *output, struct report *report);
    const char *usual_device; /* without --device; NULL: it is looked for */
    bool on_console;          /* it shares the screen with a terminal */
};

struct output {
    const struct output_kind *kind;
    struct ow_panel panel;
    struct linux_fault *fault; /* never NULL after open */
    int fd;                    /* readable when there is something to look after; -1: never */
    void (*ready)(void *output);
    void *device;      /* the driver's state */
    bool uses_changes; /* show profits from knowing what changed */
    bool is_open;
};

const struct output_kind *output_kind_of(const struct oldwell_settings *settings);

/* OW_MEMORY, or what the driver reports; output->fault says more. */
int output_open(struct output *output, const struct oldwell_settings *settings,
                const struct linux_system *system);

/* Safe on one that is not open. */
void output_close(struct output *output);

int output_finish(struct output *output);
int output_look(struct output *output);

extern const struct output_kind output_command;
extern const struct output_kind output_drm; /* where libdrm is there: OLDWELL_DRM */
extern const struct output_kind output_fbdev;
extern const struct output_kind output_file;
extern const struct output_kind output_v4l2;

#endif
