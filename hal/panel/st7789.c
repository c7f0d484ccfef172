/* SPDX-License-Identifier: 0BSD */
/* ST7789V: 240x320, 16-bit colour; glass of 240x240 and less begins at an offset or not. */
#include "hal/panel/controller.h"

static const uint8_t init[] = {
    0x11, 0 | OW_THEN_WAIT,
    120, /* sleep out */
    0x3A, 1,
    0x55, /* 16 bits a pixel */
    0xB2, 5,
    0x0C, 0x0C,
    0x00, 0x33,
    0x33, /* porches */
    0xB7, 1,
    0x35, /* gate voltages */
    0xBB, 1,
    0x19, /* VCOM 0.725 V */
    0xC0, 1,
    0x2C, /* LCM control */
    0xC2, 1,
    0x01, /* VDV and VRH by the next two */
    0xC3, 1,
    0x12, 0xC4,
    1,    0x20,
    0xC6, 1,
    0x0F, /* 60 frames a second */
    0xD0, 2,
    0xA4, 0xA1, /* power */
    0xE0, 14,
    0xD0, 0x04,
    0x0D, 0x11,
    0x13, 0x2B,
    0x3F, 0x54,
    0x4C, 0x18,
    0x0D, 0x0B,
    0x1F, 0x23,
    0xE1, 14,
    0xD0, 0x04,
    0x0C, 0x11,
    0x13, 0x2C,
    0x3F, 0x44,
    0x51, 0x2F,
    0x1F, 0x1F,
    0x20, 0x23,
};
static const uint8_t on[] = { 0x29, 0 };
static const uint8_t off[] = { 0x28, 0, 0x10, 0 | OW_THEN_WAIT, 120 };
static const uint8_t wake[] = { 0x11, 0 | OW_THEN_WAIT, 120 };

const struct ow_controller ow_controller_st7789 = {
    .name = "st7789",
    .format = &ow_format_rgb565_be,
    .width = 240,
    .height = 320,
    .ram_width = 240,
    .ram_height = 320,
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
               .usual = 0x00,
               .flip_columns = 0x40,
               .flip_rows = 0x80,
               .swap = 0x20,
               .bgr = 0x08 } },
    .normal_code = 0x20,
    .inverted_code = 0x21,
    .inverted = true,
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
