/* SPDX-License-Identifier: 0BSD */
/*
 * Drawing as a whole: the picture depends on tree, view and look alone, not on
 * the order, the bands, the cache or the list; a budget leaves what is near.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "random_scene.h"

enum { WIDTH = 203, HEIGHT = 97, FACES = 60, VIEWS = 8 };

struct picture {
    uint32_t pixels[HEIGHT][WIDTH + 1]; /* a stride that is not the width */
    struct ow_stats stats;
    enum ow_status status;
};

static const struct ow_workspace_config plain = { .parts = &ow_parts_all,
                                                  .width = WIDTH,
                                                  .lines = HEIGHT };

/* Draws in bands of so many lines; 0: all at once. */
static void draw(struct picture *picture, struct random_scene *scene,
                 const struct ow_workspace_config *config, const struct ow_view *view,
                 const struct ow_look *look, uint32_t lines)
{
    random_scene_place(scene, config);
    memset(picture, 0xA5, sizeof *picture);
    picture->status = ow_draw_begin(&scene->tree, view, look, &scene->workspace);
    lines = lines ? lines : HEIGHT;
    for (uint32_t line = 0; line < HEIGHT && picture->status == OW_OK; line += lines) {
        struct ow_target target = {
            .pixels = (uint8_t *)picture->pixels[line],
            .stride = sizeof picture->pixels[0],
            .first_line = (uint16_t)line,
            .line_count = (uint16_t)(HEIGHT - line < lines ? HEIGHT - line : lines),
            .format = &ow_format_xrgb8888,
        };
        picture->status = ow_draw_band(&scene->workspace, &target, &picture->stats);
    }
}

static void assert_same(const struct picture *a, const struct picture *b)
{
    assert_int_equal(a->status, b->status);
    for (uint32_t line = 0; line < HEIGHT; line++) {
        assert_memory_equal(a->pixels[line], b->pixels[line], WIDTH * sizeof(uint32_t));
    }
}

/* Calls check with every view and shade of a scene. */
static void for_all(void (*check)(struct random_scene *scene, const struct ow_view *view,
                                  const struct ow_look *look))
{
    static const enum ow_shade shades[] = { OW_SHADE_ID, OW_SHADE_FLAT, OW_SHADE_GOURAUD,
                                            OW_SHADE_PHONG };
    struct random_scene scene;
    random_scene_make(&scene, FACES, true);
    for (uint32_t number = 0; number < VIEWS; number++) {
        struct ow_view view = random_scene_view(&scene, number, WIDTH, HEIGHT);
        for (uint32_t k = 0; k < 4; k++) {
            struct ow_look look = random_scene_look(shades[k]);
            check(&scene, &view, &look);
        }
    }
    random_scene_free(&scene);
}

static void check_orders(struct random_scene *scene, const struct ow_view *view,
                         const struct ow_look *look)
{
    static struct picture painter;
    static struct picture other;
    struct ow_look changed = *look;
    struct ow_workspace_config lists = plain;
    lists.listed_faces = ow_listed_faces_max(&scene->tree);
    lists.height = HEIGHT;
    changed.order = OW_BACK_TO_FRONT;
    draw(&painter, scene, &plain, view, &changed, 0);
    assert_int_equal(painter.status, OW_OK);
    assert_true(painter.stats.pixels_written > WIDTH * HEIGHT / 20);
    changed.order = OW_FRONT_TO_BACK;
    draw(&other, scene, &plain, view, &changed, 0);
    assert_same(&painter, &other);
    /* Each pixel once: the model's and the background's fill the screen exactly. */
    assert_int_equal(other.stats.pixels_written + other.stats.pixels_background, WIDTH * HEIGHT);
    struct ow_parts segments = ow_parts_all;
    struct ow_workspace_config listing = plain;
    uint32_t spans = other.stats.spans;
    segments.dynamic = &ow_surface_segments;
    listing.parts = &segments;
    draw(&other, scene, &listing, view, &changed, 0);
    assert_same(&painter, &other);
    assert_int_equal(other.stats.pixels_written + other.stats.pixels_background, WIDTH * HEIGHT);
    assert_int_equal(other.stats.spans, spans);
    changed.order = OW_SCAN_LINE;
    draw(&other, scene, &lists, view, &changed, 0);
    assert_same(&painter, &other);
    assert_int_equal(other.stats.pixels_written + other.stats.pixels_background, WIDTH * HEIGHT);
    assert_int_equal(other.stats.polygons_unlisted, 0);
}

static void all_orders_draw_one_picture(void **state)
{
    (void)state;
    for_all(check_orders);
}

static void check_bands(struct random_scene *scene, const struct ow_view *view,
                        const struct ow_look *look)
{
    static const uint32_t lines[] = { 1, 8, 33, 64 };
    static struct picture whole;
    static struct picture bands;
    struct ow_workspace_config config = { .parts = &ow_parts_all,
                                          .width = WIDTH,
                                          .lines = HEIGHT,
                                          .listed_faces = ow_listed_faces_max(&scene->tree),
                                          .height = HEIGHT };
    for (int order = OW_BACK_TO_FRONT; order <= OW_SCAN_LINE; order++) {
        struct ow_look changed = *look;
        changed.order = (enum ow_order)order;
        config.lines = HEIGHT;
        draw(&whole, scene, &config, view, &changed, 0);
        for (uint32_t k = 0; k < 4; k++) {
            config.lines = (uint16_t)lines[k];
            draw(&bands, scene, &config, view, &changed, lines[k]);
            assert_same(&whole, &bands);
        }
    }
}

static void bands_of_any_height_draw_one_picture(void **state)
{
    (void)state;
    for_all(check_bands);
}

static void check_memory(struct random_scene *scene, const struct ow_view *view,
                         const struct ow_look *look)
{
    static struct picture roomy;
    static struct picture tight;
    struct ow_look changed = *look;
    changed.order = OW_FRONT_TO_BACK;
    draw(&roomy, scene, &plain, view, &changed, 0);
    struct ow_workspace_config config = plain;
    for (config.cached_vertices = 1; config.cached_vertices <= 64; config.cached_vertices *= 8) {
        draw(&tight, scene, &config, view, &changed, 0);
        assert_same(&roomy, &tight);
    }
    /* A list that is too short: counted, slow, and right. */
    changed.order = OW_SCAN_LINE;
    config = plain;
    config.listed_faces = 10;
    config.height = HEIGHT;
    draw(&tight, scene, &config, view, &changed, 0);
    assert_same(&roomy, &tight);
    assert_true(tight.stats.polygons_unlisted > 0);
}

static void little_memory_draws_the_same_picture(void **state)
{
    (void)state;
    for_all(check_memory);
}

/* Pixels of a that are background, and those that are neither b's nor background. */
static void count_missing(const struct picture *a, const struct picture *b, uint32_t background,
                          uint32_t *missing, uint32_t *wrong)
{
    *missing = 0;
    *wrong = 0;
    for (uint32_t line = 0; line < HEIGHT; line++) {
        for (uint32_t x = 0; x < WIDTH; x++) {
            bool same = a->pixels[line][x] == b->pixels[line][x];
            bool empty = a->pixels[line][x] == background;
            *missing += empty && !same;
            *wrong += !empty && !same;
        }
    }
}

static void a_budget_leaves_what_is_near(void **state)
{
    (void)state;
    static struct picture whole;
    static struct picture part;
    struct random_scene scene;
    random_scene_make(&scene, FACES, false);
    struct ow_view view = random_scene_view(&scene, 0, WIDTH, HEIGHT);
    struct ow_look look = random_scene_look(OW_SHADE_ID);
    look.order = OW_FRONT_TO_BACK;
    draw(&whole, &scene, &plain, &view, &look, 0);
    uint32_t last = WIDTH * HEIGHT;
    bool ran_out = false;
    for (look.budget = 1; look.budget < 100000; look.budget *= 3) {
        uint32_t missing;
        uint32_t wrong;
        draw(&part, &scene, &plain, &view, &look, 0);
        count_missing(&part, &whole, look.background, &missing, &wrong);
        assert_int_equal(wrong, 0);
        assert_true(missing <= last);
        assert_int_equal(part.status, missing > 0 ? OW_BUDGET : part.status);
        ran_out = ran_out || part.status == OW_BUDGET;
        last = missing;
    }
    assert_true(ran_out);
    assert_int_equal(part.status, OW_OK);
    assert_same(&whole, &part);
    look.order = OW_BACK_TO_FRONT;
    draw(&part, &scene, &plain, &view, &look, 0);
    assert_int_equal(part.status, OW_ARGUMENT);
    random_scene_free(&scene);
}

/* The standard orbit, so many times as far away: the farther, the more faces go the fast way. */
static struct ow_view far_view(const struct random_scene *scene, uint32_t number, int32_t times)
{
    struct ow_camera camera = { .projection = OW_PERSPECTIVE,
                                .fov = UINT32_C(1) << 29,
                                .width_pixels = WIDTH,
                                .height_pixels = HEIGHT };
    struct ow_view view;
    ow_camera_orbit(&camera, &scene->tree, number * 500000000u, number * 50000000u);
    for (int i = 0; i < 3; i++) {
        camera.eye[i] = camera.at[i] + (camera.eye[i] - camera.at[i]) * times;
    }
    assert_int_equal(ow_view_make(&view, &camera), OW_OK);
    return view;
}

static void parts_that_save_time_change_no_pixel(void **state)
{
    (void)state;
    static struct picture fast;
    static struct picture slow;
    struct ow_parts parts = ow_parts_all;
    struct ow_workspace_config config = plain;
    struct random_scene scene;
    uint32_t painted = 0;
    parts.draw_small = NULL;
    parts.skip = NULL;
    config.parts = &parts;
    random_scene_make(&scene, FACES, true);
    for (uint32_t number = 0; number < 4 * VIEWS; number++) {
        static const enum ow_shade shades[] = { OW_SHADE_ID, OW_SHADE_GOURAUD };
        struct ow_view view = far_view(&scene, number, (int32_t)(1 + number % 4 * 4));
        struct ow_look look = random_scene_look(shades[number / 4 % 2]);
        look.order = number & 8 ? OW_FRONT_TO_BACK : OW_BACK_TO_FRONT;
        draw(&fast, &scene, &plain, &view, &look, number & 16 ? 3 : 0);
        draw(&slow, &scene, &config, &view, &look, 0);
        assert_same(&fast, &slow);
        assert_int_equal(fast.stats.pixels_written, slow.stats.pixels_written);
        painted += fast.stats.polygons_painted;
    }
    assert_true(painted > 300);
    random_scene_free(&scene);
}

static void looks_whose_part_is_missing_are_refused(void **state)
{
    (void)state;
    static struct picture picture;
    static const struct ow_parts painter_alone = { .painter = &ow_surface_painter,
                                                   .shading[OW_SHADE_FLAT] = &ow_shading_flat };
    struct random_scene scene;
    random_scene_make(&scene, 5, false);
    struct ow_view view = random_scene_view(&scene, 0, WIDTH, HEIGHT);
    struct ow_workspace_config config = plain;
    config.parts = &painter_alone;
    const struct ow_look plain_look = random_scene_look(OW_SHADE_FLAT);
    struct ow_look looks[9];
    for (uint32_t i = 0; i < 9; i++) {
        looks[i] = plain_look;
        looks[i].order = OW_BACK_TO_FRONT;
    }
    looks[0].order = OW_FRONT_TO_BACK;
    looks[1].order = OW_SCAN_LINE;
    looks[2].shade = OW_SHADE_LINES;
    looks[3].dither = true;
    looks[5].shade = OW_SHADE_ID;
    looks[6].map = OW_MAP_HEAT;
    looks[7].depth_far = 1;
    looks[8].lights[0].at_point = true;
    for (uint32_t i = 0; i < 9; i++) {
        draw(&picture, &scene, &config, &view, &looks[i], 0);
        assert_int_equal(picture.status, i == 4 ? OW_OK : OW_UNSUPPORTED);
    }
    config.parts = NULL;
    assert_int_equal(ow_workspace_bytes_needed(&scene.tree, &config), 0);
    random_scene_free(&scene);
}

/* What does not fit is refused before anything is written. */
static void wrong_targets_and_workspaces_are_refused(void **state)
{
    (void)state;
    static struct picture picture;
    struct random_scene scene;
    random_scene_make(&scene, 5, false);
    struct ow_view view = random_scene_view(&scene, 0, WIDTH, HEIGHT);
    struct ow_look look = random_scene_look(OW_SHADE_FLAT);
    struct ow_workspace_config config = plain;
    config.width = WIDTH - 1;
    draw(&picture, &scene, &config, &view, &look, 0);
    assert_int_equal(picture.status, OW_ARGUMENT);
    config = plain;
    config.lines = HEIGHT - 1;
    draw(&picture, &scene, &config, &view, &look, 0);
    assert_int_equal(picture.status, OW_ARGUMENT);
    look.order = OW_SCAN_LINE;
    draw(&picture, &scene, &plain, &view, &look, 0);
    assert_int_equal(picture.status, OW_ARGUMENT);
    look = random_scene_look(OW_SHADE_GOURAUD);
    draw(&picture, &scene, &plain, &view, &look, 0);
    assert_int_equal(picture.status, OW_NORMALS);
    assert_int_equal(picture.pixels[0][0], 0xA5A5A5A5);
    uint32_t needed = ow_workspace_bytes_needed(&scene.tree, &plain);
    uint64_t *memory = malloc(needed);
    struct ow_workspace workspace;
    assert_int_equal(ow_workspace_place(&workspace, &scene.tree, &plain, memory, needed - 1),
                     OW_MEMORY);
    assert_int_equal(
        ow_workspace_place(&workspace, &scene.tree, &plain, (uint8_t *)memory + 4, needed),
        OW_ARGUMENT);
    config.cached_vertices = 3;
    assert_int_equal(ow_workspace_bytes_needed(&scene.tree, &config), 0);
    free(memory);
    random_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_orders_draw_one_picture),
        cmocka_unit_test(bands_of_any_height_draw_one_picture),
        cmocka_unit_test(little_memory_draws_the_same_picture),
        cmocka_unit_test(a_budget_leaves_what_is_near),
        cmocka_unit_test(parts_that_save_time_change_no_pixel),
        cmocka_unit_test(looks_whose_part_is_missing_are_refused),
        cmocka_unit_test(wrong_targets_and_workspaces_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
