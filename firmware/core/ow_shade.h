/* SPDX-License-Identifier: 0BSD */
/* Stage "shade": a face's colour from its normal, its material and the light. */
#ifndef OW_SHADE_H
#define OW_SHADE_H

#include <stdint.h>

#include "ow_draw.h"

/* The look of one frame, made ready. */
struct ow_shader {
    enum ow_shade shade;
    int32_t ambient_q16;
    int32_t light_q16[3]; /* intensity (256 is full) that one unit of an i8 normal adds */
};

void ow_shader_make(struct ow_shader *shader, const struct ow_look *look,
                    const struct ow_view *view);

/* The colour of a face, 0x00RRGGBB. */
uint32_t ow_shade_face(const struct ow_shader *shader, const struct ow_tree *tree,
                       const struct ow_face *face);

#endif
