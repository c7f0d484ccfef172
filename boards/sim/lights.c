/* SPDX-License-Identifier: 0BSD */
/* owsim's lights. */
#include "lights.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "settings.h"

enum { ONE_Q8 = 256, ONE_Q14 = 1 << 14, SHARE_MOST = 32 };

static const char point_prefix[] = "at:";

/* Three numbers and perhaps a fourth; their count, 0 for anything else. */
static int read_numbers(const char *text, double numbers[4])
{
    for (int i = 0; i < 4; i++) {
        char *end;
        numbers[i] = strtod(text, &end);
        if (end == text || !isfinite(numbers[i])) {
            return 0;
        }
        if (*end == '\0') {
            return i + 1;
        }
        if (*end != ',') {
            return 0;
        }
        text = end + 1;
    }
    return 0;
}

static void read_direction(struct ow_light *light, const double direction[3])
{
    double length = sqrt(direction[0] * direction[0] + direction[1] * direction[1] +
                         direction[2] * direction[2]);
    if (!(length > 0) || !isfinite(length)) {
        settings_wrong("--light takes the direction towards the light, not the zero vector");
    }
    for (int i = 0; i < 3; i++) {
        light->direction_q14[i] = (int16_t)lround(direction[i] / length * ONE_Q14);
    }
}

static void read_light(struct ow_light *light, double place[3], const char *text, double share)
{
    double numbers[4];
    size_t prefix = sizeof point_prefix - 1;
    bool is_point = strncmp(text, point_prefix, prefix) == 0;
    int count = read_numbers(is_point ? text + prefix : text, numbers);
    if (count < 3) {
        settings_wrong("--light takes x,y,z[,SHARE] or at:x,y,z[,SHARE], not '%s'", text);
    }
    share = count == 4 ? numbers[3] : share;
    if (!(share >= 0 && share <= SHARE_MOST)) {
        settings_wrong("--light %s: a light's share is from 0 to %d", text, SHARE_MOST);
    }
    light->intensity_q8 = (uint16_t)lround(share * ONE_Q8);
    if (is_point) {
        light->at_point = true;
        memcpy(place, numbers, 3 * sizeof *place);
    } else {
        read_direction(light, numbers);
    }
}

void lights_read(struct ow_look *look, struct light_places *places, const struct option_list *list,
                 double share, bool in_model)
{
    static const struct option_list usual = { { "-0.4,0.6,0.7" }, 1 };
    list = list->count > 0 ? list : &usual;
    look->light_count = (uint8_t)list->count;
    for (size_t i = 0; i < list->count; i++) {
        look->lights[i].in_model_space = in_model;
        read_light(&look->lights[i], places->place[i], list->text[i], share);
    }
}

void lights_scale(struct ow_look *look, const struct light_places *places,
                  const struct tree_file *tree)
{
    for (uint8_t k = 0; k < look->light_count; k++) {
        struct ow_light *light = &look->lights[k];
        for (int i = 0; i < 3 && light->at_point; i++) {
            double from = light->in_model_space ? tree->origin[i] : 0;
            double place = round((places->place[k][i] - from) / tree->step * ONE_Q8);
            if (!(fabs(place) <= OW_EYE_MAX)) {
                settings_wrong("--light: a point is farther away than 32 times the model's size");
            }
            light->place[i] = (ow_q8)place;
        }
    }
}
