/* SPDX-License-Identifier: 0BSD */
/* SSD0323: OLED, 16 greys, 128x80 of memory addressed by 2 pixels; the usual glass is 128x64. */
#include "hal/panel/controller.h"

static const uint8_t init[] = {
    0xAE, 0,                                                 /* dark */
    0xA1, 1, 0x00,                                           /* the first line shows row 0 */
    0xA2, 1, 0x00,                                           /* no offset between lines and rows */
    0xAD, 1, 0x02,                                           /* VCC from outside */
    0xB1, 1, 0x22,                                           /* phases */
    0xB2, 1, 0x46,                                           /* row period */
    0xB3, 1, 0xA0,                                           /* clock */
    0xBC, 1, 0x08,                                           /* pre-charge voltage */
    0xBE, 1, 0x10,                                           /* VCOMH */
    0xBF, 1, 0x0E,                                           /* segments' low voltage */
    0x86, 0,                                                 /* full current */
    0x81, 1, 0x40,                                           /* contrast */
    0xB8, 8, 0x01, 0x11, 0x22, 0x32, 0x43, 0x54, 0x65, 0x76, /* greys */
};
static const uint8_t on[] = { 0xAF, 0 };
static const uint8_t off[] = { 0xAE, 0 };

const struct ow_controller ow_controller_ssd0323 = {
    .name = "ssd0323",
    .format = &ow_format_gray4,
    .width = 128,
    .height = 64,
    .ram_width = 128,
    .ram_height = 80,
    .write_hz = 4000000,
    .column_code = 0x15,
    .row_code = 0x75,
    .address_bytes = 1,
    .column_pixels = 2,
    .row_lines = 1,
    .as_commands = true,
    .map = { { .code = 0xA0,
               .count = 1,
               .usual = 0x52,        /* the left pixel in the high half */
               .flip_columns = 0x03, /* halves of a byte as well */
               .flip_rows = 0x10 } },
    .flip_in_lines = true,
    .lines_code = 0xA8,
    .normal_code = 0xA4,
    .inverted_code = 0xA7,
    .light_code = 0x81,
    .light_max = 127,
    .nop_code = 0xE3,
    .reset_hold_us = 20,
    .reset_settle_us = 1000,
    .init = OW_SEQUENCE(init),
    .on = OW_SEQUENCE(on),
    .off = OW_SEQUENCE(off),
};
