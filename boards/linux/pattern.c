/* SPDX-License-Identifier: 0BSD */
/* The test pattern, a function of the pixel. */
#include "pattern.h"

#include <stdbool.h>
#include <stdlib.h>

enum { NAP_US = 2000, LIMIT_US = 2000000, BARS = 8 };

static const uint32_t bars[BARS] = { 0xFFFFFF, 0xFFFF00, 0x00FFFF, 0x00FF00,
                                     0xFF00FF, 0xFF0000, 0x0000FF, 0x000000 };

/* An arrow that points up in the square of this size: head in the upper half, shaft below. */
static bool in_arrow(uint32_t x, uint32_t y, uint32_t size)
{
    uint32_t from_middle = x < size / 2 ? size / 2 - x : x - size / 2;
    return y < size / 2 ? from_middle <= y : from_middle <= size / 8;
}

uint32_t pattern_colour(uint32_t x, uint32_t y, uint32_t width, uint32_t height)
{
    uint32_t least = width < height ? width : height;
    uint32_t corner = least / 8;
    uint32_t arrow = least / 3;
    uint32_t arrow_x = (width - arrow) / 2;
    uint32_t arrow_y = height / 8;
    bool left = x < 1 + corner;
    bool right = x + 1 + corner >= width;
    if (x == 0 || y == 0 || x + 1 == width || y + 1 == height) {
        return 0xFFFFFF;
    }
    if (y < 1 + corner && (left || right)) {
        return left ? 0xFF0000 : 0x00FF00;
    }
    if (y + 1 + corner >= height && (left || right)) {
        return left ? 0x0000FF : 0xFFFFFF;
    }
    if (x >= arrow_x && x < arrow_x + arrow && y >= arrow_y && y < arrow_y + arrow &&
        in_arrow(x - arrow_x, y - arrow_y, arrow)) {
        return 0xFFFFFF;
    }
    if (y >= height / 2 && y < height / 2 + height / 6) {
        return bars[x * BARS / width];
    }
    if (y >= height / 2 + height / 6 && y < height / 2 + height / 3) {
        return x * 255 / (width - 1) * 0x010101u;
    }
    return 0x404040;
}

/* The picture's pixel at a pixel of a panel that shows it turned. */
static uint32_t turned_colour(const struct ow_panel_info *info, uint32_t x, uint32_t y,
                              uint32_t turns)
{
    uint32_t right = info->width - 1u - x;
    uint32_t below = info->height - 1u - y;
    switch (turns) {
    case 1:
        return pattern_colour(y, right, info->height, info->width);
    case 2:
        return pattern_colour(right, below, info->width, info->height);
    case 3:
        return pattern_colour(below, x, info->height, info->width);
    default:
        return pattern_colour(x, y, info->width, info->height);
    }
}

static void draw(const struct ow_panel_info *info, uint8_t *pixels, uint32_t stride, uint32_t turns)
{
    for (uint32_t y = 0; y < info->height; y++) {
        for (uint32_t x = 0; x < info->width; x++) {
            uint32_t rgb = turned_colour(info, x, y, turns);
            info->format->store(pixels + (size_t)y * stride, x, x + 1, &rgb);
        }
    }
}

/* Repeats what a panel answers with OW_AGAIN, for LIMIT_US at most. */
static int nap(const struct ow_clock *clock, uint64_t *end_us)
{
    uint64_t now_us;
    int status = clock->ops->now(clock->device, &now_us);
    if (status < 0) {
        return status;
    }
    *end_us = *end_us == 0 ? now_us + LIMIT_US : *end_us;
    return now_us >= *end_us ? OW_TIMEOUT : clock->ops->sleep(clock->device, now_us + NAP_US);
}

static int show_lent(const struct ow_panel *panel, const struct ow_clock *clock,
                     const struct ow_panel_info *info, uint32_t turns)
{
    struct ow_panel_buffer buffer;
    uint64_t end_us = 0;
    int status;
    while ((status = panel->ops->lend(panel->device, &buffer)) == OW_AGAIN) {
        status = nap(clock, &end_us);
        if (status < 0) {
            return status;
        }
    }
    if (status < 0) {
        return status;
    }
    const struct ow_panel_rect all = { 0, 0, info->width, info->height };
    draw(info, buffer.pixels, buffer.stride, turns);
    return panel->ops->show(panel->device, &all, 1);
}

static int show_written(const struct ow_panel *panel, const struct ow_clock *clock,
                        const struct ow_panel_info *info, uint32_t turns)
{
    const struct ow_panel_rect all = { 0, 0, info->width, info->height };
    uint32_t stride = (ow_row_bytes(info->format, info->width) + 3) / 4 * 4;
    uint8_t *pixels = calloc(info->height, stride);
    uint64_t end_us = 0;
    if (pixels == NULL) {
        return OW_MEMORY;
    }
    draw(info, pixels, stride, turns);
    int status = panel->ops->write(panel->device, &all, pixels, stride, true);
    while (status >= 0 && (status = ow_panel_done(panel, 0)) == OW_AGAIN) {
        status = nap(clock, &end_us);
    }
    free(pixels);
    return status;
}

int pattern_show(const struct ow_panel *panel, const struct ow_clock *clock, uint32_t quarter_turns)
{
    struct ow_panel_info info;
    if (quarter_turns != 0 &&
        ow_panel_set(panel, OW_PANEL_ROTATION, (int32_t)quarter_turns) == OW_OK) {
        quarter_turns = 0;
    }
    int status = ow_panel_check(panel, &info);
    if (status < 0) {
        return status;
    }
    return ow_panel_lends(panel) ? show_lent(panel, clock, &info, quarter_turns)
                                 : show_written(panel, clock, &info, quarter_turns);
}
