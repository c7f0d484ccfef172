/* SPDX-License-Identifier: 0BSD */
/*
 * The Raspberry Pi 2 without an operating system: a tree turns on its HDMI
 * picture. With OW_STRIDE 4 the tree lies in the spare bytes of the frame buffer
 * itself, and is read there.
 */
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

enum { IN_PLANES = OW_STRIDE > 1 };
_Static_assert(OW_STRIDE == 1 || OW_STRIDE * 8 == FRAME_BITS,
               "a pixel's spare byte holds the tree");

enum { VIEWS = 72, INTERVAL_US = 50000, ARENA_BYTES = 16 << 20, MEMORY_BYTES = 32 << 20 };

/* The built-in tree, from tree.S. */
extern const uint8_t board_tree[];
extern const uint32_t board_tree_bytes;

static uint8_t arena[ARENA_BYTES] __attribute__((aligned(8)));
static uint8_t memory[MEMORY_BYTES] __attribute__((aligned(8)));
static struct ow_device device;
static struct chip_frame_buffer frame_buffer = {
    .width = FRAME_WIDTH,
    .height = FRAME_HEIGHT,
    .format = IN_PLANES          ? &ow_format_xrgb8888_kept
              : FRAME_BITS == 16 ? &ow_format_rgb565
                                 : &ow_format_xrgb8888,
    .pages = IN_PLANES ? 1 : 2,
    .keep = IN_PLANES ? 0xFF000000 : 0,
};

static const struct ow_clock clock = { &chip_clock_ops, NULL };
static const struct ow_wait wait = { &chip_wait_ops, NULL };
static const struct ow_stream stream = { &pl011_stream_ops, &chip_uart };
static const struct ow_board board = { &chip_board_ops, &chip_uart };
static const struct ow_panel panel = { &chip_frame_buffer_ops, &frame_buffer };
static const struct ow_workers workers = { &chip_workers_ops, NULL, CHIP_CORES };

/* Lays a tree into the planes: byte i is the high byte of pixel i. */
static const void *place(const void *tree, uint32_t bytes)
{
    const uint8_t *from = tree;
    uint8_t *planes = frame_buffer.pixels + OW_STRIDE - 1;
    bool whole = frame_buffer.stride == OW_STRIDE * FRAME_WIDTH; /* no gap between lines */
    if (frame_buffer.pixels == NULL || !whole || bytes > FRAME_WIDTH * FRAME_HEIGHT) {
        return NULL;
    }
    for (uint32_t i = 0; i < bytes; i++) {
        planes[i * OW_STRIDE] = from[i];
    }
    return planes;
}

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
                .lights = { { .direction_q14 = { -6521, 9782, 11412 }, .intensity_q8 = 179 } },
                .light_count = 1,
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
        .tree_bytes = board_tree_bytes,
        .arena = arena,
        .arena_bytes = sizeof arena,
        .place = IN_PLANES ? place : NULL,
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
    pl011_puts(&chip_uart, "frame buffer ");
    pl011_hex(&chip_uart, (uint32_t)(uintptr_t)frame_buffer.pixels);
    pl011_puts(&chip_uart, "\r\n");
    ow_device_start(&device, &config);
    for (;;) {
        ow_device_step(&device);
    }
}
