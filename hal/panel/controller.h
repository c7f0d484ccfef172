/* SPDX-License-Identifier: 0BSD */
/*
 * Controllers of panels, as constant data: what hal/panel/command_panel.c needs
 * to know to drive one. A controller is one file and a line in controllers.c.
 * Codes and figures are those of the makers' data sheets.
 */
#ifndef OW_HAL_PANEL_CONTROLLER_H
#define OW_HAL_PANEL_CONTROLLER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "ow_pixel.h"

/*
 * Commands one after the other, each: code, number of parameters (0 .. 127),
 * the parameters. OW_THEN_WAIT added to the number: a byte follows them, the
 * milliseconds to wait then.
 */
enum { OW_THEN_WAIT = 0x80 };

struct ow_sequence {
    const uint8_t *bytes;
    uint16_t count;
};

#define OW_SEQUENCE(array)     \
    {                          \
        (array), sizeof(array) \
    }

/*
 * A command that says how memory lies on the glass. The masks are toggled in
 * its first parameter, or in the code itself where it has none.
 */
struct ow_map_command {
    uint8_t code;
    uint8_t count; /* of parameters, 0 .. 2 */
    uint8_t usual; /* the first parameter as the usual module wants it upright */
    uint8_t second;
    uint8_t flip_columns;
    uint8_t flip_rows;
    uint8_t swap; /* pixels go down first, then along; 0: it cannot */
    uint8_t bgr;  /* red and blue change places */
};

enum { OW_MAP_COMMANDS = 3 };

struct ow_controller {
    const char *name;
    const struct ow_pixel_format *format; /* the usual one on the wire */
    uint16_t width;                       /* the usual glass, pixels */
    uint16_t height;
    uint16_t ram_width; /* its memory, pixels */
    uint16_t ram_height;
    uint16_t offset_x; /* where in memory the usual glass begins, pixels */
    uint16_t offset_y;
    uint32_t write_hz; /* fastest clock for writing in the data sheet */

    /* The window: two commands of first and last address, then the pixels. */
    uint8_t column_code;
    uint8_t row_code;
    uint8_t write_code;    /* 0: pixels follow at once */
    uint8_t address_bytes; /* 1, or 2 with the high byte first */
    uint8_t column_pixels; /* that one column address holds */
    uint8_t row_lines;     /* that one row address holds: 8 for pages, whose top is bit 0 */
    bool as_commands;      /* parameters go with D/C as their code's */
    bool codes_turn;       /* swapped, the column command addresses rows, and the row command... */
    bool write_restarts;   /* the write code goes back to the window's start: a window may stay */

    struct ow_map_command map[OW_MAP_COMMANDS]; /* those with code 0 are not sent */
    bool flip_in_lines;    /* rows are flipped within those driven, not within all memory */
    uint8_t lines_code;    /* takes the number of lines less one; 0: none */
    uint8_t normal_code;   /* colours as they are; 0: none */
    uint8_t inverted_code; /* or inverted */
    bool inverted;         /* the usual module needs inverted_code to look right */
    uint8_t light_code;    /* brightness; 0: none */
    uint8_t light_max;     /* its highest value */
    uint8_t status_code;   /* answers with a byte of these bits; 0: cannot be read */
    uint8_t status_awake;
    uint8_t status_lit;
    uint8_t reset_code;     /* reset by command; 0: none */
    uint8_t nop_code;       /* no operation */
    uint8_t reset_wait_ms;  /* after reset_code */
    uint32_t reset_hold_us; /* of the RESET line */
    uint32_t reset_settle_us;

    struct ow_sequence init; /* from reset to awake and dark */
    struct ow_sequence on;
    struct ow_sequence off;  /* dark, with as little power as can be */
    struct ow_sequence wake; /* from off to awake and dark */
};

extern const struct ow_controller ow_controller_ili9341;
extern const struct ow_controller ow_controller_ssd0323;
extern const struct ow_controller ow_controller_ssd1306;
extern const struct ow_controller ow_controller_ssd1322;
extern const struct ow_controller ow_controller_ssd1329;
extern const struct ow_controller ow_controller_ssd1351;
extern const struct ow_controller ow_controller_st7735;
extern const struct ow_controller ow_controller_st7789;

/* All of them, and the one of this name or NULL. A program that uses these contains all. */
extern const struct ow_controller *const ow_controllers[];
extern const uint32_t ow_controller_count;
const struct ow_controller *ow_controller_by_name(const char *name);

#endif
