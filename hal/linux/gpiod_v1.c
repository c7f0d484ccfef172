/* SPDX-License-Identifier: 0BSD */
/* libgpiod 1.x behind hal/linux/gpio_lib.h. A line belongs to its chip and has a descriptor. */
#include <errno.h>
#include <gpiod.h>
#include <stdio.h>
#include <time.h>

#include "hal/linux/gpio_lib.h"

enum { SECOND_NS = 1000000000 };

static void *chip_open(const char *path)
{
    return gpiod_chip_open(path);
}

static void chip_close(void *chip)
{
    gpiod_chip_close(chip);
}

static void chip_name(void *chip, char *text, size_t bytes)
{
    snprintf(text, bytes, "%s", gpiod_chip_name(chip));
}

static void chip_label(void *chip, char *text, size_t bytes)
{
    snprintf(text, bytes, "%s", gpiod_chip_label(chip));
}

static unsigned chip_lines(void *chip)
{
    return gpiod_chip_num_lines(chip);
}

static int find_line(void *chip, const char *name)
{
    struct gpiod_line *line = gpiod_chip_find_line(chip, name);
    return line == NULL ? -1 : (int)gpiod_line_offset(line);
}

static void line_user(void *chip, unsigned offset, char *text, size_t bytes)
{
    struct gpiod_line *line = gpiod_chip_get_line(chip, offset);
    const char *user = line == NULL ? NULL : gpiod_line_consumer(line);
    snprintf(text, bytes, "%s", user != NULL ? user : "");
}

static int request_type(const struct ow_gpio_request *request)
{
    if (request->direction == OW_GPIO_OUTPUT) {
        return GPIOD_LINE_REQUEST_DIRECTION_OUTPUT;
    }
    switch (request->edges) {
    case OW_GPIO_RISING:
        return GPIOD_LINE_REQUEST_EVENT_RISING_EDGE;
    case OW_GPIO_FALLING:
        return GPIOD_LINE_REQUEST_EVENT_FALLING_EDGE;
    case OW_GPIO_RISING | OW_GPIO_FALLING:
        return GPIOD_LINE_REQUEST_EVENT_BOTH_EDGES;
    default:
        return GPIOD_LINE_REQUEST_DIRECTION_INPUT;
    }
}

static int request_flags(const struct ow_gpio_request *request)
{
    static const int pulls[] = {
        [OW_GPIO_PULL_AS_IS] = 0,
        [OW_GPIO_PULL_NONE] = GPIOD_LINE_REQUEST_FLAG_BIAS_DISABLE,
        [OW_GPIO_PULL_UP] = GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP,
        [OW_GPIO_PULL_DOWN] = GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN,
    };
    return pulls[request->pull] | (request->active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0);
}

static void *line_request(void *chip, unsigned offset, const struct ow_gpio_request *request,
                          const char *user)
{
    struct gpiod_line *line = gpiod_chip_get_line(chip, offset);
    const struct gpiod_line_request_config config = {
        .consumer = user,
        .request_type = request_type(request),
        .flags = request_flags(request),
    };
    if (line == NULL || gpiod_line_request(line, &config, request->level) < 0) {
        return NULL;
    }
    return line;
}

static void line_release(void *line)
{
    gpiod_line_release(line);
}

static int line_get(void *line)
{
    return gpiod_line_get_value(line);
}

static int line_set(void *line, bool level)
{
    return gpiod_line_set_value(line, level);
}

static int line_fd(void *line)
{
    return gpiod_line_event_get_fd(line);
}

static int line_edge(void *line, struct linux_gpio_edge *edge)
{
    const struct timespec no_time = { 0, 0 };
    struct gpiod_line_event event;
    int ready = gpiod_line_event_wait(line, &no_time);
    if (ready <= 0) {
        return ready;
    }
    if (gpiod_line_event_read(line, &event) < 0) {
        return -1;
    }
    edge->time_ns = (uint64_t)event.ts.tv_sec * SECOND_NS + (uint64_t)event.ts.tv_nsec;
    edge->number = 0;
    edge->level = event.event_type == GPIOD_LINE_EVENT_RISING_EDGE;
    return 1;
}

static const struct linux_gpio_lib lib = {
    .version = gpiod_version_string,
    .debounces = false,
    .chip_open = chip_open,
    .chip_close = chip_close,
    .chip_name = chip_name,
    .chip_label = chip_label,
    .chip_lines = chip_lines,
    .find_line = find_line,
    .line_user = line_user,
    .line_request = line_request,
    .line_release = line_release,
    .line_get = line_get,
    .line_set = line_set,
    .line_fd = line_fd,
    .line_edge = line_edge,
};

const struct linux_gpio_lib *const linux_gpio_installed = &lib;
