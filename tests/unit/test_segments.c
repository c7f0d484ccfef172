/* SPDX-License-Identifier: 0BSD */
/*
 * The dynamic screen with lists of unlit segments: the eight cases of [GC91]'s
 * merge by their numbers, the end of a line and of a band, and the pool.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

#include "random_scene.h"

enum { WIDTH = 200, LINES = 70, WIDTH_MOST = 4096, WORDS = WIDTH_MOST / 32, LIT = 0xFF, TAKEN = 7 };
enum { BACKGROUND = 0x00AA55 };

/* A surface without a core around it. */
static struct {
    uint32_t pixels[LINES][WIDTH_MOST];
    uint32_t pool[LINES * WORDS];
    uint16_t open_pixels[LINES];
    uint32_t open_tiles[WORDS / 32 * 3];
    struct ow_target target;
    struct ow_surface surface;
} screen;

static void begin(const struct ow_surface_kind *kind, uint32_t width, uint32_t lines)
{
    memset(&screen, 0, sizeof screen);
    screen.target = (struct ow_target){ .pixels = (uint8_t *)screen.pixels,
                                        .stride = sizeof screen.pixels[0],
                                        .first_line = 1000,
                                        .line_count = (uint16_t)lines,
                                        .format = &ow_format_xrgb8888 };
    screen.surface = (struct ow_surface){ .target = &screen.target,
                                          .width = width,
                                          .colour = TAKEN,
                                          .unlit = screen.pool,
                                          .words_in_line = (width + 31) / 32,
                                          .open_pixels = screen.open_pixels,
                                          .open_tiles = screen.open_tiles };
    kind->begin(&screen.surface, BACKGROUND);
}

static void take(const struct ow_surface_kind *kind, uint32_t row, uint32_t first, uint32_t end)
{
    const struct ow_span span = { (uint16_t)(1000 + row), (uint16_t)first, (uint16_t)end };
    kind->take(&screen.surface, &span, 1);
}

/* Gives line 0 the unlit segments 40 .. 59, 100 .. 139 and 180 .. 199, and forgets the rest. */
static void three_segments(void)
{
    begin(&ow_surface_segments, WIDTH, 2);
    take(&ow_surface_segments, 0, 0, 40);
    take(&ow_surface_segments, 0, 60, 100);
    take(&ow_surface_segments, 0, 140, 180);
    memset(screen.pixels, LIT, sizeof screen.pixels);
    screen.surface.pixels_written = 0;
    screen.surface.spans_written = 0;
}

/* The merge of one span must paint these runs and leave these segments: first, end, ... */
static void merge_gives(uint32_t first, uint32_t end, const uint32_t *painted,
                        uint32_t painted_count, const uint32_t *left, uint32_t left_count)
{
    three_segments();
    take(&ow_surface_segments, 0, first, end);
    uint32_t pixels = 0;
    uint8_t expected[WIDTH];
    memset(expected, 0, sizeof expected);
    for (uint32_t i = 0; i < painted_count; i += 2) {
        pixels += painted[i + 1] - painted[i];
        memset(expected + painted[i], 1, painted[i + 1] - painted[i]);
    }
    for (uint32_t x = 0; x < WIDTH; x++) {
        assert_int_equal(screen.pixels[0][x] == TAKEN, expected[x]);
    }
    assert_int_equal(screen.surface.pixels_written, pixels);
    assert_int_equal(screen.surface.spans_written, painted_count / 2);
    uint32_t unlit = 0;
    for (uint32_t i = 0; i < left_count; i += 2) {
        assert_int_equal(screen.pool[i / 2] & 0xFFFF, left[i]);
        assert_int_equal(screen.pool[i / 2] >> 16, left[i + 1]);
        unlit += left[i + 1] - left[i];
    }
    assert_int_equal(screen.pool[left_count / 2], 0xFFFFFFFF); /* and no segment more */
    assert_int_equal(screen.open_pixels[0], unlit);
    assert_int_equal(screen.surface.lines_open, unlit > 0 ? 2 : 1);
}

#define RUNS(...) (const uint32_t[]){ __VA_ARGS__ }, sizeof((uint32_t[]){ __VA_ARGS__ }) / 4
#define NO_RUNS NULL, 0

static void case_1_the_span_ends_before_the_segment(void **state)
{
    (void)state;
    merge_gives(10, 40, NO_RUNS, RUNS(40, 60, 100, 140, 180, 200));
    merge_gives(70, 90, NO_RUNS, RUNS(40, 60, 100, 140, 180, 200));
}

static void case_2_the_span_has_the_left_part(void **state)
{
    (void)state;
    merge_gives(90, 120, RUNS(100, 120), RUNS(40, 60, 120, 140, 180, 200));
    merge_gives(100, 139, RUNS(100, 139), RUNS(40, 60, 139, 140, 180, 200));
}

static void case_3_the_span_lies_within_the_segment(void **state)
{
    (void)state;
    merge_gives(101, 139, RUNS(101, 139), RUNS(40, 60, 100, 101, 139, 140, 180, 200));
    merge_gives(45, 50, RUNS(45, 50), RUNS(40, 45, 50, 60, 100, 140, 180, 200));
    merge_gives(185, 186, RUNS(185, 186), RUNS(40, 60, 100, 140, 180, 185, 186, 200));
}

static void case_4_the_span_covers_the_segment_and_ends_with_it(void **state)
{
    (void)state;
    merge_gives(90, 140, RUNS(100, 140), RUNS(40, 60, 180, 200));
    merge_gives(180, 200, RUNS(180, 200), RUNS(40, 60, 100, 140));
}

static void case_5_the_span_has_the_right_part_and_ends_with_the_segment(void **state)
{
    (void)state;
    merge_gives(101, 140, RUNS(101, 140), RUNS(40, 60, 100, 101, 180, 200));
    merge_gives(199, 200, RUNS(199, 200), RUNS(40, 60, 100, 140, 180, 199));
}

/* Then the next segments: 2, 4, 6 or 1 follows. */
static void case_6_the_span_covers_the_segment_and_more(void **state)
{
    (void)state;
    merge_gives(90, 150, RUNS(100, 140), RUNS(40, 60, 180, 200));
    merge_gives(0, 181, RUNS(40, 60, 100, 140, 180, 181), RUNS(181, 200));
    merge_gives(40, 200, RUNS(40, 60, 100, 140, 180, 200), NO_RUNS);
}

static void case_7_the_span_has_the_right_part_and_more(void **state)
{
    (void)state;
    merge_gives(120, 150, RUNS(120, 140), RUNS(40, 60, 100, 120, 180, 200));
    merge_gives(50, 200, RUNS(50, 60, 100, 140, 180, 200), RUNS(40, 50));
    merge_gives(59, 101, RUNS(59, 60, 100, 101), RUNS(40, 59, 101, 140, 180, 200));
}

static void case_8_the_segment_ends_before_the_span(void **state)
{
    (void)state;
    merge_gives(140, 141, NO_RUNS, RUNS(40, 60, 100, 140, 180, 200)); /* 8, 8, then 1 */
    merge_gives(60, 101, RUNS(100, 101), RUNS(40, 60, 101, 140, 180, 200));
}

/* A line that is full costs one test: its list is not read any more. */
static void a_full_line_is_not_looked_at(void **state)
{
    (void)state;
    begin(&ow_surface_segments, WIDTH, 2);
    assert_int_equal(screen.surface.lines_open, 2);
    take(&ow_surface_segments, 0, 0, WIDTH);
    assert_int_equal(screen.surface.lines_open, 1);
    screen.pool[0] = 20 | 30u << 16; /* as if there were a segment */
    screen.pool[1] = 0xFFFFFFFF;
    take(&ow_surface_segments, 0, 0, WIDTH);
    assert_int_equal(screen.surface.pixels_written, WIDTH);
    take(&ow_surface_segments, 1, 100, WIDTH);
    take(&ow_surface_segments, 1, 0, 100);
    assert_int_equal(screen.surface.lines_open, 0); /* the walk ends */
}

/* A line of 200 pixels has room for 6 segments: the 7th makes it bits. The picture stays right. */
static void a_list_that_outgrows_its_room_becomes_bits(void **state)
{
    (void)state;
    begin(&ow_surface_segments, WIDTH, 2);
    for (uint32_t i = 0; i < 5; i++) {
        take(&ow_surface_segments, 0, 10 + 20 * i, 20 + 20 * i);
    }
    assert_int_equal(screen.surface.lines_outgrown, 0);
    take(&ow_surface_segments, 0, 110, 120);
    assert_int_equal(screen.surface.lines_outgrown, 1);
    take(&ow_surface_segments, 0, 115, 145);
    take(&ow_surface_segments, 1, 0, 3);
    assert_int_equal(screen.surface.pixels_written, 60 + 25 + 3);
    for (uint32_t x = 0; x < WIDTH; x++) {
        bool expected = x >= 110 ? x < 145 : x >= 10 && x / 10 % 2 == 1;
        assert_int_equal(screen.pixels[0][x], expected ? TAKEN : 0);
    }
    take(&ow_surface_segments, 0, 0, WIDTH);
    assert_int_equal(screen.surface.pixels_written, WIDTH + 3);
    assert_int_equal(screen.surface.lines_open, 1);
    ow_surface_segments.end(&screen.surface, BACKGROUND);
    assert_int_equal(screen.surface.pixels_written, WIDTH + 3);
    assert_int_equal(screen.surface.pixels_background, WIDTH - 3);
    assert_int_equal(screen.pixels[1][3], BACKGROUND);
}

/* What a box hides: never more than is lit; small boxes exactly. */
static void check_hides(const struct ow_surface_kind *kind, uint8_t lit[LINES][WIDTH_MOST],
                        uint32_t width)
{
    uint32_t left = random_below(width);
    uint32_t right = left + 1 + random_below(width - left);
    uint32_t line = random_below(LINES);
    uint32_t end_line = line + 1 + random_below(LINES - line);
    const struct ow_box box = { .left = (int32_t)left,
                                .right = (int32_t)right,
                                .line = (int32_t)line + 1000,
                                .end_line = (int32_t)end_line + 1000 };
    bool all = true;
    for (; line < end_line; line++) {
        all = all && memchr(&lit[line][left], 0, right - left) == NULL;
    }
    bool hides = kind->hides(&screen.surface, &box);
    assert_true(all || !hides);
    bool small = right - left <= 32 && box.end_line - box.line <= 32;
    assert_true(!small || left / 32 != (right - 1) / 32 || hides == all);
}

/* Spans of all lengths, until all lines are full: checked against one byte a pixel. */
static void fill_at_random(const struct ow_surface_kind *kind, uint32_t width, uint32_t longest)
{
    static uint8_t lit[LINES][WIDTH_MOST];
    uint32_t pixels = 0;
    memset(lit, 0, sizeof lit);
    begin(kind, width, LINES);
    for (uint32_t colour = 1; colour < 6000; colour++) {
        uint32_t row = random_below(LINES);
        uint32_t first = random_below(width);
        uint32_t most = width - first < longest ? width - first : longest;
        uint32_t end = first + 1 + random_below(most);
        uint32_t written = 0;
        screen.surface.colour = colour;
        static uint32_t before[WIDTH_MOST];
        memcpy(before, screen.pixels[row], sizeof before);
        take(kind, row, first, end);
        for (uint32_t x = 0; x < width; x++) {
            bool fresh = x >= first && x < end && !lit[row][x];
            assert_int_equal(screen.pixels[row][x], fresh ? colour : before[x]);
            lit[row][x] |= fresh;
            written += fresh;
        }
        pixels += written;
        assert_int_equal(screen.surface.pixels_written, pixels);
        check_hides(kind, lit, width);
    }
    screen.surface.background = BACKGROUND;
    kind->end(&screen.surface, BACKGROUND);
    assert_int_equal(screen.surface.pixels_background, LINES * width - pixels);
    for (uint32_t row = 0; row < LINES; row++) {
        for (uint32_t x = 0; x < width; x++) {
            assert_int_equal(screen.pixels[row][x] == BACKGROUND, !lit[row][x]);
        }
    }
}

static void random_spans_light_each_pixel_once(void **state)
{
    (void)state;
    static const uint32_t widths[] = { 1, 31, 32, 33, 64, 65, 203, 320 };
    for (uint32_t i = 0; i < sizeof widths / sizeof widths[0]; i++) {
        fill_at_random(&ow_surface_segments, widths[i], 9);
        assert_true(widths[i] <= 64 || screen.surface.lines_outgrown > 0);
        fill_at_random(&ow_surface_segments, widths[i], 4096);
        fill_at_random(&ow_surface_dynamic, widths[i], 40); /* the twin, by the same judge */
    }
}

/* The widest screen: lists there are shorter than their part. */
static void the_widest_line_outgrows_its_list_too(void **state)
{
    (void)state;
    begin(&ow_surface_segments, WIDTH_MOST, 1);
    for (uint32_t x = 1; x < WIDTH_MOST; x += 2) {
        take(&ow_surface_segments, 0, x, x + 1);
    }
    assert_int_equal(screen.surface.lines_outgrown, 1);
    assert_int_equal(screen.surface.pixels_written, WIDTH_MOST / 2);
    take(&ow_surface_segments, 0, 0, WIDTH_MOST);
    assert_int_equal(screen.surface.spans_written, WIDTH_MOST);
    assert_int_equal(screen.surface.lines_open, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(case_1_the_span_ends_before_the_segment),
        cmocka_unit_test(case_2_the_span_has_the_left_part),
        cmocka_unit_test(case_3_the_span_lies_within_the_segment),
        cmocka_unit_test(case_4_the_span_covers_the_segment_and_ends_with_it),
        cmocka_unit_test(case_5_the_span_has_the_right_part_and_ends_with_the_segment),
        cmocka_unit_test(case_6_the_span_covers_the_segment_and_more),
        cmocka_unit_test(case_7_the_span_has_the_right_part_and_more),
        cmocka_unit_test(case_8_the_segment_ends_before_the_span),
        cmocka_unit_test(a_full_line_is_not_looked_at),
        cmocka_unit_test(a_list_that_outgrows_its_room_becomes_bits),
        cmocka_unit_test(random_spans_light_each_pixel_once),
        cmocka_unit_test(the_widest_line_outgrows_its_list_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
