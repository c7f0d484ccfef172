/* SPDX-License-Identifier: 0BSD */
/* SSD1351: 128x128 OLED, 16-bit colour. */
#include "hal/panel/controller.h"

static const uint8_t init[] = {
    0xFD, 1, 0x12,             /* commands are unlocked, */
    0xFD, 1, 0xB1,             /* all of them */
    0xAE, 0,                   /* dark */
    0xB3, 1, 0xF1,             /* clock */
    0xA2, 1, 0x00,             /* no offset between lines and rows */
    0xA1, 1, 0x00,             /* the first line shows row 0 */
    0xB5, 1, 0x00,             /* GPIO off */
    0xAB, 1, 0x01,             /* internal regulator */
    0xB1, 1, 0x32,             /* phases */
    0xB4, 3, 0xA0, 0xB5, 0x55, /* segments' low voltage */
    0xB6, 1, 0x01,             /* second pre-charge */
    0xBE, 1, 0x05,             /* VCOMH */
    0xC1, 3, 0xC8, 0x80, 0xC8, /* contrast of the colours */
    0xC7, 1, 0x0F,             /* and of all */
};
static const uint8_t on[] = { 0xAF, 0 };
static const uint8_t off[] = { 0xAE, 0 };

const struct ow_controller ow_controller_ssd1351 = {
    .name = "ssd1351",
    .format = &ow_format_rgb565_be,
    .width = 128,
    .height = 128,
    .ram_width = 128,
    .ram_height = 128,
    .write_hz = 20000000,
    .column_code = 0x15,
    .row_code = 0x75,
    .write_code = 0x5C,
    .address_bytes = 1,
    .column_pixels = 1,
    .row_lines = 1,
    .map = { { .code = 0xA0,
               .count = 1,
               .usual = 0x74,
               .flip_columns = 0x02,
               .flip_rows = 0x10,
               .swap = 0x01,
               .bgr = 0x04 } },
    .flip_in_lines = true,
    .lines_code = 0xCA,
    .normal_code = 0xA6,
    .inverted_code = 0xA7,
    .light_code = 0xC7,
    .light_max = 15,
    .nop_code = 0xE3,
    .reset_hold_us = 20,
    .reset_settle_us = 1000,
    .init = OW_SEQUENCE(init),
    .on = OW_SEQUENCE(on),
    .off = OW_SEQUENCE(off),
};
