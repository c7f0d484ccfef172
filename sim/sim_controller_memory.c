/* SPDX-License-Identifier: 0BSD */
/* Models of panel controllers: from pixel bytes to memory, and from memory to the glass. */
#include "sim_controller.h"

/* Bits of the map's first parameter. */
enum {
    DCS_FLIP_ROWS = 0x80,
    DCS_FLIP_COLUMNS = 0x40,
    DCS_SWAP = 0x20,
    DCS_BGR = 0x08,
    SSD_FLIP_ROWS = 0x10,
    /* 16-bit SSD1351, 4 pixels a column SSD1322 */
    SSD_VERTICAL = 0x01,
    SSD_FLIP_COLUMNS = 0x02,
    SSD_BGR = 0x04,      /* SSD1351 */
    SSD_NIBBLES4 = 0x04, /* SSD1322: the left pixel is in the high half */
    /* 2 pixels a column: SSD1329, SSD0323 */
    SSD2_FLIP_COLUMNS = 0x01,
    SSD2_NIBBLES = 0x02,
    SSD2_VERTICAL = 0x04
};

static bool has(const struct sim_controller *controller, unsigned bit)
{
    return (controller->map[0] & bit) != 0;
}

static bool two_a_column(const struct sim_controller *controller)
{
    return controller->module.kind == SIM_SSD && controller->module.unit_pixels == 2;
}

/* Whether the address that counts first is the row. */
static bool vertical(const struct sim_controller *controller)
{
    switch (controller->module.kind) {
    case SIM_SSD:
        return has(controller, two_a_column(controller) ? (unsigned)SSD2_VERTICAL : SSD_VERTICAL);
    case SIM_PAGES:
        return controller->mode == 1;
    default:
        return false;
    }
}

static void store(struct sim_controller *controller, uint32_t column, uint32_t row, uint32_t value)
{
    const struct sim_module *module = &controller->module;
    if (column >= module->ram_width || row >= module->ram_height) {
        sim_complain(controller, "pixel at column %u, row %u: outside the memory", (unsigned)column,
                     (unsigned)row);
        return;
    }
    size_t at = (size_t)row * module->ram_width + column;
    controller->ram[at] = (uint16_t)value;
    controller->written[at] = 1;
}

static void store_dcs(struct sim_controller *controller)
{
    const struct sim_module *module = &controller->module;
    uint32_t high = controller->unit[module->little ? 1 : 0];
    uint32_t low = controller->unit[module->little ? 0 : 1];
    bool swap = has(controller, DCS_SWAP);
    uint32_t column = swap ? controller->row : controller->column;
    uint32_t row = swap ? controller->column : controller->row;
    column = has(controller, DCS_FLIP_COLUMNS) ? module->ram_width - 1u - column : column;
    row = has(controller, DCS_FLIP_ROWS) ? module->ram_height - 1u - row : row;
    store(controller, column, row, high << 8 | low);
}

static void store_ssd(struct sim_controller *controller)
{
    const struct sim_module *module = &controller->module;
    const uint8_t *unit = controller->unit;
    uint32_t count = module->unit_pixels;
    uint32_t value[4] = { (uint32_t)unit[0] << 8 | unit[1], 0, 0, 0 };
    bool flip = has(controller, count == 2 ? (unsigned)SSD2_FLIP_COLUMNS : SSD_FLIP_COLUMNS);
    if (count == 2) { /* this bit alone says which half is left on the glass */
        bool high_left = has(controller, SSD2_NIBBLES);
        value[0] = high_left ? unit[0] >> 4 : unit[0] & 15u;
        value[1] = high_left ? unit[0] & 15u : unit[0] >> 4;
    } else if (count == 4) { /* all four in turn; flipping turns them as well */
        bool rises = has(controller, SSD_NIBBLES4) != flip;
        for (uint32_t i = 0; i < 4; i++) {
            uint32_t nibble = rises ? i : 3 - i;
            value[i] = (uint32_t)unit[nibble / 2] >> (nibble & 1 ? 0 : 4) & 15;
        }
    }
    uint32_t first = controller->column * count;
    first = flip ? module->ram_width - count - first : first;
    for (uint32_t i = 0; i < count; i++) {
        store(controller, first + i, controller->row, value[i]);
    }
}

static void store_page(struct sim_controller *controller)
{
    uint32_t column = controller->flip_columns
                          ? controller->module.ram_width - 1u - controller->column
                          : controller->column;
    for (uint32_t i = 0; i < 8; i++) {
        store(controller, column, controller->row * 8u + i, (uint32_t)controller->unit[0] >> i & 1);
    }
}

/* Steps through a range; true when it began again. */
static bool step(uint16_t *at, const uint16_t range[2])
{
    if (*at < range[1]) {
        ++*at;
        return false;
    }
    *at = range[0];
    return true;
}

void sim_memory_begin(struct sim_controller *controller)
{
    controller->column = controller->columns[0];
    controller->row = controller->rows[0];
    controller->unit_filled = 0;
    controller->full = false;
}

void sim_memory_byte(struct sim_controller *controller, uint8_t byte)
{
    if (controller->full) {
        sim_complain(controller, "more pixels than the window holds");
        return;
    }
    controller->unit[controller->unit_filled++] = byte;
    if (controller->unit_filled < controller->module.unit_bytes) {
        return;
    }
    controller->unit_filled = 0;
    switch (controller->module.kind) {
    case SIM_DCS:
        store_dcs(controller);
        break;
    case SIM_SSD:
        store_ssd(controller);
        break;
    default:
        store_page(controller);
        break;
    }
    if (vertical(controller)) {
        controller->full = step(&controller->row, controller->rows) &&
                           step(&controller->column, controller->columns);
    } else {
        controller->full = step(&controller->column, controller->columns) &&
                           step(&controller->row, controller->rows);
    }
}

/* ---- the glass ---- */

/* Where in memory the glass's pixel x, y comes from. */
static size_t cell(const struct sim_controller *controller, uint32_t x, uint32_t y)
{
    const struct sim_module *module = &controller->module;
    uint32_t column = module->offset_x + x;
    uint32_t row = module->offset_y + y;
    uint32_t differs = controller->map[0] ^ module->upright;
    uint32_t last = controller->lines;
    switch (module->kind) {
    case SIM_DCS: /* glass and memory are wired for good */
        column = module->upright & DCS_FLIP_COLUMNS ? module->ram_width - 1u - column : column;
        row = module->upright & DCS_FLIP_ROWS ? module->ram_height - 1u - row : row;
        break;
    case SIM_SSD: /* the scan's direction says which line shows which row */
        row = differs & SSD_FLIP_ROWS ? module->offset_y + last - y : row;
        break;
    default: /* upright is with columns and rows flipped */
        column = module->ram_width - 1u - column;
        row = controller->flip_rows ? row : module->offset_y + last - y;
        break;
    }
    return (size_t)row * module->ram_width + column;
}

static uint32_t red_and_blue_changed(uint32_t value)
{
    return (value & 0x07E0) | value >> 11 | (value & 31) << 11;
}

int32_t sim_controller_glass(const struct sim_controller *controller, uint32_t x, uint32_t y)
{
    const struct sim_module *module = &controller->module;
    if (!controller->lit || !controller->awake) {
        return -1;
    }
    uint32_t value = controller->ram[cell(controller, x, y)];
    uint32_t bgr = module->kind == SIM_DCS ? DCS_BGR : SSD_BGR;
    if (module->bits == 16 && ((controller->map[0] ^ module->upright) & bgr) != 0) {
        value = red_and_blue_changed(value);
    }
    if (controller->inverted != module->inverted) {
        value = ~value & ((1u << module->bits) - 1);
    }
    return (int32_t)value;
}

bool sim_memory_is_written(const struct sim_controller *controller)
{
    for (uint32_t y = 0; y < controller->module.height; y++) {
        for (uint32_t x = 0; x < controller->module.width; x++) {
            if (!controller->written[cell(controller, x, y)]) {
                return false;
            }
        }
    }
    return true;
}
