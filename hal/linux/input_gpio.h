/* SPDX-License-Identifier: 0BSD */
/* hal/input.h from GPIO lines: buttons, and rotary encoders of two lines. */
#ifndef OW_HAL_LINUX_INPUT_GPIO_H
#define OW_HAL_LINUX_INPUT_GPIO_H

#include "hal/gpio.h"
#include "hal/input.h"

enum { LINUX_INPUT_BUTTONS = 16, LINUX_INPUT_ENCODERS = 4 };

/* Lines are numbers as gpio's open returned them, inputs with both edges. Level 1 is pressed. */
struct linux_button {
    uint16_t control;
    int line;
};

struct linux_encoder {
    uint16_t control;
    int a; /* its level rises before b's when the knob goes clockwise from rest */
    int b;
    uint8_t edges; /* from one detent to the next: 1, 2 or 4; 0: 4 */
};

struct linux_input_gpio_config {
    const struct ow_gpio *gpio;
    const struct linux_button *buttons;
    uint32_t button_count; /* at most LINUX_INPUT_BUTTONS */
    const struct linux_encoder *encoders;
    uint32_t encoder_count; /* at most LINUX_INPUT_ENCODERS */
};

/* Private. The config's arrays are copied. */
struct linux_input_gpio {
    const struct ow_gpio *gpio;
    struct linux_button buttons[LINUX_INPUT_BUTTONS];
    struct linux_encoder encoders[LINUX_INPUT_ENCODERS];
    uint32_t button_count;
    uint32_t encoder_count;
    bool pressed[LINUX_INPUT_BUTTONS];
    uint8_t levels[LINUX_INPUT_ENCODERS]; /* a in bit 1, b in bit 0 */
    uint8_t rest[LINUX_INPUT_ENCODERS];   /* levels at a detent */
    int32_t turned[LINUX_INPUT_ENCODERS]; /* edges since the last detent */
};

/* Device: struct linux_input_gpio. Events lost in the kernel are OW_CAPACITY. */
extern const struct ow_input_ops linux_input_gpio_ops;

/*
 * Reads the lines' levels; a button that is down is not pressed by that.
 * OW_ARGUMENT: too many, or a figure out of range; OW_UNSUPPORTED: the lines
 * report no edges; or what reading them reports.
 */
int linux_input_gpio_start(struct linux_input_gpio *input,
                           const struct linux_input_gpio_config *config);

#endif
