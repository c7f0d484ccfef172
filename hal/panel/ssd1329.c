/* SPDX-License-Identifier: 0BSD */
/* SSD1329: 128x128 OLED, 16 greys, addressed by 2 pixels. */
#include "hal/panel/controller.h"

static const uint8_t init[] = {
    0xAE, 0,       /* dark */
    0xB3, 1, 0x91, /* clock */
    0xA2, 1, 0x00, /* no offset between lines and rows */
    0xA1, 1, 0x00, /* the first line shows row 0 */
    0xAD, 1, 0x02, /* VCC from outside */
    0x86, 0,       /* full current */
    0xB7, 0,       /* greys in equal steps */
    0x81, 1, 0x70, /* contrast */
    0xB2, 1, 0x51, /* row period */
    0xB1, 1, 0x55, /* phases */
    0xBC, 1, 0x10, /* pre-charge voltage */
    0xB4, 1, 0x02, /* pre-charge compensation, */
    0xB0, 1, 0x28, /* on */
    0xBE, 1, 0x1C, /* VCOMH */
    0xBF, 1, 0x0F, /* segments' low voltage */
};
static const uint8_t on[] = { 0xAF, 0 };
static const uint8_t off[] = { 0xAE, 0 };

const struct ow_controller ow_controller_ssd1329 = {
    .name = "ssd1329",
    .format = &ow_format_gray4,
    .width = 128,
    .height = 128,
    .ram_width = 128,
    .ram_height = 128,
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
    .light_max = 255,
    .nop_code = 0xE3,
    .reset_hold_us = 20,
    .reset_settle_us = 1000,
    .init = OW_SEQUENCE(init),
    .on = OW_SEQUENCE(on),
    .off = OW_SEQUENCE(off),
};
