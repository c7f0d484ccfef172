/* SPDX-License-Identifier: 0BSD */
/*
 * Lines against their rule: each edge's pixels by exact integers at every
 * pixel, faces farthest first; every order, any band, and one bit a pixel.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ow_lines.h"
#include "tests/property/blob_builder.h"
#include "tests/unit/random_scene.h"

enum { WIDTH = 97, HEIGHT = 61, FACES = 40, STRIDE = 4 * WIDTH, MOST_CORNERS = 16 };

/* ---- the rule --------------------------------------------------------------------------------- */
struct canvas {
    struct ow_span_sink sink; /* first: found from its sink */
    bool line[HEIGHT][WIDTH];
};

static void take_inside(struct ow_span_sink *sink)
{
    struct canvas *canvas = (struct canvas *)(void *)sink;
    for (uint32_t i = 0; i < sink->count; i++) {
        const struct ow_span *span = &sink->spans[i];
        memset(&canvas->line[span->line][span->first], false, span->end - span->first);
    }
    sink->count = 0;
}

static int64_t floor_divide(int64_t n, int64_t d)
{
    int64_t quotient = n / d;
    return quotient * d > n ? quotient - 1 : quotient;
}

static bool holds(int64_t pixel, int64_t coordinate)
{
    return floor_divide(coordinate, OW_SUB) == pixel;
}

/* True if the edge passes the pixel's centre on axis m at a point of the pixel. */
static bool passes(const int64_t a[2], const int64_t b[2], const int64_t pixel[2], int m)
{
    int64_t low = a[m] < b[m] ? a[m] : b[m];
    int64_t high = a[m] < b[m] ? b[m] : a[m];
    int64_t centre = pixel[m] * OW_SUB + OW_SUB / 2;
    if (centre < low || centre >= high) {
        return false;
    }
    int64_t length = b[m] - a[m];
    int64_t place = a[1 - m] * length + (b[1 - m] - a[1 - m]) * (centre - a[m]);
    if (length < 0) {
        length = -length;
        place = -place;
    }
    return floor_divide(place, length * OW_SUB) == pixel[1 - m];
}

static void paint_edge(struct canvas *canvas, struct ow_outline_point p, struct ow_outline_point q)
{
    const int64_t a[2] = { p.x, p.y };
    const int64_t b[2] = { q.x, q.y };
    int m = llabs(b[0] - a[0]) >= llabs(b[1] - a[1]) ? 0 : 1;
    for (int64_t y = 0; y < HEIGHT; y++) {
        for (int64_t x = 0; x < WIDTH; x++) {
            const int64_t pixel[2] = { x, y };
            canvas->line[y][x] |= passes(a, b, pixel, m) || (holds(x, a[0]) && holds(y, a[1])) ||
                                  (holds(x, b[0]) && holds(y, b[1]));
        }
    }
}

static bool is_marked(const struct ow_tree *tree, uint32_t at, uint32_t edge)
{
    const uint8_t *record = tree->bytes + at;
    return (record[5] & 0x10) && (record[tree->corners_in_record + 2 * record[0]] >> edge & 1);
}

static void paint_face(struct canvas *canvas, const struct random_scene *scene,
                       const struct ow_view *view, const struct ow_face *face)
{
    static const struct ow_window window = { 0, HEIGHT, WIDTH };
    struct ow_outline_point p[MOST_CORNERS];
    struct ow_scan_edge edges[MOST_CORNERS];
    struct ow_box box;
    uint32_t count = random_scene_outline(scene, view, face, p);
    int64_t area = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct ow_outline_point *next = &p[(i + 1) % count];
        area += (int64_t)p[i].x * next->y - (int64_t)next->x * p[i].y;
    }
    if (area >= 0) {
        return;
    }
    if (ow_outline_box(p, count, &window, &box)) {
        ow_scan(p, count, OW_WINDING_POSITIVE, &box, edges, &canvas->sink);
    }
    for (uint32_t i = 0; i < count; i++) {
        if (!is_marked(&scene->tree, face->at, i)) {
            paint_edge(canvas, p[i], p[(i + 1) % count]);
        }
    }
}

static void paint_reference(struct canvas *canvas, const struct random_scene *scene,
                            const struct ow_view *view)
{
    static struct ow_span spans[HEIGHT];
    struct ow_walk walk;
    struct ow_face face;
    void *stack = malloc(ow_walk_stack_bytes(&scene->tree));
    assert_non_null(stack);
    memset(canvas->line, false, sizeof canvas->line);
    canvas->sink = (struct ow_span_sink){ spans, 0, HEIGHT, take_inside };
    assert_int_equal(
        ow_walk_begin(&walk, &scene->tree, view, OW_FARTHEST_FIRST, OW_CULL_BACK, stack), OW_OK);
    while (ow_walk_next(&walk, &face)) {
        paint_face(canvas, scene, view, &face);
    }
    free(stack);
}

/* ---- the core --------------------------------------------------------------------------------- */
static void draw(struct random_scene *scene, const struct ow_view *view, enum ow_order order,
                 const struct ow_pixel_format *format, uint32_t band_lines, uint8_t *pixels)
{
    struct ow_workspace_config config = { .parts = &ow_parts_all,
                                          .width = WIDTH,
                                          .lines = (uint16_t)band_lines,
                                          .height = HEIGHT,
                                          .listed_faces = ow_listed_faces_max(&scene->tree) };
    struct ow_look look = random_scene_look(OW_SHADE_LINES);
    look.order = order;
    look.cull = OW_CULL_BACK;
    random_scene_place(scene, &config);
    memset(pixels, 0xA5, STRIDE * HEIGHT);
    assert_int_equal(ow_draw_begin(&scene->tree, view, &look, &scene->workspace), OW_OK);
    for (uint32_t line = 0; line < HEIGHT; line += band_lines) {
        uint32_t lines = HEIGHT - line < band_lines ? HEIGHT - line : band_lines;
        struct ow_target target = { pixels + line * STRIDE, STRIDE, (uint16_t)line,
                                    (uint16_t)lines,        format, NULL };
        assert_int_equal(ow_draw_band(&scene->workspace, &target, NULL), OW_OK);
    }
}

static uint32_t compare(const struct canvas *canvas, const struct ow_pixel_format *format,
                        const uint8_t *pixels)
{
    struct ow_look look = random_scene_look(OW_SHADE_LINES);
    uint32_t count = 0;
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t x = 0; x < WIDTH; x++) {
            uint32_t rgb = canvas->line[y][x] ? look.foreground : look.background;
            assert_int_equal(format->get(pixels + y * STRIDE, x) & format->used, format->pack(rgb));
            count += canvas->line[y][x];
        }
    }
    return count;
}

static void test_rule(void **state)
{
    (void)state;
    static struct canvas canvas;
    static uint32_t pixels[WIDTH * HEIGHT];
    static const uint32_t bands[] = { HEIGHT, 1, 8 };
    static const enum ow_order orders[] = { OW_FRONT_TO_BACK, OW_BACK_TO_FRONT, OW_SCAN_LINE };
    struct random_scene scene;
    uint32_t lines = 0;
    for (uint32_t i = 0; i < 12; i++) {
        random_scene_make(&scene, FACES, false);
        struct ow_view view = random_scene_view(&scene, i, WIDTH, HEIGHT);
        paint_reference(&canvas, &scene, &view);
        for (uint32_t k = 0; k < 9; k++) {
            draw(&scene, &view, orders[k / 3], &ow_format_xrgb8888, bands[k % 3],
                 (uint8_t *)pixels);
            lines += compare(&canvas, &ow_format_xrgb8888, (uint8_t *)pixels);
        }
        draw(&scene, &view, OW_FRONT_TO_BACK, &ow_format_mono, 13, (uint8_t *)pixels);
        (void)compare(&canvas, &ow_format_mono, (uint8_t *)pixels);
        random_scene_free(&scene);
    }
    assert_true(lines > 12 * 9 * 200);
}

/* Marks of reverse faces, and of more than 16 corners. */
static void test_marks(void **state)
{
    (void)state;
    enum { CORNERS = 35 };
    struct builder *b = builder_new(OW_TREE_TWO_SIDED);
    uint32_t corners[CORNERS];
    uint32_t root = builder_sequence(b);
    uint32_t size;
    struct ow_tree tree;
    for (uint32_t i = 0; i < CORNERS; i++) {
        corners[i] = builder_vertex(b, (int)(i * i), (int)(i * 100), 0);
    }
    uint32_t colour = builder_colour(b, 0xFFFFFF);
    uint32_t polygon = builder_polygon(b, corners, CORNERS, colour, 1);
    builder_mark(b, polygon, 0);
    builder_mark(b, polygon, 17);
    builder_mark(b, polygon, 34);
    builder_add(b, root, OW_ITEM_FACE, polygon);
    builder_add(b, root, OW_ITEM_REVERSE, polygon);
    uint8_t *blob = builder_finish(b, root, &size);
    assert_int_equal(ow_tree_open(&tree, blob, size), OW_OK);
    struct ow_face face = { .at = tree.polygons_at, .reverse = false };
    for (uint32_t i = 0; i < CORNERS; i++) {
        assert_int_equal(ow_edge_is_marked(&tree, &face, i), i == 0 || i == 17 || i == 34);
    }
    /* Backwards corner i is CORNERS-1-i, and the edge from it leads to corner CORNERS-2-i. */
    face.reverse = true;
    for (uint32_t i = 0; i < CORNERS; i++) {
        uint32_t edge = (2 * CORNERS - 2 - i) % CORNERS;
        assert_int_equal(ow_edge_is_marked(&tree, &face, i), edge == 0 || edge == 17 || edge == 34);
    }
    free(blob);
    free(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rule),
        cmocka_unit_test(test_marks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
