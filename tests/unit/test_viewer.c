/* SPDX-License-Identifier: 0BSD */
/* The viewer: what it draws, when it draws, and what input does to the view. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hal/panel/null.h"
#include "sim/sim_script.h"
#include "tests/unit/sim_scene.h"

#define DEGREE ((int32_t)11930465) /* 2^32 / 360 */

static const struct sim_panel_config lending = { .kind = SIM_PANEL_LENDS };
static const struct sim_panel_config taking = { .kind = SIM_PANEL_TAKES };

/* ---- pictures ---- */

/* Checksum of one view on such a panel with such bands. */
static uint32_t picture(const struct sim_panel_config *panel, uint16_t lines, uint8_t bands,
                        uint32_t cached)
{
    struct scene scene;
    scene_open(&scene, panel);
    scene.config.band_lines = lines;
    scene.config.bands = bands;
    scene.config.cached_vertices = cached;
    assert_int_equal(scene_start(&scene), OW_OK);
    scene_run(&scene);
    assert_int_equal(scene.frames, 1);
    assert_int_equal(scene.viewer.stats.pixels_written + scene.viewer.stats.pixels_background,
                     SCENE_WIDTH * SCENE_HEIGHT);
    assert_true(scene.viewer.stats.pixels_written > 300);
    uint32_t crc = scene.crc[0];
    scene_close(&scene);
    return crc;
}

static void the_same_picture_lent_and_written_in_any_bands(void **state)
{
    static const uint16_t lines[] = { 0, 1, 7, 8, 46, 47, 48, 64, 4096 };
    (void)state;
    uint32_t crc = picture(&lending, 0, 0, 0);
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        for (uint8_t bands = 0; bands <= 2; bands++) {
            assert_int_equal(picture(&lending, lines[i], bands, 0), crc);
            assert_int_equal(picture(&taking, lines[i], bands, 4), crc);
        }
    }
}

static void a_slow_panel_keeps_its_pixels_until_done(void **state)
{
    (void)state;
    uint32_t crc = picture(&lending, 0, 0, 0);
    for (uint32_t delay = 1; delay < 6; delay++) {
        struct sim_panel_config slow = taking;
        slow.delay = delay;
        assert_int_equal(picture(&slow, 5, 1, 0), crc);
        assert_int_equal(picture(&slow, 5, 2, 0), crc);
    }
}

static void bands_keep_to_the_panels_alignment(void **state)
{
    struct sim_panel_config aligned = taking;
    (void)state;
    aligned.align_x = 4;
    aligned.align_y = 8;
    assert_int_equal(picture(&aligned, 5, 1, 0), picture(&lending, 0, 0, 0));
}

static void the_null_panel_takes_frames(void **state)
{
    struct scene scene;
    struct ow_null_panel device = { SCENE_WIDTH, SCENE_HEIGHT, &ow_format_rgb565, 0 };
    struct ow_panel panel = { &ow_null_panel_ops, &device };
    (void)state;
    scene_open(&scene, &taking);
    scene.config.panel = &panel;
    scene.config.views = 3;
    scene.config.band_lines = 9;
    assert_int_equal(scene_start(&scene), OW_OK);
    scene_run(&scene);
    assert_int_equal(device.frames, 3);
    scene_close(&scene);
}

/* Every pixel of the turned picture stands where it should, but for some along edges. */
static void assert_turned(const struct image *upright, const struct image *turned, uint8_t turns)
{
    uint32_t differ = 0;
    for (uint32_t y = 0; y < upright->height; y++) {
        for (uint32_t x = 0; x < upright->width; x++) {
            uint32_t right = upright->width - 1 - x;
            uint32_t below = upright->height - 1 - y;
            uint32_t to_x = turns == 1 ? below : turns == 2 ? right : y;
            uint32_t to_y = turns == 1 ? x : turns == 2 ? below : right;
            differ += image_pixel(upright, x, y) != image_pixel(turned, to_x, to_y);
        }
    }
    assert_true(differ < 60); /* the silhouette alone is about 120 pixels long */
}

static void take_picture(struct image *image, const struct sim_panel_config *panel, uint8_t turns)
{
    struct scene scene;
    struct image_error error;
    scene_open(&scene, panel);
    scene.config.quarter_turns = turns;
    assert_int_equal(scene_start(&scene), OW_OK);
    scene_run(&scene);
    assert_true(sim_panel_image(&scene.panel, image, &error));
    scene_close(&scene);
}

static void the_projection_turns_where_the_panel_cannot(void **state)
{
    (void)state;
    for (uint8_t turns = 1; turns <= 3; turns++) {
        struct sim_panel_config panel = lending;
        struct image upright;
        struct image turned;
        panel.width = turns == 2 ? SCENE_WIDTH : SCENE_HEIGHT;
        panel.height = turns == 2 ? SCENE_HEIGHT : SCENE_WIDTH;
        take_picture(&upright, &lending, 0);
        take_picture(&turned, &panel, turns);
        assert_turned(&upright, &turned, turns);
        image_free(&upright);
        image_free(&turned);
    }
}

static void a_panel_that_turns_gets_the_upright_picture(void **state)
{
    (void)state;
    for (int kind = SIM_PANEL_LENDS; kind <= SIM_PANEL_TAKES; kind++) {
        struct sim_panel_config panel = { .kind = (enum sim_panel_kind)kind, .rotates = true };
        struct image upright;
        struct image turned;
        panel.width = SCENE_HEIGHT;
        panel.height = SCENE_WIDTH;
        take_picture(&upright, &lending, 0);
        take_picture(&turned, &panel, 3);
        assert_int_equal(image_count_differences(&upright, &turned), 0);
        image_free(&upright);
        image_free(&turned);
    }
}

/* ---- changes ---- */

/* A turn of some views; returns the pixels that went to the panel. */
static uint64_t run_turn(uint32_t crc[SCENE_FRAMES], bool find_changes, uint16_t buffers)
{
    struct scene scene;
    struct sim_panel_config panel = {
        .kind = SIM_PANEL_LENDS, .align_x = 2, .align_y = 3, .buffers = buffers
    };
    scene_open(&scene, &panel);
    scene.config.views = 12;
    scene.config.find_changes = find_changes;
    assert_int_equal(scene_start(&scene), OW_OK);
    scene_run(&scene);
    assert_int_equal(scene.frames, 12);
    memcpy(crc, scene.crc, sizeof scene.crc);
    uint64_t sent = scene.panel.pixels_sent;
    scene_close(&scene);
    return sent;
}

/* The panel takes over only the rectangles: what it shows is right if they hold all changes. */
static void only_what_changed_is_shown(void **state)
{
    (void)state;
    uint32_t whole[SCENE_FRAMES];
    uint32_t parts[SCENE_FRAMES];
    uint64_t all = run_turn(whole, false, 1);
    assert_int_equal(all, 12 * SCENE_WIDTH * SCENE_HEIGHT);
    uint64_t sent = run_turn(parts, true, 1);
    assert_memory_equal(whole, parts, 12 * sizeof whole[0]);
    print_message("%u of %u pixels\n", (unsigned)sent, (unsigned)all);
    assert_true(sent < all * 3 / 4);
    /* Buffers that take turns hold an older frame: all of them is shown. */
    assert_int_equal(run_turn(parts, true, 2), all);
    assert_memory_equal(whole, parts, 12 * sizeof whole[0]);
}

/* ---- views and time ---- */

static void an_orbit_shows_each_view_once_at_its_time(void **state)
{
    struct scene scene;
    (void)state;
    scene_open(&scene, &lending);
    scene.config.views = 5;
    scene.config.interval_us = 40000;
    assert_int_equal(scene_start(&scene), OW_OK);
    scene_run(&scene);
    assert_int_equal(scene.frames, 5);
    assert_int_equal(scene.time.now_us, 4 * 40000);
    for (uint32_t i = 0; i < 5; i++) {
        for (uint32_t k = 0; k < i; k++) {
            assert_int_not_equal(scene.crc[i], scene.crc[k]);
        }
    }
    ow_viewer_restart(&scene.viewer);
    assert_int_equal(scene_step(&scene), 1);
    assert_int_equal(scene.crc[5], scene.crc[0]);
    scene_close(&scene);
}

static void a_repeated_orbit_begins_again(void **state)
{
    struct scene scene;
    (void)state;
    scene_open(&scene, &lending);
    scene.config.views = 3;
    scene.config.end = OW_VIEWER_REPEAT;
    assert_int_equal(scene_start(&scene), OW_OK);
    while (scene.frames < 7) {
        assert_true(scene_step(&scene) >= 0);
    }
    assert_int_equal(scene.crc[3], scene.crc[0]);
    assert_int_equal(scene.crc[6], scene.crc[0]);
    assert_false(scene.viewer.finished);
    scene_close(&scene);
}

static int give_view(void *context, uint32_t number, struct ow_camera *camera)
{
    const struct scene *scene = context;
    static const ow_q8 eyes[] = { 0, 1 << 24 };
    if (number == 2) {
        return OW_GONE;
    }
    ow_camera_orbit(camera, &scene->tree, 0, 0);
    for (int i = 0; number == 1 && i < 3; i++) {
        camera->eye[i] = eyes[i != 0] - (i == 1); /* the cube from +y +z */
    }
    if (number == 3) {
        memcpy(camera->at, camera->eye, sizeof camera->at);
    }
    return OW_OK;
}

static void a_list_gives_its_views_and_its_errors(void **state)
{
    struct scene scene;
    (void)state;
    scene_open(&scene, &lending);
    scene.config.views = 4;
    scene.config.view = give_view;
    scene.config.view_context = &scene;
    assert_int_equal(scene_start(&scene), OW_OK);
    assert_int_equal(scene_step(&scene), 1);
    assert_int_equal(scene_step(&scene), 1);
    assert_int_not_equal(scene.crc[0], scene.crc[1]);
    assert_int_equal(scene_step(&scene), OW_GONE);
    assert_int_equal(scene_step(&scene), OW_GONE); /* the same view again */
    scene.viewer.number = 3;
    assert_int_equal(scene_step(&scene), OW_ARGUMENT); /* the eye is where it looks at */
    assert_false(scene.viewer.finished);
    scene_close(&scene);
}

/* ---- input ---- */

/* A scene that plays a script on one orbit view. */
struct played {
    struct scene scene;
    struct sim_script script;
    struct ow_input input;
    struct ow_wait wait;
};

static void play(struct played *played, const char *text, uint32_t views)
{
    struct sim_script_error error;
    struct ow_viewer_config *config = &played->scene.config;
    scene_open(&played->scene, &lending);
    assert_true(sim_script_parse(&played->script, text, strlen(text), &error));
    played->script.clock = &played->scene.clock;
    played->input = (struct ow_input){ &sim_script_input_ops, &played->script };
    played->wait = (struct ow_wait){ &sim_script_wait_ops, &played->script };
    config->input = &played->input;
    config->wait = &played->wait;
    config->views = views;
    config->end = OW_VIEWER_HOLD;
    config->interval_us = 50000;
    config->repeat_us = 100000;
    assert_int_equal(scene_start(&played->scene), OW_OK);
    scene_run(&played->scene);
}

static void play_end(struct played *played)
{
    scene_close(&played->scene);
    sim_script_free(&played->script);
}

static void controls_turn_tilt_and_zoom(void **state)
{
    static const struct {
        const char *script;
        int32_t turn, tilt, zoom; /* degrees, degrees, levels */
    } cases[] = {
        { "0 left press\n0 left release\n", -10, 0, 0 },
        { "0 right press\n", 10, 0, 0 },
        { "0 up press\n", 0, 5, 0 },
        { "0 down press\n", 0, -5, 0 },
        { "0 in press\n", 0, 0, 1 },
        { "0 out press\n", 0, 0, -1 },
        { "0 knob1 turn 7\n", 35, 0, 0 },
        { "0 knob1 turn -7\n0 knob1 turn 8\n", 5, 0, 0 },
        { "0 knob2 turn -3\n", 0, -15, 0 },
        { "0 knob3 turn 4\n", 0, 0, 4 },
        { "0 knob3 turn 1000\n", 0, 0, 24 },
        { "0 knob3 turn -1000\n", 0, 0, -24 },
        { "0 knob2 turn 1000\n", 0, 89 - 23, 0 }, /* the orbit's own are 22.5 degrees */
        { "0 knob2 turn -1000\n", 0, -89 - 22, 0 },
        { "0 axis-x axis 16384\n", 90, 0, 0 },
        { "0 axis-x axis 16384\n0 axis-x axis -16384\n", -90, 0, 0 },
        { "0 200 press\n", 0, 0, 0 },
        { "0 right press\n0 up press\n0 in press\n0 select press\n", 0, 0, 0 },
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct played played;
        play(&played, cases[i].script, 1);
        const struct ow_viewer *viewer = &played.scene.viewer;
        assert_true(abs((int32_t)viewer->turn - cases[i].turn * DEGREE) <= DEGREE);
        assert_true(abs(viewer->tilt - cases[i].tilt * DEGREE) <= DEGREE);
        assert_int_equal(viewer->zoom, cases[i].zoom);
        assert_int_equal(played.scene.frames, 1); /* all at time 0: drawn once */
        play_end(&played);
    }
}

static void it_draws_only_when_something_changed(void **state)
{
    struct played played;
    (void)state;
    play(&played,
         "1000 left press\n2000 left release\n3000 back press\n4000 9 turn 0\n"
         "5000 right press\n5000 right release\n6000 right press\n6000 left press\n",
         1);
    /* The first frame, left, right (back to the start); the last two undo each other. */
    assert_int_equal(played.scene.viewer.frames, 4);
    assert_int_not_equal(played.scene.crc[0], played.scene.crc[1]);
    assert_int_equal(played.scene.crc[0], played.scene.crc[2]);
    assert_int_equal(played.scene.crc[2], played.scene.crc[3]);
    play_end(&played);
}

static void a_held_button_repeats_until_it_is_released(void **state)
{
    struct played played;
    (void)state;
    play(&played, "0 right press\n350000 right release\n900000 back press\n", 1);
    assert_int_equal(played.scene.viewer.turn, 40u * (uint32_t)DEGREE); /* 0, 100, 200, 300 ms */
    assert_int_equal(played.scene.viewer.frames, 4);
    assert_int_equal(played.scene.time.now_us, 900000);
    play_end(&played);
}

static void the_orbit_turns_until_input_comes_and_again_after_home(void **state)
{
    struct played played;
    (void)state;
    play(&played, "120000 up press\n130000 up release\n1000000 select press\n", 8);
    /* Views 0, 1, 2 by time; tilted; home, then views 3 to 7. */
    assert_int_equal(played.scene.viewer.frames, 3 + 1 + 1 + 5);
    assert_int_equal(played.scene.crc[4], played.scene.crc[2]);
    assert_int_equal(played.scene.viewer.number, 7);
    play_end(&played);
}

static void zooming_in_makes_the_model_larger(void **state)
{
    (void)state;
    for (int parallel = 0; parallel <= 1; parallel++) {
        uint32_t last = 0;
        for (int level = -8; level <= 8; level += 4) {
            struct scene scene;
            scene_open(&scene, &lending);
            if (parallel) {
                scene.config.camera.projection = OW_PARALLEL;
                scene.config.camera.height = 160000 * 256;
            }
            assert_int_equal(scene_start(&scene), OW_OK);
            scene.viewer.zoom = level;
            assert_int_equal(scene_step(&scene), 1);
            assert_true(scene.viewer.stats.pixels_written > last);
            last = scene.viewer.stats.pixels_written;
            scene_close(&scene);
        }
    }
}

/* ---- refusals ---- */

static void a_byte_too_little_is_refused(void **state)
{
    struct scene scene;
    (void)state;
    for (int kind = SIM_PANEL_LENDS; kind <= SIM_PANEL_TAKES; kind++) {
        scene_open(&scene, kind == SIM_PANEL_LENDS ? &lending : &taking);
        assert_int_equal(scene_start(&scene), OW_OK);
        assert_int_equal(
            ow_viewer_start(&scene.viewer, &scene.config, scene.memory, scene.memory_bytes - 1),
            OW_MEMORY);
        assert_int_equal(ow_viewer_start(&scene.viewer, &scene.config, NULL, 0), OW_MEMORY);
        assert_int_equal(ow_viewer_step(&scene.viewer), 0);
        assert_int_equal(scene.panel.frames, 0);
        scene_close(&scene);
    }
}

static void missing_functions_are_unsupported(void **state)
{
    struct scene scene;
    struct scene lender;
    struct ow_panel_info info;
    (void)state;
    scene_open(&scene, &taking);
    scene_open(&lender, &lending);
    for (int i = 0; i < 4; i++) {
        struct ow_panel_ops ops = *scene.panel.panel.ops;
        struct ow_panel panel = { &ops, &scene.panel };
        ops.info = i == 0 ? NULL : ops.info;
        ops.write = i == 1 ? NULL : ops.write;
        ops.show = i == 2 ? lender.panel.panel.ops->show : ops.show; /* without lend */
        assert_int_equal(ow_panel_check(&panel, &info), i == 3 ? OW_OK : OW_UNSUPPORTED);
    }
    assert_int_equal(ow_panel_check(NULL, &info), OW_UNSUPPORTED);
    struct ow_clock clock = { NULL, NULL };
    scene.config.clock = &clock;
    uint64_t memory[4096];
    assert_int_equal(ow_viewer_start(&scene.viewer, &scene.config, memory, sizeof memory),
                     OW_UNSUPPORTED);
    assert_true(scene.viewer.finished);
    scene_close(&scene);
    scene_close(&lender);
}

static void a_configuration_out_of_range_is_refused(void **state)
{
    (void)state;
    for (int i = 0; i < 5; i++) {
        struct scene scene;
        scene_open(&scene, &lending);
        struct ow_viewer_config *config = &scene.config;
        config->views = i == 0 ? 0 : config->views;
        config->bands = i == 1 ? 3 : 0;
        config->quarter_turns = i == 2 ? 4 : 0;
        config->binding_count = i == 3 ? OW_BINDINGS_MAX + 1 : 0;
        config->tree = i == 4 ? NULL : config->tree;
        uint64_t memory[4096];
        assert_int_equal(ow_viewer_bytes_needed(config), 0);
        assert_int_equal(ow_viewer_start(&scene.viewer, config, memory, sizeof memory),
                         OW_ARGUMENT);
        scene_close(&scene);
    }
}

static void a_panel_that_never_is_done_times_out(void **state)
{
    struct scene scene;
    struct sim_panel_config stuck = taking;
    (void)state;
    stuck.delay = UINT32_MAX;
    scene_open(&scene, &stuck);
    scene.config.timeout_us = 20000;
    assert_int_equal(scene_start(&scene), OW_OK);
    assert_int_equal(scene_step(&scene), OW_TIMEOUT);
    assert_int_equal(scene.viewer.frames, 0);
    assert_true(scene.time.now_us >= 20000 && scene.time.now_us < 100000);
    scene_close(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_picture_lent_and_written_in_any_bands),
        cmocka_unit_test(a_slow_panel_keeps_its_pixels_until_done),
        cmocka_unit_test(bands_keep_to_the_panels_alignment),
        cmocka_unit_test(the_null_panel_takes_frames),
        cmocka_unit_test(the_projection_turns_where_the_panel_cannot),
        cmocka_unit_test(a_panel_that_turns_gets_the_upright_picture),
        cmocka_unit_test(only_what_changed_is_shown),
        cmocka_unit_test(an_orbit_shows_each_view_once_at_its_time),
        cmocka_unit_test(a_repeated_orbit_begins_again),
        cmocka_unit_test(a_list_gives_its_views_and_its_errors),
        cmocka_unit_test(controls_turn_tilt_and_zoom),
        cmocka_unit_test(it_draws_only_when_something_changed),
        cmocka_unit_test(a_held_button_repeats_until_it_is_released),
        cmocka_unit_test(the_orbit_turns_until_input_comes_and_again_after_home),
        cmocka_unit_test(zooming_in_makes_the_model_larger),
        cmocka_unit_test(a_byte_too_little_is_refused),
        cmocka_unit_test(missing_functions_are_unsupported),
        cmocka_unit_test(a_configuration_out_of_range_is_refused),
        cmocka_unit_test(a_panel_that_never_is_done_times_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
