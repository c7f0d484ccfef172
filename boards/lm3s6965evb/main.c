/* SPDX-License-Identifier: 0BSD */
/* The Stellaris LM3S6965 evaluation kit: a tree turns on its display of 128x64 greys. */
#include "firmware/device/device.h"
#include "hal/lm3s6965/chip.h"
#include "hal/panel/command_panel.h"
#include "ow_skip.h"
#include "ow_surface.h"

#define TURN_OF(degrees) ((ow_turn)((((uint64_t)(degrees) << 32) + 180) / 360))

enum {
    WIDTH = 128,
    HEIGHT = 64,
    VIEWS = 72,
    INTERVAL_US = 50000,
    REPEAT_US = 150000,
    WATCHDOG_US = 4000000,
    CACHED_VERTICES = 1024,
    FRAME_BYTES = WIDTH * HEIGHT / 2,
    ARENA_BYTES = 27 << 10,
    MEMORY_BYTES = 26 << 10
};

/* The built-in tree, from tree.S. */
extern const uint8_t board_tree[];
extern const uint32_t board_tree_bytes;

static uint8_t frame[FRAME_BYTES] __attribute__((aligned(4)));
static uint8_t arena[ARENA_BYTES] __attribute__((aligned(4)));
static uint8_t memory[MEMORY_BYTES] __attribute__((aligned(8)));
static struct ow_command_panel panel;
static struct ow_device device;

/* What the look below wants; skipping saves it time, the difference the bus. */
static const struct ow_parts parts = {
    .dynamic = &ow_surface_dynamic,
    .shading = { [OW_SHADE_FLAT] = &ow_shading_flat },
    .difference = &ow_differences,
    .skip = &ow_skipping,
};

static const struct ow_clock clock = { &chip_clock_ops, NULL };
static const struct ow_wait wait = { &chip_wait_ops, NULL };
static const struct ow_stream stream = { &pl011_stream_ops, &chip_uart };
static const struct ow_board board = { &chip_board_ops, &chip_uart };
static const struct ow_input input = { &chip_buttons_ops, NULL };
static const struct ow_bus bus = { &chip_ssi_ops, NULL };

static int open_panel(void)
{
    struct ow_command_panel_config config;
    ow_command_panel_defaults(&config, &ow_controller_ssd0323);
    config.bus = &bus;
    config.clock = &clock;
    config.frame = frame;
    config.frame_bytes = sizeof frame;
    return ow_command_panel_open(&panel, &config);
}

int main(void)
{
    static const struct ow_device_config config = {
        .viewer = {
            .parts = &parts,
            .look = { /* the simulator's, on black */
                .order = OW_FRONT_TO_BACK,
                .shade = OW_SHADE_FLAT,
                .ambient_q8 = 77,
                .lights = { { .direction_q14 = { -6521, 9782, 11412 }, .intensity_q8 = 179 } },
                .light_count = 1,
            },
            .camera = { .projection = OW_PERSPECTIVE, .fov = TURN_OF(45) },
            .views = VIEWS,
            .interval_us = INTERVAL_US,
            .end = OW_VIEWER_REPEAT,
            .elevation = TURN_OF(15),
            .repeat_us = REPEAT_US,
            .cached_vertices = CACHED_VERTICES,
            .find_changes = true,
            .panel = &panel.panel,
            .clock = &clock,
            .input = &input,
            .wait = &wait,
        },
        .board = &board,
        .stream = &stream,
        .watchdog_us = WATCHDOG_US,
        .tree = board_tree,
        .arena = arena,
        .arena_bytes = sizeof arena,
        .memory = memory,
        .memory_bytes = sizeof memory,
        .stack_used = chip_stack_used,
    };
    struct ow_device_config start = config;
    start.tree_bytes = board_tree_bytes;
    start.stack_bytes = chip_stack_bytes();
    (void)ow_board_log(&board, OW_LOG_INFO, "Oldwell on lm3s6965evb");
    int status = open_panel();
    if (status < 0) {
        (void)ow_board_log(&board, OW_LOG_ERROR, ow_status_text(status));
    }
    ow_device_start(&device, &start);
    for (;;) {
        ow_device_step(&device);
    }
}
