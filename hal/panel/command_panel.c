/* SPDX-License-Identifier: 0BSD */
/*
 * Command panel: configuration, start, and what a panel must do. After any
 * failure of the bus nobody knows what the controller has understood: it is
 * reset and started anew before the next pixel, and the whole frame is sent.
 */
#include "command_panel.h"
#include "command_stages.h"

enum {
    BUS_TIMEOUT_US = 1000000, /* for pixels on their way */
    BUS_NAP_US = 50,
    NOPS = 16 /* more than any command has parameters: ends one that was torn */
};

/* ---- configuration ---- */

void ow_command_panel_defaults(struct ow_command_panel_config *config,
                               const struct ow_controller *controller)
{
    *config = (struct ow_command_panel_config){
        .controller = controller,
        .width = controller->width,
        .height = controller->height,
        .offset_x = controller->offset_x,
        .offset_y = controller->offset_y,
        .ram_width = controller->ram_width,
        .ram_height = controller->ram_height,
        .inverted = controller->inverted,
        .format = controller->format,
        .reset_hold_us = controller->reset_hold_us,
        .reset_settle_us = controller->reset_settle_us,
    };
}

/* Bytes from a line of a frame to the next. */
static uint32_t stride_of(const struct ow_command_panel_config *config, uint32_t width)
{
    return (ow_row_bytes(config->format, width) + 3) / 4 * 4;
}

uint32_t ow_command_panel_frame_bytes(const struct ow_command_panel_config *config)
{
    uint32_t upright = stride_of(config, config->width) * config->height;
    uint32_t turned = stride_of(config, config->height) * config->width;
    return upright > turned ? upright : turned;
}

/* How many pixels of the glass go together: in x what a byte or column holds, in y a page. */
static uint32_t unit_x(const struct ow_command_panel_config *config)
{
    uint32_t packed = 8u / config->format->bits;
    uint32_t column = config->controller->column_pixels;
    return packed > column ? packed : column;
}

static bool glass_fits(uint32_t offset, uint32_t size, uint32_t unit, uint32_t ram)
{
    return size > 0 && size <= OW_PANEL_SIZE_MAX && offset + size <= ram && size % unit == 0 &&
           offset % unit == 0 && (ram - offset - size) % unit == 0;
}

/* Whether it ends with a whole command. */
static bool sequence_is_whole(const struct ow_sequence *sequence)
{
    uint32_t at = 0;
    while (at + 2 <= sequence->count) {
        uint32_t second = sequence->bytes[at + 1];
        at += 2 + (second & (OW_THEN_WAIT - 1u)) + (second & OW_THEN_WAIT ? 1u : 0u);
    }
    return at == sequence->count;
}

static int check_config(const struct ow_command_panel_config *config)
{
    const struct ow_controller *controller = config->controller;
    if (controller == NULL || config->format == NULL || config->rotation > 3 ||
        config->format->bits != controller->format->bits || (uintptr_t)config->frame % 4 != 0) {
        return OW_ARGUMENT;
    }
    if (!glass_fits(config->offset_x, config->width, controller->column_pixels,
                    config->ram_width) ||
        !glass_fits(config->offset_y, config->height, controller->row_lines, config->ram_height) ||
        config->width % unit_x(config) != 0) {
        return OW_ARGUMENT;
    }
    if (!sequence_is_whole(&config->init) || !sequence_is_whole(&config->extra)) {
        return OW_ARGUMENT;
    }
    if (config->frame != NULL && config->frame_bytes < ow_command_panel_frame_bytes(config)) {
        return OW_MEMORY;
    }
    return command_can_turn(config, config->rotation);
}

/* ---- the bus ---- */

int command_wait_bus(struct ow_command_panel *device, uint32_t pending)
{
    const struct ow_clock *clock = device->config.clock;
    uint64_t end_us = 0;
    for (;;) {
        uint64_t now_us;
        int status = ow_bus_done(device->config.bus, pending);
        if (status != OW_AGAIN) {
            return status;
        }
        status = clock->ops->now(clock->device, &now_us);
        end_us = end_us == 0 ? now_us + BUS_TIMEOUT_US : end_us;
        if (status < 0 || now_us >= end_us) {
            return status < 0 ? status : OW_TIMEOUT;
        }
        status = clock->ops->sleep(clock->device, now_us + BUS_NAP_US);
        if (status < 0) {
            return status;
        }
    }
}

int command_send(struct ow_command_panel *device, uint8_t code, const uint8_t *parameters,
                 uint32_t count)
{
    const struct ow_bus *bus = device->config.bus;
    int status = command_wait_bus(device, 0);
    return status < 0 ? status
                      : bus->ops->command(bus->device, code, parameters, count,
                                          device->config.controller->as_commands);
}

/* ---- start ---- */

static int sleep_us(struct ow_command_panel *device, uint64_t wait_us)
{
    const struct ow_clock *clock = device->config.clock;
    uint64_t now_us;
    int status = clock->ops->now(clock->device, &now_us);
    return status < 0 ? status : clock->ops->sleep(clock->device, now_us + wait_us);
}

static int run(struct ow_command_panel *device, const struct ow_sequence *sequence)
{
    int status = OW_OK;
    for (uint32_t at = 0; at < sequence->count && status >= 0;) {
        const uint8_t *bytes = sequence->bytes + at;
        uint32_t count = bytes[1] & (OW_THEN_WAIT - 1u);
        bool waits = (bytes[1] & OW_THEN_WAIT) != 0;
        status = command_send(device, bytes[0], bytes + 2, count);
        if (status >= 0 && waits) {
            status = sleep_us(device, bytes[2 + count] * 1000u);
        }
        at += 2 + count + (waits ? 1 : 0);
    }
    return status;
}

static int light_back(const struct ow_command_panel *device, bool lit)
{
    const struct ow_gpio *gpio = device->config.gpio;
    return gpio == NULL ? OW_OK : gpio->ops->set(gpio->device, device->config.backlight, lit);
}

/* By the line if there is one, by command if not; a torn command takes NOPs as parameters. */
static int reset(struct ow_command_panel *device)
{
    const struct ow_command_panel_config *config = &device->config;
    const struct ow_controller *controller = config->controller;
    int status = ow_bus_reset(config->bus, config->reset_hold_us, config->reset_settle_us);
    if (status != OW_UNSUPPORTED) {
        return status;
    }
    status = sleep_us(device, config->reset_settle_us); /* power may have come just now */
    for (uint32_t i = 0; i < NOPS && controller->as_commands && status >= 0; i++) {
        status = command_send(device, controller->nop_code, NULL, 0);
    }
    if (status >= 0 && controller->reset_code != 0) {
        status = command_send(device, controller->reset_code, NULL, 0);
        status = status < 0 ? status : sleep_us(device, controller->reset_wait_ms * 1000u);
    }
    return status;
}

static int set_light(struct ow_command_panel *device)
{
    const struct ow_controller *controller = device->config.controller;
    if (device->light < 0) {
        return OW_OK;
    }
    uint32_t level = ((uint32_t)device->light * controller->light_max + 127) / 255;
    uint8_t parameter = (uint8_t)level;
    return command_send(device, controller->light_code, &parameter, 1);
}

/* What stands in the configuration and not in the controller's sequence. */
static int configure(struct ow_command_panel *device)
{
    const struct ow_command_panel_config *config = &device->config;
    const struct ow_controller *controller = config->controller;
    int status = OW_OK;
    if (controller->lines_code != 0) {
        uint8_t lines = (uint8_t)(config->height - 1);
        status = command_send(device, controller->lines_code, &lines, 1);
    }
    if (status >= 0) {
        status = command_send_map(device);
    }
    uint8_t colours = config->inverted ? controller->inverted_code : controller->normal_code;
    if (status >= 0 && colours != 0) {
        status = command_send(device, colours, NULL, 0);
    }
    status = status < 0 ? status : set_light(device);
    return status < 0 ? status : run(device, &config->extra);
}

int ow_command_panel_start(struct ow_command_panel *device)
{
    const struct ow_command_panel_config *config = &device->config;
    device->started = false;
    device->lit = false;
    device->shown = false;
    device->window_known = false;
    device->calls[0] = 0;
    device->calls[1] = 0;
    int status = command_wait_bus(device, 0);
    status = status < 0 ? status : light_back(device, false);
    status = status < 0 ? status : reset(device);
    if (status >= 0) {
        status = run(device, config->init.count > 0 ? &config->init : &config->controller->init);
    }
    status = status < 0 ? status : configure(device);
    if (status >= 0 && device->asleep) {
        status = run(device, &config->controller->off);
    }
    if (status < 0) {
        return status;
    }
    device->started = true;
    device->counts.starts++;
    return OW_OK;
}

static int failed(struct ow_command_panel *device, int status)
{
    device->started = false;
    device->shown = false;
    device->window_known = false;
    return status;
}

/* The first whole frame is there: now there is something to be seen. */
static int light_up(struct ow_command_panel *device)
{
    if (device->lit || device->asleep) {
        return OW_OK;
    }
    int status = run(device, &device->config.controller->on);
    status = status < 0 ? status : light_back(device, true);
    device->lit = status >= 0;
    return status;
}

/* ---- what a panel must do ---- */

static uint16_t picture_width(const struct ow_command_panel *device)
{
    return device->swap ? device->config.height : device->config.width;
}

static uint16_t picture_height(const struct ow_command_panel *device)
{
    return device->swap ? device->config.width : device->config.height;
}

static int panel_info(void *context, struct ow_panel_info *info)
{
    const struct ow_command_panel *device = context;
    const struct ow_command_panel_config *config = &device->config;
    const struct ow_controller *controller = config->controller;
    /* Where a window may stay, a further rectangle on a line needs one range. */
    uint32_t ranges = controller->write_restarts ? 1 : 2;
    uint32_t write = controller->write_code != 0 ? 1 : 0;
    uint32_t transfers = ranges * (controller->as_commands ? 1 : 2) + write + 1;
    uint32_t pages = controller->row_lines;
    *info = (struct ow_panel_info){
        .width = picture_width(device),
        .height = picture_height(device),
        .format = config->format,
        .align_x = (uint16_t)unit_x(config),
        .align_y = (uint16_t)(device->swap ? 1 : pages),
        .rect_bytes = ranges * (1 + 2u * controller->address_bytes) + write +
                      transfers * device->limits.transfer_bytes,
        .buffers = config->frame != NULL,
    };
    return OW_OK;
}

static bool inside(uint32_t from, uint32_t size, uint32_t unit, uint32_t end)
{
    return size > 0 && from + size <= end && from % unit == 0 && size % unit == 0;
}

static bool rect_is_good(const struct ow_command_panel *device, const struct ow_panel_rect *rect)
{
    struct ow_panel_info info;
    (void)panel_info((void *)(uintptr_t)device, &info);
    return inside(rect->x, rect->width, info.align_x, info.width) &&
           inside(rect->y, rect->height, info.align_y, info.height);
}

static int send_rect(struct ow_command_panel *device, const struct ow_panel_rect *rect,
                     const uint8_t *pixels, uint32_t stride, uint32_t *calls)
{
    int status = command_set_window(device, rect);
    return status < 0 ? status : command_send_pixels(device, rect, pixels, stride, calls);
}

static int panel_write(void *context, const struct ow_panel_rect *rect, const void *pixels,
                       uint32_t stride, bool last)
{
    struct ow_command_panel *device = context;
    uint32_t calls = 0;
    if (!rect_is_good(device, rect)) {
        return OW_ARGUMENT;
    }
    int status = device->started ? OW_OK : ow_command_panel_start(device);
    status = status < 0 ? status : send_rect(device, rect, pixels, stride, &calls);
    if (status >= 0 && last) {
        status = light_up(device);
        device->shown = true;
    }
    device->calls[1] = device->calls[0];
    device->calls[0] = calls;
    return status < 0 ? failed(device, status) : OW_OK;
}

static int panel_done(void *context, uint32_t pending)
{
    struct ow_command_panel *device = context;
    uint32_t transfers = 0;
    for (uint32_t i = 0; i < pending && i < 2; i++) {
        transfers += device->calls[i];
    }
    int status = ow_bus_done(device->config.bus, transfers);
    return status < 0 && status != OW_AGAIN ? failed(device, status) : status;
}

static int panel_lend(void *context, struct ow_panel_buffer *buffer)
{
    struct ow_command_panel *device = context;
    int status = ow_bus_done(device->config.bus, 0);
    if (status < 0) {
        return status == OW_AGAIN ? status : failed(device, status);
    }
    buffer->pixels = device->config.frame;
    buffer->stride = stride_of(&device->config, picture_width(device));
    buffer->age = device->shown ? 1 : 0;
    return OW_OK;
}

static int show_rects(struct ow_command_panel *device, const struct ow_panel_rect *rects,
                      uint32_t count)
{
    uint32_t stride = stride_of(&device->config, picture_width(device));
    uint32_t calls = 0;
    int status = OW_OK;
    for (uint32_t i = 0; i < count && status >= 0; i++) {
        const uint8_t *pixels = device->config.frame + rects[i].y * stride +
                                rects[i].x * device->config.format->bits / 8u;
        status = send_rect(device, &rects[i], pixels, stride, &calls);
    }
    return status < 0 ? status : light_up(device);
}

static int panel_show(void *context, const struct ow_panel_rect *changed, uint32_t count)
{
    struct ow_command_panel *device = context;
    struct ow_panel_rect whole = { 0, 0, picture_width(device), picture_height(device) };
    for (uint32_t i = 0; i < count; i++) {
        if (!rect_is_good(device, &changed[i])) {
            device->shown = false;
            return OW_ARGUMENT;
        }
    }
    bool known = device->shown && device->started;
    device->shown = false; /* something may have been drawn that is not shown */
    if (count == 0) {
        return OW_OK;
    }
    int status = device->started ? OW_OK : ow_command_panel_start(device);
    if (status >= 0) {
        status = known ? show_rects(device, changed, count) : show_rects(device, &whole, 1);
    }
    if (status < 0) {
        return failed(device, status);
    }
    device->shown = true;
    return OW_OK;
}

/* ---- settings ---- */

static int set_rotation(struct ow_command_panel *device, int32_t value)
{
    if (value < 0 || value > 3) {
        return OW_ARGUMENT;
    }
    uint8_t rotation = (uint8_t)((device->config.rotation + (uint32_t)value) & 3);
    int status = command_can_turn(&device->config, rotation);
    if (status < 0 || rotation == device->rotation) {
        return status;
    }
    device->rotation = rotation;
    device->shown = false;
    command_turn(device);
    status = device->started ? command_send_map(device) : OW_OK;
    return status < 0 ? failed(device, status) : OW_OK;
}

static int set_power(struct ow_command_panel *device, int32_t value)
{
    if (value < 0 || value > 1) {
        return OW_ARGUMENT;
    }
    if (device->asleep == (value == 0)) {
        return OW_OK;
    }
    device->asleep = value == 0;
    if (!device->started) {
        return OW_OK;
    }
    int status;
    if (device->asleep) {
        status = light_back(device, false);
        status = status < 0 ? status : run(device, &device->config.controller->off);
        device->lit = false;
    } else {
        status = run(device, &device->config.controller->wake);
        if (status >= 0 && device->shown) {
            status = light_up(device); /* the memory has kept the frame */
        }
    }
    return status < 0 ? failed(device, status) : OW_OK;
}

static int set_brightness(struct ow_command_panel *device, int32_t value)
{
    if (device->config.controller->light_code == 0) {
        return OW_UNSUPPORTED;
    }
    if (value < 0 || value > 255) {
        return OW_ARGUMENT;
    }
    device->light = value;
    int status = device->started ? set_light(device) : OW_OK;
    return status < 0 ? failed(device, status) : OW_OK;
}

static int panel_set(void *context, enum ow_panel_setting setting, int32_t value)
{
    struct ow_command_panel *device = context;
    switch (setting) {
    case OW_PANEL_POWER:
        return set_power(device, value);
    case OW_PANEL_BRIGHTNESS:
        return set_brightness(device, value);
    case OW_PANEL_ROTATION:
        return set_rotation(device, value);
    default:
        return OW_UNSUPPORTED;
    }
}

static const struct ow_panel_ops taking_ops = {
    .info = panel_info,
    .write = panel_write,
    .done = panel_done,
    .set = panel_set,
};

static const struct ow_panel_ops lending_ops = {
    .info = panel_info,
    .lend = panel_lend,
    .show = panel_show,
    .set = panel_set,
};

int ow_command_panel_open(struct ow_command_panel *device,
                          const struct ow_command_panel_config *config)
{
    *device = (struct ow_command_panel){ .config = *config, .light = -1 };
    int status = ow_bus_check(config->bus);
    status = status < 0 ? status : ow_clock_check(config->clock);
    if (status >= 0 && config->gpio != NULL) {
        status = ow_gpio_check(config->gpio);
    }
    status = status < 0 ? status : check_config(config);
    if (status >= 0) {
        status = config->bus->ops->limits(config->bus->device, &device->limits);
    }
    if (status < 0) {
        return status;
    }
    /* A transfer ends with a whole column of pixels: chip select may be released between. */
    device->whole = unit_x(config) * config->format->bits / 8u;
    uint32_t most = device->limits.max_bytes;
    device->chunk = most == 0 ? UINT32_MAX / 4 * 4 : most / device->whole * device->whole;
    if (device->chunk == 0) {
        return OW_UNSUPPORTED;
    }
    device->rotation = config->rotation;
    command_turn(device);
    device->panel.ops = config->frame != NULL ? &lending_ops : &taking_ops;
    device->panel.device = device;
    return OW_OK;
}

int ow_command_panel_ask(struct ow_command_panel *device, uint8_t *answer)
{
    const struct ow_controller *controller = device->config.controller;
    if (controller->status_code == 0 || !device->started) {
        return OW_UNSUPPORTED;
    }
    int status = command_wait_bus(device, 0);
    status =
        status < 0 ? status : ow_bus_read(device->config.bus, controller->status_code, answer, 1);
    if (status < 0) {
        return status == OW_UNSUPPORTED ? status : failed(device, status);
    }
    uint32_t wanted = (device->asleep ? 0u : controller->status_awake) |
                      (device->lit ? controller->status_lit : 0u);
    uint32_t bits = (uint32_t)controller->status_awake | controller->status_lit;
    return *answer != 0xFF && (*answer & bits) == wanted;
}

int ow_command_panel_close(struct ow_command_panel *device)
{
    (void)command_wait_bus(device, 0);
    int status = light_back(device, false);
    if (device->started) {
        int sent = run(device, &device->config.controller->off);
        status = sent < 0 ? sent : status;
    }
    device->started = false;
    device->lit = false;
    device->shown = false;
    return status < 0 ? status : OW_OK;
}
