/* SPDX-License-Identifier: 0BSD */
/* Which line or key is which control. */
#include "controls.h"

#include <stdio.h>
#include <string.h>

enum { BUTTON_US = 5000, WHY_BYTES = 160 };

static const char *const control_names[OW_CONTROL_NAMED] = {
    [OW_CONTROL_LEFT] = "left",     [OW_CONTROL_RIGHT] = "right",   [OW_CONTROL_UP] = "up",
    [OW_CONTROL_DOWN] = "down",     [OW_CONTROL_IN] = "in",         [OW_CONTROL_OUT] = "out",
    [OW_CONTROL_SELECT] = "select", [OW_CONTROL_BACK] = "back",     [OW_CONTROL_KNOB_1] = "knob1",
    [OW_CONTROL_KNOB_2] = "knob2",  [OW_CONTROL_KNOB_3] = "knob3",  [OW_CONTROL_AXIS_X] = "axis-x",
    [OW_CONTROL_AXIS_Y] = "axis-y", [OW_CONTROL_AXIS_Z] = "axis-z",
};

/* ---- reading the settings ---- */

static const char separators[] = " \t,";

/* The next part of a text; its length, 0 at the end. */
static size_t next_part(const char **text)
{
    *text += strspn(*text, separators);
    return strcspn(*text, separators);
}

static bool copy_text(char *to, const char *from, size_t length)
{
    if (length == 0 || length >= CONTROLS_TEXT) {
        return false;
    }
    memcpy(to, from, length);
    to[length] = '\0';
    return true;
}

static int control_of(const char *name, size_t length)
{
    for (int i = 0; i < OW_CONTROL_NAMED; i++) {
        if (strlen(control_names[i]) == length && memcmp(control_names[i], name, length) == 0) {
            return i;
        }
    }
    return -1;
}

static bool parse_part(const char *text, size_t length, bool knob, struct control_lines *part)
{
    const char *end = text + length;
    const char *equals = memchr(text, '=', length);
    int control = equals == NULL ? -1 : control_of(text, (size_t)(equals - text));
    if (control < 0) {
        return false;
    }
    part->control = (uint16_t)control;
    part->lines[1][0] = '\0';
    const char *first = equals + 1;
    const char *plus = memchr(first, '+', (size_t)(end - first));
    if (knob != (plus != NULL)) {
        return false;
    }
    return copy_text(part->lines[0], first, (size_t)((knob ? plus : end) - first)) &&
           (!knob || copy_text(part->lines[1], plus + 1, (size_t)(end - plus - 1)));
}

int controls_parse(const char *text, bool knobs, struct control_lines *parts, uint32_t most,
                   char *why, size_t why_bytes)
{
    uint32_t count = 0;
    size_t length;
    while ((length = next_part(&text)) > 0) {
        if (count == most) {
            snprintf(why, why_bytes, "more than %u", (unsigned)most);
            return OW_ARGUMENT;
        }
        if (!parse_part(text, length, knobs, &parts[count])) {
            snprintf(why, why_bytes, "'%.*s' is not %s", (int)(length < 60 ? length : 60), text,
                     knobs ? "CONTROL=LINE+LINE, knob1=5+6 for example"
                           : "CONTROL=LINE, left=23 for example");
            return OW_ARGUMENT;
        }
        text += length;
        count++;
    }
    return (int)count;
}

/* ---- lines ---- */

/* Buttons and knobs pull to ground, usually: low is pressed. Pulls where they can be had. */
static int open_line(struct controls *controls, const char *text, uint32_t debounce_us)
{
    char chip[CONTROLS_TEXT];
    bool high = text[0] == '!';
    text += high;
    const char *colon = strrchr(text, ':');
    struct ow_gpio_request request = {
        .line = colon != NULL ? colon + 1 : text,
        .direction = OW_GPIO_INPUT,
        .pull = high ? OW_GPIO_PULL_DOWN : OW_GPIO_PULL_UP,
        .active_low = !high,
        .edges = OW_GPIO_RISING | OW_GPIO_FALLING,
        .debounce_us = debounce_us,
    };
    if (colon != NULL) {
        snprintf(chip, sizeof chip, "%.*s", (int)(colon - text), text);
        request.chip = chip;
    }
    int line = linux_gpio_ops.open(&controls->gpio, &request);
    if (line == OW_UNSUPPORTED) {
        request.pull = OW_GPIO_PULL_AS_IS;
        line = linux_gpio_ops.open(&controls->gpio, &request);
    }
    if (line < 0) {
        controls->fault = controls->gpio.fault;
        return line;
    }
    int status = linux_wait_add(controls->wait, linux_gpio_fd(&controls->gpio, line), NULL, NULL);
    return status < 0 ? status : line;
}

static int wrong(struct controls *controls, const char *option, const char *why)
{
    return linux_fault_note(&controls->fault, OW_ARGUMENT, option, NULL, why,
                            "controls are left, right, up, down, in, out, select, back, knob1 "
                            "to knob3");
}

static int open_buttons(struct controls *controls, const char *text, struct linux_button *buttons)
{
    struct control_lines parts[LINUX_INPUT_BUTTONS];
    char why[WHY_BYTES];
    int count =
        text == NULL ? 0 : controls_parse(text, false, parts, LINUX_INPUT_BUTTONS, why, sizeof why);
    if (count < 0) {
        return wrong(controls, "--buttons", why);
    }
    for (int i = 0; i < count; i++) {
        int line = open_line(controls, parts[i].lines[0], BUTTON_US);
        if (line < 0) {
            return line;
        }
        buttons[i] = (struct linux_button){ parts[i].control, line };
    }
    return count;
}

static int open_knobs(struct controls *controls, const char *text, struct linux_encoder *knobs)
{
    struct control_lines parts[LINUX_INPUT_ENCODERS];
    char why[WHY_BYTES];
    int count =
        text == NULL ? 0 : controls_parse(text, true, parts, LINUX_INPUT_ENCODERS, why, sizeof why);
    if (count < 0) {
        return wrong(controls, "--knobs", why);
    }
    for (int i = 0; i < count; i++) {
        int a = open_line(controls, parts[i].lines[0], 0);
        int b = a < 0 ? a : open_line(controls, parts[i].lines[1], 0);
        if (b < 0) {
            return b;
        }
        knobs[i] = (struct linux_encoder){ .control = parts[i].control, .a = a, .b = b };
    }
    return count;
}

static int open_gpio(struct controls *controls, const struct oldwell_settings *settings)
{
    struct linux_button buttons[LINUX_INPUT_BUTTONS];
    struct linux_encoder knobs[LINUX_INPUT_ENCODERS];
    if (settings->buttons == NULL && settings->knobs == NULL) {
        return OW_OK;
    }
    int button_count = open_buttons(controls, settings->buttons, buttons);
    int knob_count = button_count < 0 ? button_count : open_knobs(controls, settings->knobs, knobs);
    if (knob_count < 0) {
        return knob_count;
    }
    const struct linux_input_gpio_config config = {
        .gpio = &controls->lines,
        .buttons = buttons,
        .button_count = (uint32_t)button_count,
        .encoders = knobs,
        .encoder_count = (uint32_t)knob_count,
    };
    const struct ow_input input = { &linux_input_gpio_ops, &controls->gpio_input };
    int status = linux_input_gpio_start(&controls->gpio_input, &config);
    if (status < 0) {
        return linux_fault_note(&controls->fault, status, "buttons and knobs", NULL,
                                ow_status_text(status), "check the lines");
    }
    status = linux_wait_add(controls->wait, linux_gpio_timer_fd(&controls->gpio), NULL, NULL);
    return status < 0 ? status : linux_inputs_add(&controls->inputs, &input);
}

/* ---- input devices ---- */

static int open_devices(struct controls *controls, const struct oldwell_settings *settings,
                        const struct linux_system *system)
{
    const char *text = settings->input;
    size_t length;
    while (text != NULL && (length = strcspn(text += strspn(text, ","), ",")) > 0) {
        uint32_t number = controls->device_count;
        if (number == CONTROLS_DEVICES || !copy_text(controls->names[number], text, length)) {
            return linux_fault_note(&controls->fault, OW_ARGUMENT, "--input", NULL,
                                    "too many devices, or too long a name", "use fewer");
        }
        const struct linux_evdev_config config = {
            .system = system,
            .device = controls->names[number],
            .grab = settings->grab,
        };
        struct linux_evdev *device = &controls->devices[number];
        int status = linux_evdev_open(device, &config);
        if (status < 0) {
            controls->fault = device->fault;
            return status;
        }
        controls->device_count++;
        const struct ow_input input = { &linux_evdev_ops, device };
        status = linux_wait_add(controls->wait, device->fd, NULL, NULL);
        status = status < 0 ? status : linux_inputs_add(&controls->inputs, &input);
        if (status < 0) {
            return status;
        }
        text += length;
    }
    return OW_OK;
}

/* ---- all ---- */

static int no_event(void *device, struct ow_input_event *event)
{
    (void)device;
    (void)event;
    return OW_AGAIN;
}

static const struct ow_input_ops no_input_ops = { no_event };

int controls_open(struct controls *controls, const struct oldwell_settings *settings,
                  const struct linux_system *system, const struct linux_gpio_lib *lib,
                  struct linux_wait *wait)
{
    const struct linux_gpio_config config = { .lib = lib };
    *controls = (struct controls){ .wait = wait };
    linux_gpio_init(&controls->gpio, &config);
    controls->lines = (struct ow_gpio){ &linux_gpio_ops, &controls->gpio };
    controls->input = (struct ow_input){ &no_input_ops, NULL };
    int status = open_gpio(controls, settings);
    if (status == OW_OK) {
        status = open_devices(controls, settings, system);
    }
    if (controls->inputs.count > 0) {
        controls->input = (struct ow_input){ &linux_inputs_ops, &controls->inputs };
    }
    if (status < 0) {
        controls_close(controls);
    }
    return status;
}

void controls_second(struct controls *controls)
{
    for (uint32_t i = 0; i < controls->device_count; i++) {
        struct linux_evdev *device = &controls->devices[i];
        if (device->fd < 0 && linux_evdev_retry(device)) {
            (void)linux_wait_add(controls->wait, device->fd, NULL, NULL);
        }
    }
}

void controls_close(struct controls *controls)
{
    for (int i = 0; i < LINUX_GPIO_LINES; i++) {
        linux_wait_remove(controls->wait, linux_gpio_fd(&controls->gpio, i));
    }
    linux_wait_remove(controls->wait, linux_gpio_timer_fd(&controls->gpio));
    linux_gpio_close(&controls->gpio);
    for (uint32_t i = 0; i < controls->device_count; i++) {
        linux_wait_remove(controls->wait, controls->devices[i].fd);
        linux_evdev_close(&controls->devices[i]);
    }
    controls->device_count = 0;
}
