/* SPDX-License-Identifier: 0BSD */
/* The controllers by name. */
#include "hal/panel/controller.h"

const struct ow_controller *const ow_controllers[] = {
    &ow_controller_ili9341, &ow_controller_ssd0323, &ow_controller_ssd1306, &ow_controller_ssd1322,
    &ow_controller_ssd1329, &ow_controller_ssd1351, &ow_controller_st7735,  &ow_controller_st7789,
};

const uint32_t ow_controller_count = sizeof ow_controllers / sizeof ow_controllers[0];

static bool same(const char *a, const char *b)
{
    while (*a != '\0' && *a == *b) {
        a++;
        b++;
    }
    return *a == *b;
}

const struct ow_controller *ow_controller_by_name(const char *name)
{
    for (uint32_t i = 0; i < ow_controller_count; i++) {
        if (same(ow_controllers[i]->name, name)) {
            return ow_controllers[i];
        }
    }
    return NULL;
}
