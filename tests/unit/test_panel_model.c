/* SPDX-License-Identifier: 0BSD */
/* The controller models complain of what they should, and decode what a data sheet says. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "sim/sim_clock.h"
#include "sim/sim_controller.h"

struct bench {
    struct sim_clock time;
    struct ow_clock clock;
    struct sim_controller controller;
};

static void power_on(struct bench *bench, const char *name)
{
    const struct sim_module *module = sim_module_by_name(name);
    assert_non_null(module);
    bench->time.now_us = 1000;
    bench->clock = (struct ow_clock){ &sim_virtual_clock_ops, &bench->time };
    assert_true(sim_controller_open(&bench->controller, module, &bench->clock));
    sim_controller_reset(&bench->controller, 1000);
    bench->time.now_us += 200000;
}

/*
 * A script: hex bytes with D/C low, after a colon with D/C high until the next
 * space-separated `.`; `|` ends a transfer; `+N` lets N milliseconds pass.
 */
static void play(struct bench *bench, const char *script)
{
    bool data = false;
    while (*script != '\0') {
        char *end = NULL;
        switch (*script) {
        case ' ':
            script++;
            break;
        case ':':
        case '.':
            data = *script++ == ':';
            break;
        case '|':
            sim_controller_release(&bench->controller);
            script++;
            break;
        case '+':
            bench->time.now_us += strtoul(script + 1, &end, 10) * 1000;
            script = end;
            break;
        default:
            sim_controller_byte(&bench->controller, data, (uint8_t)strtoul(script, &end, 16));
            script = end;
            break;
        }
    }
}

static const struct complaint {
    const char *controller;
    const char *script;
    const char *words; /* that the complaint holds; NULL: none */
} complaints[] = {
    { "ili9341", "11 +120 3A: 55. 2A: 0 0 0 1. 2B: 0 0 0 0. 2C: 12 34 56 78. 0", NULL },
    { "ili9341", "11 +120 3A: 66.", "3A: parameter 66" },
    { "ili9341", "11 +120 77", "unknown code 77" },
    { "ili9341", "11 +4 29", "29: 1000 us before" },
    { "ili9341", "11 +50 10", "10: 70000 us too early" },
    { "ili9341", "01 +4 00", "00: 1000 us before" },
    { "ili9341", "01 +10 11", "11: 110000 us too early" },
    { "ili9341", "11 +120 2A: 0 0 0. 2B", "2A: 3 parameters instead of 4" },
    { "ili9341", "11 +120 20: 1.", "20: data that it does not take" },
    { "ili9341", "11 +120 2A: 0 0 0 F0.", "2A: window 0 .. 240 of 0 .. 239" },
    { "ili9341", "11 +120 36: 28. 2A: 0 0 0 F0.", NULL },
    { "ili9341", "11 +120 36: 28. 2B: 0 0 0 F0.", "2B: window 0 .. 240 of 0 .. 239" },
    { "ili9341", "11 +120 2B: 0 5 0 4.", "2B: window 5 .. 4" },
    { "ili9341", "11 +120 2A: 0 0 0 0. 2B: 0 0 0 0. 2C: 1 2 3.", "more pixels than the window" },
    { "ili9341", "11 +120 2A: 0 0 0 9. 2B: 0 0 0 0. 2C: 1 2 3. 0", "cut in the middle by a com" },
    { "ili9341", "11 +120 2A: 0 0 0 9. 2B: 0 0 0 0. 2C: 1 2 3|", "middle by the end of a trans" },
    { "ili9341", "11 +120 29", "noise" },
    { "ili9341", "36: 4A.", "bits 02 of 4A" },
    { "ssd1351", "A6", "A6 while commands are locked" },
    { "ssd1351", "FD: 12. A6", NULL },
    { "ssd1351", "FD: 12. 15: 0 80.", "15: window 0 .. 128" },
    { "ssd1351", "FD: 12. 15: 0 1. 75: 0 1. : 1 2", "75: data that it does not take" },
    { "ssd1351", "FD: 12. CA: 3F. AF", "noise" },
    { "ssd0323", "15 0 1 75 0 0 : 1 2 3.", "more pixels" },
    { "ssd0323", "15 0 1 75 0 : 1 2.", "75: a parameter came as data" },
    { "ssd0323", "15 0 40", "15: window 0 .. 64" },
    { "ssd0323", "C7", "unknown code C7" },
    { "ssd1322", "FD: 12. 15: 1C 78.", "15: window 28 .. 120 of 0 .. 119" },
    { "ssd1322", "FD: 12. B5", NULL },
    { "ssd1322", "FD: 12. B5 A6", "B5: 0 parameters instead of 1" },
    { "ssd1306", "20 2", "mode 02" },
    { "ssd1306", "22 0 8", "22: window 0 .. 8 of 0 .. 7" },
    { "ssd1306", "21 0 0 22 0 0 :FF FF", "more pixels" },
};

static void the_model_complains(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof complaints / sizeof complaints[0]; i++) {
        struct bench bench;
        power_on(&bench, complaints[i].controller);
        play(&bench, complaints[i].script);
        const char *said = bench.controller.complaint;
        print_message("# %s, %s: %s\n", complaints[i].controller, complaints[i].script, said);
        if (complaints[i].words == NULL) {
            assert_int_equal(bench.controller.complaints, 0);
        } else {
            assert_non_null(strstr(said, complaints[i].words));
        }
        sim_controller_close(&bench.controller);
    }
}

static void a_short_reset_is_noticed(void **state)
{
    (void)state;
    struct bench bench;
    power_on(&bench, "ili9341");
    sim_controller_reset(&bench.controller, 9);
    assert_non_null(strstr(bench.controller.complaint, "9 us"));
    sim_controller_close(&bench.controller);
}

/* Two by hand: where the bytes of the data sheets' examples end up. */
static void bytes_go_where_the_data_sheet_says(void **state)
{
    (void)state;
    struct bench bench;
    power_on(&bench, "ili9341");
    play(&bench, "11 +120 36: 48. 2A: 0 2 0 3. 2B: 0 5 0 6. 2C: 11 22 33 44 55 66 77 88.");
    bench.controller.lit = true; /* without a whole frame */
    assert_int_equal(sim_controller_glass(&bench.controller, 2, 5), 0x1122);
    assert_int_equal(sim_controller_glass(&bench.controller, 3, 5), 0x3344);
    assert_int_equal(sim_controller_glass(&bench.controller, 2, 6), 0x5566);
    assert_int_equal(sim_controller_glass(&bench.controller, 3, 6), 0x7788);
    play(&bench, "21");
    assert_int_equal(sim_controller_glass(&bench.controller, 2, 5), 0xEEDD);
    play(&bench, "28");
    assert_int_equal(sim_controller_glass(&bench.controller, 2, 5), -1);
    sim_controller_close(&bench.controller);

    power_on(&bench, "ssd1306");
    play(&bench, "A1 C8 A8 3F 20 0 21 7 8 22 1 1 : 81 3");
    bench.controller.lit = true;
    static const uint8_t lines[8][2] = { { 1, 1 }, { 0, 1 }, { 0, 0 }, { 0, 0 },
                                         { 0, 0 }, { 0, 0 }, { 0, 0 }, { 1, 0 } };
    for (uint32_t y = 0; y < 8; y++) {
        for (uint32_t x = 0; x < 2; x++) {
            assert_int_equal(sim_controller_glass(&bench.controller, 7 + x, 8 + y), lines[y][x]);
        }
    }
    sim_controller_close(&bench.controller);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_model_complains),
        cmocka_unit_test(a_short_reset_is_noticed),
        cmocka_unit_test(bytes_go_where_the_data_sheet_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
