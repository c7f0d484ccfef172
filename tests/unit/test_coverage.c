/* SPDX-License-Identifier: 0BSD */
/*
 * Coverage against its definition: the same vertex positions drawn by the fine
 * scan, face over face, on a screen of four times the width and height, 16 of its
 * pixels summed and rounded once. Flat shading is equal bit for bit.
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
#include "ow_dither.h"
#include "tests/unit/random_scene.h"

enum { WIDTH = 75, HEIGHT = 53, FINE_WIDTH = 4 * WIDTH, FINE_HEIGHT = 4 * HEIGHT, FACES = 60 };
enum { STRIDE = 4 * WIDTH, MOST_CORNERS = 16 };

/* ---- the definition --------------------------------------------------------------------------- */
struct canvas {
    struct ow_span_sink sink; /* first: found from its sink */
    const struct ow_shader *shader;
    struct ow_gradient *gradient; /* NULL: flat */
    uint32_t rgb;
    uint32_t colours[FINE_HEIGHT][FINE_WIDTH];
    bool model[FINE_HEIGHT][FINE_WIDTH];
};

static uint32_t fine_colour(struct canvas *canvas, uint32_t line, uint32_t x)
{
    struct ow_corner_light light;
    if (canvas->gradient == NULL) {
        return canvas->rgb;
    }
    if (canvas->gradient->line != (int32_t)line) {
        ow_gradient_line(canvas->gradient, (int32_t)line);
    }
    for (uint32_t i = 0; i < canvas->gradient->parts; i++) {
        light.part[i] = ow_ramp_value(&canvas->gradient->ramp[i], x);
    }
    return ow_shade_pixel(canvas->shader, canvas->rgb, &light);
}

static void take(struct ow_span_sink *sink)
{
    struct canvas *canvas = (struct canvas *)(void *)sink;
    for (uint32_t i = 0; i < sink->count; i++) {
        const struct ow_span *span = &sink->spans[i];
        for (uint32_t x = span->first; x < span->end; x++) {
            canvas->colours[span->line][x] = fine_colour(canvas, span->line, x);
            canvas->model[span->line][x] = true;
        }
    }
    sink->count = 0;
}

/* One face on the fine screen, over what is there. */
static void paint_face(struct canvas *canvas, const struct random_scene *scene,
                       const struct ow_view *view, const struct ow_face *face, enum ow_winding rule)
{
    static const struct ow_window window = { 0, FINE_HEIGHT, FINE_WIDTH };
    struct ow_outline_point points[MOST_CORNERS];
    struct ow_outline_point larger[MOST_CORNERS]; /* in 1/256 of the fine screen's pixels */
    struct ow_corner_light lights[MOST_CORNERS];
    struct ow_scan_edge edges[MOST_CORNERS];
    struct ow_gradient gradient = { .beside = false };
    struct ow_box box;
    uint32_t count = random_scene_outline(scene, view, face, points);
    bool smooth = ow_shade_is_smooth(canvas->shader->shade);
    for (uint32_t i = 0; i < count; i++) {
        larger[i] = (struct ow_outline_point){ points[i].x * 4, points[i].y * 4 };
        if (smooth) {
            ow_shade_corner(canvas->shader, &scene->tree, ow_corner(&scene->tree, face->at, i),
                            false, &lights[i]);
        }
    }
    canvas->gradient = NULL;
    if (smooth) {
        canvas->rgb = ow_face_colour(canvas->shader, &scene->tree, face);
        ow_gradient_begin(&gradient, larger, lights, count, canvas->shader->parts);
        canvas->gradient = &gradient;
    } else {
        canvas->rgb = ow_shade_face(canvas->shader, &scene->tree, face);
    }
    if (ow_outline_box_4x4(points, count, &window, &box)) {
        ow_scan_4x4(points, count, rule, &box, edges, &canvas->sink);
    }
    canvas->gradient = NULL;
}

static void paint_reference(struct canvas *canvas, struct random_scene *scene,
                            const struct ow_view *view, const struct ow_look *look)
{
    static struct ow_span spans[FINE_HEIGHT];
    struct ow_shader shader;
    struct ow_walk walk;
    struct ow_face face;
    void *stack = malloc(ow_walk_stack_bytes(&scene->tree));
    assert_non_null(stack);
    ow_shader_make(&shader, &ow_parts_all, look, view);
    canvas->sink = (struct ow_span_sink){ spans, 0, FINE_HEIGHT, take };
    canvas->shader = &shader;
    memset(canvas->model, 0, sizeof canvas->model);
    for (uint32_t i = 0; i < FINE_WIDTH * FINE_HEIGHT; i++) {
        canvas->colours[i / FINE_WIDTH][i % FINE_WIDTH] = look->background;
    }
    assert_int_equal(ow_walk_begin(&walk, &scene->tree, view, OW_FARTHEST_FIRST, look->cull, stack),
                     OW_OK);
    enum ow_winding rule = walk.reject_backs ? OW_WINDING_POSITIVE : OW_WINDING_ANY;
    while (ow_walk_next(&walk, &face)) {
        paint_face(canvas, scene, view, &face, rule);
    }
    free(stack);
}

static uint32_t reference_pixel(const struct canvas *canvas, uint32_t x, uint32_t y, bool *model)
{
    uint32_t sum[3] = { 0, 0, 0 };
    *model = false;
    for (uint32_t i = 0; i < 16; i++) {
        uint32_t rgb = canvas->colours[4 * y + i / 4][4 * x + i % 4];
        *model |= canvas->model[4 * y + i / 4][4 * x + i % 4];
        for (uint32_t c = 0; c < 3; c++) {
            sum[c] += rgb >> (16 - 8 * c) & 255;
        }
    }
    return (sum[0] + 8) / 16 << 16 | (sum[1] + 8) / 16 << 8 | (sum[2] + 8) / 16;
}

/* ---- the core --------------------------------------------------------------------------------- */
static void draw(struct random_scene *scene, const struct ow_view *view, const struct ow_look *look,
                 const struct ow_pixel_format *format, uint32_t band_lines, uint8_t *pixels,
                 struct ow_stats *stats)
{
    struct ow_workspace_config config = {
        .parts = &ow_parts_all, .width = WIDTH, .lines = (uint16_t)band_lines, .coverage = true
    };
    random_scene_place(scene, &config);
    memset(pixels, 0xA5, STRIDE * HEIGHT);
    assert_int_equal(ow_draw_begin(&scene->tree, view, look, &scene->workspace), OW_OK);
    for (uint32_t line = 0; line < HEIGHT; line += band_lines) {
        uint32_t lines = HEIGHT - line < band_lines ? HEIGHT - line : band_lines;
        struct ow_target target = { pixels + line * STRIDE, STRIDE, (uint16_t)line,
                                    (uint16_t)lines,        format, NULL };
        assert_int_equal(ow_draw_band(&scene->workspace, &target, stats), OW_OK);
    }
}

static void compare(const struct canvas *canvas, const struct ow_pixel_format *format, bool dither,
                    const uint8_t *pixels, const struct ow_stats *stats)
{
    uint32_t of_model = 0;
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t x = 0; x < WIDTH; x++) {
            bool model;
            uint32_t rgb = reference_pixel(canvas, x, y, &model);
            uint32_t expected =
                dither ? format->dither(rgb, ow_dither_threshold(x, y)) : format->pack(rgb);
            assert_int_equal(format->get(pixels + y * STRIDE, x) & format->used, expected);
            of_model += model;
        }
    }
    assert_int_equal(stats->pixels_written, of_model);
    assert_int_equal(stats->pixels_background, WIDTH * HEIGHT - of_model);
}

static void test_flat_is_exact(void **state)
{
    (void)state;
    static struct canvas canvas;
    static uint32_t pixels[WIDTH * HEIGHT];
    static const uint32_t bands[] = { HEIGHT, 1, 7 };
    struct random_scene scene;
    struct ow_stats stats;
    uint32_t seen = 0;
    for (uint32_t i = 0; i < 12; i++) {
        random_scene_make(&scene, FACES, false);
        struct ow_look look = random_scene_look(OW_SHADE_FLAT);
        look.cull = OW_CULL_BACK;
        look.coverage = true;
        struct ow_view view = random_scene_view(&scene, i, WIDTH, HEIGHT);
        paint_reference(&canvas, &scene, &view, &look);
        for (uint32_t k = 0; k < 3; k++) {
            draw(&scene, &view, &look, &ow_format_xrgb8888, bands[k], (uint8_t *)pixels, &stats);
            compare(&canvas, &ow_format_xrgb8888, false, (uint8_t *)pixels, &stats);
        }
        draw(&scene, &view, &look, &ow_format_gray4, 11, (uint8_t *)pixels, &stats);
        compare(&canvas, &ow_format_gray4, false, (uint8_t *)pixels, &stats);
        look.dither = true;
        draw(&scene, &view, &look, &ow_format_rgb565, 11, (uint8_t *)pixels, &stats);
        compare(&canvas, &ow_format_rgb565, true, (uint8_t *)pixels, &stats);
        seen += stats.pixels_written;
        random_scene_free(&scene);
    }
    assert_true(seen > 12 * WIDTH * HEIGHT / 8);
}

/* Smooth shading takes the colour at the pixel's centre for all its samples. */
static void smooth_difference(enum ow_shade shade)
{
    static struct canvas canvas;
    static uint32_t pixels[WIDTH * HEIGHT];
    struct random_scene scene;
    struct ow_stats stats;
    uint32_t most = 0;
    uint64_t sum = 0;
    uint64_t count = 0;
    for (uint32_t i = 0; i < 6; i++) {
        random_scene_make(&scene, FACES, true);
        struct ow_look look = random_scene_look(shade);
        look.cull = OW_CULL_BACK;
        look.coverage = true;
        struct ow_view view = random_scene_view(&scene, i, WIDTH, HEIGHT);
        paint_reference(&canvas, &scene, &view, &look);
        draw(&scene, &view, &look, &ow_format_xrgb8888, HEIGHT, (uint8_t *)pixels, &stats);
        for (uint32_t k = 0; k < WIDTH * HEIGHT; k++) {
            bool model;
            uint32_t expected = reference_pixel(&canvas, k % WIDTH, k / WIDTH, &model);
            uint32_t got = ow_format_xrgb8888.get((uint8_t *)pixels, k);
            for (uint32_t c = 0; c < 24 && model; c += 8, count++) {
                uint32_t off = (uint32_t)abs((int)(got >> c & 255) - (int)(expected >> c & 255));
                most = off > most ? off : most;
                sum += off;
            }
        }
        random_scene_free(&scene);
    }
    print_message("shade %d: off by %.3f on the mean, %u at most\n", (int)shade,
                  (double)sum / (double)count, most);
    assert_true(count > 10000 && (double)sum / (double)count < 1);
}

static void test_smooth_is_near(void **state)
{
    (void)state;
    smooth_difference(OW_SHADE_GOURAUD);
    smooth_difference(OW_SHADE_PHONG);
}

static void test_refusals(void **state)
{
    (void)state;
    struct random_scene scene;
    struct ow_workspace_config config = { .parts = &ow_parts_all, .width = WIDTH, .lines = HEIGHT };
    random_scene_make(&scene, 3, false);
    struct ow_view view = random_scene_view(&scene, 0, WIDTH, HEIGHT);
    struct ow_look look = random_scene_look(OW_SHADE_FLAT);
    look.coverage = true;
    uint32_t without = ow_workspace_bytes_needed(&scene.tree, &config);
    random_scene_place(&scene, &config);
    assert_int_equal(ow_draw_begin(&scene.tree, &view, &look, &scene.workspace), OW_ARGUMENT);
    config.coverage = true;
    assert_true(ow_workspace_bytes_needed(&scene.tree, &config) >= without + 8 * WIDTH * HEIGHT);
    random_scene_place(&scene, &config);
    assert_int_equal(ow_draw_begin(&scene.tree, &view, &look, &scene.workspace), OW_OK);
    look.order = OW_BACK_TO_FRONT;
    assert_int_equal(ow_draw_begin(&scene.tree, &view, &look, &scene.workspace), OW_ARGUMENT);
    look.order = OW_FRONT_TO_BACK;
    look.shade = OW_SHADE_LINES;
    assert_int_equal(ow_draw_begin(&scene.tree, &view, &look, &scene.workspace), OW_ARGUMENT);
    look.shade = OW_SHADE_ID;
    assert_int_equal(ow_draw_begin(&scene.tree, &view, &look, &scene.workspace), OW_ARGUMENT);
    random_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_flat_is_exact),
        cmocka_unit_test(test_smooth_is_near),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
