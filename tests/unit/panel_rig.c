/* SPDX-License-Identifier: 0BSD */
/* The rig of the panel tests. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "panel_rig.h"

#include <stdlib.h>
#include <string.h>

void rig_begin(struct rig *rig, const struct rig_options *options)
{
    const struct ow_controller *controller = ow_controller_by_name(options->controller);
    const struct sim_module *module = sim_module_by_name(options->controller);
    assert_non_null(controller);
    assert_non_null(module);
    *rig = (struct rig){ .module = *module, .random = 1 };
    rig->bus_config = (struct sim_bus_config){
        .limits = { .max_bytes = options->max_bytes },
        .no_reset = options->no_reset,
        .delay = options->delay,
        .fail_status = OW_BUS,
    };
    ow_command_panel_defaults(&rig->config, controller);
}

void rig_open(struct rig *rig, const struct rig_options *options)
{
    rig->bus_config.module = &rig->module;
    assert_true(sim_bus_open(&rig->bus, &rig->bus_config));
    rig->config.bus = &rig->bus.bus;
    rig->config.clock = &rig->bus.clock;
    uint32_t bytes = ow_command_panel_frame_bytes(&rig->config);
    rig->frame = calloc(1, bytes);
    assert_non_null(rig->frame);
    if (options->lends) {
        rig->lent = calloc(1, bytes);
        rig->config.frame = rig->lent;
        rig->config.frame_bytes = bytes;
    }
    if (options->staging) {
        rig->staging = calloc(1, RIG_STAGING);
        rig->config.staging = rig->staging;
        rig->config.staging_bytes = RIG_STAGING;
    }
    assert_int_equal(ow_command_panel_open(&rig->device, &rig->config), OW_OK);
    const struct ow_panel *panel = &rig->device.panel;
    if (options->rotation != 0) {
        assert_int_equal(ow_panel_set(panel, OW_PANEL_ROTATION, (int32_t)options->rotation), OW_OK);
    }
    assert_int_equal(ow_panel_check(panel, &rig->info), OW_OK);
    rig->stride = (ow_row_bytes(rig->info.format, rig->info.width) + 3) / 4 * 4;
}

void rig_close(struct rig *rig)
{
    sim_bus_close(&rig->bus);
    free(rig->frame);
    free(rig->lent);
    free(rig->staging);
}

uint32_t rig_random(struct rig *rig, uint32_t below)
{
    rig->random = rig->random * 1664525u + 1013904223u;
    return (uint32_t)((uint64_t)(rig->random >> 8) * below >> 24);
}

struct ow_panel_rect rig_whole(const struct rig *rig)
{
    return (struct ow_panel_rect){ 0, 0, rig->info.width, rig->info.height };
}

static void random_range(struct rig *rig, uint32_t size, uint32_t unit, uint16_t *from,
                         uint16_t *count)
{
    uint32_t units = size / unit;
    uint32_t first = rig_random(rig, units);
    *from = (uint16_t)(first * unit);
    *count = (uint16_t)((1 + rig_random(rig, units - first)) * unit);
}

struct ow_panel_rect rig_rect(struct rig *rig)
{
    struct ow_panel_rect rect;
    random_range(rig, rig->info.width, rig->info.align_x, &rect.x, &rect.width);
    random_range(rig, rig->info.height, rig->info.align_y, &rect.y, &rect.height);
    if (rig_random(rig, 4) == 0) {
        rect.height = rig->info.align_y;
    }
    return rect;
}

void rig_scribble(struct rig *rig, const struct ow_panel_rect *rect)
{
    const struct ow_pixel_format *format = rig->info.format;
    for (uint32_t y = rect->y; y < (uint32_t)rect->y + rect->height; y++) {
        for (uint32_t x = rect->x; x < (uint32_t)rect->x + rect->width; x++) {
            uint32_t value = rig_random(rig, 1u << format->bits);
            format->fill(rig->frame + y * rig->stride, x, x + 1,
                         format->bits == 16 ? value | value << 16 : value);
        }
    }
}

static int wait_done(struct rig *rig)
{
    const struct ow_panel *panel = &rig->device.panel;
    int status = OW_AGAIN;
    for (uint32_t i = 0; i < 100000 && status == OW_AGAIN; i++) {
        status = ow_panel_done(panel, 0);
    }
    return status;
}

int rig_write(struct rig *rig, const struct ow_panel_rect *rect, uint32_t lines)
{
    const struct ow_panel *panel = &rig->device.panel;
    uint32_t end = (uint32_t)rect->y + rect->height;
    uint32_t step = lines == 0 ? rect->height : lines;
    int status = OW_OK;
    for (uint32_t y = rect->y; y < end && status >= 0; y += step) {
        struct ow_panel_rect band = *rect;
        band.y = (uint16_t)y;
        band.height = (uint16_t)(end - y < step ? end - y : step);
        const uint8_t *pixels =
            rig->frame + y * rig->stride + rect->x * rig->info.format->bits / 8u;
        status = panel->ops->write(panel->device, &band, pixels, rig->stride, y + step >= end);
        status = status < 0 ? status : wait_done(rig);
    }
    return status;
}

int rig_show(struct rig *rig, const struct ow_panel_rect *rects, uint32_t count)
{
    const struct ow_panel *panel = &rig->device.panel;
    struct ow_panel_buffer buffer;
    int status = OW_AGAIN;
    for (uint32_t i = 0; i < 100000 && status == OW_AGAIN; i++) {
        status = panel->ops->lend(panel->device, &buffer);
    }
    if (status < 0) {
        return status;
    }
    assert_ptr_equal(buffer.pixels, rig->lent);
    assert_int_equal(buffer.stride, rig->stride);
    memcpy(buffer.pixels, rig->frame, (size_t)rig->stride * rig->info.height);
    return panel->ops->show(panel->device, rects, count);
}

/* What the panel's user packed, as the module means it. */
static uint32_t packed(const struct rig *rig, uint32_t x, uint32_t y)
{
    const struct ow_pixel_format *format = rig->info.format;
    uint32_t value = format->get(rig->frame + y * rig->stride, x);
    return format->bits == 16 && format->pack(0xFF0000) != 0xF800
               ? (value >> 8 | value << 8) & 0xFFFF
               : value;
}

bool rig_is_right(const struct rig *rig)
{
    uint32_t width = rig->module.width;
    uint32_t height = rig->module.height;
    for (uint32_t y = 0; y < rig->info.height; y++) {
        for (uint32_t x = 0; x < rig->info.width; x++) {
            const uint32_t glass[4][2] = { { x, y },
                                           { width - 1 - y, x },
                                           { width - 1 - x, height - 1 - y },
                                           { y, height - 1 - x } };
            const uint32_t *at = glass[rig->device.rotation];
            if (sim_controller_glass(&rig->bus.controller, at[0], at[1]) !=
                (int32_t)packed(rig, x, y)) {
                return false;
            }
        }
    }
    return true;
}

void rig_check(struct rig *rig)
{
    int left = OW_AGAIN; /* what was shown may be on its way still */
    for (uint32_t i = 0; i < 100000 && left == OW_AGAIN; i++) {
        left = ow_bus_done(&rig->bus.bus, 0);
    }
    assert_int_equal(left, OW_OK);
    if (rig->bus.controller.complaints != 0) {
        print_message("# the controller says: %s\n", rig->bus.controller.complaint);
    }
    assert_int_equal(rig->bus.controller.complaints, 0);
    assert_true(rig_is_right(rig));
}
