/* SPDX-License-Identifier: 0BSD */
/* A camera's picture behind the model: which source pixel stands where, and its colour. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "firmware/viewer/video_backdrop.h"

enum { MOST = 400 };

static uint8_t planes[2][MOST * MOST * 4];

/* A source pixel tells where it is: red is x, green is y. */
static void make_picture(struct ow_video_info *info, uint16_t width, uint16_t height)
{
    *info = (struct ow_video_info){ width, height, OW_VIDEO_XRGB8888, 0, 1 };
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            const uint8_t pixel[4] = { 7, (uint8_t)y, (uint8_t)x, 99 };
            memcpy(planes[0] + ((size_t)y * width + x) * 4, pixel, sizeof pixel);
        }
    }
}

static struct ow_video_backdrop begin(const struct ow_video_info *info, uint16_t width,
                                      uint16_t height, uint8_t turns, uint32_t stride)
{
    struct ow_video_backdrop backdrop = { .colour = 0x123456 };
    assert_int_equal(ow_video_backdrop_begin(&backdrop, info, width, height, turns), OW_OK);
    backdrop.frame = (struct ow_video_frame){ .planes = { planes[0], planes[1] },
                                              .strides = { stride, stride } };
    backdrop.has_frame = true;
    return backdrop;
}

/* The colour at a pixel of the screen. */
static uint32_t at(struct ow_video_backdrop *backdrop, uint32_t x, uint32_t y)
{
    _Alignas(4) uint8_t row[MOST * 4] = { 0 };
    struct ow_backdrop seam = ow_backdrop_of_video(backdrop);
    seam.fill(seam.context, &ow_format_xrgb8888, row, y, 0, backdrop->width);
    return ow_format_xrgb8888.get(row, x);
}

/* The picture covers the screen from its middle, at a whole-number scale, and no pixel is outside. */
static void every_size_is_covered_from_the_middle(void **state)
{
    static const struct {
        uint16_t camera[2];
        uint16_t screen[2];
        uint32_t step;
        uint32_t repeat;
    } cases[] = {
        { { 64, 48 }, { 64, 48 }, 1, 1 },   { { 64, 48 }, { 32, 24 }, 2, 1 },
        { { 65, 49 }, { 32, 24 }, 2, 1 },   { { 64, 48 }, { 128, 96 }, 1, 2 },
        { { 64, 48 }, { 129, 96 }, 1, 3 },  { { 64, 48 }, { 48, 64 }, 1, 2 },
        { { 200, 50 }, { 50, 50 }, 1, 1 },  { { 16, 12 }, { 160, 128 }, 1, 11 },
        { { 2, 2 }, { 240, 240 }, 1, 120 }, { { 255, 255 }, { 1, 1 }, 255, 1 },
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct ow_video_info info;
        uint16_t width = cases[i].screen[0];
        uint16_t height = cases[i].screen[1];
        make_picture(&info, cases[i].camera[0], cases[i].camera[1]);
        struct ow_video_backdrop b = begin(&info, width, height, 0, info.width * 4u);
        assert_int_equal(b.step, cases[i].step);
        assert_int_equal(b.repeat, cases[i].repeat);
        uint32_t first = at(&b, 0, 0);
        uint32_t last = at(&b, width - 1u, height - 1u);
        int32_t left = (int32_t)(first >> 16);
        int32_t right = info.width - 1 - (int32_t)(last >> 16);
        int32_t top = (int32_t)(first >> 8 & 0xFF);
        int32_t bottom = info.height - 1 - (int32_t)(last >> 8 & 0xFF);
        int32_t step = (int32_t)b.step;
        assert_true(left >= 0 && right >= 0 && top >= 0 && bottom >= 0);
        assert_true(left - right <= step && right - left <= 2 * step);
        assert_true(top - bottom <= step && bottom - top <= 2 * step);
    }
}

static void a_turned_picture_stands_upright(void **state)
{
    struct ow_video_info info;
    (void)state;
    make_picture(&info, 64, 48);
    /* Where the picture's top left and top right corners are on the panel. */
    static const uint32_t corners[4][4] = {
        { 0, 0, 63, 0 }, { 47, 0, 47, 63 }, { 63, 47, 0, 47 }, { 0, 63, 0, 0 }
    };
    for (uint8_t turns = 0; turns < 4; turns++) {
        bool sideways = turns & 1;
        struct ow_video_backdrop b =
            begin(&info, sideways ? 48 : 64, sideways ? 64 : 48, turns, 64 * 4);
        const uint32_t *c = corners[turns];
        assert_int_equal(at(&b, c[0], c[1]), 0x000007);
        assert_int_equal(at(&b, c[2], c[3]), 0x3F0007);
    }
}

static void only_what_is_asked_for_is_written(void **state)
{
    struct ow_video_info info;
    _Alignas(4) uint8_t row[256 * 4];
    (void)state;
    make_picture(&info, 200, 10);
    struct ow_video_backdrop b = begin(&info, 200, 10, 0, 800);
    struct ow_backdrop seam = ow_backdrop_of_video(&b);
    memset(row, 0xEE, sizeof row);
    seam.fill(seam.context, &ow_format_xrgb8888, row, 3, 5, 150);
    assert_int_equal(row[4 * 4], 0xEE);
    assert_int_equal(row[150 * 4], 0xEE);
    for (uint32_t x = 5; x < 150; x++) {
        assert_int_equal(ow_format_xrgb8888.get(row, x), x << 16 | 3 << 8 | 7);
    }
}

static void without_a_frame_there_is_the_colour(void **state)
{
    struct ow_video_info info;
    (void)state;
    make_picture(&info, 64, 48);
    struct ow_video_backdrop b = begin(&info, 64, 48, 0, 256);
    b.has_frame = false;
    assert_int_equal(at(&b, 10, 10), 0x123456);
}

/* Grey stays grey, and the primaries come back within the rounding of 8 bits. */
static void yuv_becomes_rgb(void **state)
{
    static const struct {
        uint8_t yuv[3];
        uint32_t rgb;
    } cases[] = {
        { { 16, 128, 128 }, 0x000000 },  { { 235, 128, 128 }, 0xFFFFFF },
        { { 126, 128, 128 }, 0x808080 }, { { 81, 90, 240 }, 0xFF0000 },
        { { 145, 54, 34 }, 0x00FF00 },   { { 41, 240, 110 }, 0x0000FF },
        { { 0, 0, 0 }, 0x008700 },       { { 255, 255, 255 }, 0xFF7DFF },
    };
    static const uint32_t formats[] = { OW_VIDEO_YUYV, OW_VIDEO_NV12 };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (size_t f = 0; f < 2; f++) {
            const uint8_t *yuv = cases[i].yuv;
            struct ow_video_info info = { 8, 8, formats[f], 0, 1 };
            for (uint32_t k = 0; k < 512; k += 2) {
                planes[0][k] = yuv[0];
                planes[0][k + 1] = f == 1 ? yuv[0] : k % 4 == 0 ? yuv[1] : yuv[2];
                planes[1][k] = yuv[1];
                planes[1][k + 1] = yuv[2];
            }
            struct ow_video_backdrop b = begin(&info, 8, 8, 0, 16);
            uint32_t rgb = at(&b, 5, 6);
            for (uint32_t shift = 0; shift < 24; shift += 8) {
                int got = (int)(rgb >> shift & 0xFF);
                int wanted = (int)(cases[i].rgb >> shift & 0xFF);
                assert_true(abs(got - wanted) <= 2);
            }
        }
    }
}

static void rgb565_is_unpacked(void **state)
{
    struct ow_video_info info = { 4, 4, OW_VIDEO_RGB565, 0, 1 };
    (void)state;
    memset(planes[0], 0, 64);
    planes[0][8 + 2] = 0x00; /* line 1, pixel 1: red */
    planes[0][8 + 3] = 0xF8;
    struct ow_video_backdrop b = begin(&info, 4, 4, 0, 8);
    assert_int_equal(at(&b, 1, 1), 0xFF0000);
    assert_int_equal(at(&b, 2, 1), 0x000000);
}

static void what_makes_no_sense_is_refused(void **state)
{
    struct ow_video_backdrop b = { 0 };
    struct ow_video_info info = { 4, 4, OW_VIDEO_RGB565, 0, 1 };
    (void)state;
    assert_int_equal(ow_video_backdrop_begin(&b, &info, 0, 4, 0), OW_ARGUMENT);
    assert_int_equal(ow_video_backdrop_begin(&b, &info, 4, 4, 4), OW_ARGUMENT);
    info.height = 0;
    assert_int_equal(ow_video_backdrop_begin(&b, &info, 4, 4, 0), OW_ARGUMENT);
    info.height = 4;
    info.format = OW_VIDEO_FORMAT('M', 'J', 'P', 'G');
    assert_int_equal(ow_video_backdrop_begin(&b, &info, 4, 4, 0), OW_UNSUPPORTED);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_size_is_covered_from_the_middle),
        cmocka_unit_test(a_turned_picture_stands_upright),
        cmocka_unit_test(only_what_is_asked_for_is_written),
        cmocka_unit_test(without_a_frame_there_is_the_colour),
        cmocka_unit_test(yuv_becomes_rgb),
        cmocka_unit_test(rgb565_is_unpacked),
        cmocka_unit_test(what_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
