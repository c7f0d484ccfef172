/* SPDX-License-Identifier: 0BSD */
/*
 * Every controller and rotation on its model: what the glass shows is the frame
 * drawn, bit for bit, however it was cut, and the model has nothing to complain of.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

#include "panel_rig.h"

static bool turns(const char *controller, uint32_t rotation)
{
    static const char *const flips_only[] = { "ssd0323", "ssd1322", "ssd1329" };
    for (size_t i = 0; i < sizeof flips_only / sizeof flips_only[0]; i++) {
        if (strcmp(controller, flips_only[i]) == 0) {
            return rotation % 2 == 0;
        }
    }
    return true;
}

/* The frame at once, in bands, and rectangles over it. */
static void draw(struct rig *rig, bool lends)
{
    struct ow_panel_rect whole = rig_whole(rig);
    rig_scribble(rig, &whole);
    assert_int_equal(lends ? rig_show(rig, &whole, 1) : rig_write(rig, &whole, 0), OW_OK);
    rig_check(rig);
    rig_scribble(rig, &whole);
    assert_int_equal(lends ? rig_show(rig, &whole, 1) : rig_write(rig, &whole, 16), OW_OK);
    rig_check(rig);
    for (int i = 0; i < 12; i++) {
        struct ow_panel_rect rects[3];
        for (int k = 0; k < 3; k++) {
            rects[k] = rig_rect(rig);
            rig_scribble(rig, &rects[k]);
        }
        for (int k = 0; k < 3 && !lends; k++) {
            assert_int_equal(rig_write(rig, &rects[k], 0), OW_OK);
        }
        if (lends) {
            assert_int_equal(rig_show(rig, rects, 3), OW_OK);
        }
        rig_check(rig);
    }
}

static void the_glass_shows_the_frame(void **state)
{
    (void)state;
    for (uint32_t c = 0; c < ow_controller_count; c++) {
        for (uint32_t rotation = 0; rotation < 4; rotation++) {
            for (uint32_t way = 0; way < 8; way++) {
                const struct rig_options options = {
                    .controller = ow_controllers[c]->name,
                    .rotation = rotation,
                    .max_bytes = way & 2 ? 103 : 0,
                    .staging = way & 1,
                    .lends = (way & 4) != 0,
                    .delay = way == 3 || way == 5 ? 3 : 0,
                };
                if (!turns(options.controller, rotation)) {
                    continue;
                }
                struct rig rig;
                print_message("# %s, rotation %u, way %u\n", options.controller, (unsigned)rotation,
                              (unsigned)way);
                rig_begin(&rig, &options);
                rig.bus_config.delay = options.max_bytes == 0 ? options.delay : 0;
                rig_open(&rig, &options);
                draw(&rig, options.lends);
                assert_int_equal(rig.bus.controller.resets, 1);
                assert_true(rig.bus.config.limits.max_bytes == 0 || rig.bus.longest <= 103);
                assert_int_equal(ow_command_panel_close(&rig.device), OW_OK);
                assert_int_equal(rig.bus.controller.complaints, 0);
                assert_false(rig.bus.controller.lit);
                rig_close(&rig);
            }
        }
    }
}

static void what_cannot_turn_says_so(void **state)
{
    (void)state;
    for (uint32_t c = 0; c < ow_controller_count; c++) {
        const struct rig_options options = { .controller = ow_controllers[c]->name };
        for (int32_t rotation = 0; rotation < 4; rotation++) {
            struct rig rig;
            rig_begin(&rig, &options);
            rig_open(&rig, &options);
            assert_int_equal(ow_panel_set(&rig.device.panel, OW_PANEL_ROTATION, rotation),
                             turns(options.controller, (uint32_t)rotation) ? OW_OK
                                                                           : OW_UNSUPPORTED);
            rig.config.still = true;
            assert_int_equal(ow_command_panel_open(&rig.device, &rig.config), OW_OK);
            assert_int_equal(ow_panel_set(&rig.device.panel, OW_PANEL_ROTATION, rotation),
                             rotation == 0 ? OW_OK : OW_UNSUPPORTED);
            rig_close(&rig);
        }
    }
}

/* The picture is upright with the configured rotation; a setting turns it from there. */
static void the_configured_rotation_comes_first(void **state)
{
    (void)state;
    for (uint32_t mounted = 0; mounted < 4; mounted++) {
        const struct rig_options options = { .controller = "ili9341", .rotation = 3 };
        struct rig rig;
        rig_begin(&rig, &options);
        rig.config.rotation = (uint8_t)mounted;
        rig_open(&rig, &options);
        assert_int_equal(rig.device.rotation, (mounted + 3) % 4);
        assert_int_equal(rig.info.width, mounted % 2 == 0 ? 320 : 240);
        draw(&rig, false);
        rig_close(&rig);
    }
}

/* Modules that differ from the usual one, and the configuration that says how. */
static const struct other {
    const char *name;
    uint16_t width, height, offset_x, offset_y;
    uint8_t toggled; /* bits of the map */
    bool mirror_x, mirror_y, bgr, inverts;
} others[] = {
    { "st7789", 240, 240, 0, 0, 0, false, false, false, false },
    { "st7789", 135, 240, 52, 40, 0, false, false, false, false },
    { "st7789", 240, 320, 0, 0, 0x40, true, false, false, false },
    { "st7735", 80, 160, 26, 1, 0x08, false, false, true, true },
    { "ili9341", 240, 320, 0, 0, 0x88, false, true, true, true },
    { "ssd1351", 128, 96, 0, 0, 0x04, false, false, true, true },
    { "ssd1351", 128, 128, 0, 0, 0x10, false, true, false, false },
    { "ssd1306", 128, 32, 0, 0, 0, false, false, false, true },
    { "ssd1306", 72, 40, 28, 0, 0, false, false, false, false },
    { "ssd1322", 240, 128, 120, 0, 0, false, false, false, true },
    { "ssd1329", 96, 96, 0, 0, 0, false, false, false, true },
};

static void other_modules_are_configured(void **state)
{
    static const uint8_t pins[] = { 0xDA, 1, 0x02 };
    (void)state;
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        const struct other *other = &others[i];
        for (uint32_t rotation = 0; rotation < 4; rotation++) {
            const struct rig_options options = { .controller = other->name, .rotation = rotation };
            if (!turns(other->name, rotation)) {
                continue;
            }
            struct rig rig;
            print_message("# module %u, %s, rotation %u\n", (unsigned)i, other->name,
                          (unsigned)rotation);
            rig_begin(&rig, &options);
            rig.config.width = rig.module.width = other->width;
            rig.config.height = rig.module.height = other->height;
            rig.config.offset_x = rig.module.offset_x = other->offset_x;
            rig.config.offset_y = rig.module.offset_y = other->offset_y;
            rig.module.upright ^= other->toggled;
            rig.config.mirror_x = other->mirror_x;
            rig.config.mirror_y = other->mirror_y;
            rig.config.bgr = other->bgr;
            rig.module.inverted ^= other->inverts;
            rig.config.inverted ^= other->inverts;
            if (rig.module.kind == SIM_PAGES) {
                rig.config.extra = (struct ow_sequence)OW_SEQUENCE(pins);
            }
            rig_open(&rig, &options);
            draw(&rig, false);
            rig_close(&rig);
        }
    }
}

static void little_endian_pixels_can_be_sent(void **state)
{
    static const uint8_t endian[] = { 0xB0, 2, 0x00, 0xF8 };
    const struct rig_options options = { .controller = "st7789", .lends = true };
    struct rig rig;
    (void)state;
    rig_begin(&rig, &options);
    rig.module.little = true;
    rig.config.format = &ow_format_rgb565;
    rig.config.extra = (struct ow_sequence)OW_SEQUENCE(endian);
    rig_open(&rig, &options);
    draw(&rig, true);
    rig_close(&rig);
}

static void without_a_reset_line_it_is_reset_by_command(void **state)
{
    (void)state;
    for (uint32_t c = 0; c < ow_controller_count; c++) {
        const struct rig_options options = { .controller = ow_controllers[c]->name,
                                             .no_reset = true };
        struct rig rig;
        rig_begin(&rig, &options);
        rig_open(&rig, &options);
        draw(&rig, false);
        assert_int_equal(rig.bus.controller.resets, 0);
        rig_close(&rig);
    }
}

static void it_is_dark_until_it_has_a_whole_frame(void **state)
{
    (void)state;
    for (uint32_t c = 0; c < ow_controller_count; c++) {
        const struct rig_options options = { .controller = ow_controllers[c]->name };
        struct rig rig;
        rig_begin(&rig, &options);
        rig_open(&rig, &options);
        struct ow_panel_rect whole = rig_whole(&rig);
        const struct ow_panel *panel = &rig.device.panel;
        assert_int_equal(rig.bus.calls, 0); /* opening sends nothing */
        assert_int_equal(ow_command_panel_start(&rig.device), OW_OK);
        assert_int_equal(panel->ops->write(panel->device, &whole, rig.frame, rig.stride, false),
                         OW_OK);
        assert_false(rig.bus.controller.lit);
        assert_int_equal(rig_write(&rig, &whole, 0), OW_OK);
        assert_true(rig.bus.controller.lit);
        rig_check(&rig);
        /* Off, a new frame in the dark, on again. */
        assert_int_equal(ow_panel_set(panel, OW_PANEL_POWER, 0), OW_OK);
        assert_false(rig.bus.controller.lit);
        rig_scribble(&rig, &whole);
        assert_int_equal(rig_write(&rig, &whole, 0), OW_OK);
        assert_false(rig.bus.controller.lit);
        assert_int_equal(ow_panel_set(panel, OW_PANEL_POWER, 1), OW_OK);
        rig_check(&rig);
        int light = ow_panel_set(panel, OW_PANEL_BRIGHTNESS, 100);
        assert_int_equal(light, ow_controllers[c]->light_code == 0 ? OW_UNSUPPORTED : OW_OK);
        assert_int_equal(ow_panel_set(panel, OW_PANEL_POWER, 2), OW_ARGUMENT);
        rig_check(&rig);
        rig_close(&rig);
    }
}

/* ---- a backlight ---- */

static struct {
    bool lit;
    int status; /* of setting it */
} backlight;

static int light_open(void *device, const struct ow_gpio_request *request)
{
    (void)device;
    (void)request;
    return OW_UNSUPPORTED;
}

static int light_get(void *device, int line)
{
    (void)device;
    (void)line;
    return backlight.lit;
}

static int light_set(void *device, int line, bool level)
{
    (void)device;
    assert_int_equal(line, 5);
    backlight.lit = backlight.status < 0 ? backlight.lit : level;
    return backlight.status;
}

static int light_close(void *device, int line)
{
    (void)device;
    (void)line;
    return OW_OK;
}

static void the_backlight_comes_with_the_first_frame(void **state)
{
    static const struct ow_gpio_ops ops = { light_open, light_get, light_set, NULL, light_close };
    static const struct ow_gpio gpio = { &ops, NULL };
    const struct rig_options options = { .controller = "st7789" };
    struct rig rig;
    (void)state;
    rig_begin(&rig, &options);
    rig.config.gpio = &gpio;
    rig.config.backlight = 5;
    rig_open(&rig, &options);
    struct ow_panel_rect whole = rig_whole(&rig);
    backlight.lit = true; /* as the board came up */
    backlight.status = OW_OK;
    assert_int_equal(ow_command_panel_start(&rig.device), OW_OK);
    assert_false(backlight.lit);
    assert_int_equal(rig_write(&rig, &whole, 0), OW_OK);
    assert_true(backlight.lit);
    assert_int_equal(ow_panel_set(&rig.device.panel, OW_PANEL_POWER, 0), OW_OK);
    assert_false(backlight.lit);
    assert_int_equal(ow_panel_set(&rig.device.panel, OW_PANEL_POWER, 1), OW_OK);
    assert_true(backlight.lit);
    backlight.status = OW_GONE;
    assert_int_equal(ow_panel_set(&rig.device.panel, OW_PANEL_POWER, 0), OW_GONE);
    assert_int_equal(ow_panel_set(&rig.device.panel, OW_PANEL_POWER, 1), OW_OK);
    assert_int_equal(rig_write(&rig, &whole, 0), OW_GONE); /* the start needs it */
    backlight.status = OW_OK;
    assert_int_equal(rig_write(&rig, &whole, 0), OW_OK);
    rig_check(&rig);
    assert_true(backlight.lit);
    assert_int_equal(ow_command_panel_close(&rig.device), OW_OK);
    assert_false(backlight.lit);
    rig_close(&rig);
}

static void a_rotation_set_later_needs_a_new_frame(void **state)
{
    (void)state;
    const struct rig_options options = { .controller = "st7735", .lends = true };
    struct rig rig;
    rig_begin(&rig, &options);
    rig_open(&rig, &options);
    draw(&rig, true);
    const struct ow_panel *panel = &rig.device.panel;
    assert_int_equal(ow_panel_set(panel, OW_PANEL_ROTATION, 1), OW_OK);
    assert_int_equal(ow_panel_check(panel, &rig.info), OW_OK);
    rig.stride = (ow_row_bytes(rig.info.format, rig.info.width) + 3) / 4 * 4;
    struct ow_panel_rect whole = rig_whole(&rig);
    struct ow_panel_rect part = rig_rect(&rig);
    rig_scribble(&rig, &whole);
    assert_int_equal(rig_show(&rig, &part, 1), OW_OK); /* all is sent all the same */
    rig_check(&rig);
    rig_close(&rig);
}

static void the_age_says_what_the_glass_shows(void **state)
{
    (void)state;
    const struct rig_options options = { .controller = "ssd1351", .lends = true };
    struct rig rig;
    struct ow_panel_buffer buffer;
    rig_begin(&rig, &options);
    rig_open(&rig, &options);
    const struct ow_panel *panel = &rig.device.panel;
    struct ow_panel_rect whole = rig_whole(&rig);
    assert_int_equal(panel->ops->lend(panel->device, &buffer), OW_OK);
    assert_int_equal(buffer.age, 0);
    assert_int_equal(panel->ops->show(panel->device, &whole, 1), OW_OK);
    assert_int_equal(panel->ops->lend(panel->device, &buffer), OW_OK);
    assert_int_equal(buffer.age, 1);
    uint32_t calls = rig.bus.calls;
    assert_int_equal(panel->ops->show(panel->device, NULL, 0), OW_OK); /* drawing failed */
    assert_int_equal(rig.bus.calls, calls);
    assert_int_equal(panel->ops->lend(panel->device, &buffer), OW_OK);
    assert_int_equal(buffer.age, 0);
    rig_close(&rig);
}

/* A window is not sent again where the controller keeps it. */
static void windows_cost_what_they_must(void **state)
{
    (void)state;
    const struct rig_options options = { .controller = "ili9341" };
    struct rig rig;
    rig_begin(&rig, &options);
    rig_open(&rig, &options);
    struct ow_panel_rect whole = rig_whole(&rig);
    assert_int_equal(rig.info.rect_bytes, 6); /* of a further one on a line */
    assert_int_equal(rig_write(&rig, &whole, 0), OW_OK);
    static const struct {
        struct ow_panel_rect rect;
        uint32_t bytes;
    } steps[] = {
        { { 10, 20, 5, 1 }, 11 }, { { 30, 20, 5, 1 }, 6 }, { { 30, 21, 9, 1 }, 6 },
        { { 30, 21, 9, 2 }, 6 },  { { 30, 23, 9, 2 }, 6 }, { { 30, 23, 9, 2 }, 1 },
        { { 31, 24, 9, 2 }, 11 }, { { 31, 24, 3, 1 }, 1 },
    };
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        uint64_t before = rig.bus.command_bytes;
        rig_scribble(&rig, &steps[i].rect);
        assert_int_equal(rig_write(&rig, &steps[i].rect, 0), OW_OK);
        assert_int_equal(rig.bus.command_bytes - before, steps[i].bytes);
        rig_check(&rig);
    }
    rig_close(&rig);
}

static void the_controller_is_asked_how_it_is(void **state)
{
    (void)state;
    for (uint32_t c = 0; c < ow_controller_count; c++) {
        const struct rig_options options = { .controller = ow_controllers[c]->name };
        struct rig rig;
        uint8_t answer = 0;
        rig_begin(&rig, &options);
        rig_open(&rig, &options);
        assert_int_equal(ow_command_panel_ask(&rig.device, &answer), OW_UNSUPPORTED);
        assert_int_equal(ow_command_panel_start(&rig.device), OW_OK);
        if (ow_controllers[c]->status_code == 0) {
            assert_int_equal(ow_command_panel_ask(&rig.device, &answer), OW_UNSUPPORTED);
            rig_close(&rig);
            continue;
        }
        assert_int_equal(ow_command_panel_ask(&rig.device, &answer), 1);
        assert_int_equal(answer, 0x98);
        draw(&rig, false);
        assert_int_equal(ow_command_panel_ask(&rig.device, &answer), 1);
        assert_int_equal(answer, 0x9C);
        rig_check(&rig);
        rig.bus.controller.lit = false; /* somebody else did that */
        assert_int_equal(ow_command_panel_ask(&rig.device, &answer), 0);
        rig.bus.config.mute = true;
        assert_int_equal(ow_command_panel_ask(&rig.device, &answer), 0);
        assert_int_equal(answer, 0xFF);
        rig.bus.config.fail_every = 1;
        assert_int_equal(ow_command_panel_ask(&rig.device, &answer), OW_BUS);
        rig.bus.config.fail_every = 0;
        draw(&rig, false); /* it was started anew */
        rig_close(&rig);
    }
}

static void a_bad_configuration_is_refused(void **state)
{
    (void)state;
    static const uint8_t cut[] = { 0xDA, 2, 0x02 };
    uint32_t frame[4] = { 0 };
    for (int i = 0; i < 12; i++) {
        const struct rig_options options = { .controller = i == 11 ? "ssd1322" : "ssd1306" };
        struct rig rig;
        rig_begin(&rig, &options);
        rig_open(&rig, &options);
        struct ow_command_panel_config *config = &rig.config;
        struct ow_bus no_bus = { NULL, NULL };
        config->width = i == 0 ? 0 : i == 1 ? 124 : config->width;
        config->height = i == 2 ? 72 : i == 3 ? 60 : config->height;
        config->offset_x = i == 4 ? 8 : config->offset_x;
        config->rotation = i == 5 ? 4 : 0;
        config->format = i == 6 ? &ow_format_gray4 : i == 7 ? NULL : config->format;
        config->frame = i == 8 ? (uint8_t *)frame : NULL;
        config->frame_bytes = sizeof frame;
        config->bus = i == 9 ? &no_bus : config->bus;
        config->extra = i == 10 ? (struct ow_sequence)OW_SEQUENCE(cut) : config->extra;
        config->offset_x = i == 11 ? 2 : config->offset_x;
        int wanted = i == 8 ? OW_MEMORY : i == 9 ? OW_UNSUPPORTED : OW_ARGUMENT;
        assert_int_equal(ow_command_panel_open(&rig.device, config), wanted);
        rig_close(&rig);
    }
}

static void a_bad_rectangle_is_refused(void **state)
{
    (void)state;
    static const struct ow_panel_rect bad[] = {
        { 0, 0, 0, 8 },  { 0, 0, 8, 0 },   { 4, 0, 8, 8 },  { 0, 4, 8, 8 }, { 128, 0, 8, 8 },
        { 0, 64, 8, 8 }, { 0, 0, 136, 8 }, { 0, 0, 8, 72 }, { 0, 0, 4, 8 }, { 0, 0, 8, 4 },
    };
    const struct rig_options options = { .controller = "ssd1306" };
    struct rig rig;
    rig_begin(&rig, &options);
    rig_open(&rig, &options);
    const struct ow_panel *panel = &rig.device.panel;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(panel->ops->write(panel->device, &bad[i], rig.frame, 16, true),
                         OW_ARGUMENT);
    }
    assert_int_equal(rig.bus.calls, 0);
    rig_close(&rig);
}

static void names_are_found(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < ow_controller_count; i++) {
        assert_ptr_equal(ow_controller_by_name(ow_controllers[i]->name), ow_controllers[i]);
    }
    assert_null(ow_controller_by_name("ili934"));
    assert_null(ow_controller_by_name("ili93411"));
    assert_null(ow_controller_by_name(""));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_glass_shows_the_frame),
        cmocka_unit_test(what_cannot_turn_says_so),
        cmocka_unit_test(the_configured_rotation_comes_first),
        cmocka_unit_test(other_modules_are_configured),
        cmocka_unit_test(little_endian_pixels_can_be_sent),
        cmocka_unit_test(without_a_reset_line_it_is_reset_by_command),
        cmocka_unit_test(it_is_dark_until_it_has_a_whole_frame),
        cmocka_unit_test(the_backlight_comes_with_the_first_frame),
        cmocka_unit_test(a_rotation_set_later_needs_a_new_frame),
        cmocka_unit_test(the_age_says_what_the_glass_shows),
        cmocka_unit_test(windows_cost_what_they_must),
        cmocka_unit_test(the_controller_is_asked_how_it_is),
        cmocka_unit_test(a_bad_configuration_is_refused),
        cmocka_unit_test(a_bad_rectangle_is_refused),
        cmocka_unit_test(names_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
