/* SPDX-License-Identifier: 0BSD */
/* Models of panel controllers: codes and parameters, time, and complaints. */
#include "sim_controller.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    SETTLED_NOPS = 8,       /* so many in a row end what was torn */
    SLEEP_AFTER_US = 120000 /* from waking to sleep, and from sleep to waking */
};

void sim_complain(struct sim_controller *controller, const char *format, ...)
{
    if (controller->torn) {
        return;
    }
    if (controller->complaints++ == 0) {
        va_list arguments;
        va_start(arguments, format);
        (void)vsnprintf(controller->complaint, sizeof controller->complaint, format, arguments);
        va_end(arguments);
    }
}

static uint64_t now(const struct sim_controller *controller)
{
    uint64_t time_us = 0;
    if (controller->clock != NULL) {
        (void)controller->clock->ops->now(controller->clock->device, &time_us);
    }
    return time_us;
}

/* ---- what codes do ---- */

/* As after a reset; memory stays. */
static void reset_registers(struct sim_controller *controller)
{
    const struct sim_module *module = &controller->module;
    uint64_t time_us = now(controller);
    controller->command = NULL;
    controller->parameters = 0;
    controller->map[0] = 0;
    controller->map[1] = 0;
    controller->mode = 2;
    controller->flip_columns = false;
    controller->flip_rows = false;
    controller->inverted = false;
    controller->unlocked = false;
    controller->lines = (uint8_t)(module->ram_height - 1u);
    controller->awake = module->kind != SIM_DCS;
    controller->lit = false;
    controller->writing = false;
    controller->full = true;
    controller->unit_filled = 0;
    controller->ready_us = time_us + module->reset_ready_us;
    controller->wake_us = time_us + module->reset_wake_us;
    controller->sleep_us = 0;
    controller->torn = false;
}

static uint16_t address(const struct sim_controller *controller, uint32_t number)
{
    const uint8_t *parameter = controller->parameter + number * controller->module.window_bytes;
    return (uint16_t)(controller->module.window_bytes == 2 ? parameter[0] << 8 | parameter[1]
                                                           : parameter[0]);
}

/* How many addresses a window command can name. */
static uint32_t address_count(const struct sim_controller *controller, bool rows)
{
    const struct sim_module *module = &controller->module;
    bool swapped = module->kind == SIM_DCS && (controller->map[0] & 0x20) != 0;
    if (rows != swapped) {
        return module->kind == SIM_PAGES ? module->ram_height / 8u : module->ram_height;
    }
    return (uint32_t)module->ram_width / module->unit_pixels;
}

static void set_range(struct sim_controller *controller, uint16_t range[2], bool rows)
{
    uint16_t first = address(controller, 0);
    uint16_t last = address(controller, 1);
    if (first > last || last >= address_count(controller, rows)) {
        sim_complain(controller, "code %02X: window %u .. %u of 0 .. %u", controller->code, first,
                     last, (unsigned)(address_count(controller, rows) - 1));
        return;
    }
    range[0] = first;
    range[1] = last;
    *(rows ? &controller->row : &controller->column) = first;
    controller->unit_filled = 0;
    controller->full = false;
    if (controller->module.kind != SIM_DCS) {
        controller->writing = false; /* until the write code, where there is one */
    }
}

static bool has_write_code(const struct sim_controller *controller)
{
    return !controller->module.as_commands;
}

static void set_map(struct sim_controller *controller)
{
    const struct sim_module *module = &controller->module;
    uint8_t wrong = (controller->parameter[0] ^ module->upright) & module->fixed;
    if (wrong != 0) {
        sim_complain(controller, "code %02X: bits %02X of %02X do not fit this glass",
                     controller->code, wrong, controller->parameter[0]);
    }
    controller->map[0] = controller->parameter[0];
    controller->map[1] = controller->parameter[1];
}

static void set_awake(struct sim_controller *controller, bool awake)
{
    uint64_t time_us = now(controller);
    uint64_t from_us = awake ? controller->wake_us : controller->sleep_us;
    if (controller->clock != NULL && time_us < from_us) {
        sim_complain(controller, "code %02X: %llu us too early", controller->code,
                     (unsigned long long)(from_us - time_us));
    }
    controller->awake = awake;
    controller->ready_us = time_us + (awake ? controller->module.wake_ready_us : 5000);
    controller->sleep_us = time_us + SLEEP_AFTER_US;
    controller->wake_us = time_us + SLEEP_AFTER_US;
}

static void set_lit(struct sim_controller *controller)
{
    if (!controller->awake) {
        sim_complain(controller, "switched on while asleep");
    }
    if (!sim_memory_is_written(controller)) {
        sim_complain(controller, "switched on while memory holds noise");
    }
    if (controller->lines + 1u != controller->module.height && controller->module.kind != SIM_DCS) {
        sim_complain(controller, "switched on with %u lines driven of %u", controller->lines + 1u,
                     controller->module.height);
    }
    uint8_t pins = controller->module.height == 64 ? 0x12 : 0x02; /* alternating, or in turn */
    if (controller->module.kind == SIM_PAGES && controller->pins != pins) {
        sim_complain(controller, "switched on with pins %02X, this glass wants %02X",
                     controller->pins, pins);
    }
    controller->lit = true;
}

static void expect_parameter(struct sim_controller *controller, unsigned wanted)
{
    if (controller->parameter[0] != wanted) {
        sim_complain(controller, "code %02X: parameter %02X, this glass wants %02X",
                     controller->code, controller->parameter[0], wanted);
    }
}

/* Codes that stand for a state alone. */
static void set_state(struct sim_controller *controller)
{
    switch (controller->command->does) {
    case SIM_CODE_FLIP_COLUMNS:
        controller->flip_columns = controller->code & 1;
        break;
    case SIM_CODE_FLIP_ROWS:
        controller->flip_rows = (controller->code & 8) != 0;
        break;
    case SIM_CODE_NORMAL:
    case SIM_CODE_INVERTED:
        controller->inverted = controller->command->does == SIM_CODE_INVERTED;
        break;
    case SIM_CODE_RESET:
        reset_registers(controller);
        break;
    case SIM_CODE_WAKE:
    case SIM_CODE_SLEEP:
        set_awake(controller, controller->command->does == SIM_CODE_WAKE);
        break;
    case SIM_CODE_ON:
        set_lit(controller);
        break;
    case SIM_CODE_OFF:
        controller->lit = false;
        break;
    case SIM_CODE_WRITE:
        controller->writing = true;
        controller->windows++;
        if (controller->module.kind == SIM_DCS) {
            sim_memory_begin(controller);
        }
        break;
    default:
        break;
    }
}

/* All parameters are there. */
static void execute(struct sim_controller *controller)
{
    switch (controller->command->does) {
    case SIM_CODE_COLUMNS:
        set_range(controller, controller->columns, false);
        break;
    case SIM_CODE_ROWS:
        set_range(controller, controller->rows, true);
        break;
    case SIM_CODE_MAP:
        set_map(controller);
        break;
    case SIM_CODE_MODE:
        if (controller->parameter[0] > 1) {
            sim_complain(controller, "code 20: mode %02X has no window", controller->parameter[0]);
        }
        controller->mode = controller->parameter[0];
        break;
    case SIM_CODE_DEPTH:
        expect_parameter(controller, controller->module.depth);
        break;
    case SIM_CODE_PINS:
        controller->pins = controller->parameter[0];
        break;
    case SIM_CODE_LINES:
        controller->lines = controller->parameter[0];
        break;
    case SIM_CODE_LOCK:
        controller->unlocked = controller->parameter[0] != 0x16;
        break;
    default:
        set_state(controller);
        break;
    }
}

/* ---- bytes ---- */

static const struct sim_command *find(const struct sim_controller *controller, uint8_t code)
{
    for (uint32_t i = 0; i < controller->module.command_count; i++) {
        if (controller->module.commands[i].code == code) {
            return &controller->module.commands[i];
        }
    }
    return NULL;
}

static bool is_complete(const struct sim_controller *controller)
{
    return controller->command == NULL || controller->parameters >= controller->command->parameters;
}

static void finish_command(struct sim_controller *controller)
{
    if (!is_complete(controller)) {
        sim_complain(controller, "code %02X: %u parameters instead of %u", controller->code,
                     (unsigned)controller->parameters, controller->command->parameters);
    }
    if (controller->unit_filled != 0) {
        sim_complain(controller, "a pixel was cut in the middle by a command");
        controller->unit_filled = 0;
    }
}

static void check_time(struct sim_controller *controller, uint8_t code)
{
    uint64_t time_us = now(controller);
    if (controller->clock != NULL && time_us < controller->ready_us) {
        sim_complain(controller, "code %02X: %llu us before the controller is ready", code,
                     (unsigned long long)(controller->ready_us - time_us));
    }
}

/* Many NOPs in a row: what was torn has had its parameters. */
static void count_nops(struct sim_controller *controller, uint8_t code)
{
    const struct sim_command *command = find(controller, code);
    bool nop = command != NULL && command->does == SIM_CODE_NOP;
    controller->nops = nop ? controller->nops + 1 : 0;
    if (controller->nops == SETTLED_NOPS) {
        controller->torn = false;
        controller->command = NULL;
        controller->parameters = 0;
    }
}

static void begin_command(struct sim_controller *controller, uint8_t code)
{
    if (controller->torn && !controller->module.as_commands) { /* D/C says where one begins */
        controller->torn = false;
        controller->command = NULL;
        controller->unit_filled = 0;
    }
    finish_command(controller);
    check_time(controller, code);
    controller->command = find(controller, code);
    controller->code = code;
    controller->parameters = 0;
    if (controller->module.kind == SIM_DCS || !controller->module.as_commands) {
        controller->writing = false;
    }
    if (controller->command == NULL) {
        sim_complain(controller, "unknown code %02X", code);
        return;
    }
    if (controller->command->does != SIM_CODE_LOCK && !controller->unlocked &&
        find(controller, 0xFD) != NULL) {
        sim_complain(controller, "code %02X while commands are locked", code);
    }
    if (controller->command->parameters == 0) {
        execute(controller);
    }
}

static void take_parameter(struct sim_controller *controller, uint8_t byte)
{
    if (controller->parameters < sizeof controller->parameter) {
        controller->parameter[controller->parameters] = byte;
    }
    controller->parameters++;
    if (is_complete(controller)) {
        execute(controller);
    }
}

void sim_controller_byte(struct sim_controller *controller, bool data, uint8_t byte)
{
    controller->bytes[data]++;
    if (!data) {
        count_nops(controller, byte);
        if (controller->module.as_commands && !is_complete(controller)) {
            take_parameter(controller, byte);
        } else {
            begin_command(controller, byte);
        }
        return;
    }
    if (!is_complete(controller)) {
        if (controller->module.as_commands) {
            sim_complain(controller, "code %02X: a parameter came as data", controller->code);
            return;
        }
        take_parameter(controller, byte);
        return;
    }
    if (!has_write_code(controller)) {
        controller->windows += !controller->writing;
        controller->writing = true;
    }
    if (!controller->writing) {
        sim_complain(controller, "code %02X: data that it does not take", controller->code);
        return;
    }
    sim_memory_byte(controller, byte);
}

bool sim_controller_answer(struct sim_controller *controller, uint8_t code, uint8_t *answer)
{
    finish_command(controller);
    check_time(controller, code);
    controller->command = NULL;
    controller->writing = false;
    if (controller->module.kind != SIM_DCS || code != 0x0A) {
        return false;
    }
    /* The booster, awake, normal mode, lit. */
    *answer =
        (uint8_t)((controller->awake ? 0x80 | 0x10 : 0) | 0x08 | (controller->lit ? 0x04 : 0));
    return true;
}

void sim_controller_release(struct sim_controller *controller)
{
    if (controller->unit_filled != 0) {
        sim_complain(controller, "a pixel was cut in the middle by the end of a transfer");
    }
}

void sim_controller_tear(struct sim_controller *controller)
{
    controller->torn = true;
    controller->nops = 0;
}

void sim_controller_reset(struct sim_controller *controller, uint32_t held_us)
{
    controller->resets++;
    reset_registers(controller);
    if (held_us < controller->module.reset_hold_us) {
        sim_complain(controller, "RESET was low for %u us only", (unsigned)held_us);
    }
}

bool sim_controller_open(struct sim_controller *controller, const struct sim_module *module,
                         const struct ow_clock *clock)
{
    size_t cells = (size_t)module->ram_width * module->ram_height;
    *controller = (struct sim_controller){ .module = *module, .clock = clock };
    controller->ram = malloc(cells * sizeof *controller->ram);
    controller->written = calloc(cells, 1);
    if (controller->ram == NULL || controller->written == NULL) {
        sim_controller_close(controller);
        return false;
    }
    uint32_t noise = 12345;
    for (size_t i = 0; i < cells; i++) {
        noise = noise * 1664525u + 1013904223u;
        controller->ram[i] = (uint16_t)((noise >> 16) & ((1u << module->bits) - 1));
    }
    reset_registers(controller);
    return true;
}

void sim_controller_close(struct sim_controller *controller)
{
    free(controller->ram);
    free(controller->written);
    controller->ram = NULL;
    controller->written = NULL;
}
