/* SPDX-License-Identifier: 0BSD */
/*
 * SSD1322: OLED, 16 greys. 480x128 of memory, addressed by 4 pixels; the usual
 * glass is 256x64 in the middle of its columns.
 */
#include "hal/panel/controller.h"

static const uint8_t init[] = {
    0xFD, 1, 0x12,       /* commands are unlocked */
    0xAE, 0,             /* dark */
    0xB3, 1, 0x91,       /* clock: 80 frames a second */
    0xA2, 1, 0x00,       /* no offset between lines and rows */
    0xA1, 1, 0x00,       /* the first line shows row 0 */
    0xB5, 1, 0x00,       /* GPIO off */
    0xAB, 1, 0x01,       /* internal regulator */
    0xB4, 2, 0xA0, 0xFD, /* external VSL, enhanced low greys */
    0xC1, 1, 0x9F,       /* contrast */
    0xC7, 1, 0x0F,       /* and its scale */
    0xB9, 0,             /* greys in equal steps */
    0xB1, 1, 0xE2,       /* phases */
    0xD1, 2, 0x82, 0x20, /* reserved, as the data sheet wants it */
    0xBB, 1, 0x1F,       /* pre-charge voltage */
    0xB6, 1, 0x08,       /* second pre-charge */
    0xBE, 1, 0x07,       /* VCOMH */
    0xA9, 0,             /* not partial */
};
static const uint8_t on[] = { 0xAF, 0 };
static const uint8_t off[] = { 0xAE, 0 };

const struct ow_controller ow_controller_ssd1322 = {
    .name = "ssd1322",
    .format = &ow_format_gray4,
    .width = 256,
    .height = 64,
    .ram_width = 480,
    .ram_height = 128,
    .offset_x = 112,
    .write_hz = 10000000,
    .column_code = 0x15,
    .row_code = 0x75,
    .write_code = 0x5C,
    .address_bytes = 1,
    .column_pixels = 4,
    .row_lines = 1,
    .map = { { .code = 0xA0,
               .count = 2,
               .usual = 0x14, /* the left pixel in the high half */
               .second = 0x11,
               .flip_columns = 0x02,
               .flip_rows = 0x10 } },
    .flip_in_lines = true,
    .lines_code = 0xCA,
    .normal_code = 0xA6,
    .inverted_code = 0xA7,
    .light_code = 0xC1,
    .light_max = 255,
    .nop_code = 0xA9, /* "not partial" changes nothing: there is no other */
    .reset_hold_us = 200,
    .reset_settle_us = 1000,
    .init = OW_SEQUENCE(init),
    .on = OW_SEQUENCE(on),
    .off = OW_SEQUENCE(off),
};
