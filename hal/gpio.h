/* SPDX-License-Identifier: 0BSD */
/*
 * Pins: single lines for output (D/C, RESET, backlight) and for input with
 * edges that carry the time at which they happened.
 */
#ifndef OW_HAL_GPIO_H
#define OW_HAL_GPIO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "ow_status.h"

enum ow_gpio_direction { OW_GPIO_INPUT, OW_GPIO_OUTPUT };

enum ow_gpio_pull { OW_GPIO_PULL_AS_IS, OW_GPIO_PULL_NONE, OW_GPIO_PULL_UP, OW_GPIO_PULL_DOWN };

/* Edges are of the logical level: active_low turns them round as well. */
enum { OW_GPIO_RISING = 1, OW_GPIO_FALLING = 2 };

struct ow_gpio_request {
    const char *chip; /* its name, label or number; NULL: search all chips for the line */
    const char *line; /* the line's name, or its number on the chip */
    enum ow_gpio_direction direction;
    enum ow_gpio_pull pull;
    bool active_low;
    bool level;           /* an output's first logical level */
    uint8_t edges;        /* OW_GPIO_RISING | OW_GPIO_FALLING to be reported, 0: none */
    uint32_t debounce_us; /* edges nearer than this are dropped, 0: none are */
};

struct ow_gpio_event {
    uint64_t time_us; /* of the edge, on the clock of hal/clock.h */
    int line;         /* as open returned it */
    bool level;       /* logical, after the edge */
};

struct ow_gpio_ops {
    /*
     * Opens a line and returns its number for the other calls, 0 or more. The
     * request's strings are not kept. OW_GONE: no such chip or line; OW_BUSY: in
     * use; OW_DENIED; OW_UNSUPPORTED: pull or edges cannot be had. Mandatory.
     */
    int (*open)(void *device, const struct ow_gpio_request *request);

    /* The logical level, 0 or 1. Mandatory. */
    int (*get)(void *device, int line);

    /* Sets an output's logical level. Mandatory. */
    int (*set)(void *device, int line, bool level);

    /*
     * The oldest edge of all open lines not yet reported, in the order of their
     * times; OW_AGAIN: none; OW_CAPACITY, once, where edges were lost. Optional.
     */
    int (*event)(void *device, struct ow_gpio_event *event);

    /* Gives a line back, as an input if it can. Mandatory. */
    int (*close)(void *device, int line);
};

struct ow_gpio {
    const struct ow_gpio_ops *ops;
    void *device;
};

/* OW_UNSUPPORTED where a mandatory function is missing. */
static inline int ow_gpio_check(const struct ow_gpio *gpio)
{
    bool complete = gpio != NULL && gpio->ops != NULL && gpio->ops->open != NULL &&
                    gpio->ops->get != NULL && gpio->ops->set != NULL && gpio->ops->close != NULL;
    return complete ? OW_OK : OW_UNSUPPORTED;
}

static inline int ow_gpio_event(const struct ow_gpio *gpio, struct ow_gpio_event *event)
{
    return gpio->ops->event == NULL ? OW_UNSUPPORTED : gpio->ops->event(gpio->device, event);
}

#endif
