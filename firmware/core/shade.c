/* SPDX-License-Identifier: 0BSD */
/* Stage "shade": what all shadings share; the look made ready. */
#include "ow_shade.h"

#include "ow_light.h"

static void make_directional(struct ow_ready_light *ready, const struct ow_light *light,
                             const struct ow_view *view)
{
    int32_t towards[3];
    for (int i = 0; i < 3; i++) {
        towards[i] = light->direction_q14[i];
    }
    if (!light->in_model_space) {
        const int32_t given[3] = { towards[0], towards[1], towards[2] };
        ow_to_model(towards, given, view);
    }
    ow_light_set_direction(ready, towards);
}

static struct ow_ready_light *add_light(struct ow_shader *shader, const struct ow_light *light)
{
    struct ow_ready_light *ready = &shader->lights[shader->directional + shader->points];
    ready->intensity_q8 =
        light->intensity_q8 < OW_INTENSITY_MAX ? light->intensity_q8 : OW_INTENSITY_MAX;
    return ready;
}

/* The directional ones first. */
static void make_lights(struct ow_shader *shader, const struct ow_look *look,
                        const struct ow_view *view)
{
    for (uint32_t i = 0; i < look->light_count; i++) {
        if (!look->lights[i].at_point) {
            make_directional(add_light(shader, &look->lights[i]), &look->lights[i], view);
            shader->directional++;
        }
    }
    for (uint32_t i = 0; i < look->light_count; i++) {
        if (look->lights[i].at_point) {
            shader->point->make(add_light(shader, &look->lights[i]), &look->lights[i], view);
            shader->points++;
        }
    }
}

void ow_shader_make(struct ow_shader *shader, const struct ow_parts *parts,
                    const struct ow_look *look, const struct ow_view *view)
{
    *shader = (struct ow_shader){
        .shading = parts->shading[look->shade],
        .effect = ow_look_has_effect(look) ? parts->effect : NULL,
        .point = parts->point,
        .shade = look->shade,
        .caps = view->cuts && look->caps,
        .cap = look->cap,
        .ambient_q16 =
            (look->ambient_q8 < OW_INTENSITY_FULL ? look->ambient_q8 : OW_INTENSITY_FULL) * 65536,
        .specular_q8 =
            look->specular_q8 < OW_INTENSITY_FULL ? look->specular_q8 : OW_INTENSITY_FULL,
        .shininess = look->shininess,
        .background = look->background,
        .foreground = look->foreground,
        .view = view,
    };
    if (shader->effect != NULL) {
        shader->effect->make(shader, look, view);
    }
    make_lights(shader, look, view);
    const struct ow_shading *shading = shader->shading;
    shader->parts =
        (uint8_t)(shading->parts + (shader->points > 0 && shading->parts > 1) + shader->has_depth);
    if (shading->make != NULL) {
        shading->make(shader);
    }
    for (int i = 0; i < 3 && view->cuts; i++) { /* the cap looks at what was taken away */
        int64_t kept = ((int64_t)view->cut_axis[i] * 127 + (1 << 29)) >> 30;
        shader->cap_normal[i] = (int8_t)-kept;
    }
}

uint32_t ow_face_colour(const struct ow_shader *shader, const struct ow_tree *tree,
                        const struct ow_face *face)
{
    if (face->reverse && shader->caps) {
        return shader->cap;
    }
    uint32_t number = ow_read_u16(tree->bytes, face->at + 4) & OW_POLYGON_COLOUR_MASK;
    return ow_read_u32(tree->bytes, tree->colours_at + number * OW_COLOUR_BYTES);
}

int32_t ow_face_share(const struct ow_shader *shader, const struct ow_tree *tree,
                      const struct ow_face *face)
{
    uint32_t corners = ow_read_u8(tree->bytes, face->at);
    int32_t most = 0;
    for (uint32_t i = 0; i < corners; i++) {
        int32_t share = shader->effect->share(shader, tree, ow_corner(tree, face->at, i));
        most = share > most ? share : most;
    }
    return most;
}
