/* SPDX-License-Identifier: 0BSD */
/*
 * Models of panel controllers: they take the bytes of the bus, each with its
 * D/C level, keep what the controller's memory would hold, say what the glass
 * shows, and complain about whatever a data sheet forbids: unknown codes, wrong
 * numbers of parameters, commands before a wait is over, windows outside the
 * memory, more pixels than the window holds, noise on a panel that is lit.
 *
 * They know nothing of the drivers: their tables are their own.
 */
#ifndef OLDWELL_SIM_CONTROLLER_H
#define OLDWELL_SIM_CONTROLLER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "hal/clock.h"

enum sim_controller_kind { SIM_DCS, SIM_SSD, SIM_PAGES };

/* What a code does. */
enum sim_code {
    SIM_CODE_OTHER, /* settings that the picture does not show */
    SIM_CODE_NOP,
    SIM_CODE_COLUMNS,
    SIM_CODE_ROWS,
    SIM_CODE_WRITE,
    SIM_CODE_MAP,
    SIM_CODE_MODE,         /* SSD1306: horizontal or vertical */
    SIM_CODE_FLIP_COLUMNS, /* SSD1306: in the code's lowest bit, */
    SIM_CODE_FLIP_ROWS,    /* and in bit 3 */
    SIM_CODE_DEPTH,
    SIM_CODE_LINES,
    SIM_CODE_PINS, /* SSD1306: how lines are wired */
    SIM_CODE_NORMAL,
    SIM_CODE_INVERTED,
    SIM_CODE_LOCK,
    SIM_CODE_RESET,
    SIM_CODE_WAKE,
    SIM_CODE_SLEEP,
    SIM_CODE_ON,
    SIM_CODE_OFF
};

struct sim_command {
    uint8_t code;
    uint8_t parameters;
    uint8_t does; /* enum sim_code */
};

/* A module: the controller and the glass that hangs on it. */
struct sim_module {
    const char *name;
    enum sim_controller_kind kind;
    const struct sim_command *commands;
    uint8_t command_count;
    bool as_commands;     /* parameters come with D/C low */
    uint8_t bits;         /* of a pixel */
    uint8_t unit_pixels;  /* at one column address, */
    uint8_t unit_bytes;   /* in so many bytes */
    uint8_t window_bytes; /* of each address in a window command */
    uint16_t ram_width;
    uint16_t ram_height;
    uint16_t width; /* the glass */
    uint16_t height;
    uint16_t offset_x; /* where it begins in memory as it is upright */
    uint16_t offset_y;
    uint8_t upright; /* the map's first parameter that shows addresses upright; fixed bits too */
    uint8_t fixed;   /* bits of it that must be as in upright, or the glass shows a mess */
    uint8_t depth;   /* parameter of SIM_CODE_DEPTH for 16 bits */
    bool inverted;   /* the glass needs inversion to look right */
    bool little;     /* pixels come low byte first */
    uint32_t reset_hold_us;  /* at least, */
    uint32_t reset_ready_us; /* then no command before, */
    uint32_t reset_wake_us;  /* nor this one */
    uint32_t wake_ready_us;
};

/* The usual modules by their controllers' names; NULL: none of that name. */
const struct sim_module *sim_module_by_name(const char *name);

struct sim_controller {
    struct sim_module module;
    const struct ow_clock *clock; /* NULL: time is not looked at */

    /* To be read. */
    uint32_t complaints;
    char complaint[160]; /* the first */
    uint32_t resets;     /* by the line */
    uint32_t windows;    /* pixels begun to be written */
    uint64_t bytes[2];   /* by D/C level */
    bool awake;
    bool lit;

    /* The command under way. */
    const struct sim_command *command;
    uint8_t code;
    uint8_t parameter[32];
    uint32_t parameters;
    uint32_t nops;
    bool torn; /* a transfer broke off: nothing is complained of until a reset or many NOPs */

    /* Registers. */
    uint8_t map[2];
    uint8_t mode;
    bool flip_columns;
    bool flip_rows;
    bool inverted;
    bool unlocked;
    uint8_t lines;
    uint8_t pins;
    uint64_t ready_us;
    uint64_t wake_us;
    uint64_t sleep_us;

    /* The window and the memory. */
    uint16_t columns[2];
    uint16_t rows[2];
    uint16_t column;
    uint16_t row;
    bool writing;
    bool full;
    uint8_t unit[2];
    uint32_t unit_filled;
    uint16_t *ram;    /* values as they came, by physical column and row */
    uint8_t *written; /* since power came */
};

/* As after power-on: memory is noise. The module is copied. False: out of memory. */
bool sim_controller_open(struct sim_controller *controller, const struct sim_module *module,
                         const struct ow_clock *clock);
void sim_controller_close(struct sim_controller *controller);

/* A byte; data: D/C is high. */
void sim_controller_byte(struct sim_controller *controller, bool data, uint8_t byte);

/* RESET was low for so long. */
void sim_controller_reset(struct sim_controller *controller, uint32_t held_us);

/* A transfer ended: chip select was released. */
void sim_controller_release(struct sim_controller *controller);

/* A transfer broke off somewhere. */
void sim_controller_tear(struct sim_controller *controller);

/* What the glass shows at its x, y, as the module's bits mean it; -1: dark. */
int32_t sim_controller_glass(const struct sim_controller *controller, uint32_t x, uint32_t y);

/* What a controller that can be read answers to a code; false: nothing, it keeps its line high. */
bool sim_controller_answer(struct sim_controller *controller, uint8_t code, uint8_t *answer);

/* For the parts of the model. */
void sim_complain(struct sim_controller *controller, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void sim_memory_begin(struct sim_controller *controller);
void sim_memory_byte(struct sim_controller *controller, uint8_t byte);
bool sim_memory_is_written(const struct sim_controller *controller);

#endif
