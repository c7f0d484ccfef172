/* SPDX-License-Identifier: 0BSD */
/* The Raspberry Pi 2 without an operating system: a tree turns on its HDMI picture. */
#include "firmware/device/device.h"
#include "hal/bcm2836/chip.h"

#define TURN_OF(degrees) ((ow_turn)((((uint64_t)(degrees) << 32) + 180) / 360))

/* The picture: make FRAME_WIDTH=.. FRAME_HEIGHT=.. FRAME_BITS=16|32 */
#ifndef FRAME_WIDTH
#define FRAME_WIDTH 640
#define FRAME_HEIGHT 480
#endif
#ifndef FRAME_BITS
#define FRAME_BITS 32
#endif

enum { VIEWS = 72, INTERVAL_US = 50000, ARENA_BYTES = 16 << 20, MEMORY_BYTES = 32 << 20 };

/* The built-in tree, from tree.S. */
extern const uint8_t board_tree[];
extern const uint8_t board_tree_end[];

static uint8_t arena[ARENA_BYTES] __attribute__((aligned(8)));
static uint8_t memory[MEMORY_BYTES] __attribute__((aligned(8)));
static struct ow_device device;
static struct chip_frame_buffer frame_buffer = {
    .width = FRAME_WIDTH,
    .height = FRAME_HEIGHT,
    .format = FRAME_BITS == 16 ? &ow_format_rgb565 : &ow_format_xrgb8888,
    .pages = 2,
};

static const struct ow_clock clock = { &chip_clock_ops, NULL };
static const struct ow_wait wait = { &chip_wait_ops, NULL };
static const struct ow_stream stream = { &pl011_stream_ops, &chip_uart };
static const struct ow_board board = { &chip_board_ops, &chip_uart };
static const struct ow_panel panel = { &chip_frame_buffer_ops, &frame_buffer };
static const struct ow_workers workers = { &chip_workers_ops, NULL, CHIP_CORES };

int main(void)
{
    const struct ow_device_config config = {
        .viewer = {
            .parts = &ow_parts_all,
            .look = { /* the simulator's */
                .order = OW_FRONT_TO_BACK,
                .shade = OW_SHADE_FLAT,
                .background = 0x20242C,
                .ambient_q8 = 77,
                .light = { .direction_q14 = { -6521, 9782, 11412 }, .intensity_q8 = 179 },
            },
            .camera = { .projection = OW_PERSPECTIVE, .fov = TURN_OF(45) },
            .views = VIEWS,
            .interval_us = INTERVAL_US,
            .end = OW_VIEWER_REPEAT,
            .elevation = TURN_OF(15),
            .panel = &panel,
            .clock = &clock,
            .wait = &wait,
            .workers = &workers,
        },
        .board = &board,
        .stream = &stream,
        .tree = board_tree,
        .tree_bytes = (uint32_t)(board_tree_end - board_tree),
        .arena = arena,
        .arena_bytes = sizeof arena,
        .memory = memory,
        .memory_bytes = sizeof memory,
        .stack_used = chip_stack_used,
        .stack_bytes = chip_stack_bytes(),
    };
    (void)ow_board_log(&board, OW_LOG_INFO, "Oldwell on raspi2b");
    int status = chip_frame_buffer_open(&frame_buffer);
    if (status < 0) {
        (void)ow_board_log(&board, OW_LOG_ERROR, ow_status_text(status));
    }
    ow_device_start(&device, &config);
    for (;;) {
        ow_device_step(&device);
    }
}
