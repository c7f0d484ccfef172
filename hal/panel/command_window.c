/* SPDX-License-Identifier: 0BSD */
/*
 * Command panel: where a rectangle of the picture lies in the controller's
 * memory. Turned by r quarters, the picture's pixel (x, y) lies on the glass at
 * r = 0: (x, y); 1: (w-1-y, x); 2: (w-1-x, h-1-y); 3: (y, h-1-x). The controller
 * flips its columns and rows and swaps them so that addresses rise with x and y.
 */
#include "command_stages.h"

enum {
    FLIP_COLUMNS_AT = 1u << 1 | 1u << 2,
    FLIP_ROWS_AT = 1u << 2 | 1u << 3
}; /* a bit for each r */

void command_turn(struct ow_command_panel *device)
{
    uint32_t r = device->rotation;
    device->swap = r & 1;
    device->flip_columns = FLIP_COLUMNS_AT >> r & 1;
    device->flip_rows = FLIP_ROWS_AT >> r & 1;
    device->window_known = false;
}

int command_can_turn(const struct ow_command_panel_config *config, uint32_t rotation)
{
    const struct ow_map_command *map = config->controller->map;
    if (rotation == 0) {
        return OW_OK;
    }
    bool swaps = false;
    bool flips = false;
    for (uint32_t i = 0; i < OW_MAP_COMMANDS; i++) {
        swaps = swaps || map[i].swap != 0;
        flips = flips || map[i].flip_columns != 0;
    }
    return !config->still && flips && (swaps || (rotation & 1) == 0) ? OW_OK : OW_UNSUPPORTED;
}

int command_send_map(struct ow_command_panel *device)
{
    const struct ow_command_panel_config *config = &device->config;
    bool columns = device->flip_columns != config->mirror_x;
    bool rows = device->flip_rows != config->mirror_y;
    int status = OW_OK;
    for (uint32_t i = 0; i < OW_MAP_COMMANDS && status >= 0; i++) {
        const struct ow_map_command *map = &config->controller->map[i];
        uint32_t toggled = (columns ? map->flip_columns : 0u) ^ (rows ? map->flip_rows : 0u) ^
                           (device->swap ? map->swap : 0u) ^ (config->bgr ? map->bgr : 0u);
        uint8_t parameters[2] = { (uint8_t)(map->usual ^ toggled), map->second };
        uint8_t code = (uint8_t)(map->count == 0 ? map->code ^ toggled : map->code);
        if (map->code != 0) {
            status = command_send(device, code, parameters, map->count);
        }
    }
    return status;
}

/* Addresses of pixels first .. first+count-1 along the glass's columns or rows. */
static void addresses(uint16_t range[2], uint32_t first, uint32_t count, uint32_t unit)
{
    range[0] = (uint16_t)(first / unit);
    range[1] = (uint16_t)((first + count - 1) / unit);
}

static int send_range(struct ow_command_panel *device, uint8_t code, const uint16_t range[2])
{
    const struct ow_controller *controller = device->config.controller;
    uint8_t bytes[4];
    uint32_t count = 0;
    for (uint32_t i = 0; i < 2; i++) {
        if (controller->address_bytes == 2) {
            bytes[count++] = (uint8_t)(range[i] >> 8);
        }
        bytes[count++] = (uint8_t)range[i];
    }
    return command_send(device, code, bytes, count);
}

/*
 * Whether the range that the controller has serves for another one. open: the
 * window's end does not matter, because the pixels end before they reach it.
 */
static bool serves(const uint16_t has[2], const uint16_t wanted[2], bool open)
{
    return has[0] == wanted[0] && (open ? has[1] >= wanted[1] : has[1] == wanted[1]);
}

/* Two ranges, and where those that may end anywhere behind their end do so. */
struct window {
    uint16_t columns[2];
    uint16_t rows[2];
    uint16_t last_column;
    uint16_t last_row;
    bool columns_open;
    bool rows_open;
};

/* Sends what differs from the window that the controller has; it may have none. */
static int send_window(struct ow_command_panel *device, const struct window *window)
{
    const struct ow_controller *controller = device->config.controller;
    bool keeps = device->window_known && controller->write_restarts;
    int status = OW_OK;
    device->window_known = false;
    if (!keeps || !serves(device->columns, window->columns, window->columns_open)) {
        device->columns[0] = window->columns[0];
        device->columns[1] = window->columns_open ? window->last_column : window->columns[1];
        status = send_range(device, controller->column_code, device->columns);
    }
    if (status >= 0 && (!keeps || !serves(device->rows, window->rows, window->rows_open))) {
        device->rows[0] = window->rows[0];
        device->rows[1] = window->rows_open ? window->last_row : window->rows[1];
        status = send_range(device, controller->row_code, device->rows);
    }
    if (status >= 0 && controller->write_code != 0) {
        status = command_send(device, controller->write_code, NULL, 0);
    }
    device->window_known = status >= 0;
    return status < 0 ? status : OW_OK;
}

int command_set_window(struct ow_command_panel *device, const struct ow_panel_rect *rect)
{
    const struct ow_command_panel_config *config = &device->config;
    const struct ow_controller *controller = config->controller;
    uint32_t from_x = device->flip_columns
                          ? (uint32_t)config->ram_width - config->width - config->offset_x
                          : config->offset_x;
    uint32_t from_y = device->flip_rows && !controller->flip_in_lines
                          ? (uint32_t)config->ram_height - config->height - config->offset_y
                          : config->offset_y;
    uint32_t unit_x = controller->column_pixels;
    uint32_t unit_y = controller->row_lines;
    struct window window = { .columns_open = false };
    device->counts.windows++;
    if (!device->swap) {
        addresses(window.columns, from_x + rect->x, rect->width, unit_x);
        addresses(window.rows, from_y + rect->y, rect->height, unit_y);
    } else if (controller->codes_turn) {
        addresses(window.columns, from_y + rect->x, rect->width, unit_y);
        addresses(window.rows, from_x + rect->y, rect->height, unit_x);
    } else {
        addresses(window.columns, from_x + rect->y, rect->height, unit_x);
        addresses(window.rows, from_y + rect->x, rect->width, unit_y);
    }
    /*
     * Where the write code goes back to the window's start, lines may end at the
     * glass's edge for all rectangles, and columns for those of one line: so the
     * next rectangle on the same line, or below with the same left side, needs one
     * command less. (These controllers have codes_turn: columns are the picture's x.)
     */
    uint32_t last_x = from_x + config->width - 1;
    uint32_t last_y = from_y + config->height - 1;
    window.rows_open = controller->write_restarts;
    window.columns_open = controller->write_restarts && rect->height == 1;
    window.last_column = (uint16_t)(device->swap ? last_y : last_x);
    window.last_row = (uint16_t)(device->swap ? last_x : last_y);
    return send_window(device, &window);
}
