/* SPDX-License-Identifier: 0BSD */
/*
 * SSD1306: 128x64 OLED, one bit a pixel in pages of 8 lines, over SPI or I2C.
 * Glass of 128x32 needs 0xDA, 1, 0x02 as extra commands; of 72x40 offset_x 28.
 */
#include "hal/panel/controller.h"

static const uint8_t init[] = {
    0xAE, 0,       /* dark */
    0xD5, 1, 0x80, /* clock */
    0xD3, 1, 0x00, /* no offset between lines and rows */
    0x40, 0,       /* the first line shows row 0 */
    0x8D, 1, 0x14, /* charge pump on */
    0xDA, 1, 0x12, /* lines alternate between both sides */
    0x81, 1, 0xCF, /* contrast */
    0xD9, 1, 0xF1, /* phases */
    0xDB, 1, 0x40, /* VCOMH */
    0xA4, 0,       /* show the memory */
    0x2E, 0,       /* no scrolling */
};
static const uint8_t on[] = { 0xAF, 0 };
static const uint8_t off[] = { 0xAE, 0 };

const struct ow_controller ow_controller_ssd1306 = {
    .name = "ssd1306",
    .format = &ow_format_mono,
    .width = 128,
    .height = 64,
    .ram_width = 128,
    .ram_height = 64,
    .write_hz = 10000000,
    .column_code = 0x21,
    .row_code = 0x22,
    .address_bytes = 1,
    .column_pixels = 1,
    .row_lines = 8,
    .as_commands = true,
    .map = { { .code = 0xA1, .flip_columns = 0x01 },
             { .code = 0xC8, .flip_rows = 0x08 },
             { .code = 0x20, .count = 1, .usual = 0x00, .swap = 0x01 } },
    .flip_in_lines = true,
    .lines_code = 0xA8,
    .normal_code = 0xA6,
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
