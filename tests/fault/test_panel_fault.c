/* SPDX-License-Identifier: 0BSD */
/*
 * A panel that fails: every call in turn, then every n-th one, with each status.
 * The viewer reports it, keeps nothing lent or in flight, and goes on; what is
 * seen in the end is what a sound panel shows. A failing case prints its name.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>

#include "tests/unit/sim_scene.h"

enum { VIEWS = 3, STEPS = 1000 };

static const struct variant {
    const char *name;
    enum sim_panel_kind kind;
    uint16_t buffers;
    uint16_t lines;
    uint8_t bands;
    uint32_t delay;
} variants[] = {
    { "lend", SIM_PANEL_LENDS, 1, 0, 1, 0 },
    { "lend, two buffers, bands", SIM_PANEL_LENDS, 2, 16, 1, 0 },
    { "write", SIM_PANEL_TAKES, 0, 0, 1, 0 },
    { "write, bands", SIM_PANEL_TAKES, 0, 16, 1, 0 },
    { "write, two slow bands", SIM_PANEL_TAKES, 0, 16, 2, 3 },
};
enum { VARIANTS = sizeof variants / sizeof variants[0] };

static const int statuses[] = { OW_BUS, OW_GONE, OW_TIMEOUT, OW_BUSY };
enum { STATUSES = sizeof statuses / sizeof statuses[0] };

static void open_variant(struct scene *scene, const struct variant *variant)
{
    struct sim_panel_config panel = {
        .kind = variant->kind,
        .buffers = variant->buffers,
        .delay = variant->delay,
    };
    scene_open(scene, &panel);
    scene->config.views = VIEWS;
    scene->config.band_lines = variant->lines;
    scene->config.bands = variant->bands;
    scene->config.interval_us = 20000;
    assert_int_equal(scene_start(scene), OW_OK);
}

/* What a run that fails nowhere shows, and the calls it makes. */
static uint32_t sound_run(const struct variant *variant, uint32_t crc[VIEWS])
{
    struct scene scene;
    open_variant(&scene, variant);
    uint32_t before = scene.panel.calls;
    scene_run(&scene);
    assert_int_equal(scene.frames, VIEWS);
    for (int i = 0; i < VIEWS; i++) {
        crc[i] = scene.crc[i];
    }
    uint32_t calls = scene.panel.calls - before;
    scene_close(&scene);
    return calls;
}

/* Steps to the end through failures; their number. Every frame must come out right. */
static uint32_t run_through(struct scene *scene, int status, const uint32_t crc[VIEWS])
{
    uint32_t reported = 0;
    for (int i = 0; i < STEPS && !scene->viewer.finished; i++) {
        int result = scene_step(scene);
        if (result < 0) {
            assert_int_equal(result, status);
            reported++;
        }
        assert_false(scene->panel.lent);
        assert_int_equal(scene->panel.pending, 0);
        assert_null(scene->panel.wrong);
    }
    assert_true(scene->viewer.finished);
    assert_int_equal(scene->frames, VIEWS);
    for (int i = 0; i < VIEWS; i++) {
        assert_int_equal(scene->crc[i], crc[i]);
    }
    return reported;
}

static void any_one_call_may_fail(void **state)
{
    (void)state;
    for (int v = 0; v < VARIANTS; v++) {
        uint32_t crc[VIEWS];
        uint32_t calls = sound_run(&variants[v], crc);
        assert_true(calls >= 2 * VIEWS);
        for (uint32_t n = 1; n <= calls; n++) {
            for (int s = 0; s < STATUSES; s++) {
                struct scene scene;
                open_variant(&scene, &variants[v]);
                scene.panel.config.fail_at = scene.panel.calls + n;
                scene.panel.config.fail_status = statuses[s];
                print_message("# %s, call %u, status %d\n", variants[v].name, (unsigned)n,
                              statuses[s]);
                uint32_t reported = run_through(&scene, statuses[s], crc);
                assert_int_equal(scene.panel.failed, 1);
                assert_int_equal(reported, 1);
                scene_close(&scene);
            }
        }
    }
}

static void every_nth_call_may_fail(void **state)
{
    (void)state;
    for (int v = 0; v < VARIANTS; v++) {
        uint32_t crc[VIEWS];
        uint32_t calls = sound_run(&variants[v], crc);
        for (uint32_t n = calls / VIEWS + 2; n <= calls; n++) {
            struct scene scene;
            open_variant(&scene, &variants[v]);
            scene.panel.config.fail_every = n;
            scene.panel.config.fail_status = OW_BUS;
            print_message("# %s, every call %u\n", variants[v].name, (unsigned)n);
            assert_true(run_through(&scene, OW_BUS, crc) > 0);
            scene_close(&scene);
        }
    }
}

/* "Again" is no failure: the viewer waits and asks again. */
static void a_panel_that_is_not_ready_is_asked_again(void **state)
{
    (void)state;
    for (int v = 0; v < 2; v++) { /* those that lend */
        uint32_t crc[VIEWS];
        struct scene scene;
        (void)sound_run(&variants[v], crc);
        open_variant(&scene, &variants[v]);
        scene.panel.config.fail_at = scene.panel.calls + 1;
        scene.panel.config.fail_status = OW_AGAIN;
        assert_int_equal(scene_step(&scene), 0);
        assert_true(scene.time.now_us > 0);
        assert_int_equal(run_through(&scene, OW_AGAIN, crc), 0);
        scene_close(&scene);
    }
}

static void a_panel_that_always_fails_is_reported_each_time(void **state)
{
    (void)state;
    for (int v = 0; v < VARIANTS; v++) {
        struct scene scene;
        open_variant(&scene, &variants[v]);
        scene.panel.config.fail_every = 1;
        scene.panel.config.fail_status = OW_GONE;
        for (int i = 0; i < 20; i++) {
            assert_int_equal(scene_step(&scene), OW_GONE);
            assert_false(scene.viewer.finished);
            assert_false(scene.panel.lent);
        }
        assert_int_equal(scene.frames, 0);
        scene.panel.config.fail_every = 0; /* it is back */
        scene_run(&scene);
        assert_int_equal(scene.frames, VIEWS);
        scene_close(&scene);
    }
}

static void a_panel_that_fails_at_the_start_is_reported(void **state)
{
    (void)state;
    for (int v = 0; v < VARIANTS; v++) {
        struct scene scene;
        open_variant(&scene, &variants[v]);
        scene.panel.config.fail_at = scene.panel.calls + 1;
        scene.panel.config.fail_status = OW_DENIED;
        assert_int_equal(
            ow_viewer_start(&scene.viewer, &scene.config, scene.memory, scene.memory_bytes),
            OW_DENIED);
        assert_true(scene.viewer.finished);
        scene.panel.config.fail_at = scene.panel.calls + 1;
        assert_int_equal(ow_viewer_bytes_needed(&scene.config), 0);
        scene_close(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_one_call_may_fail),
        cmocka_unit_test(every_nth_call_may_fail),
        cmocka_unit_test(a_panel_that_is_not_ready_is_asked_again),
        cmocka_unit_test(a_panel_that_always_fails_is_reported_each_time),
        cmocka_unit_test(a_panel_that_fails_at_the_start_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
