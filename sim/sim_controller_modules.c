/* SPDX-License-Identifier: 0BSD */
/* Models of panel controllers: the commands that each data sheet lists, and the usual glass. */
#include "sim_controller.h"

#include <string.h>

static const struct sim_command ili9341[] = {
    { 0x00, 0, SIM_CODE_NOP },      { 0x01, 0, SIM_CODE_RESET },   { 0x10, 0, SIM_CODE_SLEEP },
    { 0x11, 0, SIM_CODE_WAKE },     { 0x13, 0, SIM_CODE_OTHER },   { 0x20, 0, SIM_CODE_NORMAL },
    { 0x21, 0, SIM_CODE_INVERTED }, { 0x26, 1, SIM_CODE_OTHER },   { 0x28, 0, SIM_CODE_OFF },
    { 0x29, 0, SIM_CODE_ON },       { 0x2A, 4, SIM_CODE_COLUMNS }, { 0x2B, 4, SIM_CODE_ROWS },
    { 0x2C, 0, SIM_CODE_WRITE },    { 0x36, 1, SIM_CODE_MAP },     { 0x38, 0, SIM_CODE_OTHER },
    { 0x3A, 1, SIM_CODE_DEPTH },    { 0x51, 1, SIM_CODE_OTHER },   { 0x53, 1, SIM_CODE_OTHER },
    { 0xB0, 1, SIM_CODE_OTHER },    { 0xB1, 2, SIM_CODE_OTHER },   { 0xB4, 1, SIM_CODE_OTHER },
    { 0xB6, 3, SIM_CODE_OTHER },    { 0xB7, 1, SIM_CODE_OTHER },   { 0xC0, 1, SIM_CODE_OTHER },
    { 0xC1, 1, SIM_CODE_OTHER },    { 0xC5, 2, SIM_CODE_OTHER },   { 0xC7, 1, SIM_CODE_OTHER },
    { 0xE0, 15, SIM_CODE_OTHER },   { 0xE1, 15, SIM_CODE_OTHER },  { 0xF6, 3, SIM_CODE_OTHER },
};

static const struct sim_command st7789[] = {
    { 0x00, 0, SIM_CODE_NOP },      { 0x01, 0, SIM_CODE_RESET },   { 0x10, 0, SIM_CODE_SLEEP },
    { 0x11, 0, SIM_CODE_WAKE },     { 0x13, 0, SIM_CODE_OTHER },   { 0x20, 0, SIM_CODE_NORMAL },
    { 0x21, 0, SIM_CODE_INVERTED }, { 0x26, 1, SIM_CODE_OTHER },   { 0x28, 0, SIM_CODE_OFF },
    { 0x29, 0, SIM_CODE_ON },       { 0x2A, 4, SIM_CODE_COLUMNS }, { 0x2B, 4, SIM_CODE_ROWS },
    { 0x2C, 0, SIM_CODE_WRITE },    { 0x36, 1, SIM_CODE_MAP },     { 0x38, 0, SIM_CODE_OTHER },
    { 0x3A, 1, SIM_CODE_DEPTH },    { 0x51, 1, SIM_CODE_OTHER },   { 0xB0, 2, SIM_CODE_OTHER },
    { 0xB2, 5, SIM_CODE_OTHER },    { 0xB7, 1, SIM_CODE_OTHER },   { 0xBB, 1, SIM_CODE_OTHER },
    { 0xC0, 1, SIM_CODE_OTHER },    { 0xC2, 1, SIM_CODE_OTHER },   { 0xC3, 1, SIM_CODE_OTHER },
    { 0xC4, 1, SIM_CODE_OTHER },    { 0xC6, 1, SIM_CODE_OTHER },   { 0xD0, 2, SIM_CODE_OTHER },
    { 0xE0, 14, SIM_CODE_OTHER },   { 0xE1, 14, SIM_CODE_OTHER },
};

static const struct sim_command st7735[] = {
    { 0x00, 0, SIM_CODE_NOP },      { 0x01, 0, SIM_CODE_RESET },   { 0x10, 0, SIM_CODE_SLEEP },
    { 0x11, 0, SIM_CODE_WAKE },     { 0x13, 0, SIM_CODE_OTHER },   { 0x20, 0, SIM_CODE_NORMAL },
    { 0x21, 0, SIM_CODE_INVERTED }, { 0x26, 1, SIM_CODE_OTHER },   { 0x28, 0, SIM_CODE_OFF },
    { 0x29, 0, SIM_CODE_ON },       { 0x2A, 4, SIM_CODE_COLUMNS }, { 0x2B, 4, SIM_CODE_ROWS },
    { 0x2C, 0, SIM_CODE_WRITE },    { 0x36, 1, SIM_CODE_MAP },     { 0x3A, 1, SIM_CODE_DEPTH },
    { 0xB1, 3, SIM_CODE_OTHER },    { 0xB2, 3, SIM_CODE_OTHER },   { 0xB3, 6, SIM_CODE_OTHER },
    { 0xB4, 1, SIM_CODE_OTHER },    { 0xC0, 3, SIM_CODE_OTHER },   { 0xC1, 1, SIM_CODE_OTHER },
    { 0xC2, 2, SIM_CODE_OTHER },    { 0xC3, 2, SIM_CODE_OTHER },   { 0xC4, 2, SIM_CODE_OTHER },
    { 0xC5, 1, SIM_CODE_OTHER },    { 0xE0, 16, SIM_CODE_OTHER },  { 0xE1, 16, SIM_CODE_OTHER },
};

static const struct sim_command ssd1351[] = {
    { 0x15, 2, SIM_CODE_COLUMNS }, { 0x75, 2, SIM_CODE_ROWS },     { 0x5C, 0, SIM_CODE_WRITE },
    { 0xA0, 1, SIM_CODE_MAP },     { 0xA1, 1, SIM_CODE_OTHER },    { 0xA2, 1, SIM_CODE_OTHER },
    { 0xA6, 0, SIM_CODE_NORMAL },  { 0xA7, 0, SIM_CODE_INVERTED }, { 0xAB, 1, SIM_CODE_OTHER },
    { 0xAD, 0, SIM_CODE_NOP },     { 0xAE, 0, SIM_CODE_OFF },      { 0xAF, 0, SIM_CODE_ON },
    { 0xB1, 1, SIM_CODE_OTHER },   { 0xB3, 1, SIM_CODE_OTHER },    { 0xB4, 3, SIM_CODE_OTHER },
    { 0xB5, 1, SIM_CODE_OTHER },   { 0xB6, 1, SIM_CODE_OTHER },    { 0xB8, 63, SIM_CODE_OTHER },
    { 0xB9, 0, SIM_CODE_OTHER },   { 0xBB, 1, SIM_CODE_OTHER },    { 0xBE, 1, SIM_CODE_OTHER },
    { 0xC1, 3, SIM_CODE_OTHER },   { 0xC7, 1, SIM_CODE_OTHER },    { 0xCA, 1, SIM_CODE_LINES },
    { 0xE3, 0, SIM_CODE_NOP },     { 0xFD, 1, SIM_CODE_LOCK },
};

static const struct sim_command ssd1322[] = {
    { 0x15, 2, SIM_CODE_COLUMNS }, { 0x75, 2, SIM_CODE_ROWS },     { 0x5C, 0, SIM_CODE_WRITE },
    { 0xA0, 2, SIM_CODE_MAP },     { 0xA1, 1, SIM_CODE_OTHER },    { 0xA2, 1, SIM_CODE_OTHER },
    { 0xA6, 0, SIM_CODE_NORMAL },  { 0xA7, 0, SIM_CODE_INVERTED }, { 0xA9, 0, SIM_CODE_OTHER },
    { 0xAB, 1, SIM_CODE_OTHER },   { 0xAE, 0, SIM_CODE_OFF },      { 0xAF, 0, SIM_CODE_ON },
    { 0xB1, 1, SIM_CODE_OTHER },   { 0xB3, 1, SIM_CODE_OTHER },    { 0xB4, 2, SIM_CODE_OTHER },
    { 0xB5, 1, SIM_CODE_OTHER },   { 0xB6, 1, SIM_CODE_OTHER },    { 0xB8, 15, SIM_CODE_OTHER },
    { 0xB9, 0, SIM_CODE_OTHER },   { 0xBB, 1, SIM_CODE_OTHER },    { 0xBE, 1, SIM_CODE_OTHER },
    { 0xC1, 1, SIM_CODE_OTHER },   { 0xC7, 1, SIM_CODE_OTHER },    { 0xCA, 1, SIM_CODE_LINES },
    { 0xD1, 2, SIM_CODE_OTHER },   { 0xFD, 1, SIM_CODE_LOCK },
};

static const struct sim_command ssd1329[] = {
    { 0x15, 2, SIM_CODE_COLUMNS }, { 0x75, 2, SIM_CODE_ROWS },     { 0x81, 1, SIM_CODE_OTHER },
    { 0x84, 0, SIM_CODE_OTHER },   { 0x85, 0, SIM_CODE_OTHER },    { 0x86, 0, SIM_CODE_OTHER },
    { 0xA0, 1, SIM_CODE_MAP },     { 0xA1, 1, SIM_CODE_OTHER },    { 0xA2, 1, SIM_CODE_OTHER },
    { 0xA4, 0, SIM_CODE_NORMAL },  { 0xA7, 0, SIM_CODE_INVERTED }, { 0xA8, 1, SIM_CODE_LINES },
    { 0xAD, 1, SIM_CODE_OTHER },   { 0xAE, 0, SIM_CODE_OFF },      { 0xAF, 0, SIM_CODE_ON },
    { 0xB0, 1, SIM_CODE_OTHER },   { 0xB1, 1, SIM_CODE_OTHER },    { 0xB2, 1, SIM_CODE_OTHER },
    { 0xB3, 1, SIM_CODE_OTHER },   { 0xB4, 1, SIM_CODE_OTHER },    { 0xB7, 0, SIM_CODE_OTHER },
    { 0xB8, 15, SIM_CODE_OTHER },  { 0xBC, 1, SIM_CODE_OTHER },    { 0xBE, 1, SIM_CODE_OTHER },
    { 0xBF, 1, SIM_CODE_OTHER },   { 0xE3, 0, SIM_CODE_NOP },
};

static const struct sim_command ssd0323[] = {
    { 0x15, 2, SIM_CODE_COLUMNS }, { 0x75, 2, SIM_CODE_ROWS },     { 0x81, 1, SIM_CODE_OTHER },
    { 0x84, 0, SIM_CODE_OTHER },   { 0x85, 0, SIM_CODE_OTHER },    { 0x86, 0, SIM_CODE_OTHER },
    { 0xA0, 1, SIM_CODE_MAP },     { 0xA1, 1, SIM_CODE_OTHER },    { 0xA2, 1, SIM_CODE_OTHER },
    { 0xA4, 0, SIM_CODE_NORMAL },  { 0xA7, 0, SIM_CODE_INVERTED }, { 0xA8, 1, SIM_CODE_LINES },
    { 0xAD, 1, SIM_CODE_OTHER },   { 0xAE, 0, SIM_CODE_OFF },      { 0xAF, 0, SIM_CODE_ON },
    { 0xB1, 1, SIM_CODE_OTHER },   { 0xB2, 1, SIM_CODE_OTHER },    { 0xB3, 1, SIM_CODE_OTHER },
    { 0xB4, 1, SIM_CODE_OTHER },   { 0xB8, 8, SIM_CODE_OTHER },    { 0xBC, 1, SIM_CODE_OTHER },
    { 0xBE, 1, SIM_CODE_OTHER },   { 0xBF, 1, SIM_CODE_OTHER },    { 0xE3, 0, SIM_CODE_NOP },
};

static const struct sim_command ssd1306[] = {
    { 0x20, 1, SIM_CODE_MODE },         { 0x21, 2, SIM_CODE_COLUMNS },
    { 0x22, 2, SIM_CODE_ROWS },         { 0x2E, 0, SIM_CODE_OTHER },
    { 0x40, 0, SIM_CODE_OTHER },        { 0x81, 1, SIM_CODE_OTHER },
    { 0x8D, 1, SIM_CODE_OTHER },        { 0xA0, 0, SIM_CODE_FLIP_COLUMNS },
    { 0xA1, 0, SIM_CODE_FLIP_COLUMNS }, { 0xA4, 0, SIM_CODE_OTHER },
    { 0xA6, 0, SIM_CODE_NORMAL },       { 0xA7, 0, SIM_CODE_INVERTED },
    { 0xA8, 1, SIM_CODE_LINES },        { 0xAE, 0, SIM_CODE_OFF },
    { 0xAF, 0, SIM_CODE_ON },           { 0xC0, 0, SIM_CODE_FLIP_ROWS },
    { 0xC8, 0, SIM_CODE_FLIP_ROWS },    { 0xD3, 1, SIM_CODE_OTHER },
    { 0xD5, 1, SIM_CODE_OTHER },        { 0xD9, 1, SIM_CODE_OTHER },
    { 0xDA, 1, SIM_CODE_PINS },         { 0xDB, 1, SIM_CODE_OTHER },
    { 0xE3, 0, SIM_CODE_NOP },
};

#define COMMANDS(table) .commands = (table), .command_count = sizeof(table) / sizeof(table)[0]
#define DCS                                                                            \
    .kind = SIM_DCS, .bits = 16, .unit_pixels = 1, .unit_bytes = 2, .window_bytes = 2, \
    .reset_hold_us = 10, .reset_ready_us = 5000, .reset_wake_us = 120000
#define SSD .kind = SIM_SSD, .window_bytes = 1, .reset_hold_us = 3, .reset_ready_us = 3

static const struct sim_module modules[] = {
    { .name = "ili9341",
      DCS,
      COMMANDS(ili9341),
      .ram_width = 240,
      .ram_height = 320,
      .width = 240,
      .height = 320,
      .upright = 0x48,
      .fixed = 0x17,
      .depth = 0x55,
      .wake_ready_us = 5000 },
    { .name = "st7789",
      DCS,
      COMMANDS(st7789),
      .ram_width = 240,
      .ram_height = 320,
      .width = 240,
      .height = 320,
      .upright = 0x00,
      .fixed = 0x17,
      .depth = 0x55,
      .inverted = true,
      .wake_ready_us = 5000 },
    { .name = "st7735",
      DCS,
      COMMANDS(st7735),
      .ram_width = 132,
      .ram_height = 162,
      .width = 128,
      .height = 160,
      .offset_x = 2,
      .offset_y = 1,
      .upright = 0xC0,
      .fixed = 0x17,
      .depth = 0x05,
      .wake_ready_us = 120000 },
    { .name = "ssd1351",
      SSD,
      COMMANDS(ssd1351),
      .bits = 16,
      .unit_pixels = 1,
      .unit_bytes = 2,
      .ram_width = 128,
      .ram_height = 128,
      .width = 128,
      .height = 128,
      .upright = 0x74,
      .fixed = 0xE8 },
    { .name = "ssd1322",
      .kind = SIM_SSD,
      COMMANDS(ssd1322),
      .window_bytes = 1,
      .reset_hold_us = 100,
      .reset_ready_us = 100,
      .bits = 4,
      .unit_pixels = 4,
      .unit_bytes = 2,
      .ram_width = 480,
      .ram_height = 128,
      .width = 256,
      .height = 64,
      .offset_x = 112,
      .upright = 0x14,
      .fixed = 0xE8 },
    { .name = "ssd1329",
      SSD,
      COMMANDS(ssd1329),
      .as_commands = true,
      .bits = 4,
      .unit_pixels = 2,
      .unit_bytes = 1,
      .ram_width = 128,
      .ram_height = 128,
      .width = 128,
      .height = 128,
      .upright = 0x52,
      .fixed = 0xE8 },
    { .name = "ssd0323",
      SSD,
      COMMANDS(ssd0323),
      .as_commands = true,
      .bits = 4,
      .unit_pixels = 2,
      .unit_bytes = 1,
      .ram_width = 128,
      .ram_height = 80,
      .width = 128,
      .height = 64,
      .upright = 0x52,
      .fixed = 0xE8 },
    { .name = "ssd1306",
      .kind = SIM_PAGES,
      COMMANDS(ssd1306),
      .as_commands = true,
      .window_bytes = 1,
      .reset_hold_us = 3,
      .reset_ready_us = 3,
      .bits = 1,
      .unit_pixels = 1,
      .unit_bytes = 1,
      .ram_width = 128,
      .ram_height = 64,
      .width = 128,
      .height = 64 },
};

const struct sim_module *sim_module_by_name(const char *name)
{
    for (size_t i = 0; i < sizeof modules / sizeof modules[0]; i++) {
        if (strcmp(modules[i].name, name) == 0) {
            return &modules[i];
        }
    }
    return NULL;
}
