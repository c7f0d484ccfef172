/* SPDX-License-Identifier: 0BSD */
/*
 * A command bus that breaks off: every call in turn, then every n-th one. The
 * panel reports it once, starts anew, and shows the right picture in the end;
 * the controller is never sent what it does not understand after its reset.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/unit/panel_rig.h"

enum { FRAMES = 4, TRIES = 400 };

static const int statuses[] = { OW_BUS, OW_GONE, OW_TIMEOUT };

static const struct way {
    bool lends, staging, no_reset;
    uint32_t delay;
} ways[] = {
    { .lends = false },
    { .lends = true, .staging = true },
    { .lends = true, .delay = 2 },
    { .lends = false, .delay = 3, .staging = true },
    { .lends = true, .no_reset = true },
};
enum { WAYS = sizeof ways / sizeof ways[0] };

static void open_way(struct rig *rig, const char *controller, const struct way *way)
{
    const struct rig_options options = {
        .controller = controller,
        .max_bytes = 2000,
        .lends = way->lends,
        .staging = way->staging,
        .delay = way->delay,
        .no_reset = way->no_reset,
    };
    rig_begin(rig, &options);
    rig_open(rig, &options);
}

static int show(struct rig *rig, const struct ow_panel_rect *rects, uint32_t count)
{
    struct ow_panel_rect whole = rig_whole(rig);
    if (rig->lent != NULL) {
        return rig_show(rig, rects, count);
    }
    return rig_write(rig, &whole, whole.height / 2u); /* bands are whole frames */
}

/* Frames one after the other, each tried until it succeeds; how often that failed. */
static uint32_t run(struct rig *rig, int status)
{
    uint32_t failures = 0;
    for (uint32_t frame = 0; frame < FRAMES; frame++) {
        struct ow_panel_rect rects[2] = { rig_whole(rig), rig_whole(rig) };
        uint32_t count = frame == 0 ? 1 : 2;
        for (uint32_t i = 0; i < count; i++) {
            rects[i] = frame == 0 ? rig_whole(rig) : rig_rect(rig);
            rig_scribble(rig, &rects[i]);
        }
        uint32_t tries = 0;
        for (int result = -1; result < 0; tries++) {
            assert_true(tries < TRIES);
            result = show(rig, rects, count);
            if (result < 0) {
                assert_int_equal(result, status);
                failures++;
            }
        }
    }
    return failures;
}

/* What was on its way when the last frame was shown may fail still: one more shows it. */
static void check(struct rig *rig)
{
    struct ow_panel_rect whole = rig_whole(rig);
    rig->bus.config.fail_every = 0;
    rig->bus.config.fail_at = 0;
    if (rig->bus_config.delay > 0) {
        assert_int_equal(show(rig, &whole, 1), OW_OK);
    }
    assert_false(rig->bus.controller.torn); /* it was reset: its complaints count */
    rig_check(rig);
}

static uint32_t sound_calls(const char *controller, const struct way *way)
{
    struct rig rig;
    open_way(&rig, controller, way);
    assert_int_equal(run(&rig, OW_OK), 0);
    uint32_t calls = rig.bus.calls;
    check(&rig);
    rig_close(&rig);
    return calls;
}

static void any_one_call_may_fail(void **state)
{
    static const char *const some[] = { "st7735", "ssd0323", "ssd1306", "ssd1351" };
    (void)state;
    for (size_t c = 0; c < sizeof some / sizeof some[0]; c++) {
        for (int w = 0; w < WAYS; w++) {
            uint32_t calls = sound_calls(some[c], &ways[w]);
            uint32_t step = calls / 150 + 1; /* all of the start, some of the pixels */
            for (uint32_t n = 1; n <= calls; n += n < 80 ? 1 : step) {
                struct rig rig;
                open_way(&rig, some[c], &ways[w]);
                rig.bus.config.fail_at = n;
                rig.bus.config.fail_status = statuses[n % 3];
                print_message("# %s, way %d, call %u\n", some[c], w, (unsigned)n);
                uint32_t failures = run(&rig, statuses[n % 3]);
                assert_int_equal(rig.bus.failed, 1);
                assert_true(failures == 1 || (failures == 0 && ways[w].delay > 0));
                check(&rig);
                rig_close(&rig);
            }
        }
    }
}

static void every_nth_call_may_fail(void **state)
{
    (void)state;
    for (uint32_t c = 0; c < ow_controller_count; c++) {
        for (int w = 0; w < WAYS; w++) {
            const char *name = ow_controllers[c]->name;
            uint32_t calls = sound_calls(name, &ways[w]);
            for (uint32_t part = 1; part <= 4; part++) { /* a frame must fit between two failures */
                struct rig rig;
                open_way(&rig, name, &ways[w]);
                rig.bus.config.fail_every = calls * part / 4 + 80;
                print_message("# %s, way %d, every call %u\n", name, w,
                              (unsigned)rig.bus.config.fail_every);
                (void)run(&rig, OW_BUS);
                rig.bus.config.fail_every = 0;
                check(&rig);
                rig_close(&rig);
            }
        }
    }
}

static void a_bus_that_always_fails_is_reported_each_time(void **state)
{
    (void)state;
    for (int w = 0; w < WAYS; w++) {
        struct rig rig;
        open_way(&rig, "ili9341", &ways[w]);
        struct ow_panel_rect whole = rig_whole(&rig);
        rig_scribble(&rig, &whole);
        rig.bus.config.fail_every = 1;
        for (int i = 0; i < 10; i++) {
            assert_int_equal(show(&rig, &whole, 1), OW_BUS);
        }
        (void)ow_command_panel_close(&rig.device);
        rig.bus.config.fail_every = 0; /* it is back */
        assert_int_equal(show(&rig, &whole, 1), OW_OK);
        rig_check(&rig);
        rig_close(&rig);
    }
}

/* A transfer that never ends: the driver gives up, and goes on when it can. */
static void a_bus_that_never_is_done_times_out(void **state)
{
    (void)state;
    const struct way slow = { .lends = false, .delay = 1 };
    struct rig rig;
    open_way(&rig, "st7789", &slow);
    struct ow_panel_rect whole = rig_whole(&rig);
    rig_scribble(&rig, &whole);
    assert_int_equal(rig_write(&rig, &whole, 0), OW_OK);
    rig.bus.config.delay = UINT32_MAX;
    const struct ow_panel *panel = &rig.device.panel;
    assert_int_equal(panel->ops->write(panel->device, &whole, rig.frame, rig.stride, true), OW_OK);
    assert_int_equal(panel->ops->write(panel->device, &whole, rig.frame, rig.stride, true),
                     OW_TIMEOUT);
    rig.bus.config.delay = 1;
    rig.bus.asked = 0;
    assert_int_equal(rig_write(&rig, &whole, 0), OW_OK);
    rig_check(&rig);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_one_call_may_fail),
        cmocka_unit_test(every_nth_call_may_fail),
        cmocka_unit_test(a_bus_that_always_fails_is_reported_each_time),
        cmocka_unit_test(a_bus_that_never_is_done_times_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
