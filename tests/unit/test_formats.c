/* SPDX-License-Identifier: 0BSD */
/*
 * Pixel formats: round trips, nearest levels, fills and stores of every run in
 * a short row against a reference that sets single bits, and the dither.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ow_dither.h"
#include "ow_pixel.h"

enum { WIDTH = 37, GUARD = 16, ROW_BYTES = 4 * WIDTH + 2 * GUARD + 4 };

static uint64_t random_state = 1;

static uint32_t random_below(uint32_t n)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((random_state >> 33) % n);
}

/* ---- what the formats are, said a second time ------------------------------------------------ */
struct layout {
    const char *name;
    uint32_t bits;
    uint32_t levels[3]; /* highest level of each channel; grey: of the first */
    uint32_t shift[3];
    bool grey;
    bool big_endian; /* of words of several bytes */
};

static const struct layout layouts[] = {
    { "xrgb8888", 32, { 255, 255, 255 }, { 16, 8, 0 }, false, false },
    { "rgb565", 16, { 31, 63, 31 }, { 11, 5, 0 }, false, false },
    { "rgb565-be", 16, { 31, 63, 31 }, { 11, 5, 0 }, false, true },
    { "rgb332", 8, { 7, 7, 3 }, { 5, 2, 0 }, false, false },
    { "gray8", 8, { 255, 0, 0 }, { 0, 0, 0 }, true, false },
    { "gray4", 4, { 15, 0, 0 }, { 0, 0, 0 }, true, false },
    { "mono", 1, { 1, 0, 0 }, { 0, 0, 0 }, true, false },
};
enum { LAYOUTS = sizeof layouts / sizeof layouts[0] };

static const struct ow_pixel_format *format_of(const struct layout *layout)
{
    const struct ow_pixel_format *format = ow_format_by_name(layout->name);
    assert_non_null(format);
    assert_string_equal(format->name, layout->name);
    assert_int_equal(format->bits, layout->bits);
    return format;
}

static double luminance(uint32_t rgb)
{
    return 0.299 * (rgb >> 16 & 255) + 0.587 * (rgb >> 8 & 255) + 0.114 * (rgb & 255);
}

/* Channel i of a packed value, and of a colour, 0 .. 255. */
static double packed_channel(const struct layout *layout, uint32_t value, int i)
{
    return (value >> layout->shift[i] & layout->levels[i]) * 255.0 / layout->levels[i];
}

static double channel(const struct layout *layout, uint32_t rgb, int i)
{
    return layout->grey ? luminance(rgb) : rgb >> (16 - 8 * i) & 255;
}

static int channels(const struct layout *layout)
{
    return layout->grey ? 1 : 3;
}

/* Sets pixel x of a row bit by bit. */
static void set_pixel(const struct layout *layout, uint8_t *row, uint32_t x, uint32_t value)
{
    for (uint32_t bit = 0; bit < layout->bits; bit++) {
        uint32_t place; /* of the bit in the row: byte * 8 + bit of the byte */
        if (layout->bits < 8) {
            place = x * layout->bits / 8 * 8 + (8 - layout->bits) - x * layout->bits % 8 + bit;
        } else {
            uint32_t byte = bit / 8;
            byte = layout->big_endian ? layout->bits / 8 - 1 - byte : byte;
            place = (x * layout->bits / 8 + byte) * 8 + bit % 8;
        }
        uint32_t mask = 1u << place % 8;
        uint8_t *byte = &row[place / 8];
        *byte = (uint8_t)(value >> bit & 1 ? *byte | mask : *byte & ~mask);
    }
}

static uint32_t random_colour(void)
{
    return random_below(1 << 24);
}

static void test_names(void **state)
{
    (void)state;
    assert_int_equal(ow_format_count, LAYOUTS);
    for (uint32_t i = 0; i < ow_format_count; i++) {
        assert_ptr_equal(ow_format_by_name(ow_formats[i]->name), ow_formats[i]);
    }
    assert_ptr_equal(ow_format_by_name("rgb565-be"), &ow_format_rgb565_be);
    assert_null(ow_format_by_name("rgb56"));
    assert_null(ow_format_by_name("rgb5650"));
    assert_null(ow_format_by_name(""));
}

static void test_round_trip(void **state)
{
    (void)state;
    for (int i = 0; i < LAYOUTS; i++) {
        const struct ow_pixel_format *format = format_of(&layouts[i]);
        uint32_t values = layouts[i].bits > 16 ? 1u << 16 : 1u << layouts[i].bits;
        for (uint32_t n = 0; n < values; n++) {
            uint32_t value = (layouts[i].bits > 16 ? n * 257 : n) & format->used;
            assert_int_equal(format->pack(format->unpack(value)), value);
        }
        for (uint32_t t = 0; format->dither != NULL && t < 64; t++) {
            assert_int_equal(format->dither(0, t), 0);
            assert_int_equal(format->dither(0xFFFFFF, t), format->used);
        }
        assert_int_equal(format->unpack(format->pack(0)), 0);
        assert_int_equal(format->unpack(format->pack(0xFFFFFF)), 0xFFFFFF);
        assert_int_equal(format->pack(0xFFFFFF), format->used);
    }
}

/* No level is nearer to a channel than the one that is packed, nor to what is unpacked. */
static void test_nearest_level(void **state)
{
    (void)state;
    for (int i = 0; i < LAYOUTS; i++) {
        const struct layout *layout = &layouts[i];
        const struct ow_pixel_format *format = format_of(layout);
        for (int n = 0; n < 20000; n++) {
            uint32_t rgb = n < 256 ? (uint32_t)n * 0x010101 : random_colour();
            uint32_t value = format->pack(rgb);
            assert_int_equal(value & ~format->used, 0);
            for (int c = 0; c < channels(layout); c++) {
                double step = 255.0 / layout->levels[c];
                double slack = layout->grey ? 0.01 : 1e-9; /* the weights are integers */
                double off = packed_channel(layout, value, c) - channel(layout, rgb, c);
                assert_true(off <= step / 2 + slack && off >= -step / 2 - slack);
                double back = channel(layout, format->unpack(value), c);
                double unpacked = back - packed_channel(layout, value, c);
                assert_true(unpacked <= 0.5 + 1e-9 && unpacked >= -0.5 - 1e-9);
            }
        }
    }
}

/* ---- rows ------------------------------------------------------------------------------------ */
struct rows {
    uint8_t *got; /* pixels, aligned, with guard bytes on both sides */
    uint8_t *expected;
    uint8_t *memory[2];
};

static void rows_make(struct rows *rows)
{
    for (int i = 0; i < 2; i++) {
        rows->memory[i] = malloc(ROW_BYTES);
        assert_non_null(rows->memory[i]);
    }
    rows->got = rows->memory[0] + GUARD;
    rows->expected = rows->memory[1] + GUARD;
}

static void rows_shuffle(struct rows *rows)
{
    for (int i = 0; i < ROW_BYTES; i++) {
        rows->memory[0][i] = rows->memory[1][i] = (uint8_t)random_below(256);
    }
}

static void rows_compare(const struct rows *rows)
{
    assert_memory_equal(rows->memory[0], rows->memory[1], ROW_BYTES);
}

static void rows_free(struct rows *rows)
{
    free(rows->memory[0]);
    free(rows->memory[1]);
}

static void test_fill(void **state)
{
    (void)state;
    struct rows rows;
    rows_make(&rows);
    for (int i = 0; i < LAYOUTS; i++) {
        const struct ow_pixel_format *format = format_of(&layouts[i]);
        for (uint32_t first = 0; first <= WIDTH; first++) {
            for (uint32_t end = 0; end <= WIDTH; end++) {
                uint32_t value = random_colour() & format->used;
                rows_shuffle(&rows);
                for (uint32_t x = first; x < end; x++) {
                    set_pixel(&layouts[i], rows.expected, x, value);
                }
                format->fill(rows.got, first, end, value);
                rows_compare(&rows);
                if (first < end) {
                    assert_int_equal(format->get(rows.got, first), value);
                    assert_int_equal(format->get(rows.got, end - 1), value);
                }
            }
        }
    }
    rows_free(&rows);
}

static void test_store(void **state)
{
    (void)state;
    struct rows rows;
    uint32_t rgb[WIDTH];
    rows_make(&rows);
    for (int i = 0; i < LAYOUTS; i++) {
        const struct ow_pixel_format *format = format_of(&layouts[i]);
        for (uint32_t first = 0; first <= WIDTH; first++) {
            for (uint32_t end = first; end <= WIDTH; end++) {
                rows_shuffle(&rows);
                for (uint32_t x = first; x < end; x++) {
                    rgb[x - first] = random_colour();
                    set_pixel(&layouts[i], rows.expected, x, format->pack(rgb[x - first]));
                }
                format->store(rows.got, first, end, rgb);
                rows_compare(&rows);
            }
        }
    }
    rows_free(&rows);
}

/* ---- dither ---------------------------------------------------------------------------------- */
/* Bayer's matrix by its recursive definition. */
static uint32_t bayer(uint32_t x, uint32_t y, uint32_t size)
{
    static const uint32_t quarter[2][2] = { { 0, 2 }, { 3, 1 } };
    uint32_t value = 0;
    for (uint32_t weight = size * size / 4; weight > 0; weight /= 4) {
        value += weight * quarter[y & 1][x & 1];
        x >>= 1;
        y >>= 1;
    }
    return value;
}

static void test_thresholds(void **state)
{
    (void)state;
    for (uint32_t y = 0; y < 40; y++) {
        for (uint32_t x = 0; x < 40; x++) {
            assert_int_equal(ow_dither_threshold(x, y), bayer(x & 7, y & 7, 8));
        }
    }
}

/* Each pixel has a level next to the colour, and the mean over 8x8 is the colour to 1/64 level. */
static void test_dither_mean(void **state)
{
    (void)state;
    for (int i = 0; i < LAYOUTS; i++) {
        const struct layout *layout = &layouts[i];
        const struct ow_pixel_format *format = format_of(layout);
        assert_true((format->dither == NULL) == (layout->levels[0] == 255));
        for (int n = 0; format->dither != NULL && n < 2000; n++) {
            uint32_t rgb = n < 256 ? (uint32_t)n * 0x010101 : random_colour();
            double sum[3] = { 0, 0, 0 };
            for (uint32_t t = 0; t < 64; t++) {
                uint32_t value = format->dither(rgb, t);
                for (int c = 0; c < channels(layout); c++) {
                    double off = packed_channel(layout, value, c) - channel(layout, rgb, c);
                    double step = 255.0 / layout->levels[c];
                    assert_true(off < step && off > -step);
                    sum[c] += off;
                }
            }
            for (int c = 0; c < channels(layout); c++) {
                double share = sum[c] / 64 * layout->levels[c] / 255;
                assert_true(share < 1.01 / 64 && share > -1.01 / 64);
            }
        }
    }
}

static void test_dither_runs(void **state)
{
    (void)state;
    struct rows rows;
    uint32_t rgb[WIDTH];
    rows_make(&rows);
    for (int i = 0; i < LAYOUTS; i++) {
        const struct ow_pixel_format *format = format_of(&layouts[i]);
        for (uint32_t first = 0; format->dither != NULL && first <= WIDTH; first++) {
            for (uint32_t end = first; end <= WIDTH; end++) {
                uint32_t y = random_below(20);
                uint32_t colour = random_colour();
                bool one_colour = random_below(2) == 0;
                rows_shuffle(&rows);
                for (uint32_t x = first; x < end; x++) {
                    rgb[x - first] = one_colour ? colour : random_colour();
                    set_pixel(&layouts[i], rows.expected, x,
                              format->dither(rgb[x - first], bayer(x & 7, y & 7, 8)));
                }
                if (one_colour) {
                    ow_dithering.fill(format, rows.got, y, first, end, colour);
                } else {
                    ow_dithering.store(format, rows.got, y, first, end, rgb);
                }
                rows_compare(&rows);
            }
        }
    }
    rows_free(&rows);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names),         cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_nearest_level), cmocka_unit_test(test_fill),
        cmocka_unit_test(test_store),         cmocka_unit_test(test_thresholds),
        cmocka_unit_test(test_dither_mean),   cmocka_unit_test(test_dither_runs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
