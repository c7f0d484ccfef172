/* SPDX-License-Identifier: 0BSD */
/* Which line is which control, as a board says it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

#include "boards/linux/controls.h"
#include "tests/unit/fake_linux.h"

static void buttons_are_read(void **state)
{
    struct control_lines parts[4];
    char why[160];
    (void)state;
    assert_int_equal(controls_parse(" left=23, right=!gpio-32-63:24\tselect=KEY_A ", false, parts,
                                    4, why, sizeof why),
                     3);
    assert_int_equal(parts[0].control, OW_CONTROL_LEFT);
    assert_string_equal(parts[0].lines[0], "23");
    assert_string_equal(parts[0].lines[1], "");
    assert_int_equal(parts[1].control, OW_CONTROL_RIGHT);
    assert_string_equal(parts[1].lines[0], "!gpio-32-63:24");
    assert_int_equal(parts[2].control, OW_CONTROL_SELECT);
    assert_string_equal(parts[2].lines[0], "KEY_A");
    assert_int_equal(controls_parse("", false, parts, 4, why, sizeof why), 0);
}

static void knobs_are_read(void **state)
{
    struct control_lines parts[2];
    char why[160];
    (void)state;
    assert_int_equal(
        controls_parse("knob1=5+6 knob3=pinctrl:7+!8", true, parts, 2, why, sizeof why), 2);
    assert_string_equal(parts[0].lines[0], "5");
    assert_string_equal(parts[0].lines[1], "6");
    assert_int_equal(parts[1].control, OW_CONTROL_KNOB_3);
    assert_string_equal(parts[1].lines[0], "pinctrl:7");
    assert_string_equal(parts[1].lines[1], "!8");
}

static void what_is_wrong_is_told(void **state)
{
    static const struct {
        const char *text;
        bool knobs;
        const char *says;
    } cases[] = {
        { "left", false, "'left' is not CONTROL=LINE" },
        { "left=", false, "'left=' is not" },
        { "middle=3", false, "'middle=3' is not" },
        { "=3", false, "'=3' is not" },
        { "left=3+4", false, "'left=3+4' is not" },
        { "knob1=3", true, "'knob1=3' is not CONTROL=LINE+LINE" },
        { "knob1=3+", true, "'knob1=3+' is not" },
        { "knob1=+3", true, "'knob1=+3' is not" },
        { "left=1 left=2 left=3", false, "more than 2" },
        { "left=aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa", false,
          "is not" },
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct control_lines parts[2];
        char why[160];
        assert_int_equal(controls_parse(cases[i].text, cases[i].knobs, parts, 2, why, sizeof why),
                         OW_ARGUMENT);
        if (strstr(why, cases[i].says) == NULL) {
            fail_msg("'%s' says: %s", cases[i].text, why);
        }
    }
}

static void opening_says_what_is_missing(void **state)
{
    static struct controls controls;
    struct linux_wait wait;
    struct oldwell_settings settings = { .buttons = "left=x=y=" };
    struct ow_input_event event;
    (void)state;
    fake_reset();
    linux_wait_init(&wait, &fake_linux);
    const struct oldwell_settings none = { .buttons = NULL };
    assert_int_equal(controls_open(&controls, &none, &fake_linux, NULL, &wait), OW_OK);
    assert_int_equal(controls.input.ops->next(controls.input.device, &event), OW_AGAIN);
    controls_close(&controls);
    assert_int_equal(controls_open(&controls, &settings, &fake_linux, NULL, &wait),
                     OW_UNSUPPORTED); /* built without libgpiod */
    settings.buttons = "left";
    assert_int_equal(controls_open(&controls, &settings, &fake_linux, NULL, &wait), OW_ARGUMENT);
    assert_string_equal(controls.fault.device, "--buttons");
    settings = (struct oldwell_settings){ .input = "/dev/input/event9" };
    assert_int_equal(controls_open(&controls, &settings, &fake_linux, NULL, &wait), OW_GONE);
    assert_non_null(strstr(controls.fault.device, "event9"));
    settings.input = "a,b,c,d,e";
    assert_true(controls_open(&controls, &settings, &fake_linux, NULL, &wait) < 0);
    assert_int_equal(wait.count, 0);
    assert_int_equal(fake.open_fds, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(buttons_are_read),
        cmocka_unit_test(knobs_are_read),
        cmocka_unit_test(what_is_wrong_is_told),
        cmocka_unit_test(opening_says_what_is_missing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
