/* SPDX-License-Identifier: 0BSD */
/* Two pictures compared, pixel by pixel. */
#include "image.h"

enum { DIFFERENT = 0xFF0000 };

static bool is_inside(const struct image *image, uint32_t x, uint32_t y)
{
    return x < image->width && y < image->height;
}

static uint32_t larger(uint32_t a, uint32_t b)
{
    return a > b ? a : b;
}

uint64_t image_count_differences(const struct image *actual, const struct image *expected)
{
    if (actual->width != expected->width || actual->height != expected->height) {
        return (uint64_t)larger(actual->width, expected->width) *
               larger(actual->height, expected->height);
    }
    uint64_t count = 0;
    for (uint32_t y = 0; y < actual->height; y++) {
        for (uint32_t x = 0; x < actual->width; x++) {
            count += image_pixel(actual, x, y) != image_pixel(expected, x, y);
        }
    }
    return count;
}

/* A quarter as bright as the colour's green, which is nearest to what the eye sees. */
static uint32_t dark_grey(uint32_t rgb)
{
    uint32_t level = (rgb >> 8 & 255) / 4;
    return level << 16 | level << 8 | level;
}

bool image_difference(struct image *picture, const struct image *actual,
                      const struct image *expected, struct image_error *error)
{
    if (!image_make(picture, larger(actual->width, expected->width),
                    larger(actual->height, expected->height), error)) {
        return false;
    }
    for (uint32_t y = 0; y < picture->height; y++) {
        for (uint32_t x = 0; x < picture->width; x++) {
            bool both = is_inside(actual, x, y) && is_inside(expected, x, y);
            uint32_t rgb = DIFFERENT;
            if (both && image_pixel(actual, x, y) == image_pixel(expected, x, y)) {
                rgb = dark_grey(image_pixel(expected, x, y));
            }
            image_set_pixel(picture, x, y, rgb);
        }
    }
    return true;
}
