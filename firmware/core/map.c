/* SPDX-License-Identifier: 0BSD */
/* Maps: an intensity as a colour, linear between five knots. */
#include "ow_shade.h"

enum { KNOTS = 5, STEP_BITS = 6 }; /* at 0, 64 .. 256 */

static const uint32_t knots[][KNOTS] = {
    [OW_MAP_NONE] = { 0, 0, 0, 0, 0 },
    [OW_MAP_HEAT] = { 0x000000, 0x900000, 0xF05000, 0xFFC020, 0xFFFFFF },
    [OW_MAP_COOL] = { 0x000000, 0x102070, 0x2070C0, 0x60C8F0, 0xFFFFFF },
    [OW_MAP_SPECTRUM] = { 0x2000A0, 0x0080FF, 0x00C040, 0xFFD000, 0xFF2000 },
};

uint32_t ow_map_colour(enum ow_map map, uint32_t intensity)
{
    uint32_t i = intensity >> STEP_BITS;
    if (i >= KNOTS - 1) {
        return knots[map][KNOTS - 1];
    }
    uint32_t share = (intensity & ((1u << STEP_BITS) - 1)) << (8 - STEP_BITS);
    return ow_mix(knots[map][i], knots[map][i + 1], share);
}
