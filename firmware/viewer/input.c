/* SPDX-License-Identifier: 0BSD */
/* Input: events of controls become turn, tilt and zoom. */
#include "stages.h"

#define DEGREE ((int32_t)11930465) /* 2^32 / 360 */

enum {
    AXIS_BITS = 15,
    TILT_LIMIT = 89,   /* degrees: at the pole `up` would be parallel to the view */
    ZOOM_LIMIT = 24,   /* levels: (17/16)^24 is about 4.3 */
    EVENTS_A_STEP = 64 /* a noisy control may not keep the loop from drawing */
};

const struct ow_binding ow_default_bindings[] = {
    { OW_CONTROL_LEFT, OW_ACTION_TURN, -10 * DEGREE },
    { OW_CONTROL_RIGHT, OW_ACTION_TURN, 10 * DEGREE },
    { OW_CONTROL_UP, OW_ACTION_TILT, 5 * DEGREE },
    { OW_CONTROL_DOWN, OW_ACTION_TILT, -5 * DEGREE },
    { OW_CONTROL_IN, OW_ACTION_ZOOM, 1 },
    { OW_CONTROL_OUT, OW_ACTION_ZOOM, -1 },
    { OW_CONTROL_KNOB_1, OW_ACTION_TURN, 5 * DEGREE },
    { OW_CONTROL_KNOB_2, OW_ACTION_TILT, 5 * DEGREE },
    { OW_CONTROL_KNOB_3, OW_ACTION_ZOOM, 1 },
    { OW_CONTROL_AXIS_X, OW_ACTION_TURN, 180 * (DEGREE - 1) },
    { OW_CONTROL_AXIS_Y, OW_ACTION_TILT, TILT_LIMIT *DEGREE },
    { OW_CONTROL_AXIS_Z, OW_ACTION_ZOOM, ZOOM_LIMIT },
    { OW_CONTROL_SELECT, OW_ACTION_HOME, 0 },
};
const uint32_t ow_default_binding_count =
    sizeof ow_default_bindings / sizeof ow_default_bindings[0];

static int32_t clamp(int64_t value, int32_t limit)
{
    if (value > limit) {
        return limit;
    }
    return value < -limit ? -limit : (int32_t)value;
}

/* The tilt and the orbit's own elevation together stay off the poles. */
static int32_t clamp_tilt(const struct ow_viewer *viewer, int64_t tilt)
{
    int32_t own = (int32_t)viewer->config.elevation;
    return (int32_t)(clamp(tilt + own, TILT_LIMIT * DEGREE) - (int64_t)own);
}

static void go_home(struct ow_viewer *viewer)
{
    viewer->turn = 0;
    viewer->tilt = 0;
    viewer->zoom = 0;
    viewer->manual = false;
}

/* Acts `times` times, or (absolute) sets the quantity to `amount`. Notes whether anything moved. */
static void act(struct ow_viewer *viewer, enum ow_action action, int64_t amount, bool absolute)
{
    ow_turn turn = viewer->turn;
    int32_t tilt = viewer->tilt;
    int32_t zoom = viewer->zoom;
    switch (action) {
    case OW_ACTION_TURN:
        viewer->turn = (absolute ? 0 : turn) + (ow_turn)amount;
        break;
    case OW_ACTION_TILT:
        viewer->tilt = clamp_tilt(viewer, (absolute ? 0 : tilt) + amount);
        break;
    case OW_ACTION_ZOOM:
        viewer->zoom = clamp((absolute ? 0 : zoom) + amount, ZOOM_LIMIT);
        break;
    case OW_ACTION_HOME:
        break;
    }
    if (viewer->turn != turn || viewer->tilt != tilt || viewer->zoom != zoom) {
        viewer->changed = true;
        viewer->manual = true;
    }
}

static void press(struct ow_viewer *viewer, const struct ow_binding *binding, uint32_t bit,
                  uint64_t time_us)
{
    if (binding->action == OW_ACTION_HOME) {
        if (viewer->manual) {
            viewer->changed = true;
        }
        go_home(viewer);
        return;
    }
    act(viewer, (enum ow_action)binding->action, binding->amount, false);
    if (viewer->held == 0) {
        viewer->repeat_us = time_us + viewer->config.repeat_us;
    }
    viewer->held |= bit;
}

static void take_event(struct ow_viewer *viewer, const struct ow_input_event *event)
{
    for (uint32_t i = 0; i < viewer->config.binding_count; i++) {
        const struct ow_binding *binding = &viewer->config.bindings[i];
        enum ow_action action = (enum ow_action)binding->action;
        if (binding->control != event->control) {
            continue;
        }
        switch ((enum ow_input_kind)event->kind) {
        case OW_INPUT_PRESS:
            press(viewer, binding, 1u << i, event->time_us);
            break;
        case OW_INPUT_RELEASE:
            viewer->held &= ~(1u << i);
            break;
        case OW_INPUT_TURN:
            act(viewer, action, (int64_t)binding->amount * event->value, false);
            break;
        case OW_INPUT_AXIS:
            act(viewer, action, ((int64_t)binding->amount * event->value) >> AXIS_BITS, true);
            break;
        }
    }
}

/* Held buttons act at each repeat_us that has passed by now_us. */
static void repeat_held(struct ow_viewer *viewer, uint64_t now_us)
{
    uint32_t interval_us = viewer->config.repeat_us;
    while (interval_us != 0 && viewer->held != 0 && viewer->repeat_us <= now_us) {
        for (uint32_t i = 0; i < viewer->config.binding_count; i++) {
            if (viewer->held >> i & 1) {
                const struct ow_binding *binding = &viewer->config.bindings[i];
                act(viewer, (enum ow_action)binding->action, binding->amount, false);
            }
        }
        viewer->repeat_us += interval_us;
    }
}

int viewer_take_input(struct ow_viewer *viewer, uint64_t now_us)
{
    const struct ow_input *input = viewer->config.input;
    for (uint32_t i = 0; i < EVENTS_A_STEP && input != NULL && !viewer->input_gone; i++) {
        struct ow_input_event event;
        int status = input->ops->next(input->device, &event);
        if (status == OW_AGAIN) {
            break;
        }
        if (status == OW_GONE || status == OW_CAPACITY) {
            viewer->held = 0; /* releases may be among what was lost */
            viewer->input_gone = status == OW_GONE;
            continue;
        }
        if (status < 0) {
            return status;
        }
        if (viewer->config.view == NULL) {
            repeat_held(viewer, event.time_us);
            take_event(viewer, &event);
        }
    }
    repeat_held(viewer, now_us);
    return OW_OK;
}
