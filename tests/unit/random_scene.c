/* SPDX-License-Identifier: 0BSD */
/* Random faces in a fixed order. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "tests/property/blob_builder.h"
#include "tests/unit/random_scene.h"

enum { CANARY = 0x5C, CANARY_BYTES = 64, REACH = 20000, NORMAL = 127 };

static uint64_t random_state = 1;

uint32_t random_below(uint32_t n)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((random_state >> 33) % n);
}

static int random_in(int low, int high)
{
    return low + (int)random_below((uint32_t)(high - low + 1));
}

/* Corners around a centre, near in depth: seen from +z mostly a front. */
static void add_face(struct builder *b, uint32_t root, uint32_t number)
{
    static const int circle[6][2] = { { 2, 0 },  { 1, 2 },   { -1, 2 },
                                      { -2, 0 }, { -1, -2 }, { 1, -2 } };
    uint32_t corners[6];
    uint32_t count = 3 + random_below(4);
    int size = random_below(4) == 0 ? 6000 : 1200;
    int x = random_in(-REACH / 2, REACH / 2);
    int y = random_in(-REACH / 2, REACH / 2);
    int z = random_in(-REACH / 2, REACH / 2);
    for (uint32_t i = 0; i < count; i++) {
        const int *place = circle[i * 6 / count];
        corners[i] = builder_vertex(b, x + place[0] * size / 2 + random_in(-size, size) / 2,
                                    y + place[1] * size / 2 + random_in(-size, size) / 2,
                                    z + random_in(-300, 300));
    }
    uint32_t colour = builder_colour(b, random_below(1 << 24));
    uint32_t polygon = builder_polygon(b, corners, count, colour, number + 1);
    for (uint32_t i = 0; i < count; i++) {
        if (random_below(3) == 0) {
            builder_mark(b, polygon, i);
        }
    }
    builder_add(b, root, OW_ITEM_FACE, polygon);
}

/* Normals within a quarter turn of +z. */
static void shake_normals(struct random_scene *scene)
{
    for (uint32_t i = 0; i < scene->tree.vertex_count; i++) {
        uint8_t *normal = scene->blob + scene->tree.normals_at + 3 * i;
        int x = random_in(-80, 80);
        int y = random_in(-80, 80);
        int z = 1;
        while (x * x + y * y + z * z < NORMAL * NORMAL) {
            z++;
        }
        normal[0] = (uint8_t)x;
        normal[1] = (uint8_t)y;
        normal[2] = (uint8_t)(z > NORMAL ? NORMAL : z);
    }
    blob_seal(scene->blob, scene->blob_bytes);
}

void random_scene_make(struct random_scene *scene, uint32_t count, bool normals)
{
    struct builder *b = builder_new(OW_TREE_IDS | (normals ? OW_TREE_NORMALS : 0u));
    uint32_t root = builder_sequence(b);
    builder_bound(b, root); /* so that drawing asks whether it can be skipped */
    memset(scene, 0, sizeof *scene);
    assert_true(count <= BUILDER_COLOURS);
    for (uint32_t i = 0; i < count; i++) {
        add_face(b, root, i);
    }
    b->step = 0.001;
    scene->blob = builder_finish(b, root, &scene->blob_bytes);
    free(b);
    assert_int_equal(ow_tree_open(&scene->tree, scene->blob, scene->blob_bytes), OW_OK);
    if (normals) {
        shake_normals(scene);
        assert_int_equal(ow_tree_open(&scene->tree, scene->blob, scene->blob_bytes), OW_OK);
    }
}

static void check_guard(const struct random_scene *scene)
{
    for (uint32_t i = 0; scene->memory != NULL && i < CANARY_BYTES; i++) {
        assert_int_equal(((uint8_t *)scene->memory)[scene->memory_bytes + i], CANARY);
    }
}

void random_scene_place(struct random_scene *scene, const struct ow_workspace_config *config)
{
    check_guard(scene);
    free(scene->memory);
    scene->memory_bytes = ow_workspace_bytes_needed(&scene->tree, config);
    assert_int_not_equal(scene->memory_bytes, 0);
    scene->memory = malloc(scene->memory_bytes + CANARY_BYTES);
    assert_non_null(scene->memory);
    memset(scene->memory, CANARY, scene->memory_bytes + CANARY_BYTES);
    assert_int_equal(ow_workspace_place(&scene->workspace, &scene->tree, config, scene->memory,
                                        scene->memory_bytes),
                     OW_OK);
}

void random_scene_free(struct random_scene *scene)
{
    check_guard(scene);
    free(scene->memory);
    free(scene->blob);
    memset(scene, 0, sizeof *scene);
}

struct ow_view random_scene_view(const struct random_scene *scene, uint32_t number, uint16_t width,
                                 uint16_t height)
{
    struct ow_camera camera = {
        .projection = number % 3 == 2 ? OW_PARALLEL : OW_PERSPECTIVE,
        .fov = UINT32_C(1) << (number % 2 == 0 ? 28 : 29),
        .height = 40000 * 256,
        .width_pixels = width,
        .height_pixels = height,
    };
    struct ow_view view;
    ow_camera_orbit(&camera, &scene->tree, number * 100000000u, number * 50000000u);
    assert_int_equal(ow_view_make(&view, &camera), OW_OK);
    return view;
}

struct ow_look random_scene_look(enum ow_shade shade)
{
    return (struct ow_look){
        .order = OW_FRONT_TO_BACK,
        .shade = shade,
        .background = 0x203040,
        .foreground = 0xF0E0D0,
        .ambient_q8 = 60,
        .lights = { { .direction_q14 = { -6000, 9000, 12288 }, .intensity_q8 = 196 } },
        .light_count = 1,
        .specular_q8 = 100,
        .shininess = 4,
    };
}

uint32_t random_scene_outline(const struct random_scene *scene, const struct ow_view *view,
                              const struct ow_face *face, struct ow_outline_point *points)
{
    uint32_t count = ow_read_u8(scene->tree.bytes, face->at);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t vertex = ow_corner(&scene->tree, face->at, i);
        struct ow_camera_point p = ow_to_camera(&scene->tree, view, vertex);
        assert_true(ow_is_inside(view, p) && !face->reverse);
        points[i] = ow_to_screen(view, p);
    }
    return count;
}
