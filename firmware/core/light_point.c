/* SPDX-License-Identifier: 0BSD */
/* Lights at a point, as bright far away as near by. */
#include "ow_light.h"

_Static_assert(OW_EYE_MAX + 7LL * (OW_EYE_MAX / 4) == OW_PLACE_MAX &&
                   7 * 7 >= 3 * 4 * 4, /* 7/4 > sqrt(3) */
               "a place in camera space is within OW_PLACE_MAX of the model's origin");
_Static_assert(OW_PLACE_MAX + 256LL * (OW_LATTICE_MAX + 1) + 4 < INT32_MAX,
               "the way from a vertex to a light fits 32 bits");

static void make(struct ow_ready_light *ready, const struct ow_light *light,
                 const struct ow_view *view)
{
    int32_t given[3];
    for (int i = 0; i < 3; i++) {
        int32_t p = light->place[i];
        given[i] = p > OW_EYE_MAX ? OW_EYE_MAX : p < -OW_EYE_MAX ? -OW_EYE_MAX : p;
        ready->light_q16[i] = given[i];
    }
    if (!light->in_model_space) {
        ow_to_model(ready->light_q16, given, view);
        for (int i = 0; i < 3; i++) {
            ready->light_q16[i] += view->eye[i];
        }
    }
}

/* The direction from one place to another (ow_q8), 14 fraction bits. */
static void direction_q14(int32_t way[3])
{
    uint32_t sizes = 0;
    for (int i = 0; i < 3; i++) {
        sizes |= (uint32_t)(way[i] < 0 ? -way[i] : way[i]);
    }
    int32_t shift = 18 - (int32_t)ow_leading_zeros(sizes); /* leaves 14 bits */
    for (int i = 0; i < 3; i++) {
        way[i] = shift >= 0 ? way[i] >> shift : way[i] * (1 << -shift);
    }
    ow_make_unit_q14(way);
}

static int32_t shine(const struct ow_shader *shader, const int32_t normal[3],
                     const int32_t place[3])
{
    int32_t sum = 0;
    for (uint32_t k = 0; k < shader->points; k++) {
        const struct ow_ready_light *light = &shader->lights[shader->directional + k];
        int32_t way[3];
        for (int i = 0; i < 3; i++) {
            way[i] = light->light_q16[i] - place[i] * 256;
        }
        direction_q14(way);
        int32_t along = normal[0] * way[0] + normal[1] * way[1] + normal[2] * way[2];
        if (along > 0) { /* below 2^23: the cosine, times 127, 14 fraction bits */
            int64_t part = ((int64_t)along * light->intensity_q8 * OW_PER_NORMAL_Q22) >> 20;
            sum += part < OW_LIGHT_FULL ? (int32_t)part : OW_LIGHT_FULL;
        }
    }
    return sum;
}

const struct ow_light_kind ow_light_point = { .make = make, .shine = shine };
