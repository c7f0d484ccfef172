/* SPDX-License-Identifier: 0BSD */
/* The view: axes, units, scale and orbit against double, and what is refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <math.h>

#include "ow_view.h"

static const double pi = 3.14159265358979323846;

static uint64_t random_state = 1;

static int32_t random_in(int32_t low, int32_t high)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return low + (int32_t)((random_state >> 33) % (uint64_t)((int64_t)high - low + 1));
}

/* A valid perspective camera. */
static struct ow_camera plain(void)
{
    return (struct ow_camera){ .eye = { 0, 0, 50000 * 256 },
                               .up = { 0, 256, 0 },
                               .projection = OW_PERSPECTIVE,
                               .fov = 1u << 29,
                               .width_pixels = 320,
                               .height_pixels = 240 };
}

/* Eyes from a fraction of a lattice unit to the limit away, any up that is not parallel. */
static struct ow_camera random_camera(void)
{
    struct ow_camera camera = plain();
    int32_t reach = 1 << random_in(4, 29);
    for (int i = 0; i < 3; i++) {
        camera.eye[i] = random_in(-reach, reach);
        camera.at[i] = random_in(-reach, reach);
        camera.up[i] = random_in(-1000, 1000);
    }
    camera.at[0] += camera.at[0] == camera.eye[0] ? 1 : 0;
    return camera;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void axis(const ow_q30 q[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = ldexp(q[i], -30);
    }
}

/* Unit length, right angles and right-handedness within 2^-27. */
static void axes_are_orthonormal(void **state)
{
    (void)state;
    double bound = ldexp(1, -27), worst = 0;
    int made = 0;
    for (int i = 0; i < 20000; i++) {
        struct ow_camera camera = random_camera();
        struct ow_view view;
        if (ow_view_make(&view, &camera) != OW_OK) {
            continue; /* up happened to be parallel */
        }
        made++;
        double r[3], u[3], f[3];
        axis(view.right, r);
        axis(view.up, u);
        axis(view.forward, f);
        const double errors[] = { dot(r, r) - 1, dot(u, u) - 1, dot(f, f) - 1,
                                  dot(r, u),     dot(u, f),     dot(f, r) };
        for (int k = 0; k < 6; k++) {
            worst = fmax(worst, fabs(errors[k]));
        }
        double turn = r[0] * (u[1] * f[2] - u[2] * f[1]) - r[1] * (u[0] * f[2] - u[2] * f[0]) +
                      r[2] * (u[0] * f[1] - u[1] * f[0]);
        assert_true(turn < -0.99); /* right, up, backward are right-handed */
    }
    print_message("worst deviation of the axes: 2^%.2f\n", log2(worst));
    assert_true(made > 19000);
    assert_true(worst <= bound);
}

/* Forward points from the eye to at; up leans to the caller's up. */
static void axes_look_where_the_camera_says(void **state)
{
    (void)state;
    for (int i = 0; i < 20000; i++) {
        struct ow_camera camera = random_camera();
        struct ow_view view;
        if (ow_view_make(&view, &camera) != OW_OK) {
            continue;
        }
        double f[3], u[3], r[3], way[3], up[3];
        axis(view.forward, f);
        axis(view.up, u);
        axis(view.right, r);
        for (int k = 0; k < 3; k++) {
            way[k] = (double)camera.at[k] - camera.eye[k];
            up[k] = camera.up[k];
        }
        double length = sqrt(dot(way, way));
        for (int k = 0; k < 3; k++) {
            assert_true(fabs(f[k] - way[k] / length) <= ldexp(1, -28));
        }
        assert_true(dot(u, up) > 0);
        assert_true(fabs(dot(r, up)) <= ldexp(1, -18) * sqrt(dot(up, up)));
    }
}

static void units_and_scale_are_as_documented(void **state)
{
    (void)state;
    for (int i = 0; i < 20000; i++) {
        struct ow_camera camera = random_camera();
        camera.fov = (ow_turn)random_in(11930465, 2000000000);
        camera.near = random_in(0, 1) ? 0 : random_in(1, 100000);
        camera.height_pixels = (uint16_t)random_in(1, OW_SCREEN_MAX);
        camera.projection = random_in(0, 1) ? OW_PARALLEL : OW_PERSPECTIVE;
        camera.height = random_in(1, INT32_MAX);
        struct ow_view view;
        if (ow_view_make(&view, &camera) != OW_OK) {
            continue;
        }
        double unit = ldexp(1, view.camera_shift - 38);
        double scale = ldexp(view.scale.mantissa, -view.scale.exponent);
        /* The farthest corner of the lattice fits 31 bits and a sign. */
        double far = 0;
        for (int k = 0; k < 3; k++) {
            far = fmax(far, fabs(view.eye[k] / 256.0) + 32768);
        }
        assert_true(sqrt(3) * far / unit < 2147483647.0);
        assert_int_equal(memcmp(view.eye, camera.eye, sizeof view.eye), 0);
        if (view.projection == OW_PARALLEL) {
            double due = 256.0 * camera.height_pixels / (camera.height / 256.0);
            assert_true(fabs(scale / unit / due - 1) < 1e-8);
        } else {
            double half = pi * camera.fov / 4294967296.0;
            double due = 128.0 * camera.height_pixels / tan(half);
            /* Sine and cosine are right within 2^-15 each. */
            double bound = ldexp(1, -15) * (1 / sin(half) + 1 / cos(half)) + 1e-8;
            assert_true(fabs(scale / due - 1) < bound);
            double near = (camera.near ? camera.near : OW_NEAR_DEFAULT) / 256.0;
            assert_true(fabs(view.near_z * unit - near) <= unit);
        }
    }
}

static void the_orbit_follows_its_formula(void **state)
{
    (void)state;
    struct ow_tree tree;
    memset(&tree, 0, sizeof tree);
    for (int i = 0; i < 5000; i++) {
        double squares = 0, radius, sine = ldexp(1, -15);
        struct ow_camera camera = plain();
        for (int k = 0; k < 3; k++) {
            int16_t a = (int16_t)random_in(-32767, 32767), b = (int16_t)random_in(-32767, 32767);
            tree.box_min[k] = a < b ? a : b;
            tree.box_max[k] = a < b ? b : a;
            squares += pow(tree.box_max[k] - tree.box_min[k], 2);
        }
        radius = 2.5 * sqrt(squares) / 2;
        ow_turn azimuth = (ow_turn)random_in(INT32_MIN, INT32_MAX);
        int32_t elevation = random_in(-(1 << 30), 1 << 30);
        ow_camera_orbit(&camera, &tree, azimuth, (ow_turn)elevation);
        double a = 2 * pi * azimuth / 4294967296.0, e = 2 * pi * elevation / 4294967296.0;
        const double way[3] = { cos(e) * sin(a), sin(e), cos(e) * cos(a) };
        for (int k = 0; k < 3; k++) {
            double centre = (tree.box_min[k] + tree.box_max[k]) / 2.0;
            double error = camera.eye[k] / 256.0 - (centre + radius * way[k]);
            /* Two sines' errors, and rounding to 1/256 a few times. */
            assert_true(fabs(error) <= 2 * radius * sine + 0.05);
            assert_true(camera.at[k] == centre * 256);
        }
        assert_true(camera.up[0] == 0 && camera.up[1] > 0 && camera.up[2] == 0);
    }
}

/* Azimuth 0 is +z, a quarter turn +x; the middle of the model is in the middle. */
static void the_orbit_turns_from_z_to_x(void **state)
{
    (void)state;
    struct ow_tree tree;
    memset(&tree, 0, sizeof tree);
    for (int k = 0; k < 3; k++) {
        tree.box_min[k] = -3000;
        tree.box_max[k] = 3000;
    }
    struct ow_camera camera = plain();
    ow_camera_orbit(&camera, &tree, 0, 0);
    assert_true(camera.eye[0] == 0 && camera.eye[1] == 0 && camera.eye[2] > 12900 * 256);
    ow_camera_orbit(&camera, &tree, 0x40000000, 0);
    assert_true(camera.eye[0] > 12900 * 256 && camera.eye[1] == 0 && camera.eye[2] == 0);
    ow_camera_orbit(&camera, &tree, 0, 0x20000000);
    assert_true(camera.eye[1] > 9000 * 256);
}

static enum ow_status make(const struct ow_camera *camera)
{
    struct ow_view view;
    return ow_view_make(&view, camera);
}

static void wrong_cameras_are_refused(void **state)
{
    (void)state;
    struct ow_camera camera = plain();
    assert_int_equal(make(&camera), OW_OK);
#define REFUSED(change) \
    camera = plain();   \
    change;             \
    assert_int_equal(make(&camera), OW_ARGUMENT)
    REFUSED(memcpy(camera.at, camera.eye, sizeof camera.at));
    REFUSED(camera.up[1] = 0);
    REFUSED(camera.up[1] = 0; camera.up[2] = 77);
    REFUSED(camera.up[1] = 0; camera.up[2] = -77);
    REFUSED(camera.eye[1] = OW_EYE_MAX + 1);
    REFUSED(camera.eye[0] = -OW_EYE_MAX - 1);
    REFUSED(camera.eye[2] = INT32_MIN);
    REFUSED(camera.at[1] = OW_EYE_MAX + 1);
    REFUSED(camera.at[2] = INT32_MIN);
    REFUSED(camera.width_pixels = 0);
    REFUSED(camera.height_pixels = 0);
    REFUSED(camera.width_pixels = OW_SCREEN_MAX + 1);
    REFUSED(camera.height_pixels = OW_SCREEN_MAX + 1);
    REFUSED(camera.fov = 0);
    REFUSED(camera.fov = 11000000);   /* below 1 degree */
    REFUSED(camera.fov = 2040109466); /* above 171 degrees */
    REFUSED(camera.fov = 4294967295u);
    REFUSED(camera.near = -1);
    REFUSED(camera.projection = OW_PARALLEL; camera.height = 0);
    REFUSED(camera.projection = OW_PARALLEL; camera.height = -5);
#undef REFUSED
}

static void the_limits_themselves_are_accepted(void **state)
{
    (void)state;
    struct ow_camera camera = plain();
    camera.eye[0] = OW_EYE_MAX;
    camera.at[0] = -OW_EYE_MAX;
    camera.width_pixels = camera.height_pixels = OW_SCREEN_MAX;
    camera.fov = 11930465; /* 1 degree */
    assert_int_equal(make(&camera), OW_OK);
    camera.fov = 2028178978; /* 170 degrees */
    assert_int_equal(make(&camera), OW_OK);
    camera.near = INT32_MAX;
    assert_int_equal(make(&camera), OW_OK);
    camera.projection = OW_PARALLEL;
    camera.height = 1;
    assert_int_equal(make(&camera), OW_OK);
    camera.height = INT32_MAX;
    assert_int_equal(make(&camera), OW_OK);
    camera.up[0] = INT32_MIN;
    assert_int_equal(make(&camera), OW_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(axes_are_orthonormal),
        cmocka_unit_test(axes_look_where_the_camera_says),
        cmocka_unit_test(units_and_scale_are_as_documented),
        cmocka_unit_test(the_orbit_follows_its_formula),
        cmocka_unit_test(the_orbit_turns_from_z_to_x),
        cmocka_unit_test(wrong_cameras_are_refused),
        cmocka_unit_test(the_limits_themselves_are_accepted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
