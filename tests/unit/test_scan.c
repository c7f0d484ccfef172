/* SPDX-License-Identifier: 0BSD */
/*
 * The fill rule: spans of random outlines (convex, concave, with holes, crossing
 * themselves, far beyond the screen) against winding numbers by 64-bit integers
 * at every pixel's centre; neighbours neither share a pixel nor leave one out.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ow_coverage.h"

enum { WIDTH = 64, HEIGHT = 48, MOST = 40 };

static uint64_t random_state = 1;
static int sub = OW_SUB; /* of a pixel; a quarter: the fine scan of coverage */

static uint32_t random_below(uint32_t n)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((random_state >> 33) % n);
}

static int random_in(int low, int high)
{
    return low + (int)random_below((uint32_t)(high - low + 1));
}

/* ---- what the core does --------------------------------------------------------------------- */
struct canvas {
    struct ow_span_sink sink; /* first: found from its sink */
    struct ow_window window;
    int32_t line; /* of the last span, and where it ended */
    int32_t end;
    uint8_t hits[HEIGHT][WIDTH];
};

static void take(struct ow_span_sink *sink)
{
    struct canvas *canvas = (struct canvas *)(void *)sink;
    assert_true(sink->count <= sink->capacity);
    for (uint32_t i = 0; i < sink->count; i++) {
        const struct ow_span *span = &sink->spans[i];
        assert_true(span->first < span->end && span->end <= canvas->window.width);
        assert_true(span->line >= canvas->window.first_line &&
                    span->line < canvas->window.end_line);
        assert_true(span->line > canvas->line ||
                    (span->line == canvas->line && span->first >= canvas->end));
        canvas->line = span->line;
        canvas->end = span->end;
        for (uint32_t x = span->first; x < span->end; x++) {
            canvas->hits[span->line][x]++;
        }
    }
    sink->count = 0;
}

/* Adds the outline's pixels to the canvas. The sink holds as many spans as it must, or more. */
static void scan(struct canvas *canvas, const struct ow_outline_point *points, uint32_t count,
                 enum ow_winding rule, uint32_t spare)
{
    uint32_t capacity = (uint32_t)(canvas->window.end_line - canvas->window.first_line) + spare;
    struct ow_span *spans = malloc(capacity * sizeof *spans);
    struct ow_scan_edge *edges = malloc(count * sizeof *edges);
    assert_non_null(spans);
    assert_non_null(edges);
    canvas->sink = (struct ow_span_sink){ spans, 0, capacity, take };
    canvas->line = -1;
    struct ow_box box;
    if (sub != OW_SUB) {
        if (ow_outline_box_4x4(points, count, &canvas->window, &box)) {
            ow_scan_4x4(points, count, rule, &box, edges, &canvas->sink);
        }
    } else if (ow_outline_box(points, count, &canvas->window, &box)) {
        ow_scan(points, count, rule, &box, edges, &canvas->sink);
    }
    assert_int_equal(canvas->sink.count, 0);
    free(edges);
    free(spans);
}

static void clear(struct canvas *canvas)
{
    memset(canvas, 0, sizeof *canvas);
    canvas->window = (struct ow_window){ 0, HEIGHT, WIDTH };
}

/* ---- what is right -------------------------------------------------------------------------- */
/* The edge that goes down from a to b lies left of the point or on it: the rule of ow_scan.h. */
static bool is_right_of(struct ow_outline_point a, struct ow_outline_point b, int64_t x, int64_t y)
{
    int64_t dx = b.x - a.x, dy = b.y - a.y;
    if (llabs(dx) < 120 * OW_SUB && dy < 120 * OW_SUB) {
        return a.x * INT64_C(65536) + dx * 65536 / dy * (y - a.y) <= x * 65536;
    }
    return dx * (y - a.y) <= (x - a.x) * dy;
}

/* Winding at a pixel's centre, counter-clockwise positive on a screen whose y goes down. */
static int winding_at(const struct ow_outline_point *points, uint32_t count, int32_t column,
                      int32_t line)
{
    int64_t x = sub * column + sub / 2, y = sub * line + sub / 2;
    int winding = 0;
    for (uint32_t i = 0; i < count; i++) {
        struct ow_outline_point a = points[i], b = points[(i + 1) % count];
        int down = a.y <= y && y < b.y, up = b.y <= y && y < a.y;
        if (up) {
            struct ow_outline_point swap = a;
            a = b;
            b = swap;
        }
        if ((down || up) && is_right_of(a, b, x, y)) {
            winding += down ? 1 : -1;
        }
    }
    return winding;
}

static void check_outline(const struct ow_outline_point *points, uint32_t count)
{
    static struct canvas canvas;
    for (int rule = 0; rule < 2; rule++) {
        clear(&canvas);
        if (random_below(2)) {
            canvas.window.first_line = random_in(0, HEIGHT - 2);
            canvas.window.end_line = random_in(canvas.window.first_line + 1, HEIGHT);
            canvas.window.width = random_in(1, WIDTH);
        }
        scan(&canvas, points, count, rule ? OW_WINDING_ANY : OW_WINDING_POSITIVE, random_below(5));
        for (int line = 0; line < HEIGHT; line++) {
            for (int x = 0; x < WIDTH; x++) {
                int winding = winding_at(points, count, x, line);
                bool due = line >= canvas.window.first_line && line < canvas.window.end_line &&
                           x < canvas.window.width && (rule ? winding != 0 : winding > 0);
                if (canvas.hits[line][x] != due) {
                    print_error("pixel %d,%d: winding %d, hits %u\n", x, line, winding,
                                canvas.hits[line][x]);
                    fail();
                }
            }
        }
    }
}

static struct ow_outline_point random_point(int reach)
{
    struct ow_outline_point p = { sub / 2 * WIDTH + random_in(-reach, reach),
                                  sub / 2 * HEIGHT + random_in(-reach, reach) };
    if (random_below(4) == 0) { /* on a pixel's centre */
        p.x = (p.x & ~15) + 8;
        p.y = (p.y & ~15) + 8;
    }
    return p;
}

static int random_reach(void)
{
    static const int reaches[] = { 20, 300, 1600, 6400, 11200, 48000, OW_GUARD };
    return reaches[random_below(7)];
}

/* ---- tests ---------------------------------------------------------------------------------- */
static void triangles_cover_their_windings(void **state)
{
    (void)state;
    for (int i = 0; i < 3000; i++) {
        int reach = random_reach();
        struct ow_outline_point p[3];
        for (int k = 0; k < 3; k++) {
            p[k] = random_point(k == 2 && random_below(3) == 0 ? random_reach() : reach);
        }
        check_outline(p, 3);
    }
}

static void any_outline_covers_its_windings(void **state)
{
    (void)state;
    for (int i = 0; i < 1500; i++) {
        struct ow_outline_point p[MOST];
        uint32_t count = 3 + random_below(random_below(2) ? 5 : MOST - 3);
        int reach = random_reach();
        for (uint32_t k = 0; k < count; k++) {
            p[k] = k > 0 && random_below(8) == 0 ? p[random_below(k)] : random_point(reach);
        }
        check_outline(p, count);
    }
}

/* Two chains, both monotone in y, that may cross: the fast path. */
static void monotone_outlines_cover_their_windings(void **state)
{
    (void)state;
    for (int i = 0; i < 1500; i++) {
        struct ow_outline_point p[2 * MOST];
        uint32_t half = 2 + random_below(8), count = 0;
        int reach = random_reach();
        int y = sub / 2 * HEIGHT - reach / 2;
        for (uint32_t k = 0; k < half; k++) {
            y += random_in(0, 2 * reach / (int)half);
            y = y > sub / 2 * HEIGHT + reach ? sub / 2 * HEIGHT + reach : y;
            p[count++] = (struct ow_outline_point){ sub / 2 * WIDTH + random_in(-reach, reach), y };
        }
        for (uint32_t k = 0; k < half; k++) {
            y -= random_in(0, 2 * reach / (int)half);
            y = y < sub / 2 * HEIGHT - reach ? sub / 2 * HEIGHT - reach : y;
            p[count++] = (struct ow_outline_point){ sub / 2 * WIDTH + random_in(-reach, reach), y };
        }
        check_outline(p, count);
    }
}

/* A square with a square hole, joined by a bridge that runs there and back. */
static void holes_stay_empty(void **state)
{
    (void)state;
    static const struct ow_outline_point p[] = { { 1600, 1600 },  { 1600, 9600 }, { 11200, 9600 },
                                                 { 11200, 1600 }, { 1600, 1600 }, { 4800, 4800 },
                                                 { 8000, 4800 },  { 8000, 7200 }, { 4800, 7200 },
                                                 { 4800, 4800 } };
    static struct canvas canvas;
    clear(&canvas);
    scan(&canvas, p, 10, OW_WINDING_POSITIVE, 0);
    check_outline(p, 10);
    assert_int_equal(canvas.hits[10][10], 1);
    assert_int_equal(canvas.hits[22][25], 0);
    assert_int_equal(canvas.hits[22][40], 1);
    assert_int_equal(canvas.hits[40][25], 0);
}

static void backs_have_no_pixels_and_any_has_the_same(void **state)
{
    (void)state;
    static struct canvas front, back;
    for (int i = 0; i < 500; i++) {
        struct ow_outline_point p[3], q[3];
        for (int k = 0; k < 3; k++) {
            p[k] = random_point(500);
            q[2 - k] = p[k];
        }
        clear(&front);
        clear(&back);
        scan(&front, p, 3, OW_WINDING_POSITIVE, 0);
        scan(&front, q, 3, OW_WINDING_POSITIVE, 0);
        scan(&back, q, 3, OW_WINDING_ANY, 0);
        assert_memory_equal(front.hits, back.hits, sizeof front.hits);
    }
}

/*
 * A mesh of jittered quadrilaterals, some cut into triangles, some merged in
 * pairs: outlines may fold over, yet windings add up to one everywhere inside.
 */
enum { ACROSS = 9, DOWN = 7 };

static void make_grid(struct ow_outline_point grid[DOWN + 1][ACROSS + 1], int jitter)
{
    for (int y = 0; y <= DOWN; y++) {
        for (int x = 0; x <= ACROSS; x++) {
            bool border = x == 0 || y == 0 || x == ACROSS || y == DOWN;
            int by = border ? 0 : jitter;
            grid[y][x].x = OW_SUB * WIDTH * x / ACROSS + random_in(-by, by);
            grid[y][x].y = OW_SUB * HEIGHT * y / DOWN + random_in(-by, by);
        }
    }
}

static void scan_cell(struct canvas *canvas, struct ow_outline_point a, struct ow_outline_point b,
                      struct ow_outline_point c, struct ow_outline_point d)
{
    /* a top left, b bottom left, c bottom right, d top right: counter-clockwise. */
    const struct ow_outline_point whole[4] = { a, b, c, d }, one[3] = { a, b, c },
                                  two[3] = { a, c, d }, three[3] = { a, b, d },
                                  four[3] = { d, b, c };
    switch (random_below(3)) {
    case 0:
        scan(canvas, whole, 4, OW_WINDING_POSITIVE, 0);
        break;
    case 1:
        scan(canvas, one, 3, OW_WINDING_POSITIVE, 0);
        scan(canvas, two, 3, OW_WINDING_POSITIVE, 0);
        break;
    default:
        scan(canvas, three, 3, OW_WINDING_POSITIVE, 0);
        scan(canvas, four, 3, OW_WINDING_POSITIVE, 0);
        break;
    }
}

static void scan_grid(struct canvas *canvas, struct ow_outline_point grid[DOWN + 1][ACROSS + 1])
{
    clear(canvas);
    for (int y = 0; y < DOWN; y++) {
        for (int x = 0; x < ACROSS; x++) {
            scan_cell(canvas, grid[y][x], grid[y + 1][x], grid[y + 1][x + 1], grid[y][x + 1]);
        }
    }
}

static void meshes_cover_each_pixel_once(void **state)
{
    (void)state;
    static struct canvas canvas;
    struct ow_outline_point grid[DOWN + 1][ACROSS + 1];
    for (int i = 0; i < 400; i++) {
        /* A jitter below a quarter of a cell leaves every quadrilateral convex. */
        make_grid(grid, 26);
        scan_grid(&canvas, grid);
        for (int y = 0; y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                assert_int_equal(canvas.hits[y][x], 1);
            }
        }
    }
}

static void folded_meshes_leave_no_hole(void **state)
{
    (void)state;
    static struct canvas canvas;
    struct ow_outline_point grid[DOWN + 1][ACROSS + 1];
    for (int i = 0; i < 400; i++) {
        make_grid(grid, 300);
        scan_grid(&canvas, grid);
        for (int y = 0; y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                assert_true(canvas.hits[y][x] >= 1);
            }
        }
    }
}

/* The fine scan keeps the same rule: positions and slopes stay, pixels are a quarter as large. */
static void the_fine_scan_covers_its_windings(void **state)
{
    sub = OW_SUB / 4;
    triangles_cover_their_windings(state);
    any_outline_covers_its_windings(state);
    monotone_outlines_cover_their_windings(state);
    sub = OW_SUB;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_cover_their_windings),
        cmocka_unit_test(any_outline_covers_its_windings),
        cmocka_unit_test(monotone_outlines_cover_their_windings),
        cmocka_unit_test(the_fine_scan_covers_its_windings),
        cmocka_unit_test(holes_stay_empty),
        cmocka_unit_test(backs_have_no_pixels_and_any_has_the_same),
        cmocka_unit_test(meshes_cover_each_pixel_once),
        cmocka_unit_test(folded_meshes_leave_no_hole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
