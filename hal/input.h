/* SPDX-License-Identifier: 0BSD */
/*
 * Input: buttons, knobs, sticks and keys, as events of logical controls. The
 * driver or the board says which physical thing is which control; the viewer
 * says what a control does.
 */
#ifndef OW_HAL_INPUT_H
#define OW_HAL_INPUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "ow_status.h"

enum ow_control {
    OW_CONTROL_LEFT,
    OW_CONTROL_RIGHT,
    OW_CONTROL_UP,
    OW_CONTROL_DOWN,
    OW_CONTROL_IN,
    OW_CONTROL_OUT,
    OW_CONTROL_SELECT,
    OW_CONTROL_BACK,
    OW_CONTROL_KNOB_1, /* encoders: turn; their push button: press and release */
    OW_CONTROL_KNOB_2,
    OW_CONTROL_KNOB_3,
    OW_CONTROL_AXIS_X, /* sticks and sliders: axis */
    OW_CONTROL_AXIS_Y,
    OW_CONTROL_AXIS_Z,
    OW_CONTROL_NAMED,      /* how many have a name above; a board may use numbers from here */
    OW_CONTROL_LIMIT = 256 /* all numbers are below this */
};

enum ow_input_kind {
    OW_INPUT_PRESS,   /* value 0 */
    OW_INPUT_RELEASE, /* value 0 */
    OW_INPUT_TURN,    /* value: steps since the last event, clockwise is positive */
    OW_INPUT_AXIS     /* value: position, -32767 .. 32767 */
};

struct ow_input_event {
    uint64_t time_us; /* when it happened, on the clock of hal/clock.h */
    uint16_t control; /* below OW_CONTROL_LIMIT */
    uint16_t kind;    /* enum ow_input_kind */
    int32_t value;
};

struct ow_input_ops {
    /*
     * Takes the oldest event, in the order of their times. OW_AGAIN: none now;
     * OW_GONE: none will ever come again; OW_CAPACITY, once: events were lost
     * (take every control as released). Never waits. Mandatory.
     */
    int (*next)(void *device, struct ow_input_event *event);
};

struct ow_input {
    const struct ow_input_ops *ops;
    void *device;
};

/* OW_UNSUPPORTED where a mandatory function is missing. */
static inline int ow_input_check(const struct ow_input *input)
{
    bool complete = input != NULL && input->ops != NULL && input->ops->next != NULL;
    return complete ? OW_OK : OW_UNSUPPORTED;
}

#endif
