/* SPDX-License-Identifier: 0BSD */
/* All pixel formats in one list: for programs that choose by name. Firmware names its one. */
#include "ow_pixel.h"

#include <stdbool.h>
#include <stddef.h>

const struct ow_pixel_format *const ow_formats[] = {
    &ow_format_xrgb8888, &ow_format_rgb565, &ow_format_rgb565_be, &ow_format_rgb332,
    &ow_format_gray8,    &ow_format_gray4,  &ow_format_mono,
};
const uint32_t ow_format_count = sizeof ow_formats / sizeof ow_formats[0];

static bool same_text(const char *a, const char *b)
{
    while (*a != '\0' && *a == *b) {
        a++;
        b++;
    }
    return *a == *b;
}

const struct ow_pixel_format *ow_format_by_name(const char *name)
{
    for (uint32_t i = 0; i < ow_format_count; i++) {
        if (same_text(ow_formats[i]->name, name)) {
            return ow_formats[i];
        }
    }
    return NULL;
}
