/* SPDX-License-Identifier: 0BSD */
/*
 * The doctor's picture. A frame of one white pixel at the very edge; a square
 * in each corner: red top left, green top right, blue bottom left, white bottom
 * right; an arrow up in the middle; below it bars of white, yellow, cyan,
 * green, magenta, red, blue, black, and of grey.
 */
#ifndef OLDWELL_BOARDS_LINUX_PATTERN_H
#define OLDWELL_BOARDS_LINUX_PATTERN_H

#include <stdint.h>

#include "hal/clock.h"
#include "hal/panel.h"

/* 0x00RRGGBB of a pixel of a picture of this size. */
uint32_t pattern_colour(uint32_t x, uint32_t y, uint32_t width, uint32_t height);

/*
 * Shows it, turned clockwise. Returns when the panel has taken it, or a status:
 * OW_MEMORY, OW_TIMEOUT, or what the panel reports.
 */
int pattern_show(const struct ow_panel *panel, const struct ow_clock *clock,
                 uint32_t quarter_turns);

#endif
