/* SPDX-License-Identifier: 0BSD */
/*
 * The cutting plane: a closed box, cut open, against rays in binary64. A pixel
 * must show what a ray shows at its centre or at one of its eight neighbours'.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ow_draw.h"
#include "owc_models.h"
#include "random_scene.h"
#include "tools/owc/import.h"

enum { SIZE = 120, BACKGROUND = 0x000001, CAP = 0xFF00FF };

static const double box_size[3] = { 2, 1.2, 1.6 };

struct cut_scene {
    struct blob blob;
    struct ow_tree tree;
    double half[3]; /* of the box, lattice steps */
};

static void open_scene(struct cut_scene *scene, enum sides sides)
{
    struct model model;
    memset(&model, 0, sizeof model);
    const struct models_pose home = { 0, 0, { 0, 0, 0 } };
    models_box(&model, box_size, 3, &home);
    struct compile_options options = models_options();
    options.sides = sides;
    struct compile_stats stats;
    models_compile(&scene->blob, &stats, &model, &options);
    assert_int_equal(ow_tree_open(&scene->tree, scene->blob.bytes, scene->blob.size), OW_OK);
    for (int k = 0; k < 3; k++) {
        scene->half[k] = scene->tree.box_max[k];
    }
    import_free(&model);
}

static void close_scene(struct cut_scene *scene)
{
    blob_free(&scene->blob);
}

static double along(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The ray through a point of the screen, pixels. */
static void ray_of(const struct ow_view *view, double x, double y, double from[3], double to[3])
{
    double focal = ldexp(view->scale.mantissa, -view->scale.exponent) / OW_SUB;
    for (int k = 0; k < 3; k++) {
        from[k] = view->eye[k] / 256.0;
        to[k] = ldexp(view->right[k] * (x - SIZE / 2.0) / focal -
                          view->up[k] * (y - SIZE / 2.0) / focal + view->forward[k],
                      -30);
    }
}

/* What the ray meets first of the box where normal.v >= distance. */
static uint32_t shoot(const struct cut_scene *scene, const struct ow_view *view,
                      const double normal[3], double distance, double x, double y)
{
    double from[3];
    double to[3];
    ray_of(view, x, y, from, to);
    double enter = 0;
    double leave = 1e30;
    uint32_t met = BACKGROUND;
    for (int k = 0; k < 4; k++) {
        double slope = k < 3 ? to[k] : -along(normal, to);
        double base = k < 3 ? from[k] : distance - along(normal, from);
        double high = k < 3 ? scene->half[k] : 0;
        double low = k < 3 ? -scene->half[k] : -1e30;
        double first = (slope > 0 ? low - base : high - base) / slope;
        double last = (slope > 0 ? high - base : low - base) / slope;
        if (first > enter) {
            enter = first;
            met = k < 3 ? 0xCCCCCC : CAP;
        }
        leave = last < leave ? last : leave;
    }
    return enter < leave ? met : BACKGROUND;
}

static uint32_t pixels[SIZE][SIZE];

static enum ow_status draw(const struct cut_scene *scene, const struct ow_view *view,
                           enum ow_order order, bool caps)
{
    const struct ow_workspace_config config = { .parts = &ow_parts_all,
                                                .width = SIZE,
                                                .lines = SIZE };
    uint32_t bytes = ow_workspace_bytes_needed(&scene->tree, &config);
    void *memory = malloc(bytes);
    struct ow_workspace workspace;
    assert_int_equal(ow_workspace_place(&workspace, &scene->tree, &config, memory, bytes), OW_OK);
    struct ow_look look = { .order = order,
                            .shade = OW_SHADE_FLAT,
                            .background = BACKGROUND,
                            .ambient_q8 = 256,
                            .caps = caps,
                            .cap = CAP };
    struct ow_target target = { (uint8_t *)pixels, SIZE * 4, 0, SIZE, &ow_format_xrgb8888, NULL };
    enum ow_status status = ow_draw(&scene->tree, view, &look, &target, &workspace, NULL);
    free(memory);
    return status;
}

static void compare(const struct cut_scene *scene, const struct ow_view *view,
                    const double normal[3], double distance, uint32_t *caps)
{
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            bool fine = false;
            for (int n = 0; n < 9 && !fine; n++) {
                fine = pixels[y][x] == shoot(scene, view, normal, distance, x + 0.5 + n % 3 - 1,
                                             y + 0.5 + n / 3 - 1);
            }
            if (!fine) {
                print_error("pixel %d,%d shows %06x\n", x, y, (unsigned)pixels[y][x]);
            }
            assert_true(fine);
            *caps += pixels[y][x] == CAP;
        }
    }
}

static struct ow_view make_view(const struct cut_scene *scene, uint32_t azimuth)
{
    struct ow_camera camera = {
        .projection = OW_PERSPECTIVE, .fov = 0x14000000, .width_pixels = SIZE, .height_pixels = SIZE
    };
    struct ow_view view;
    ow_camera_orbit(&camera, &scene->tree, azimuth, 0x10000000);
    assert_int_equal(ow_view_make(&view, &camera), OW_OK);
    return view;
}

static void a_cut_box_shows_what_rays_show(void **state)
{
    (void)state;
    struct cut_scene scene;
    open_scene(&scene, SIDES_TWO);
    uint32_t caps = 0;
    for (int i = 0; i < 40; i++) {
        int32_t normal[3];
        double unit[3];
        for (int k = 0; k < 3; k++) {
            normal[k] = (int32_t)random_below(2001) - 1000;
        }
        double length = sqrt((double)normal[0] * normal[0] + (double)normal[1] * normal[1] +
                             (double)normal[2] * normal[2]);
        ow_q8 distance = ((int32_t)random_below(40001) - 20000) * 256;
        struct ow_view view = make_view(&scene, random_below(0xFFFFFFFF));
        assert_int_equal(ow_view_cut(&view, normal, distance), OW_OK);
        for (int k = 0; k < 3; k++) {
            unit[k] = normal[k] / length;
        }
        assert_int_equal(draw(&scene, &view, i % 2 ? OW_FRONT_TO_BACK : OW_BACK_TO_FRONT, true),
                         OW_OK);
        compare(&scene, &view, unit, distance / 256.0, &caps);
    }
    assert_true(caps > 10000); /* the cut was seen */
    close_scene(&scene);
}

static void without_caps_the_inside_is_seen(void **state)
{
    (void)state;
    struct cut_scene scene;
    open_scene(&scene, SIDES_TWO);
    struct ow_view view = make_view(&scene, 0);
    const int32_t away[3] = { 0, 0, -1 };
    assert_int_equal(ow_view_cut(&view, away, 0), OW_OK);
    assert_int_equal(draw(&scene, &view, OW_FRONT_TO_BACK, false), OW_OK);
    assert_int_equal(pixels[SIZE / 2][SIZE / 2], 0xCCCCCC);
    assert_int_equal(draw(&scene, &view, OW_FRONT_TO_BACK, true), OW_OK);
    assert_int_equal(pixels[SIZE / 2][SIZE / 2], CAP);
    close_scene(&scene);
}

static void what_cannot_be_cut_is_refused(void **state)
{
    (void)state;
    struct cut_scene scene;
    open_scene(&scene, SIDES_ONE);
    struct ow_view view = make_view(&scene, 0);
    const int32_t nowhere[3] = { 0, 0, 0 };
    const int32_t up[3] = { 0, 1, 0 };
    assert_int_equal(ow_view_cut(&view, nowhere, 0), OW_ARGUMENT);
    assert_int_equal(ow_view_cut(&view, up, OW_EYE_MAX + 1), OW_ARGUMENT);
    assert_int_equal(ow_view_cut(&view, up, 0), OW_OK);
    assert_int_equal(draw(&scene, &view, OW_FRONT_TO_BACK, true), OW_SIDES);
    close_scene(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cut_box_shows_what_rays_show),
        cmocka_unit_test(without_caps_the_inside_is_seen),
        cmocka_unit_test(what_cannot_be_cut_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
