/* SPDX-License-Identifier: 0BSD */
/* Buttons, knobs and input devices of a board, as one input. */
#ifndef OLDWELL_BOARDS_LINUX_CONTROLS_H
#define OLDWELL_BOARDS_LINUX_CONTROLS_H

#include "hal/linux/gpio.h"
#include "hal/linux/input_evdev.h"
#include "hal/linux/input_gpio.h"
#include "hal/linux/inputs.h"
#include "hal/linux/wait.h"
#include "settings.h"

enum { CONTROLS_DEVICES = 4, CONTROLS_TEXT = 64 };

/* A part of `left=23 right=!gpiochip0:24 knob1=5+6`. */
struct control_lines {
    uint16_t control;
    char lines[2][CONTROLS_TEXT]; /* [!][CHIP:]LINE; the second is empty for a button */
};

struct controls {
    struct linux_fault fault;
    struct linux_wait *wait;
    struct linux_gpio gpio;
    struct ow_gpio lines;
    struct linux_input_gpio gpio_input;
    struct linux_evdev devices[CONTROLS_DEVICES];
    char names[CONTROLS_DEVICES][CONTROLS_TEXT];
    uint32_t device_count;
    struct linux_inputs inputs;
    struct ow_input input; /* for the viewer; its events never end */
};

/*
 * Reads the parts of a text that blanks or commas separate; at most `most`, each
 * of two lines (a knob) or one. Their count, or OW_ARGUMENT: why says what is wrong.
 */
int controls_parse(const char *text, bool knobs, struct control_lines *parts, uint32_t most,
                   char *why, size_t why_bytes);

/*
 * Opens what the settings name; nothing is fine too. lib: NULL without libgpiod.
 * On failure controls->fault says why: OW_ARGUMENT, or what the drivers report.
 */
int controls_open(struct controls *controls, const struct oldwell_settings *settings,
                  const struct linux_system *system, const struct linux_gpio_lib *lib,
                  struct linux_wait *wait);

/* Once a second: a device that is gone is looked for. */
void controls_second(struct controls *controls);

void controls_close(struct controls *controls);

#endif
