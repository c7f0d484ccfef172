/* SPDX-License-Identifier: 0BSD */
/* Scripted input: what is read, what is refused and where, and when events come. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#include "sim/sim_clock.h"
#include "sim/sim_script.h"

static void events_are_read(void **state)
{
    static const char text[] = "# a comment\n"
                               "\n"
                               "0 left press\n"
                               "  10\tleft   release # behind an event\r\n"
                               "10 knob1 turn -3\n"
                               "86400000000 axis-z axis 32767\n"
                               "86400000000 255 turn +1000";
    static const struct ow_input_event expected[] = {
        { 0, OW_CONTROL_LEFT, OW_INPUT_PRESS, 0 },
        { 10, OW_CONTROL_LEFT, OW_INPUT_RELEASE, 0 },
        { 10, OW_CONTROL_KNOB_1, OW_INPUT_TURN, -3 },
        { SIM_SCRIPT_TIME_MAX, OW_CONTROL_AXIS_Z, OW_INPUT_AXIS, 32767 },
        { SIM_SCRIPT_TIME_MAX, 255, OW_INPUT_TURN, 1000 },
    };
    struct sim_script script;
    struct sim_script_error error;
    (void)state;
    assert_true(sim_script_parse(&script, text, strlen(text), &error));
    assert_int_equal(script.count, sizeof expected / sizeof expected[0]);
    for (size_t i = 0; i < script.count; i++) {
        assert_int_equal(script.events[i].time_us, expected[i].time_us);
        assert_int_equal(script.events[i].control, expected[i].control);
        assert_int_equal(script.events[i].kind, expected[i].kind);
        assert_int_equal(script.events[i].value, expected[i].value);
    }
    sim_script_free(&script);
}

static void wrong_lines_are_named(void **state)
{
    static const struct {
        const char *text;
        long line;
        const char *says;
    } cases[] = {
        { "x left press\n", 1, "'x' is not a time" },
        { "-1 left press\n", 1, "not a time" },
        { "86400000001 left press\n", 1, "not a time" },
        { "99999999999999999999999 left press\n", 1, "not a time" },
        { "1.5 left press\n", 1, "not a time" },
        { "0x10 left press\n", 1, "not a time" },
        { "\n\n5 left press\n4 left release\n", 4, "before the line above" },
        { "0 middle press\n", 1, "'middle' is not a control" },
        { "0 256 press\n", 1, "not a control" },
        { "0 -1 press\n", 1, "not a control" },
        { "0 left\n", 1, "an event is" },
        { "# fine\n0\n", 2, "an event is" },
        { "0 left push\n", 1, "'push' is not press" },
        { "0 left press 1\n", 1, "press takes no value" },
        { "0 knob1 turn\n", 1, "turn takes one value" },
        { "0 knob1 turn 1 2\n", 1, "turn takes one value" },
        { "0 knob1 turn 1001\n", 1, "from -1000 to 1000" },
        { "0 knob1 turn 1x\n", 1, "not '1x'" },
        { "0 axis-x axis -32768\n", 1, "from -32767 to 32767" },
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct sim_script script;
        struct sim_script_error error;
        assert_false(sim_script_parse(&script, cases[i].text, strlen(cases[i].text), &error));
        assert_int_equal(error.line, cases[i].line);
        if (strstr(error.text, cases[i].says) == NULL) {
            fail_msg("'%s' says: %s", cases[i].text, error.text);
        }
        assert_null(script.events);
    }
}

static void zero_bytes_and_long_lines_are_refused(void **state)
{
    struct sim_script script;
    struct sim_script_error error;
    char text[400];
    (void)state;
    assert_false(sim_script_parse(&script, "0 left press\n\0", 14, &error));
    assert_int_equal(error.line, 2);
    memset(text, ' ', sizeof text);
    assert_false(sim_script_parse(&script, text, sizeof text, &error));
    assert_int_equal(error.line, 1);
    assert_true(sim_script_parse(&script, "", 0, &error));
    assert_int_equal(script.count, 0);
    sim_script_free(&script);
}

static void events_come_at_their_time(void **state)
{
    static const char text[] = "5 left press\n5 left release\n9 up press\n";
    struct sim_script script;
    struct sim_script_error error;
    struct sim_clock time = { 0 };
    struct ow_clock clock = { &sim_virtual_clock_ops, &time };
    struct ow_input_event event;
    (void)state;
    assert_true(sim_script_parse(&script, text, strlen(text), &error));
    script.clock = &clock;
    assert_int_equal(sim_script_input_ops.next(&script, &event), OW_AGAIN);
    assert_int_equal(sim_script_wait_ops.wait(&script, 3), 0);
    assert_int_equal(time.now_us, 3);
    assert_int_equal(sim_script_wait_ops.wait(&script, OW_TIME_NEVER), 1);
    assert_int_equal(time.now_us, 5);
    assert_int_equal(sim_script_input_ops.next(&script, &event), OW_OK);
    assert_int_equal(sim_script_input_ops.next(&script, &event), OW_OK);
    assert_int_equal(event.kind, OW_INPUT_RELEASE);
    assert_int_equal(sim_script_input_ops.next(&script, &event), OW_AGAIN);
    assert_int_equal(sim_script_wait_ops.wait(&script, 20), 1);
    assert_int_equal(time.now_us, 9);
    assert_int_equal(sim_script_input_ops.next(&script, &event), OW_OK);
    assert_int_equal(event.control, OW_CONTROL_UP);
    assert_int_equal(sim_script_input_ops.next(&script, &event), OW_GONE);
    assert_int_equal(sim_script_wait_ops.wait(&script, 20), 0);
    assert_int_equal(time.now_us, 20);
    assert_int_equal(sim_script_wait_ops.wait(&script, OW_TIME_NEVER), OW_GONE);
    sim_script_free(&script);
}

static void clocks_never_go_back(void **state)
{
    struct sim_clock time = { 100 };
    uint64_t first;
    uint64_t second;
    (void)state;
    assert_int_equal(sim_virtual_clock_ops.sleep(&time, 50), OW_OK);
    assert_int_equal(time.now_us, 100);
    assert_int_equal(sim_virtual_clock_ops.sleep(&time, OW_TIME_NEVER), OW_ARGUMENT);
    assert_int_equal(sim_host_clock_ops.now(NULL, &first), OW_OK);
    assert_int_equal(sim_host_clock_ops.sleep(NULL, first + 2000), OW_OK);
    assert_int_equal(sim_host_clock_ops.now(NULL, &second), OW_OK);
    assert_true(second >= first + 2000);
    assert_int_equal(sim_host_clock_ops.sleep(NULL, first), OW_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(events_are_read),
        cmocka_unit_test(wrong_lines_are_named),
        cmocka_unit_test(zero_bytes_and_long_lines_are_refused),
        cmocka_unit_test(events_come_at_their_time),
        cmocka_unit_test(clocks_never_go_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
