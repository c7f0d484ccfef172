/* SPDX-License-Identifier: 0BSD */
/* ILI9341: 240x320, 16-bit colour. */
#include "hal/panel/controller.h"

static const uint8_t init[] = {
    0xC0, 1,    0x23,             /* GVDD 4.6 V */
    0xC1, 1,    0x10,             /* step-up factors */
    0xC5, 2,    0x3E, 0x28,       /* VCOMH 4.25 V, VCOML -1.5 V */
    0xC7, 1,    0x86,             /* their offset */
    0x3A, 1,    0x55,             /* 16 bits a pixel */
    0xB1, 2,    0x00, 0x18,       /* 79 frames a second */
    0xB6, 3,    0x08, 0x82, 0x27, /* 320 lines, scanned in turn */
    0x26, 1,    0x01,             /* gamma: curve 1, adjusted */
    0xE0, 15,   0x0F, 0x31, 0x2B, 0x0C, 0x0E, 0x08, 0x4E, 0xF1, 0x37, 0x07,
    0x10, 0x03, 0x0E, 0x09, 0x00, 0xE1, 15,   0x00, 0x0E, 0x14, 0x03, 0x11,
    0x07, 0x31, 0xC1, 0x48, 0x08, 0x0F, 0x0C, 0x31, 0x36, 0x0F, 0x11, 0 | OW_THEN_WAIT,
    120, /* sleep out */
};
static const uint8_t on[] = { 0x29, 0 };
static const uint8_t off[] = { 0x28, 0, 0x10, 0 | OW_THEN_WAIT, 120 };
static const uint8_t wake[] = { 0x11, 0 | OW_THEN_WAIT, 120 };

const struct ow_controller ow_controller_ili9341 = {
    .name = "ili9341",
    .format = &ow_format_rgb565_be,
    .width = 240,
    .height = 320,
    .ram_width = 240,
    .ram_height = 320,
    .write_hz = 10000000,
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
               .usual = 0x48,
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
