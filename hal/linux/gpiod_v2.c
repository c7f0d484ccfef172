/* SPDX-License-Identifier: 0BSD */
/* libgpiod 2.x behind hal/linux/gpio_lib.h. A request of one line stands for the line. */
#include <errno.h>
#include <gpiod.h>
#include <stdio.h>
#include <stdlib.h>

#include "hal/linux/gpio_lib.h"

struct line {
    struct gpiod_line_request *request;
    struct gpiod_edge_event_buffer *buffer; /* NULL: no edges are reported */
    unsigned offset;
};

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
    struct gpiod_chip_info *info = gpiod_chip_get_info(chip);
    snprintf(text, bytes, "%s", info != NULL ? gpiod_chip_info_get_name(info) : "");
    gpiod_chip_info_free(info);
}

static void chip_label(void *chip, char *text, size_t bytes)
{
    struct gpiod_chip_info *info = gpiod_chip_get_info(chip);
    snprintf(text, bytes, "%s", info != NULL ? gpiod_chip_info_get_label(info) : "");
    gpiod_chip_info_free(info);
}

static unsigned chip_lines(void *chip)
{
    struct gpiod_chip_info *info = gpiod_chip_get_info(chip);
    unsigned count = info != NULL ? (unsigned)gpiod_chip_info_get_num_lines(info) : 0;
    gpiod_chip_info_free(info);
    return count;
}

static int find_line(void *chip, const char *name)
{
    return gpiod_chip_get_line_offset_from_name(chip, name);
}

static void line_user(void *chip, unsigned offset, char *text, size_t bytes)
{
    struct gpiod_line_info *info = gpiod_chip_get_line_info(chip, offset);
    const char *user = info != NULL ? gpiod_line_info_get_consumer(info) : NULL;
    snprintf(text, bytes, "%s", user != NULL ? user : "");
    gpiod_line_info_free(info);
}

/* 0, or -1 where a value is refused. */
static int set_up(struct gpiod_line_settings *settings, const struct ow_gpio_request *request)
{
    static const enum gpiod_line_bias pulls[] = {
        [OW_GPIO_PULL_AS_IS] = GPIOD_LINE_BIAS_AS_IS,
        [OW_GPIO_PULL_NONE] = GPIOD_LINE_BIAS_DISABLED,
        [OW_GPIO_PULL_UP] = GPIOD_LINE_BIAS_PULL_UP,
        [OW_GPIO_PULL_DOWN] = GPIOD_LINE_BIAS_PULL_DOWN,
    };
    static const enum gpiod_line_edge edges[] = {
        GPIOD_LINE_EDGE_NONE,
        [OW_GPIO_RISING] = GPIOD_LINE_EDGE_RISING,
        [OW_GPIO_FALLING] = GPIOD_LINE_EDGE_FALLING,
        [OW_GPIO_RISING | OW_GPIO_FALLING] = GPIOD_LINE_EDGE_BOTH,
    };
    gpiod_line_settings_set_active_low(settings, request->active_low);
    if (gpiod_line_settings_set_bias(settings, pulls[request->pull]) < 0) {
        return -1;
    }
    if (request->direction == OW_GPIO_OUTPUT) {
        enum gpiod_line_value level =
            request->level ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
        return gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_OUTPUT) < 0
                   ? -1
                   : gpiod_line_settings_set_output_value(settings, level);
    }
    gpiod_line_settings_set_debounce_period_us(settings, request->debounce_us);
    return gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_INPUT) < 0
               ? -1
               : gpiod_line_settings_set_edge_detection(settings, edges[request->edges & 3]);
}

static struct gpiod_line_request *request_line(struct gpiod_chip *chip, unsigned offset,
                                               const struct ow_gpio_request *wish, const char *user)
{
    struct gpiod_line_settings *settings = gpiod_line_settings_new();
    struct gpiod_line_config *lines = gpiod_line_config_new();
    struct gpiod_request_config *config = gpiod_request_config_new();
    struct gpiod_line_request *request = NULL;
    if (settings != NULL && lines != NULL && config != NULL && set_up(settings, wish) == 0 &&
        gpiod_line_config_add_line_settings(lines, &offset, 1, settings) == 0) {
        gpiod_request_config_set_consumer(config, user);
        request = gpiod_chip_request_lines(chip, config, lines);
    }
    int number = errno;
    gpiod_request_config_free(config);
    gpiod_line_config_free(lines);
    gpiod_line_settings_free(settings);
    errno = number;
    return request;
}

static void line_release(void *context)
{
    struct line *line = context;
    gpiod_edge_event_buffer_free(line->buffer);
    gpiod_line_request_release(line->request);
    free(line);
}

static void *line_request(void *chip, unsigned offset, const struct ow_gpio_request *request,
                          const char *user)
{
    struct line *line = calloc(1, sizeof *line);
    if (line == NULL) {
        return NULL;
    }
    line->offset = offset;
    line->request = request_line(chip, offset, request, user);
    if (line->request == NULL) {
        int number = errno;
        free(line);
        errno = number;
        return NULL;
    }
    if (request->direction == OW_GPIO_INPUT && request->edges != 0) {
        line->buffer = gpiod_edge_event_buffer_new(1);
        if (line->buffer == NULL) {
            line_release(line);
            errno = ENOMEM;
            return NULL;
        }
    }
    return line;
}

static int line_get(void *context)
{
    const struct line *line = context;
    return (int)gpiod_line_request_get_value(line->request, line->offset);
}

static int line_set(void *context, bool level)
{
    const struct line *line = context;
    return gpiod_line_request_set_value(
        line->request, line->offset, level ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE);
}

static int line_fd(void *context)
{
    const struct line *line = context;
    return line->buffer == NULL ? -1 : gpiod_line_request_get_fd(line->request);
}

static int line_edge(void *context, struct linux_gpio_edge *edge)
{
    struct line *line = context;
    int ready = gpiod_line_request_wait_edge_events(line->request, 0);
    if (ready <= 0) {
        return ready;
    }
    if (gpiod_line_request_read_edge_events(line->request, line->buffer, 1) < 1) {
        return -1;
    }
    struct gpiod_edge_event *event = gpiod_edge_event_buffer_get_event(line->buffer, 0);
    edge->time_ns = gpiod_edge_event_get_timestamp_ns(event);
    edge->number = (uint32_t)gpiod_edge_event_get_line_seqno(event);
    edge->level = gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE;
    return 1;
}

static const struct linux_gpio_lib lib = {
    .version = gpiod_api_version,
    .debounces = true,
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
