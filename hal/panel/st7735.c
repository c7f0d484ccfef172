/* SPDX-License-Identifier: 0BSD */
/*
 * ST7735R: 128x160, 16-bit colour. Its memory is 132x162 where GM is 000: glass
 * then begins at 2, 1 (128x160) or 26, 1 (80x160). Many modules want bgr.
 */
#include "hal/panel/controller.h"

static const uint8_t init[] = {
    0x11, 0 | OW_THEN_WAIT,
    120, /* sleep out */
    0xB1, 3,
    0x01, 0x2C,
    0x2D, /* frame rate: normal, */
    0xB2, 3,
    0x01, 0x2C,
    0x2D, /* idle, */
    0xB3, 6,
    0x01, 0x2C,
    0x2D, 0x01,
    0x2C, 0x2D, /* partial */
    0xB4, 1,
    0x07, /* no inversion by columns */
    0xC0, 3,
    0xA2, 0x02,
    0x84, /* power: -4.6 V */
    0xC1, 1,
    0xC5, 0xC2,
    2,    0x0A,
    0x00, 0xC3,
    2,    0x8A,
    0x2A, 0xC4,
    2,    0x8A,
    0xEE, 0xC5,
    1,    0x0E, /* VCOM */
    0x3A, 1,
    0x05, /* 16 bits a pixel */
    0xE0, 16,
    0x02, 0x1C,
    0x07, 0x12,
    0x37, 0x32,
    0x29, 0x2D,
    0x29, 0x25,
    0x2B, 0x39,
    0x00, 0x01,
    0x03, 0x10,
    0xE1, 16,
    0x03, 0x1D,
    0x07, 0x06,
    0x2E, 0x2C,
    0x29, 0x2D,
    0x2E, 0x2E,
    0x37, 0x3F,
    0x00, 0x00,
    0x02, 0x10,
    0x13, 0 | OW_THEN_WAIT,
    10, /* normal, not partial */
};
static const uint8_t on[] = { 0x29, 0 };
static const uint8_t off[] = { 0x28, 0, 0x10, 0 | OW_THEN_WAIT, 120 };
static const uint8_t wake[] = { 0x11, 0 | OW_THEN_WAIT, 120 };

const struct ow_controller ow_controller_st7735 = {
    .name = "st7735",
    .format = &ow_format_rgb565_be,
    .width = 128,
    .height = 160,
    .ram_width = 132,
    .ram_height = 162,
    .offset_x = 2,
    .offset_y = 1,
    .write_hz = 15000000,
    .column_code = 0x2A,
    .row_code = 0x2B,
    .write_code = 0x2C,
    .address_bytes = 2,
    .column_pixels = 1,
    .row_lines = 1,
    .codes_turn = true,
    .write_restarts = true,
    .map = { { .code = 0x36,
               .count = 1,
               .usual = 0xC0,
               .flip_columns = 0x40,
               .flip_rows = 0x80,
               .swap = 0x20,
               .bgr = 0x08 } },
    .normal_code = 0x20,
    .inverted_code = 0x21,
    .status_code = 0x0A,
    .status_awake = 0x10,
    .status_lit = 0x04,
    .reset_code = 0x01,
    .nop_code = 0x00,
    .reset_wait_ms = 120,
    .reset_hold_us = 20,
    .reset_settle_us = 120000,
    .init = OW_SEQUENCE(init),
    .on = OW_SEQUENCE(on),
    .off = OW_SEQUENCE(off),
    .wake = OW_SEQUENCE(wake),
};
