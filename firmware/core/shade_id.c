/* SPDX-License-Identifier: 0BSD */
/* Shading by number: the source polygon's, as a colour, without light. */
#include "ow_light.h"

static uint32_t face_number(const struct ow_shader *shader, const struct ow_tree *tree,
                            const struct ow_face *face)
{
    (void)shader;
    return (tree->flags & OW_TREE_IDS)
               ? ow_read_u32(tree->bytes, face->at + OW_POLYGON_HEAD_BYTES) & 0xFFFFFF
               : 0xFFFFFF;
}

const struct ow_shading ow_shading_id = { .face = face_number };
