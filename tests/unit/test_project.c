/* SPDX-License-Identifier: 0BSD */
/*
 * Projection and clipping: vertices on the screen against double; neighbours
 * get the same clipped vertices; nothing leaves the guard band.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <math.h>

#include "ow_clip.h"
#include "ow_project.h"
#include "ow_view.h"

enum { ROOM = 24 };

static uint64_t random_state = 1;

static int32_t random_in(int32_t low, int32_t high)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return low + (int32_t)((random_state >> 33) % (uint64_t)((int64_t)high - low + 1));
}

static struct ow_view random_view(void)
{
    struct ow_view view;
    struct ow_camera camera;
    do {
        int32_t reach = 1 << random_in(16, 27);
        camera = (struct ow_camera){ .up = { 3, 250, -7 },
                                     .fov = (ow_turn)random_in(2 << 26, 2 << 28),
                                     .near = random_in(0, 2) ? 0 : random_in(1, 4000000),
                                     .height = random_in(1 << 12, 1 << 26),
                                     .width_pixels = (uint16_t)random_in(1, OW_SCREEN_MAX),
                                     .height_pixels = (uint16_t)random_in(1, OW_SCREEN_MAX) };
        camera.projection = random_in(0, 2) ? OW_PERSPECTIVE : OW_PARALLEL;
        for (int i = 0; i < 3; i++) {
            camera.eye[i] = random_in(-reach, reach);
            camera.at[i] = random_in(-8000000, 8000000);
        }
    } while (ow_view_make(&view, &camera) != OW_OK);
    return view;
}

/* Some lattice points as a tree that only ow_to_camera looks at. */
struct points {
    struct ow_tree tree;
    uint8_t bytes[6 * 8];
    int v[8][3];
};

static void random_points(struct points *points)
{
    memset(&points->tree, 0, sizeof points->tree);
    points->tree.bytes = points->bytes;
    int reach = 1 << random_in(4, 15);
    for (int i = 0; i < 24; i++) {
        int v = random_in(-reach + 1, reach - 1);
        points->v[i / 3][i % 3] = v;
        points->bytes[2 * i] = (uint8_t)(v & 0xFF);
        points->bytes[2 * i + 1] = (uint8_t)((unsigned)v >> 8);
    }
}

static double along(const ow_q30 axis[3], const struct ow_view *view, const int v[3])
{
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        sum += ldexp(axis[i], -30) * (v[i] - view->eye[i] / 256.0);
    }
    return sum;
}

static void camera_points_are_exact_but_for_the_last_unit(void **state)
{
    (void)state;
    for (int n = 0; n < 5000; n++) {
        struct ow_view view = random_view();
        struct points points;
        random_points(&points);
        double unit = ldexp(1, view.camera_shift - 38);
        for (uint32_t i = 0; i < 8; i++) {
            struct ow_camera_point p = ow_to_camera(&points.tree, &view, i);
            const double errors[3] = { p.x - along(view.right, &view, points.v[i]) / unit,
                                       p.y - along(view.up, &view, points.v[i]) / unit,
                                       p.z - along(view.forward, &view, points.v[i]) / unit };
            for (int k = 0; k < 3; k++) { /* rounded down; the offset's own rounding is far below */
                assert_true(errors[k] <= 0.01 && errors[k] >= -1.01);
            }
        }
    }
}

/* To the nearest 1/256 pixel, and what a camera unit and the reciprocal can add to that. */
static void screen_points_are_rounded_to_the_nearest(void **state)
{
    (void)state;
    int inside = 0;
    for (int n = 0; n < 20000; n++) {
        struct ow_view view = random_view();
        struct points points;
        random_points(&points);
        double unit = ldexp(1, view.camera_shift - 38);
        double scale = ldexp(view.scale.mantissa, -view.scale.exponent);
        for (uint32_t i = 0; i < 8; i++) {
            struct ow_camera_point p = ow_to_camera(&points.tree, &view, i);
            if (!ow_is_inside(&view, p)) {
                continue;
            }
            inside++;
            struct ow_outline_point s = ow_to_screen(&view, p);
            double x = along(view.right, &view, points.v[i]) / unit;
            double y = along(view.up, &view, points.v[i]) / unit;
            double z = view.projection == OW_PERSPECTIVE
                           ? along(view.forward, &view, points.v[i]) / unit
                           : 1;
            double slope = view.projection == OW_PERSPECTIVE ? fmax(fabs(x), fabs(y)) / z : 0;
            double bound = 0.5 + 1.1 * (1 + slope) * scale / z + ldexp(OW_GUARD, -26);
            assert_true(fabs(s.x - (OW_SUB / 2 * view.width + x * scale / z)) <= bound);
            assert_true(fabs(s.y - (OW_SUB / 2 * view.height - y * scale / z)) <= bound);
            assert_true(abs(s.x - OW_SUB / 2 * view.width) <= OW_GUARD);
            assert_true(abs(s.y - OW_SUB / 2 * view.height) <= OW_GUARD);
        }
    }
    assert_true(inside > 10000);
}

/* ---- clipping ------------------------------------------------------------------------------- */
struct outline {
    struct ow_camera_point buffers[2][ROOM];
    const struct ow_camera_point *points;
    uint32_t count;
    bool overflow;
};

static void clip(struct outline *out, const struct ow_view *view, const struct ow_camera_point *in,
                 uint32_t count, uint32_t capacity)
{
    uint32_t which;
    memcpy(out->buffers[0], in, count * sizeof *in);
    out->overflow = false;
    struct ow_camera_point *const buffers[2] = { out->buffers[0], out->buffers[1] };
    out->count = ow_clip(view, buffers, count, capacity, &which, &out->overflow);
    out->points = out->buffers[which];
}

static bool same(struct ow_camera_point a, struct ow_camera_point b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static bool contains(const struct outline *outline, struct ow_camera_point p)
{
    for (uint32_t i = 0; i < outline->count; i++) {
        if (same(outline->points[i], p)) {
            return true;
        }
    }
    return false;
}

static void random_polygon(const struct ow_view *view, struct ow_camera_point *p, uint32_t count)
{
    struct points points;
    random_points(&points);
    for (uint32_t i = 0; i < count; i++) {
        p[i] = ow_to_camera(&points.tree, view, i);
    }
}

static void clipped_outlines_are_inside(void **state)
{
    (void)state;
    uint32_t cut = 0, gone = 0, whole = 0;
    for (int n = 0; n < 40000; n++) {
        struct ow_view view = random_view();
        struct ow_camera_point p[8];
        struct outline out;
        uint32_t count = (uint32_t)random_in(3, 8);
        random_polygon(&view, p, count);
        clip(&out, &view, p, count, ROOM);
        assert_false(out.overflow);
        bool all_inside = true;
        for (uint32_t i = 0; i < count; i++) {
            bool inside = ow_is_inside(&view, p[i]);
            all_inside = all_inside && inside;
            assert_true(!inside || contains(&out, p[i]));
        }
        for (uint32_t i = 0; i < out.count; i++) {
            /* A later plane's rounding may leave a vertex a hair beyond an earlier plane. */
            int64_t reach = ow_reach(&view, out.points[i].z);
            reach += 16 + (reach >> 14);
            assert_true(view.projection == OW_PARALLEL || out.points[i].z >= view.near_z);
            assert_true(llabs(out.points[i].x) <= reach && llabs(out.points[i].y) <= reach);
            struct ow_outline_point s = ow_to_screen(&view, out.points[i]);
            assert_true(abs(s.x - OW_SUB / 2 * view.width) <= OW_GUARD);
            assert_true(abs(s.y - OW_SUB / 2 * view.height) <= OW_GUARD);
        }
        assert_true(!all_inside || out.count == count);
        whole += all_inside;
        gone += out.count == 0;
        cut += out.count > 0 && !all_inside;
    }
    print_message("%u whole, %u cut, %u gone\n", whole, cut, gone);
    assert_true(whole > 1000 && cut > 1000 && gone > 1000);
}

/* The same triangle from the other side: each edge is shared, and runs the other way. */
static void neighbours_get_the_same_vertices(void **state)
{
    (void)state;
    uint32_t cut = 0;
    for (int n = 0; n < 40000; n++) {
        struct ow_view view = random_view();
        struct ow_camera_point p[3], q[3];
        struct outline one, other;
        random_polygon(&view, p, 3);
        for (int i = 0; i < 3; i++) {
            q[i] = p[2 - i];
        }
        clip(&one, &view, p, 3, ROOM);
        clip(&other, &view, q, 3, ROOM);
        assert_int_equal(one.count, other.count);
        for (uint32_t i = 0; i < one.count; i++) {
            assert_true(contains(&other, one.points[i]));
            assert_true(contains(&one, other.points[i]));
        }
        cut += one.count > 0 &&
               !(contains(&one, p[0]) && contains(&one, p[1]) && contains(&one, p[2]));
    }
    assert_true(cut > 1000);
}

/* The cut corner moves along its edge only: within two camera units of the exact place. */
static void new_vertices_lie_on_their_edge(void **state)
{
    (void)state;
    uint32_t checked = 0;
    for (int n = 0; n < 60000; n++) {
        struct ow_view view = random_view();
        struct ow_camera_point p[3];
        struct outline out;
        random_polygon(&view, p, 3);
        if (view.projection != OW_PERSPECTIVE || p[0].z < view.near_z || p[1].z < view.near_z ||
            p[2].z >= view.near_z) {
            continue;
        }
        clip(&out, &view, p, 3, ROOM);
        for (uint32_t k = 0; k < 2; k++) {
            double t = ((double)p[k].z - view.near_z) / ((double)p[k].z - p[2].z);
            double x = p[k].x + t * ((double)p[2].x - p[k].x);
            double y = p[k].y + t * ((double)p[2].y - p[k].y);
            struct ow_camera_point due = { .x = (int32_t)lround(x),
                                           .y = (int32_t)lround(y),
                                           .z = view.near_z };
            bool found = !ow_is_inside(&view, p[k]) || !ow_is_inside(&view, due);
            for (uint32_t i = 0; i < out.count && !found; i++) {
                found = out.points[i].z == view.near_z && fabs(out.points[i].x - x) <= 4 &&
                        fabs(out.points[i].y - y) <= 4;
            }
            checked += ow_is_inside(&view, p[k]) && ow_is_inside(&view, due);
            assert_true(found);
        }
    }
    print_message("%u checked\n", checked);
    assert_true(checked > 100);
}

static void too_little_room_is_reported(void **state)
{
    (void)state;
    uint32_t overflows = 0;
    for (int n = 0; n < 20000; n++) {
        struct ow_view view = random_view();
        struct ow_camera_point p[8];
        struct outline out;
        random_polygon(&view, p, 8);
        memset(&out, 0x5A, sizeof out);
        clip(&out, &view, p, 8, 8);
        for (int b = 0; b < 2; b++) { /* never past the capacity */
            const uint8_t *beyond = (const uint8_t *)&out.buffers[b][8];
            for (size_t i = 0; i < (ROOM - 8) * sizeof *p; i++) {
                assert_int_equal(beyond[i], 0x5A);
            }
        }
        assert_true(!out.overflow || out.count == 0);
        overflows += out.overflow;
    }
    assert_true(overflows > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(camera_points_are_exact_but_for_the_last_unit),
        cmocka_unit_test(screen_points_are_rounded_to_the_nearest),
        cmocka_unit_test(clipped_outlines_are_inside),
        cmocka_unit_test(neighbours_get_the_same_vertices),
        cmocka_unit_test(new_vertices_lie_on_their_edge),
        cmocka_unit_test(too_little_room_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
