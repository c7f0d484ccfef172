/* SPDX-License-Identifier: 0BSD */
/*
 * Several lights, from directions and at points: against double precision, and
 * what light must do: none from behind, none lost on the way, mirrored lights
 * on mirrored normals alike, no order among lights, never more than full.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "tests/unit/random_scene.h"

enum { WIDTH = 75, HEIGHT = 53, FACES = 40, LATTICE = 32767 };

static struct random_scene scene;

static int make_scene(void **state)
{
    (void)state;
    random_scene_make(&scene, FACES, true);
    return 0;
}

static int free_scene(void **state)
{
    (void)state;
    random_scene_free(&scene);
    return 0;
}

/* A look whose only light is ambient: 64 of 256. */
static struct ow_look dark_look(enum ow_shade shade)
{
    struct ow_look look = random_scene_look(shade);
    look.ambient_q8 = 64;
    look.light_count = 0;
    return look;
}

static void add(struct ow_look *look, struct ow_light light)
{
    look->lights[look->light_count++] = light;
}

static struct ow_light from_direction(double x, double y, double z, uint16_t intensity_q8)
{
    double length = sqrt(x * x + y * y + z * z);
    return (struct ow_light){ .direction_q14 = { (int16_t)lround(x / length * 16384),
                                                 (int16_t)lround(y / length * 16384),
                                                 (int16_t)lround(z / length * 16384) },
                              .intensity_q8 = intensity_q8,
                              .in_model_space = true };
}

static struct ow_light at_point(double x, double y, double z, uint16_t intensity_q8)
{
    return (struct ow_light){ .at_point = true,
                              .place = { (ow_q8)lround(x * 256), (ow_q8)lround(y * 256),
                                         (ow_q8)lround(z * 256) },
                              .intensity_q8 = intensity_q8,
                              .in_model_space = true };
}

/* What the shader makes of full white at a vertex: 0 .. 255. Gouraud and Phong without highlight. */
static uint32_t white_at(const struct ow_look *look, const struct ow_view *view, uint32_t vertex)
{
    struct ow_shader shader;
    struct ow_corner_light light;
    memset(&light, 0x7A, sizeof light); /* parts that are not its own are not read */
    ow_shader_make(&shader, &ow_parts_all, look, view);
    assert_true(shader.parts <= OW_LIGHT_PARTS);
    ow_shade_corner(&shader, &scene.tree, vertex, false, &light);
    return ow_shade_pixel(&shader, 0xFFFFFF, &light) & 255;
}

static void vertex_at(uint32_t vertex, double place[3], double normal[3])
{
    double length = 0;
    for (uint32_t i = 0; i < 3; i++) {
        place[i] = ow_read_i16(scene.tree.bytes, scene.tree.vertices_at + 6 * vertex + 2 * i);
        normal[i] = ow_read_i8(scene.tree.bytes, scene.tree.normals_at + 3 * vertex + i);
        length += normal[i] * normal[i];
    }
    for (uint32_t i = 0; i < 3; i++) {
        normal[i] /= sqrt(length);
    }
}

/* The intensity, 0 .. 1, that a look's lights in model space should give. */
static double expected_at(const struct ow_look *look, const double place[3], const double normal[3])
{
    double sum = look->ambient_q8 / 256.0;
    for (uint32_t k = 0; k < look->light_count; k++) {
        const struct ow_light *light = &look->lights[k];
        double along = 0;
        double length = 0;
        for (uint32_t i = 0; i < 3; i++) {
            double way = light->at_point ? light->place[i] / 256.0 - place[i]
                                         : light->direction_q14[i] / 16384.0;
            along += way * normal[i];
            length += way * way;
        }
        along = length > 0 ? along / sqrt(length) : 0;
        sum += along > 0 ? along * light->intensity_q8 / 256 : 0;
    }
    return sum > 1 ? 1 : sum;
}

static double random_place(void)
{
    return (double)random_below(4 * LATTICE) - 2 * LATTICE;
}

static void add_random_lights(struct ow_look *look)
{
    uint32_t count = 1 + random_below(OW_LIGHTS_MAX);
    for (uint32_t k = 0; k < count; k++) {
        double x = random_place();
        double y = random_place();
        double z = random_place() + 0.5;
        uint16_t intensity = (uint16_t)random_below(100);
        add(look,
            random_below(2) ? at_point(x, y, z, intensity) : from_direction(x, y, z, intensity));
    }
}

static void smooth_light_is_what_it_should_be(void **state)
{
    (void)state;
    struct ow_view view = random_scene_view(&scene, 0, WIDTH, HEIGHT);
    for (uint32_t n = 0; n < 400; n++) {
        struct ow_look look = dark_look(n % 2 ? OW_SHADE_GOURAUD : OW_SHADE_PHONG);
        look.specular_q8 = 0;
        add_random_lights(&look);
        uint32_t vertex = random_below(scene.tree.vertex_count);
        double place[3];
        double normal[3];
        vertex_at(vertex, place, normal);
        double expected = expected_at(&look, place, normal) * 255;
        assert_true(fabs(white_at(&look, &view, vertex) - expected) < 4);
    }
}

static void middle_of(uint32_t at, double middle[3], double normal[3])
{
    uint32_t corners = ow_read_u8(scene.tree.bytes, at);
    double place[3];
    double unused[3];
    double length = 0;
    for (uint32_t i = 0; i < 3; i++) {
        middle[i] = 0;
        normal[i] = ow_read_i8(scene.tree.bytes, at + 1 + i);
        length += normal[i] * normal[i];
    }
    for (uint32_t i = 0; i < 3; i++) {
        normal[i] /= sqrt(length);
    }
    for (uint32_t k = 0; k < corners; k++) {
        vertex_at(ow_corner(&scene.tree, at, k), place, unused);
        for (uint32_t i = 0; i < 3; i++) {
            middle[i] += place[i] / corners;
        }
    }
}

/* Flat faces: points shine on the middle. */
static void flat_light_is_what_it_should_be(void **state)
{
    (void)state;
    struct ow_view view = random_scene_view(&scene, 1, WIDTH, HEIGHT);
    struct ow_face face = { .at = scene.tree.polygons_at, .reverse = false };
    for (uint32_t n = 0; n < FACES; n++) {
        double middle[3];
        double normal[3];
        middle_of(face.at, middle, normal);
        for (uint32_t k = 0; k < 10; k++) {
            struct ow_shader shader;
            struct ow_look look = dark_look(OW_SHADE_FLAT);
            add_random_lights(&look);
            ow_shader_make(&shader, &ow_parts_all, &look, &view);
            uint32_t colour = ow_face_colour(&shader, &scene.tree, &face);
            uint32_t got = ow_shade_face(&shader, &scene.tree, &face);
            double share = expected_at(&look, middle, normal);
            for (uint32_t shift = 0; shift < 24; shift += 8) {
                double expected = (colour >> shift & 255) * share;
                assert_true(fabs((got >> shift & 255) - expected) < 4);
            }
        }
        face.at += ow_polygon_bytes(&scene.tree, face.at);
    }
}

/* A light behind a face leaves the ambient light, exactly; the back has it then. */
static void light_from_behind_is_none(void **state)
{
    (void)state;
    struct ow_view view = random_scene_view(&scene, 0, WIDTH, HEIGHT);
    static const enum ow_shade shades[] = { OW_SHADE_GOURAUD, OW_SHADE_PHONG };
    for (uint32_t vertex = 0; vertex < scene.tree.vertex_count; vertex++) {
        double place[3];
        double n[3];
        vertex_at(vertex, place, n);
        struct ow_look look = dark_look(shades[vertex % 2]);
        uint32_t ambient = white_at(&look, &view, vertex);
        assert_int_equal(ambient, 255 * 64 / 256);
        add(&look, from_direction(-n[0], -n[1], -n[2], 256));
        add(&look,
            at_point(place[0] - 900 * n[0], place[1] - 900 * n[1], place[2] - 900 * n[2], 256));
        assert_int_equal(white_at(&look, &view, vertex), ambient);
        look.lights[0] = from_direction(n[0], n[1], n[2], 64);
        assert_true(white_at(&look, &view, vertex) > ambient + 50);
    }
}

/* The same light from near, far and as a direction; in model space or seen from the eye. */
static void no_light_is_lost_on_the_way(void **state)
{
    (void)state;
    for (uint32_t vertex = 0; vertex < scene.tree.vertex_count; vertex++) {
        struct ow_view view = random_scene_view(&scene, vertex, WIDTH, HEIGHT);
        double p[3];
        double n[3];
        vertex_at(vertex, p, n);
        n[0] += 0.3; /* some way off the normal */
        struct ow_look look = dark_look(OW_SHADE_GOURAUD);
        add(&look, from_direction(n[0], n[1], n[2], 150));
        uint32_t expected = white_at(&look, &view, vertex);
        static const double distances[] = { 5, 500, 50000, 1500000 };
        for (uint32_t k = 0; k < 4; k++) {
            double d = distances[k] / sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
            look.lights[0] = at_point(p[0] + d * n[0], p[1] + d * n[1], p[2] + d * n[2], 150);
            assert_true(fabs((double)white_at(&look, &view, vertex) - expected) <= 1);
        }
        double seen[3] = { 0, 0, 0 };
        for (uint32_t i = 0; i < 3; i++) {
            double way = p[i] + 500 * n[i] - view.eye[i] / 256.0;
            seen[0] += way * view.right[i] / 1073741824.0;
            seen[1] += way * view.up[i] / 1073741824.0;
            seen[2] -= way * view.forward[i] / 1073741824.0;
        }
        look.lights[0] = at_point(seen[0], seen[1], seen[2], 150);
        look.lights[0].in_model_space = false;
        assert_true(fabs((double)white_at(&look, &view, vertex) - expected) <= 1);
    }
}

/* Lights add up in any order, and never to more than full. */
static void lights_have_no_order(void **state)
{
    (void)state;
    struct ow_view view = random_scene_view(&scene, 2, WIDTH, HEIGHT);
    for (uint32_t n = 0; n < 200; n++) {
        struct ow_look look = dark_look(n % 2 ? OW_SHADE_GOURAUD : OW_SHADE_PHONG);
        add_random_lights(&look);
        struct ow_look turned = look;
        for (uint32_t k = 0; k < look.light_count; k++) {
            turned.lights[k] = look.lights[look.light_count - 1 - k];
        }
        uint32_t vertex = random_below(scene.tree.vertex_count);
        assert_int_equal(white_at(&look, &view, vertex), white_at(&turned, &view, vertex));
    }
}

/* Mirrored lights on a mirrored normal: the same light. Vertex 0 is given both normals. */
static void mirrored_lights_are_alike(void **state)
{
    (void)state;
    struct ow_view view = random_scene_view(&scene, 0, WIDTH, HEIGHT);
    uint8_t *normal = scene.blob + scene.tree.normals_at;
    uint8_t kept[3];
    double p[3];
    double unused[3];
    memcpy(kept, normal, 3);
    vertex_at(0, p, unused);
    for (uint32_t n = 0; n < 100; n++) {
        uint32_t white[2];
        double d[3] = { random_place(), random_place(), random_place() };
        for (int side = 0; side < 2; side++) {
            double sign = side ? -1 : 1;
            struct ow_look look = dark_look(OW_SHADE_GOURAUD);
            normal[0] = (uint8_t)(side ? -60 : 60);
            normal[1] = 70;
            normal[2] = 88;
            add(&look, from_direction(sign * d[0], d[1], d[2], 80));
            add(&look, at_point(p[0] + sign * d[1], p[1] + d[0], p[2] + d[2], 80));
            white[side] = white_at(&look, &view, 0);
        }
        assert_true(white[0] <= white[1] + 1 && white[1] <= white[0] + 1);
    }
    memcpy(normal, kept, 3);
}

/* The largest numbers that fit the fields: bounded, and (under sanitizers) without overflow. */
static void extremes_are_bounded(void **state)
{
    (void)state;
    static const ow_q8 places[] = { 0, INT32_MAX, INT32_MIN, OW_EYE_MAX, -OW_EYE_MAX };
    static const enum ow_shade shades[] = { OW_SHADE_GOURAUD, OW_SHADE_PHONG };
    uint8_t *normal = scene.blob + scene.tree.normals_at;
    uint8_t kept[3];
    memcpy(kept, normal, 3);
    memset(normal, 0x80, 3);
    for (uint32_t n = 0; n < 500; n++) {
        struct ow_view view = random_scene_view(&scene, n % 3, WIDTH, HEIGHT);
        struct ow_look look = random_scene_look(shades[n % 2]);
        look.ambient_q8 = 65535;
        look.specular_q8 = 65535;
        look.shininess = (uint8_t)(n % 8);
        look.light_count = OW_LIGHTS_MAX;
        for (uint32_t k = 0; k < OW_LIGHTS_MAX; k++) {
            struct ow_light *light = &look.lights[k];
            *light = (struct ow_light){ .intensity_q8 = 65535, .in_model_space = n % 4 < 2 };
            light->at_point = random_below(2);
            for (uint32_t i = 0; i < 3; i++) {
                light->direction_q14[i] = random_below(2) ? INT16_MAX : INT16_MIN;
                light->place[i] = places[random_below(5)];
            }
        }
        assert_int_equal(white_at(&look, &view, n % 2 ? 0 : random_below(5)), 255);
        struct ow_shader shader;
        struct ow_face face = { .at = scene.tree.polygons_at, .reverse = n % 3 == 0 };
        look.shade = OW_SHADE_FLAT;
        ow_shader_make(&shader, &ow_parts_all, &look, &view);
        assert_int_equal(ow_shade_face(&shader, &scene.tree, &face),
                         ow_face_colour(&shader, &scene.tree, &face));
    }
    memcpy(normal, kept, 3);
}

static void draw(const struct ow_view *view, const struct ow_look *look, uint32_t band,
                 uint32_t *pixels)
{
    struct ow_workspace_config config = { .parts = &ow_parts_all,
                                          .width = WIDTH,
                                          .lines = (uint16_t)band,
                                          .height = HEIGHT,
                                          .listed_faces = ow_listed_faces_max(&scene.tree) };
    random_scene_place(&scene, &config);
    assert_int_equal(ow_draw_begin(&scene.tree, view, look, &scene.workspace), OW_OK);
    for (uint32_t line = 0; line < HEIGHT; line += band) {
        uint32_t lines = HEIGHT - line < band ? HEIGHT - line : band;
        struct ow_target target = { .pixels = (uint8_t *)(pixels + line * WIDTH),
                                    .stride = 4 * WIDTH,
                                    .first_line = (uint16_t)line,
                                    .line_count = (uint16_t)lines,
                                    .format = &ow_format_xrgb8888 };
        assert_int_equal(ow_draw_band(&scene.workspace, &target, NULL), OW_OK);
    }
}

/* With lights of both kinds and a depth cue, faces are clipped, and all orders agree. */
static void all_orders_draw_one_picture(void **state)
{
    (void)state;
    static uint32_t expected[WIDTH * HEIGHT];
    static uint32_t got[WIDTH * HEIGHT];
    for (uint32_t n = 0; n < 9; n++) {
        static const enum ow_shade shades[] = { OW_SHADE_FLAT, OW_SHADE_GOURAUD, OW_SHADE_PHONG };
        struct ow_view view = random_scene_view(&scene, n, WIDTH, HEIGHT);
        struct ow_look look = random_scene_look(shades[n % 3]);
        add(&look, at_point(1000, 20000, 9000, 120));
        add(&look, from_direction(1, 0, 0, 60));
        if (n >= 3) {
            look.depth_far = 100000 * 256;
        }
        if (n >= 6 && view.projection == OW_PERSPECTIVE) {
            view.near_z = view.near_z * 400; /* some faces are clipped */
        }
        draw(&view, &look, HEIGHT, expected);
        for (int order = OW_BACK_TO_FRONT; order <= OW_SCAN_LINE; order++) {
            look.order = (enum ow_order)order;
            draw(&view, &look, 7, got);
            assert_memory_equal(got, expected, sizeof got);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(smooth_light_is_what_it_should_be),
        cmocka_unit_test(flat_light_is_what_it_should_be),
        cmocka_unit_test(light_from_behind_is_none),
        cmocka_unit_test(no_light_is_lost_on_the_way),
        cmocka_unit_test(lights_have_no_order),
        cmocka_unit_test(mirrored_lights_are_alike),
        cmocka_unit_test(extremes_are_bounded),
        cmocka_unit_test(all_orders_draw_one_picture),
    };
    return cmocka_run_group_tests(tests, make_scene, free_scene);
}
