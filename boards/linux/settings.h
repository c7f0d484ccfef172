/* SPDX-License-Identifier: 0BSD */
/* What a board file and the command line ask of oldwell, checked as far as needs no device. */
#ifndef OLDWELL_BOARDS_LINUX_SETTINGS_H
#define OLDWELL_BOARDS_LINUX_SETTINGS_H

#include <stdbool.h>
#include <stdint.h>

#include "ow_draw.h"

enum panel_kind {
    PANEL_FBDEV,
    PANEL_DRM,
    PANEL_V4L2,
    PANEL_FILE,
    PANEL_COMMAND /* and above: ow_controllers[panel - PANEL_COMMAND] */
};

enum invert_choice { INVERT_AUTO, INVERT_YES, INVERT_NO };

struct oldwell_settings {
    bool doctor;
    const char *tree;  /* file; may be NULL for the doctor */
    const char *board; /* the board file read, or NULL */

    /* The panel. */
    int panel;          /* enum panel_kind */
    const char *device; /* NULL: the kind's usual one */
    uint32_t size[2];   /* pixels: v4l2, file */
    bool has_size;
    const struct ow_pixel_format *format; /* file */
    uint64_t depth;                       /* fbdev: 16, 32; 0: as it is */
    bool one_page;
    const char *connector; /* drm: its name; NULL: the first with a screen */
    const char *mode;      /* drm: WxH or WxH@HZ; NULL: the preferred one */
    uint64_t rotate;       /* degrees */
    const char *console;   /* auto, none or a terminal's path */
    uint32_t pixels;       /* v4l2: OW_VIDEO_...; 0: what the device has */
    const char *camera;    /* NULL: none */
    uint32_t camera_size[2];
    bool has_camera_size;

    /* A panel on a bus. Lines are [!][CHIP:]LINE, ! turns the level round; NULL: none. */
    bool on_i2c;
    uint64_t spi_hz; /* 0: the controller's own */
    uint64_t spi_mode;
    uint8_t i2c_address;
    const char *dc;
    const char *reset;
    const char *backlight;
    uint16_t offset[2];
    bool has_offset;
    bool bgr;
    int invert; /* enum invert_choice */
    bool mirror_x;
    bool mirror_y;

    /* Input. */
    const char *buttons; /* CONTROL=LINE ... */
    const char *knobs;   /* CONTROL=LINE+LINE ... */
    const char *input;   /* event devices by path or name, separated by commas */
    bool grab;

    /* The view. */
    struct ow_look look;
    double fov;
    double elevation;
    uint64_t orbit; /* views of one turn */
    uint64_t first; /* the view to begin with */
    uint64_t fps;
    bool still;
    bool once;

    /* The run. */
    uint64_t seconds; /* the doctor shows its picture for */
    bool stats;
    bool no_watch;
    uint64_t retry_s; /* of a device that fails; 0: give up at once */
    uint64_t wait_s;  /* for a device that is not there at the start */
};

/*
 * Reads the board file that --board names, then the command line, which has the
 * last word. Ends the program for what is wrong: status 2, or 1 for the file.
 */
void oldwell_settings_read(struct oldwell_settings *settings, int argc, char **argv);

/* Of an enum panel_kind. */
const char *panel_kind_name(int kind);

#endif
