/* SPDX-License-Identifier: 0BSD */
/*
 * The device's loop on a simulated panel: good trees are shown, bad ones are
 * explained, trees come over a stream in any pieces, time can be stopped, and a
 * panel that fails is tried again.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "firmware/device/device.h"
#include "firmware/device/font.h"
#include "firmware/device/message.h"
#include "sim_scene.h"

enum { WIDTH = 128, HEIGHT = 64, ARENA = 1 << 12, MEMORY = 1 << 17, LOG = 1 << 14, STEP_US = 1000 };

struct bench {
    struct sim_panel panel;
    struct ow_clock clock;
    struct ow_wait wait;
    struct ow_stream stream;
    struct ow_board board;
    struct ow_device_config config;
    struct ow_device device;
    uint8_t *tree;
    uint32_t tree_bytes;
    uint64_t now_us;
    uint8_t sent[1 << 14]; /* what the stream holds */
    uint32_t sent_bytes;
    uint32_t taken;
    uint32_t piece;    /* bytes that a read gets at most */
    int stream_status; /* instead of OW_AGAIN, once */
    char log[LOG];
    uint32_t fed; /* times that the watchdog was */
    uint8_t arena[ARENA];
    uint64_t memory[MEMORY / 8];
};

static int now(void *device, uint64_t *time_us)
{
    *time_us = ((struct bench *)device)->now_us;
    return OW_OK;
}

static int sleep_until(void *device, uint64_t until_us)
{
    struct bench *bench = device;
    bench->now_us = until_us > bench->now_us ? until_us : bench->now_us;
    return OW_OK;
}

/* Time passes; the stream's bytes wake it. */
static int wait(void *device, uint64_t until_us)
{
    struct bench *bench = device;
    if (bench->taken < bench->sent_bytes) {
        return 1;
    }
    return sleep_until(device, until_us == OW_TIME_NEVER ? bench->now_us + STEP_US : until_us);
}

static int read(void *device, void *bytes, uint32_t count)
{
    struct bench *bench = device;
    uint32_t left = bench->sent_bytes - bench->taken;
    if (left == 0) {
        int status = bench->stream_status;
        bench->stream_status = OW_AGAIN;
        return status;
    }
    count = count < left ? count : left;
    count = bench->piece != 0 && count > bench->piece ? bench->piece : count;
    memcpy(bytes, bench->sent + bench->taken, count);
    bench->taken += count;
    return (int)count;
}

static int log_line(void *device, enum ow_log_level level, const char *text)
{
    struct bench *bench = device;
    size_t used = strlen(bench->log);
    assert_true(used + strlen(text) + 3 < LOG);
    strcat(bench->log, level == OW_LOG_ERROR ? "E " : "I ");
    strcat(bench->log, text);
    strcat(bench->log, "\n");
    return OW_OK;
}

static int watchdog(void *device, uint32_t limit_us)
{
    struct bench *bench = device;
    assert_int_equal(limit_us, 1000000);
    bench->fed++;
    return OW_OK;
}

static const struct ow_clock_ops clock_ops = { .now = now, .sleep = sleep_until };
static const struct ow_wait_ops wait_ops = { .wait = wait };
static const struct ow_stream_ops stream_ops = { .read = read };
static const struct ow_board_ops board_ops = { .log = log_line, .watchdog = watchdog };

static struct bench *bench_new(enum sim_panel_kind kind)
{
    struct bench *bench = calloc(1, sizeof *bench);
    struct sim_panel_config panel = {
        .width = WIDTH, .height = HEIGHT, .format = &ow_format_gray4, .kind = kind
    };
    assert_non_null(bench);
    assert_true(sim_panel_open(&bench->panel, &panel));
    bench->tree = scene_cube(&bench->tree_bytes);
    bench->clock = (struct ow_clock){ &clock_ops, bench };
    bench->wait = (struct ow_wait){ &wait_ops, bench };
    bench->stream = (struct ow_stream){ &stream_ops, bench };
    bench->board = (struct ow_board){ &board_ops, bench };
    bench->stream_status = OW_AGAIN;
    bench->config = (struct ow_device_config){
        .viewer = { .parts = &ow_parts_all,
                    .look = { .order = OW_FRONT_TO_BACK,
                              .shade = OW_SHADE_FLAT,
                              .ambient_q8 = 256 },
                    .camera = { .projection = OW_PERSPECTIVE, .fov = UINT32_C(1) << 29 },
                    .views = 16,
                    .interval_us = 50000,
                    .end = OW_VIEWER_REPEAT,
                    .panel = &bench->panel.panel,
                    .clock = &bench->clock,
                    .wait = &bench->wait },
        .board = &bench->board,
        .stream = &bench->stream,
        .watchdog_us = 1000000,
        .tree = bench->tree,
        .tree_bytes = bench->tree_bytes,
        .arena = bench->arena,
        .arena_bytes = ARENA,
        .memory = bench->memory,
        .memory_bytes = sizeof bench->memory,
    };
    return bench;
}

static void bench_free(struct bench *bench)
{
    assert_null(bench->panel.wrong);
    assert_true(bench->fed > 0);
    sim_panel_close(&bench->panel);
    free(bench->tree);
    free(bench);
}

static void step(struct bench *bench, uint32_t count)
{
    while (count-- > 0) {
        ow_device_step(&bench->device);
    }
}

static void send(struct bench *bench, const void *bytes, uint32_t count)
{
    assert_true(bench->sent_bytes + count <= sizeof bench->sent);
    memcpy(bench->sent + bench->sent_bytes, bytes, count);
    bench->sent_bytes += count;
}

static void assert_said(const struct bench *bench, const char *text)
{
    if (strstr(bench->log, text) == NULL) {
        fail_msg("it did not say '%s' but:\n%s", text, bench->log);
    }
}

/* The letter at a place of the panel's message. */
static void assert_letter(const struct bench *bench, uint32_t column, uint32_t row, char letter)
{
    for (uint32_t y = 0; y < 8; y++) {
        uint32_t bits = 0;
        const uint8_t *line = bench->panel.screen + (8 * row + y) * bench->panel.row_bytes;
        for (uint32_t x = 0; x < 6; x++) {
            bits |= (uint32_t)(ow_format_gray4.get(line, 6 * column + x) != 0) << x;
        }
        assert_int_equal(bits, font_line(letter, y));
    }
}

static void test_shows(void **state)
{
    (void)state;
    struct bench *bench = bench_new(SIM_PANEL_TAKES);
    ow_device_start(&bench->device, &bench->config);
    assert_int_equal(bench->device.state, OW_DEVICE_SHOWS);
    step(bench, 100);
    assert_int_equal(bench->device.state, OW_DEVICE_SHOWS);
    assert_true(bench->panel.frames > 20);
    assert_said(bench, "I tree bytes");
    bench_free(bench);
}

/* What is wrong with the built-in tree is said on both, and a good one is then shown. */
static void check_bad_tree(enum sim_panel_kind kind, const uint8_t *tree, uint32_t bytes,
                           int status)
{
    struct bench *bench = bench_new(kind);
    bench->config.tree = tree;
    bench->config.tree_bytes = bytes;
    ow_device_start(&bench->device, &bench->config);
    assert_int_equal(bench->device.state, OW_DEVICE_SAYS);
    assert_int_equal(bench->device.status, status);
    assert_said(bench, "E built-in tree: ");
    assert_said(bench, ow_status_text(status));
    assert_letter(bench, 0, 0, 'B');
    assert_letter(bench, 13, 0, ':');
    assert_letter(bench, 0, 1, ow_status_text(status)[0]);
    step(bench, 10);
    assert_int_equal(bench->panel.frames, 1);
    send(bench, bench->tree, bench->tree_bytes);
    step(bench, 10);
    assert_int_equal(bench->device.state, OW_DEVICE_SHOWS);
    assert_true(bench->panel.frames > 2);
    bench_free(bench);
}

static void test_bad_trees(void **state)
{
    (void)state;
    uint32_t bytes;
    uint8_t *tree = scene_cube(&bytes);
    static const uint8_t erased[512] = { 0xFF, 0xFF, 0xFF, 0xFF };
    for (int kind = SIM_PANEL_LENDS; kind <= SIM_PANEL_TAKES; kind++) {
        check_bad_tree((enum sim_panel_kind)kind, erased, sizeof erased, OW_MAGIC);
        check_bad_tree((enum sim_panel_kind)kind, tree, bytes - 1, OW_TRUNCATED);
        tree[bytes - 1] ^= 1;
        check_bad_tree((enum sim_panel_kind)kind, tree, bytes, OW_CHECKSUM);
        tree[bytes - 1] ^= 1;
    }
    free(tree);
}

static void test_too_little_memory(void **state)
{
    (void)state;
    struct bench *bench = bench_new(SIM_PANEL_TAKES);
    bench->config.memory_bytes = 2000;
    ow_device_start(&bench->device, &bench->config);
    assert_int_equal(bench->device.status, OW_MEMORY);
    assert_letter(bench, 0, 0, 'B');
    step(bench, 3);
    bench_free(bench);
}

/* Whole trees in pieces of any size, between commands and noise. */
static void test_pieces(void **state)
{
    (void)state;
    for (uint32_t piece = 0; piece < 40; piece = piece < 5 ? piece + 1 : piece + 7) {
        struct bench *bench = bench_new(SIM_PANEL_TAKES);
        bench->piece = piece;
        ow_device_start(&bench->device, &bench->config);
        bench->log[0] = '\0';
        send(bench, "\r\nx\177OW\177?", 9);
        send(bench, bench->tree, bench->tree_bytes);
        send(bench, "?", 1);
        step(bench, 8);
        assert_int_equal(bench->device.state, OW_DEVICE_SHOWS);
        assert_ptr_equal(bench->device.tree.bytes, bench->arena);
        assert_said(bench, "I shows frame");
        bench_free(bench);
    }
}

static void test_wrong_arrivals(void **state)
{
    (void)state;
    struct bench *bench = bench_new(SIM_PANEL_TAKES);
    ow_device_start(&bench->device, &bench->config);
    send(bench, bench->tree, bench->tree_bytes - 1); /* and then nothing */
    step(bench, 1);
    assert_int_equal(bench->device.state, OW_DEVICE_RECEIVES);
    assert_letter(bench, 0, 0, 'R');
    step(bench, 3);
    assert_int_equal(bench->device.status, OW_TRUNCATED);

    uint8_t head[12];
    memcpy(head, bench->tree, sizeof head);
    head[9] = 0x7F; /* far too long */
    send(bench, head, sizeof head);
    send(bench, bench->tree, bench->tree_bytes); /* belongs to the long one, so far */
    step(bench, 6);
    assert_int_equal(bench->device.status, OW_MEMORY);
    head[8] = 5; /* shorter than a header */
    head[9] = 0;
    send(bench, head, sizeof head);
    step(bench, 6);
    assert_int_equal(bench->device.status, OW_CORRUPT);

    send(bench, bench->tree, 50);
    step(bench, 1);
    bench->stream_status = OW_CAPACITY; /* bytes were lost */
    step(bench, 4);
    assert_int_equal(bench->device.status, OW_BUS);

    bench->tree[bench->tree_bytes / 2] ^= 4;
    send(bench, bench->tree, bench->tree_bytes);
    step(bench, 2);
    assert_int_equal(bench->device.status, OW_CHECKSUM);
    bench->tree[bench->tree_bytes / 2] ^= 4;
    send(bench, "b", 1);
    step(bench, 2);
    assert_int_equal(bench->device.state, OW_DEVICE_SHOWS);
    assert_ptr_equal(bench->device.tree.bytes, bench->tree);
    bench->stream_status = OW_GONE;
    step(bench, 5);
    assert_int_equal(bench->device.state, OW_DEVICE_SHOWS);
    bench_free(bench);
}

/* A frame for each n, and none without; then it goes on. */
static void test_stopped_time(void **state)
{
    (void)state;
    struct bench *bench = bench_new(SIM_PANEL_TAKES);
    ow_device_start(&bench->device, &bench->config);
    send(bench, "sb", 2);
    step(bench, 50);
    uint32_t frames = bench->panel.frames;
    assert_int_equal(bench->device.viewer.number, 0);
    for (uint32_t i = 1; i < 20; i++) {
        send(bench, "n", 1);
        step(bench, 10);
        assert_int_equal(bench->panel.frames, frames + i);
        assert_int_equal(bench->device.viewer.number, i % 16);
    }
    send(bench, "g", 1);
    step(bench, 50);
    assert_true(bench->panel.frames > frames + 30);
    bench_free(bench);
}

static void test_panel_fails(void **state)
{
    (void)state;
    struct bench *bench = bench_new(SIM_PANEL_TAKES);
    ow_device_start(&bench->device, &bench->config);
    step(bench, 10);
    bench->panel.config.fail_status = OW_BUS;
    bench->panel.config.fail_every = 1;
    step(bench, 10);
    assert_int_equal(bench->device.state, OW_DEVICE_SHOWS);
    assert_said(bench, "trying again");
    assert_null(strstr(strstr(bench->log, "trying again") + 1, "trying again"));
    bench->panel.config.fail_every = 0;
    uint32_t frames = bench->panel.frames;
    step(bench, 20);
    assert_true(bench->panel.frames > frames);
    bench_free(bench);
}

/* A message of any length stays inside the panel; without room for a band it says so. */
static void test_messages(void **state)
{
    (void)state;
    struct bench *bench = bench_new(SIM_PANEL_TAKES);
    ow_device_start(&bench->device, &bench->config);
    char text[600];
    memset(text, 'x', sizeof text);
    text[sizeof text - 1] = '\0';
    assert_int_equal(message_show(&bench->panel.panel, text, bench->memory, 512), OW_OK);
    assert_letter(bench, 20, 7, 'X');
    assert_int_equal(message_show(&bench->panel.panel, "one two", bench->memory, 64), OW_OK);
    assert_letter(bench, 4, 0, 'T');
    assert_int_equal(message_show(&bench->panel.panel, "no", bench->memory, 60), OW_MEMORY);
    assert_int_equal(
        message_show(&bench->panel.panel, "aaaaaaaaaaaa bbbbbbbbbbbb", bench->memory, 512), OW_OK);
    assert_letter(bench, 0, 1, 'B'); /* broken at the blank */
    step(bench, 1);
    bench_free(bench);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shows),
        cmocka_unit_test(test_bad_trees),
        cmocka_unit_test(test_too_little_memory),
        cmocka_unit_test(test_pieces),
        cmocka_unit_test(test_wrong_arrivals),
        cmocka_unit_test(test_stopped_time),
        cmocka_unit_test(test_panel_fails),
        cmocka_unit_test(test_messages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
