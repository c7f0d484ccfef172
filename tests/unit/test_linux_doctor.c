/* SPDX-License-Identifier: 0BSD */
/* Board files, permissions in words, the test pattern, the doctor's lines. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "boards/linux/access.h"
#include "boards/linux/board_file.h"
#include "boards/linux/doctor.h"
#include "boards/linux/pattern.h"
#include "hal/linux/clock.h"
#include "sim/sim_panel.h"
#include "tests/unit/child.h"
#include "tests/unit/fake_linux.h"

/* ---- board files ---- */

static void settings_are_cut_out(void **state)
{
    char text[] = "# a board\n"
                  "\n"
                  "panel = fbdev   # the kind\r\n"
                  "  device=/dev/fb1\t\n"
                  "light = 1, 2, 3";
    static const char *const expected[][2] = { { "panel", "fbdev" },
                                               { "device", "/dev/fb1" },
                                               { "light", "1, 2, 3" } };
    static const long lines[] = { 3, 4, 5 };
    size_t at = 0;
    long line = 0;
    struct board_setting setting;
    const char *wrong;
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        assert_true(board_file_next(text, sizeof text - 1, &at, &line, &setting, &wrong));
        assert_string_equal(setting.name, expected[i][0]);
        assert_string_equal(setting.value, expected[i][1]);
        assert_int_equal(setting.line, lines[i]);
    }
    assert_false(board_file_next(text, sizeof text - 1, &at, &line, &setting, &wrong));
    assert_null(wrong);
}

static void wrong_lines_are_told(void **state)
{
    static const struct {
        const char *text;
        size_t bytes;
        long line;
        const char *says;
    } cases[] = {
        { "panel fbdev\n", 12, 1, "name = value" },    { "\n\n= fbdev\n", 10, 3, "small letters" },
        { "Panel = fbdev\n", 14, 1, "small letters" }, { "a b = c", 7, 1, "small letters" },
        { "panel =  # nothing\n", 19, 1, "missing" },  { "panel = a\0b\n", 12, 1, "zero byte" },
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[64] = { 0 };
        size_t at = 0;
        long line = 0;
        struct board_setting setting;
        const char *wrong;
        memcpy(text, cases[i].text, cases[i].bytes);
        assert_false(board_file_next(text, cases[i].bytes, &at, &line, &setting, &wrong));
        assert_non_null(wrong);
        assert_non_null(strstr(wrong, cases[i].says));
        assert_int_equal(line, cases[i].line);
    }
}

/* ---- permissions ---- */

static void permissions_are_explained(void **state)
{
    static const struct {
        mode_t mode;
        uid_t owner;
        gid_t group;
        const char *name;
        bool may;
        const char *says;
    } cases[] = {
        { 0600, 1000, 0, "", true, "owner" },
        { 0660, 0, 44, "video", true, "group video" },
        { 0660, 0, 99, "spi", false, "usermod -aG spi" },
        { 0660, 0, 0, "root", false, "udev rule" },
        { 0600, 0, 44, "video", false, "udev rule" },
        { 0640, 0, 44, "video", false, "udev rule" },
        { 0666, 0, 0, "root", true, "everybody" },
        { 0660, 0, 99, "", false, "udev rule" },
    };
    const gid_t groups[] = { 1000, 44 };
    const struct access_user user = { 1000, groups, 2 };
    const struct access_user root = { 0, NULL, 0 };
    char text[256];
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct stat node = { .st_mode = cases[i].mode,
                             .st_uid = cases[i].owner,
                             .st_gid = cases[i].group };
        assert_int_equal(access_explain(&node, &user, cases[i].name, text, sizeof text),
                         cases[i].may);
        if (strstr(text, cases[i].says) == NULL) {
            fail_msg("case %zu says: %s", i, text);
        }
        assert_true(access_explain(&node, &root, cases[i].name, text, sizeof text));
    }
}

/* ---- the pattern ---- */

static void the_pattern_has_its_marks(void **state)
{
    static const uint32_t sizes[][2] = { { 320, 240 }, { 240, 240 }, { 128, 160 }, { 128, 64 } };
    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        uint32_t w = sizes[i][0];
        uint32_t h = sizes[i][1];
        for (uint32_t x = 0; x < w; x++) {
            assert_int_equal(pattern_colour(x, 0, w, h), 0xFFFFFF);
            assert_int_equal(pattern_colour(x, h - 1, w, h), 0xFFFFFF);
        }
        for (uint32_t y = 0; y < h; y++) {
            assert_int_equal(pattern_colour(0, y, w, h), 0xFFFFFF);
            assert_int_equal(pattern_colour(w - 1, y, w, h), 0xFFFFFF);
        }
        assert_int_equal(pattern_colour(1, 1, w, h), 0xFF0000);
        assert_int_equal(pattern_colour(w - 2, 1, w, h), 0x00FF00);
        assert_int_equal(pattern_colour(1, h - 2, w, h), 0x0000FF);
        assert_int_equal(pattern_colour(w - 2, h - 2, w, h), 0xFFFFFF);
    }
}

static int keep_frame(void *context, const struct sim_panel *panel)
{
    (void)panel;
    ++*(int *)context;
    return OW_OK;
}

/* Lending and taking panels, turned each way: the red corner is the picture's top left. */
static void the_pattern_is_shown_on_any_panel(void **state)
{
    static const uint32_t red[4][2] = { { 1, 1 }, { 318, 1 }, { 318, 238 }, { 1, 238 } };
    static const uint32_t green[4][2] = { { 318, 1 }, { 318, 238 }, { 1, 238 }, { 1, 1 } };
    struct ow_clock clock = { &linux_clock_ops, (void *)(uintptr_t)&fake_linux };
    (void)state;
    fake_reset();
    for (int kind = SIM_PANEL_LENDS; kind <= SIM_PANEL_TAKES; kind++) {
        for (uint32_t turns = 0; turns < 4; turns++) {
            int frames = 0;
            struct sim_panel panel;
            const struct sim_panel_config config = { .width = 320,
                                                     .height = 240,
                                                     .format = &ow_format_xrgb8888,
                                                     .kind = (enum sim_panel_kind)kind,
                                                     .delay = 3,
                                                     .frame = keep_frame,
                                                     .context = &frames };
            assert_true(sim_panel_open(&panel, &config));
            assert_int_equal(pattern_show(&panel.panel, &clock, turns), OW_OK);
            assert_int_equal(frames, 1);
            assert_null(panel.wrong);
            const uint8_t *row = panel.screen + (size_t)red[turns][1] * panel.row_bytes;
            assert_int_equal(ow_format_xrgb8888.get(row, red[turns][0]), 0xFF0000);
            row = panel.screen + (size_t)green[turns][1] * panel.row_bytes;
            assert_int_equal(ow_format_xrgb8888.get(row, green[turns][0]), 0x00FF00);
            sim_panel_close(&panel);
        }
    }
}

static void a_panel_that_fails_is_told(void **state)
{
    struct ow_clock clock = { &linux_clock_ops, (void *)(uintptr_t)&fake_linux };
    (void)state;
    for (int kind = SIM_PANEL_LENDS; kind <= SIM_PANEL_TAKES; kind++) {
        uint32_t failed = 1;
        for (uint32_t n = 1; failed > 0; n++) {
            struct sim_panel panel;
            const struct sim_panel_config config = { .width = 16,
                                                     .height = 16,
                                                     .format = &ow_format_rgb565,
                                                     .kind = (enum sim_panel_kind)kind,
                                                     .fail_at = n,
                                                     .fail_status = OW_BUS };
            assert_true(sim_panel_open(&panel, &config));
            int status = pattern_show(&panel.panel, &clock, 0);
            failed = panel.failed;
            assert_int_equal(status, failed > 0 ? OW_BUS : OW_OK);
            assert_null(panel.wrong);
            sim_panel_close(&panel);
        }
    }
}

/* ---- the round ---- */

static int round_of(const struct oldwell_settings *settings, char *text, size_t bytes)
{
    memset(text, 0, bytes);
    struct report report = { .stream = fmemopen(text, bytes - 1, "w") };
    int status = doctor_main(&report, settings, &fake_linux);
    fclose(report.stream);
    return status;
}

static void a_missing_device_is_told_with_the_remedy(void **state)
{
    struct oldwell_settings settings = { .doctor = true,
                                         .panel = PANEL_FBDEV,
                                         .device = "/dev/there-is-none",
                                         .board = "boards/none/board.conf",
                                         .console = "/dev/tty0" };
    char text[2048];
    (void)state;
    fake_reset();
    assert_int_equal(round_of(&settings, text, sizeof text), 3);
    assert_non_null(strstr(text, "ok board: boards/none/board.conf\n"));
    assert_non_null(strstr(text, "ok console: its text gives way to the picture\n"));
    assert_non_null(strstr(text, "not ok fbdev: /dev/there-is-none: No such file or directory; "));
    assert_non_null(strstr(text, "2 right, 1 wrong\n"));
}

static void a_good_display_is_described(void **state)
{
    char folder[CHILD_PATH];
    char path[CHILD_PATH];
    folder_make(folder);
    folder_path(path, folder, "frame");
    struct oldwell_settings settings = { .doctor = true,
                                         .panel = PANEL_FILE,
                                         .device = path,
                                         .format = &ow_format_rgb565,
                                         .size = { 160, 128 } };
    char text[2048];
    (void)state;
    memset(text, 0, sizeof text);
    struct report report = { .stream = fmemopen(text, sizeof text - 1, "w") };
    assert_int_equal(doctor_main(&report, &settings, &linux_system), 0);
    fclose(report.stream);
    assert_non_null(strstr(text, "ok panel: 160x128 pixels, rgb565, what changed is copied\n"));
    assert_non_null(strstr(text, "1 right, 0 wrong\n"));
    folder_remove(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(settings_are_cut_out),
        cmocka_unit_test(wrong_lines_are_told),
        cmocka_unit_test(permissions_are_explained),
        cmocka_unit_test(the_pattern_has_its_marks),
        cmocka_unit_test(the_pattern_is_shown_on_any_panel),
        cmocka_unit_test(a_panel_that_fails_is_told),
        cmocka_unit_test(a_missing_device_is_told_with_the_remedy),
        cmocka_unit_test(a_good_display_is_described),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
