/* SPDX-License-Identifier: 0BSD */
/*
 * The look: maps, depth cue and what they are mixed of, against double
 * precision; and that a picture with all of it is the same for every order and
 * band.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/unit/random_scene.h"

enum { WIDTH = 75, HEIGHT = 53, STRIDE = 4 * WIDTH, FACES = 40 };

static uint32_t channel(uint32_t rgb, uint32_t i)
{
    return rgb >> (16 - 8 * i) & 255;
}

static void test_mix(void **state)
{
    (void)state;
    for (int n = 0; n < 100000; n++) {
        uint32_t a = random_below(1 << 24);
        uint32_t b = random_below(1 << 24);
        uint32_t share = random_below(257);
        uint32_t mixed = ow_mix(a, b, share);
        for (uint32_t i = 0; i < 3; i++) {
            double exact = (channel(a, i) * (256.0 - share) + channel(b, i) * share) / 256;
            assert_int_equal(channel(mixed, i), floor(exact + 0.5));
        }
        assert_int_equal(mixed >> 24, 0);
    }
}

/* Knots where they should be, no jumps between them, and brighter with more heat or cold. */
static void test_maps(void **state)
{
    (void)state;
    static const uint32_t ends[][2] = { [OW_MAP_HEAT] = { 0x000000, 0xFFFFFF },
                                        [OW_MAP_COOL] = { 0x000000, 0xFFFFFF },
                                        [OW_MAP_SPECTRUM] = { 0x2000A0, 0xFF2000 } };
    for (enum ow_map map = OW_MAP_HEAT; map <= OW_MAP_SPECTRUM; map++) {
        assert_int_equal(ow_map_colour(map, 0), ends[map][0]);
        assert_int_equal(ow_map_colour(map, 256), ends[map][1]);
        for (uint32_t i = 1; i <= 256; i++) {
            uint32_t before = ow_map_colour(map, i - 1);
            uint32_t now = ow_map_colour(map, i);
            assert_int_not_equal(now, before);
            for (uint32_t c = 0; c < 3; c++) {
                int step = (int)channel(now, c) - (int)channel(before, c);
                assert_true(step >= (map == OW_MAP_SPECTRUM ? -5 : 0) && step <= 5);
            }
        }
    }
}

/* Depth along the view vector, in lattice steps. */
static double depth(const struct random_scene *scene, const struct ow_view *view, uint32_t vertex)
{
    double sum = 0;
    for (uint32_t i = 0; i < 3; i++) {
        uint32_t at = scene->tree.vertices_at + vertex * OW_VERTEX_BYTES + 2 * i;
        double v = ow_read_i16(scene->tree.bytes, at) - view->eye[i] / 256.0;
        sum += v * view->forward[i] / 1073741824.0;
    }
    return sum;
}

static double share_at(const struct ow_look *look, double z)
{
    double near = look->depth_near / 256.0;
    double far = look->depth_far / 256.0;
    return fmin(fmax((far - z) / (far - near), 0), 1);
}

static void set_depth_cue(struct ow_look *look, const struct random_scene *scene,
                          const struct ow_view *view)
{
    double near = 1e9;
    double far = 0;
    for (uint32_t i = 0; i < scene->tree.vertex_count; i++) {
        double z = depth(scene, view, i);
        near = fmin(near, z);
        far = fmax(far, z);
    }
    look->depth_near = (ow_q8)((near + (far - near) * 0.2) * 256);
    look->depth_far = (ow_q8)((near + (far - near) * 0.8) * 256);
}

static void check_channels(uint32_t got, uint32_t plain, uint32_t background, double share)
{
    for (uint32_t c = 0; c < 3; c++) {
        double expected = channel(background, c) * (1 - share) + channel(plain, c) * share;
        assert_true(fabs(expected - channel(got, c)) < 1.6);
    }
}

static void test_depth_cue(void **state)
{
    (void)state;
    uint32_t faded = 0;
    for (uint32_t i = 0; i < 9; i++) {
        struct random_scene scene;
        struct ow_shader shader;
        struct ow_shader plain;
        random_scene_make(&scene, FACES, true);
        struct ow_view view = random_scene_view(&scene, i, WIDTH, HEIGHT);
        struct ow_look look = random_scene_look(OW_SHADE_FLAT);
        ow_shader_make(&plain, &ow_parts_all, &look, &view);
        set_depth_cue(&look, &scene, &view);
        ow_shader_make(&shader, &ow_parts_all, &look, &view);
        struct ow_face face = { .at = scene.tree.polygons_at, .reverse = false };
        for (uint32_t n = 0; n < FACES; n++) {
            double nearest = 1e9;
            for (uint32_t k = 0; k < ow_read_u8(scene.tree.bytes, face.at); k++) {
                nearest = fmin(nearest, depth(&scene, &view, ow_corner(&scene.tree, face.at, k)));
            }
            double share = share_at(&look, nearest);
            check_channels(ow_shade_face(&shader, &scene.tree, &face),
                           ow_shade_face(&plain, &scene.tree, &face), look.background, share);
            faded += share > 0.1 && share < 0.9;
            face.at += ow_polygon_bytes(&scene.tree, face.at);
        }
        random_scene_free(&scene);
    }
    assert_true(faded > FACES);
}

/* Smooth shading has the share as its last part, and the map instead of the material. */
static void test_smooth_parts(void **state)
{
    (void)state;
    static const enum ow_shade shades[] = { OW_SHADE_GOURAUD, OW_SHADE_PHONG };
    struct random_scene scene;
    random_scene_make(&scene, FACES, true);
    for (uint32_t i = 0; i < 6; i++) {
        struct ow_shader shader;
        struct ow_shader plain;
        struct ow_view view = random_scene_view(&scene, i, WIDTH, HEIGHT);
        struct ow_look look = random_scene_look(shades[i % 2]);
        look.specular_q8 = 0;
        look.map = OW_MAP_HEAT;
        ow_shader_make(&plain, &ow_parts_all, &look, &view);
        set_depth_cue(&look, &scene, &view);
        ow_shader_make(&shader, &ow_parts_all, &look, &view);
        for (uint32_t vertex = 0; vertex < scene.tree.vertex_count; vertex++) {
            struct ow_corner_light light;
            ow_shade_corner(&shader, &scene.tree, vertex, false, &light);
            uint32_t got = ow_shade_pixel(&shader, 0x123456, &light);
            uint32_t unfaded = ow_shade_pixel(&plain, 0x654321, &light);
            check_channels(got, unfaded, look.background,
                           share_at(&look, depth(&scene, &view, vertex)));
            if (shades[i % 2] == OW_SHADE_GOURAUD) {
                assert_int_equal(unfaded, ow_map_colour(OW_MAP_HEAT, (uint32_t)light.part[0] >> 8));
            }
        }
    }
    random_scene_free(&scene);
}

/* ---- whole pictures ----------------------------------------------------------------------------- */
static void draw(struct random_scene *scene, const struct ow_view *view, const struct ow_look *look,
                 const struct ow_pixel_format *format, uint32_t band_lines, uint32_t *pixels)
{
    struct ow_workspace_config config = { .parts = &ow_parts_all,
                                          .width = WIDTH,
                                          .lines = (uint16_t)band_lines,
                                          .height = HEIGHT,
                                          .listed_faces = ow_listed_faces_max(&scene->tree) };
    random_scene_place(scene, &config);
    memset(pixels, 0, STRIDE * HEIGHT);
    assert_int_equal(ow_draw_begin(&scene->tree, view, look, &scene->workspace), OW_OK);
    for (uint32_t line = 0; line < HEIGHT; line += band_lines) {
        uint32_t lines = HEIGHT - line < band_lines ? HEIGHT - line : band_lines;
        struct ow_target target = {
            (uint8_t *)pixels + line * STRIDE, STRIDE, (uint16_t)line, (uint16_t)lines, format, NULL
        };
        assert_int_equal(ow_draw_band(&scene->workspace, &target, NULL), OW_OK);
    }
}

static void compare_orders(struct random_scene *scene, const struct ow_view *view,
                           struct ow_look look, const struct ow_pixel_format *format)
{
    static uint32_t expected[WIDTH * HEIGHT];
    static uint32_t got[WIDTH * HEIGHT];
    static const enum ow_order orders[] = { OW_FRONT_TO_BACK, OW_BACK_TO_FRONT, OW_SCAN_LINE };
    static const uint32_t bands[] = { HEIGHT, 1, 9 };
    look.order = OW_FRONT_TO_BACK;
    draw(scene, view, &look, format, HEIGHT, expected);
    for (uint32_t i = 0; i < 9; i++) {
        look.order = orders[i / 3];
        draw(scene, view, &look, format, bands[i % 3], got);
        assert_memory_equal(got, expected, sizeof got);
    }
}

static void test_one_picture(void **state)
{
    (void)state;
    static const enum ow_shade shades[] = { OW_SHADE_FLAT, OW_SHADE_GOURAUD, OW_SHADE_PHONG,
                                            OW_SHADE_LINES };
    struct random_scene scene;
    random_scene_make(&scene, FACES, true);
    for (uint32_t i = 0; i < 4; i++) {
        struct ow_view view = random_scene_view(&scene, i, WIDTH, HEIGHT);
        struct ow_look look = random_scene_look(shades[i]);
        look.cull = OW_CULL_BACK;
        set_depth_cue(&look, &scene, &view);
        for (uint32_t k = 0; k < ow_format_count; k++) {
            look.dither = true;
            look.map = i == 2 ? OW_MAP_COOL : OW_MAP_NONE;
            compare_orders(&scene, &view, look, ow_formats[k]);
        }
    }
    random_scene_free(&scene);
}

/* Numbers of polygons are neither dithered nor faded nor mapped. */
static void test_ids_stay(void **state)
{
    (void)state;
    static uint32_t plain[WIDTH * HEIGHT];
    static uint32_t got[WIDTH * HEIGHT];
    struct random_scene scene;
    random_scene_make(&scene, FACES, false);
    struct ow_view view = random_scene_view(&scene, 0, WIDTH, HEIGHT);
    struct ow_look look = random_scene_look(OW_SHADE_ID);
    look.cull = OW_CULL_BACK;
    draw(&scene, &view, &look, &ow_format_rgb565, HEIGHT, plain);
    look.dither = true;
    look.map = OW_MAP_HEAT;
    set_depth_cue(&look, &scene, &view);
    draw(&scene, &view, &look, &ow_format_rgb565, HEIGHT, got);
    assert_memory_equal(got, plain, sizeof got);
    random_scene_free(&scene);
}

static void test_refusals(void **state)
{
    (void)state;
    struct random_scene scene;
    struct ow_workspace_config config = { .parts = &ow_parts_all, .width = WIDTH, .lines = HEIGHT };
    random_scene_make(&scene, 3, false);
    random_scene_place(&scene, &config);
    struct ow_view view = random_scene_view(&scene, 0, WIDTH, HEIGHT);
    static const ow_q8 wrong[][2] = { { 5, 5 }, { 6, 5 }, { -1, 5 }, { 5, 0 }, { 0, -1 } };
    for (uint32_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        struct ow_look look = random_scene_look(OW_SHADE_FLAT);
        look.depth_near = wrong[i][0];
        look.depth_far = wrong[i][1];
        assert_int_equal(ow_draw_begin(&scene.tree, &view, &look, &scene.workspace), OW_ARGUMENT);
    }
    struct ow_look look = random_scene_look(OW_SHADE_FLAT);
    look.map = (enum ow_map)(OW_MAP_SPECTRUM + 1);
    assert_int_equal(ow_draw_begin(&scene.tree, &view, &look, &scene.workspace), OW_ARGUMENT);
    look.map = OW_MAP_NONE;
    assert_int_equal(ow_draw_begin(&scene.tree, &view, &look, &scene.workspace), OW_OK);
    look.light_count = OW_LIGHTS_MAX + 1;
    assert_int_equal(ow_draw_begin(&scene.tree, &view, &look, &scene.workspace), OW_ARGUMENT);
    random_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mix),         cmocka_unit_test(test_maps),
        cmocka_unit_test(test_depth_cue),   cmocka_unit_test(test_smooth_parts),
        cmocka_unit_test(test_one_picture), cmocka_unit_test(test_ids_stay),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
