/* SPDX-License-Identifier: 0BSD */
/*
 * Buttons and encoders. An encoder's two lines change in turn; which of them
 * changes first is the direction. It turns by one when it comes to rest, if most
 * of the way went in one direction: contacts that bounce go back and forth and
 * add up to nothing.
 */
#include "hal/linux/input_gpio.h"

enum { ALL_EDGES = 4 };

static int read_levels(struct linux_input_gpio *input)
{
    const struct ow_gpio *gpio = input->gpio;
    for (uint32_t i = 0; i < input->button_count; i++) {
        int level = gpio->ops->get(gpio->device, input->buttons[i].line);
        if (level < 0) {
            return level;
        }
        input->pressed[i] = level != 0;
    }
    for (uint32_t i = 0; i < input->encoder_count; i++) {
        int a = gpio->ops->get(gpio->device, input->encoders[i].a);
        int b = gpio->ops->get(gpio->device, input->encoders[i].b);
        if (a < 0 || b < 0) {
            return a < 0 ? a : b;
        }
        input->levels[i] = (uint8_t)(a << 1 | b);
        input->turned[i] = 0;
    }
    return OW_OK;
}

int linux_input_gpio_start(struct linux_input_gpio *input,
                           const struct linux_input_gpio_config *config)
{
    *input = (struct linux_input_gpio){ .gpio = config->gpio };
    if (ow_gpio_check(config->gpio) < 0 || config->gpio->ops->event == NULL) {
        return OW_UNSUPPORTED;
    }
    if (config->button_count > LINUX_INPUT_BUTTONS ||
        config->encoder_count > LINUX_INPUT_ENCODERS) {
        return OW_ARGUMENT;
    }
    for (uint32_t i = 0; i < config->button_count; i++) {
        input->buttons[i] = config->buttons[i];
    }
    for (uint32_t i = 0; i < config->encoder_count; i++) {
        struct linux_encoder *encoder = &input->encoders[i];
        *encoder = config->encoders[i];
        encoder->edges = encoder->edges == 0 ? (uint8_t)ALL_EDGES : encoder->edges;
        if (encoder->edges > ALL_EDGES || encoder->edges == 3) {
            return OW_ARGUMENT;
        }
    }
    input->button_count = config->button_count;
    input->encoder_count = config->encoder_count;
    int status = read_levels(input);
    for (uint32_t i = 0; i < input->encoder_count; i++) {
        input->rest[i] = input->levels[i]; /* nobody turns it now: it rests at a detent */
    }
    return status;
}

/* +1: a went before b; -1: b before a; 0: no change, or both at once (one edge was missed). */
static int direction(uint32_t before, uint32_t now)
{
    static const int8_t turns[4][4] = {
        { 0, -1, 1, 0 }, { 1, 0, 0, -1 }, { -1, 0, 0, 1 }, { 0, 1, -1, 0 }
    };
    return turns[before][now];
}

static bool rests(const struct linux_input_gpio *input, uint32_t number)
{
    uint32_t levels = input->levels[number];
    switch (input->encoders[number].edges) {
    case 1:
        return true;
    case 2:
        return levels == input->rest[number] || levels == (input->rest[number] ^ 3u);
    default:
        return levels == input->rest[number];
    }
}

/* An encoder's line has changed. True: *value is how far it has turned. */
static bool turn(struct linux_input_gpio *input, uint32_t number, bool is_a, bool level,
                 int32_t *value)
{
    uint32_t bit = is_a ? 2 : 1;
    uint32_t before = input->levels[number];
    uint32_t now = level ? before | bit : before & ~bit;
    input->levels[number] = (uint8_t)now;
    input->turned[number] += direction(before, now);
    if (!rests(input, number)) {
        return false;
    }
    int32_t turned = input->turned[number];
    int enough = (input->encoders[number].edges + 1) / 2;
    input->turned[number] = 0;
    *value = turned >= enough ? 1 : turned <= -enough ? -1 : 0;
    return *value != 0;
}

/* What an edge means. True: *event is filled, but for the time. */
static bool translate(struct linux_input_gpio *input, const struct ow_gpio_event *edge,
                      struct ow_input_event *event)
{
    for (uint32_t i = 0; i < input->button_count; i++) {
        if (input->buttons[i].line == edge->line && input->pressed[i] != edge->level) {
            input->pressed[i] = edge->level;
            event->control = input->buttons[i].control;
            event->kind = edge->level ? OW_INPUT_PRESS : OW_INPUT_RELEASE;
            event->value = 0;
            return true;
        }
    }
    for (uint32_t i = 0; i < input->encoder_count; i++) {
        bool is_a = input->encoders[i].a == edge->line;
        if ((is_a || input->encoders[i].b == edge->line) &&
            turn(input, i, is_a, edge->level, &event->value)) {
            event->control = input->encoders[i].control;
            event->kind = OW_INPUT_TURN;
            return true;
        }
    }
    return false;
}

static int input_next(void *device, struct ow_input_event *event)
{
    struct linux_input_gpio *input = device;
    struct ow_gpio_event edge;
    for (;;) {
        int status = ow_gpio_event(input->gpio, &edge);
        if (status == OW_CAPACITY) { /* all is released; what is down now comes up unheard */
            int read = read_levels(input);
            return read < 0 ? read : OW_CAPACITY;
        }
        if (status < 0) {
            return status;
        }
        if (translate(input, &edge, event)) {
            event->time_us = edge.time_us;
            return OW_OK;
        }
    }
}

const struct ow_input_ops linux_input_gpio_ops = { input_next };
