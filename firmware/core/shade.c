/* SPDX-License-Identifier: 0BSD */
/*
 * Stage "shade": flat. Intensity is ambient plus directional light times the
 * cosine of its angle of incidence, at most 1, times the material's colour.
 */
#include "ow_shade.h"

#include "ow_read.h"

enum {
    FULL = 256,           /* intensity that shows a colour as it is */
    PER_NORMAL_Q22 = 33026 /* 2^22 / 127: normals are 127 long */
};

void ow_shader_make(struct ow_shader *shader, const struct ow_look *look,
                    const struct ow_view *view)
{
    shader->shade = look->shade;
    shader->ambient_q16 = look->ambient_q8 * 65536;
    const int16_t *d = look->light.direction_q14;
    for (int i = 0; i < 3; i++) {
        int64_t along = d[i];
        if (!look->light.in_model_space) {
            along = ((int64_t)d[0] * view->right[i] + (int64_t)d[1] * view->up[i] -
                     (int64_t)d[2] * view->forward[i]) >> 30;
        }
        shader->light_q16[i] =
            (int32_t)((along * look->light.intensity_q8 * PER_NORMAL_Q22) >> (14 + 22 - 16));
    }
}

static uint32_t scale_channel(uint32_t colour, uint32_t shift, uint32_t intensity)
{
    return ((colour >> shift & 255) * intensity / FULL) << shift;
}

static uint32_t face_intensity(const struct ow_shader *shader, const uint8_t *bytes,
                               const struct ow_face *face)
{
    int64_t light = 0;
    for (uint32_t i = 0; i < 3; i++) {
        light += (int64_t)ow_read_i8(bytes, face->at + 1 + i) * shader->light_q16[i];
    }
    if (face->reverse) {
        light = -light;
    }
    int64_t intensity = (shader->ambient_q16 + (light > 0 ? light : 0)) >> 16;
    return intensity > FULL ? FULL : (uint32_t)intensity;
}

uint32_t ow_shade_face(const struct ow_shader *shader, const struct ow_tree *tree,
                       const struct ow_face *face)
{
    const uint8_t *bytes = tree->bytes;
    if (shader->shade == OW_SHADE_ID) {
        return (tree->flags & OW_TREE_IDS)
                   ? ow_read_u32(bytes, face->at + OW_POLYGON_HEAD_BYTES) & 0xFFFFFF
                   : 0xFFFFFF;
    }
    uint32_t number = ow_read_u16(bytes, face->at + 4) & OW_POLYGON_COLOUR_MASK;
    uint32_t colour = ow_read_u32(bytes, tree->colours_at + number * OW_COLOUR_BYTES);
    uint32_t intensity = face_intensity(shader, bytes, face);
    return scale_channel(colour, 16, intensity) | scale_channel(colour, 8, intensity) |
           scale_channel(colour, 0, intensity);
}
