/* SPDX-License-Identifier: 0BSD */
/* All shadings by number: for programs that choose one. Firmware names its own. */
#include "ow_shade.h"

const struct ow_shading *ow_shading_of(enum ow_shade shade)
{
    static const struct ow_shading *const shadings[] = {
        [OW_SHADE_ID] = &ow_shading_id,           [OW_SHADE_FLAT] = &ow_shading_flat,
        [OW_SHADE_GOURAUD] = &ow_shading_gouraud, [OW_SHADE_PHONG] = &ow_shading_phong,
        [OW_SHADE_LINES] = &ow_shading_lines,
    };
    return shadings[shade];
}
