/* SPDX-License-Identifier: 0BSD */
/*
 * Panels that are driven by commands: one driver for every controller, above
 * the bus of hal/bus.h. Freestanding, without heap; all state is in the struct.
 *
 *     struct ow_command_panel_config config;
 *     ow_command_panel_defaults(&config, &ow_controller_ili9341);
 *     config.bus = &bus;
 *     config.clock = &clock;
 *     config.rotation = 1;
 *     int status = ow_command_panel_open(&device, &config);
 *     ... device.panel is what a viewer is given ...
 *     ow_command_panel_close(&device);
 *
 * With a frame in the configuration the panel lends it and sends what changed;
 * without one it takes writes, so that a chip with little memory can draw band
 * by band.
 */
#ifndef OW_HAL_PANEL_COMMAND_PANEL_H
#define OW_HAL_PANEL_COMMAND_PANEL_H

#include "hal/bus.h"
#include "hal/clock.h"
#include "hal/gpio.h"
#include "hal/panel.h"
#include "hal/panel/controller.h"

/* Filled by ow_command_panel_defaults; then the board changes what differs. */
struct ow_command_panel_config {
    const struct ow_controller *controller;
    const struct ow_bus *bus;     /* mandatory */
    const struct ow_clock *clock; /* mandatory */
    const struct ow_gpio *gpio;   /* of the backlight; NULL: none */
    int backlight;                /* the output line, as gpio's open returned it; level 1 is lit */

    /* The glass, pixels, as the controller sees it; the picture's size is with rotation 0. */
    uint16_t width; /* multiples of the controller's column_pixels and row_lines; mono: of 8 */
    uint16_t height;
    uint16_t offset_x; /* where in the controller's memory it begins, with rotation 0 */
    uint16_t offset_y;
    uint16_t ram_width; /* that memory */
    uint16_t ram_height;

    uint8_t rotation; /* quarter turns clockwise, 0 .. 3, that put the picture upright */
    bool mirror_x;    /* against the usual module, */
    bool mirror_y;
    bool bgr;      /* red and blue change places, */
    bool inverted; /* and light and dark: whether, not whether more than usual */
    bool still;    /* the controller does not turn (an emulator, say): only the viewer does */
    const struct ow_pixel_format *format; /* on the wire; as many bits as the controller's own */

    struct ow_sequence init;  /* instead of the controller's, where there are bytes */
    struct ow_sequence extra; /* after it */
    uint32_t reset_hold_us;
    uint32_t reset_settle_us;

    uint8_t *frame; /* lent to the viewer, aligned to 4 bytes; NULL: the panel takes writes */
    uint32_t frame_bytes;
    uint8_t *staging; /* where lines are put together to one transfer; NULL: each is its own */
    uint32_t staging_bytes;
};

enum { OW_COMMAND_PANEL_CONVERT = 64 }; /* bytes of mono turned at a time without staging */

/* A device's state. Fields down to `counts` may be read, the others are private. */
struct ow_command_panel {
    struct ow_panel panel; /* for those who show pictures */
    struct ow_command_panel_config config;
    struct {
        uint32_t starts;  /* from reset: 1, and one more after each failure */
        uint32_t windows; /* set for a rectangle */
        uint32_t bytes;   /* of pixels */
    } counts;

    struct ow_bus_limits limits;
    uint32_t whole;   /* bytes that a transfer must not cut: a column's pixels */
    uint32_t chunk;   /* bytes of a transfer at most, a multiple of that */
    uint8_t rotation; /* the configured one and the one that was set */
    bool swap;        /* what this means for the memory */
    bool flip_columns;
    bool flip_rows;
    bool started;        /* the controller is as we left it */
    bool lit;            /* a whole frame is there and the panel is on */
    bool asleep;         /* switched off by a setting */
    int32_t light;       /* brightness 0 .. 255 that was set; negative: the controller's own */
    uint16_t columns[2]; /* the window that was sent last, if started and the controller keeps it */
    uint16_t rows[2];
    bool window_known;
    bool shown;        /* the frame lent is what the glass shows */
    uint32_t calls[2]; /* bus transfers of the last write and of the one before */
    uint8_t convert[OW_COMMAND_PANEL_CONVERT];
};

/* Fills *config with the controller's usual module; bus and clock are missing then. */
void ow_command_panel_defaults(struct ow_command_panel_config *config,
                               const struct ow_controller *controller);

/* Bytes of a frame to be lent, whichever way up. */
uint32_t ow_command_panel_frame_bytes(const struct ow_command_panel_config *config);

/*
 * Checks the configuration and copies it; what it points at outlives the
 * device. Sends nothing yet: the first frame does, or ow_command_panel_start.
 * OW_ARGUMENT: a figure is out of range; OW_MEMORY: the frame is too small;
 * OW_UNSUPPORTED: a bus or clock function or the rotation is missing; or what
 * the bus reports.
 */
int ow_command_panel_open(struct ow_command_panel *device,
                          const struct ow_command_panel_config *config);

/*
 * Resets the controller and gets it ready; the panel stays dark until it has a
 * whole frame. Done anew by itself after a failure. Returns OW_OK or what the
 * bus or clock reports.
 */
int ow_command_panel_start(struct ow_command_panel *device);

/*
 * Asks a started controller for its status: *answer is what it says. 1: it is
 * awake and lit or dark as it should be; 0: it says otherwise, or its answers do
 * not come here (all bits equal); OW_UNSUPPORTED: controller or bus cannot be read;
 * or what the bus reports.
 */
int ow_command_panel_ask(struct ow_command_panel *device, uint8_t *answer);

/* Waits for transfers under way and switches the panel off. May be called after any failure. */
int ow_command_panel_close(struct ow_command_panel *device);

#endif
