/* SPDX-License-Identifier: 0BSD */
/* BT.601 in integers: coefficients with 8 fraction bits, sums kept positive. */
#include "hal/linux/v4l2_pixels.h"

#include <string.h>

struct rgb {
    int32_t red;
    int32_t green;
    int32_t blue;
};

static struct rgb read_pixel(const uint8_t *at)
{
    uint32_t word;
    memcpy(&word, at, sizeof word);
    return (struct rgb){ (int32_t)(word >> 16 & 0xFF), (int32_t)(word >> 8 & 0xFF),
                         (int32_t)(word & 0xFF) };
}

static uint8_t luma(struct rgb c)
{
    return (uint8_t)((66 * c.red + 129 * c.green + 25 * c.blue + 128 + 16 * 256) >> 8);
}

/* Of the sum of 1 << shift pixels. */
static uint8_t blue_difference(struct rgb sum, unsigned shift)
{
    int32_t mean = -38 * sum.red - 74 * sum.green + 112 * sum.blue;
    return (uint8_t)((mean + ((128 + 128 * 256) << shift)) >> (8 + shift));
}

static uint8_t red_difference(struct rgb sum, unsigned shift)
{
    int32_t mean = 112 * sum.red - 94 * sum.green - 18 * sum.blue;
    return (uint8_t)((mean + ((128 + 128 * 256) << shift)) >> (8 + shift));
}

static struct rgb add(struct rgb a, struct rgb b)
{
    return (struct rgb){ a.red + b.red, a.green + b.green, a.blue + b.blue };
}

void linux_rgb_to_yuyv(uint8_t *to, uint32_t to_stride, const uint8_t *from, uint32_t from_stride,
                       uint32_t width, uint32_t height)
{
    for (uint32_t y = 0; y < height; y++) {
        const uint8_t *source = from + (size_t)y * from_stride;
        uint8_t *target = to + (size_t)y * to_stride;
        for (uint32_t x = 0; x < width; x += 2) {
            struct rgb left = read_pixel(source + (size_t)4 * x);
            struct rgb right = read_pixel(source + (size_t)4 * x + 4);
            struct rgb sum = add(left, right);
            *target++ = luma(left);
            *target++ = blue_difference(sum, 1);
            *target++ = luma(right);
            *target++ = red_difference(sum, 1);
        }
    }
}

void linux_rgb_to_nv12(uint8_t *to, uint32_t to_stride, const uint8_t *from, uint32_t from_stride,
                       uint32_t width, uint32_t height)
{
    uint8_t *chroma = to + (size_t)to_stride * height;
    for (uint32_t y = 0; y < height; y += 2) {
        const uint8_t *upper = from + (size_t)y * from_stride;
        uint8_t *line = to + (size_t)y * to_stride;
        uint8_t *pair = chroma + (size_t)(y / 2) * to_stride;
        for (uint32_t x = 0; x < width; x += 2) {
            struct rgb sum = { 0, 0, 0 };
            for (uint32_t i = 0; i < 4; i++) {
                struct rgb pixel =
                    read_pixel(upper + (size_t)(i / 2) * from_stride + (size_t)4 * (x + i % 2));
                line[(size_t)(i / 2) * to_stride + x + i % 2] = luma(pixel);
                sum = add(sum, pixel);
            }
            pair[x] = blue_difference(sum, 2);
            pair[x + 1] = red_difference(sum, 2);
        }
    }
}
