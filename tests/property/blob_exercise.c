/* SPDX-License-Identifier: 0BSD */
/* Uses a blob in every way the core offers: see blob_exercise.h. */
#include "tests/property/blob_exercise.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ow_draw.h"

enum { WIDTH = 37, HEIGHT = 23, BAND = 9, MANY_FACES = 2000 };

static void insist(bool good, const char *what)
{
    if (!good) {
        fprintf(stderr, "blob_exercise: %s\n", what);
        abort();
    }
}

static void *block_of(size_t bytes)
{
    void *block = malloc(bytes ? bytes : 1);
    insist(block != NULL, "out of memory");
    return block;
}

/* Eyes outside, inside, on a corner of the box, and as far off as can be. */
static const struct ow_camera cameras[] = {
    { .eye = { 0, 0, 3000 * 256 }, .up = { 0, 1, 0 }, .fov = 1u << 29 },
    { .eye = { 40 * 256, 77 * 256, 20 * 256 },
      .at = { 256 * 900, 0, -256 * 200 },
      .up = { 0, 256, 30 },
      .fov = 1u << 30,
      .near = 1 },
    { .eye = { -900 * 256, -900 * 256, 3 }, .up = { 0, 1, 0 }, .fov = 5u << 28, .near = 256 },
    { .eye = { OW_EYE_MAX, -OW_EYE_MAX, OW_EYE_MAX },
      .at = { -OW_EYE_MAX, 0, 0 },
      .up = { 0, 0, 1 },
      .fov = 12000000 },
    { .eye = { 300, 500 * 256, -800 * 256 },
      .up = { 0, 1, 0 },
      .projection = OW_PARALLEL,
      .height = 2500 * 256 },
    { .eye = { 0, 0, 0 },
      .at = { 256, 1, 1 },
      .up = { 0, 1, 0 },
      .projection = OW_PARALLEL,
      .height = 1 },
};
enum { CAMERAS = sizeof cameras / sizeof *cameras };

static void walk(const struct ow_tree *tree, const struct ow_view *view, enum ow_direction way,
                 enum ow_cull cull)
{
    struct ow_walk_run *stack = block_of(ow_walk_stack_bytes(tree));
    struct ow_walk state;
    struct ow_face face;
    enum ow_status status = ow_walk_begin(&state, tree, view, way, cull, stack);
    bool may_refuse = cull == OW_CULL_NONE && !(tree->flags & OW_TREE_TWO_SIDED);
    insist(status == OW_OK || (may_refuse && status == OW_SIDES), "the walk's status");
    uint32_t yielded = 0;
    while (status == OW_OK && ow_walk_next(&state, &face)) {
        uint32_t bytes = ow_polygon_bytes(tree, face.at);
        insist(face.at + bytes <= tree->vertices_at, "a face beyond the records");
        insist(++yielded <= tree->face_count, "more faces than the header says");
    }
    insist(status != OW_OK || tree->instance_count > 0 || state.faces_met == tree->face_count,
           "not every face was met");
    free(stack);
}

static void draw_bands(const struct ow_tree *tree, const struct ow_view *view,
                       const struct ow_look *look, const struct ow_pixel_format *format,
                       uint32_t cached)
{
    struct ow_workspace_config config = {
        .parts = &ow_parts_all, .width = WIDTH, .lines = BAND, .cached_vertices = cached
    };
    uint32_t bytes = ow_workspace_bytes_needed(tree, &config);
    insist(bytes > 0, "a sane configuration was refused");
    void *memory = block_of(bytes);
    struct ow_workspace workspace;
    insist(ow_workspace_place(&workspace, tree, &config, memory, bytes) == OW_OK, "placing");
    uint32_t stride = (ow_row_bytes(format, WIDTH) + 3) & ~3u;
    for (uint16_t first = 0; first < HEIGHT; first = (uint16_t)(first + BAND)) {
        uint16_t lines = (uint16_t)(HEIGHT - first < BAND ? HEIGHT - first : BAND);
        uint8_t *pixels = block_of((size_t)stride * lines);
        struct ow_target target = { pixels, stride, first, lines, format, NULL };
        struct ow_stats stats;
        enum ow_status status = ow_draw(tree, view, look, &target, &workspace, &stats);
        insist(status == OW_OK || status == OW_CAPACITY || status == OW_SIDES ||
                   status == OW_REGION,
               "drawing's status");
        if ((status == OW_OK || status == OW_REGION) && look->order == OW_FRONT_TO_BACK) {
            insist(stats.pixels_written + stats.pixels_background == (uint32_t)(WIDTH * lines),
                   "each pixel is written once");
        }
        free(pixels);
    }
    free(memory);
}

/* Objects stand where their own lattice does, or lie about. */
static const struct ow_pose *make_poses(const struct ow_tree *tree, uint32_t number)
{
    static struct ow_pose poses[OW_MAX_INSTANCES];
    for (uint32_t k = 0; k < tree->instance_count; k++) {
        static const struct ow_pose turned = {
            { { 0, -(1 << 30), 0 }, { 644245094, 0, 858993459 }, { -858993459, 0, 644245094 } },
            { 1 << 17, -(1 << 18), 99 }
        };
        static const struct ow_pose straight = {
            { { 1 << 30, 0, 0 }, { 0, 1 << 30, 0 }, { 0, 0, 1 << 30 } }, { 0, 0, 0 }
        };
        poses[k] = (number + k) % 2 ? turned : straight;
    }
    return poses;
}

static void use_view(const struct ow_tree *tree, const struct ow_view *view, uint32_t number)
{
    static const enum ow_cull culls[] = { OW_CULL_AUTO, OW_CULL_BACK, OW_CULL_NONE };
    for (uint32_t c = 0; c < 3; c++) {
        walk(tree, view, OW_FARTHEST_FIRST, culls[c]);
        walk(tree, view, OW_NEAREST_FIRST, culls[c]);
    }
    for (uint32_t order = 0; order < 2; order++) {
        struct ow_look look = { .order = order ? OW_FRONT_TO_BACK : OW_BACK_TO_FRONT,
                                .shade = number % 2 ? OW_SHADE_FLAT : OW_SHADE_ID,
                                .cull = culls[number % 3],
                                .background = 0x204060,
                                .ambient_q8 = 64,
                                .poses = make_poses(tree, number),
                                .lights = { { .direction_q14 = { 5000, 9000, 12000 },
                                              .intensity_q8 = 256,
                                              .in_model_space = number % 3 == 0 },
                                            { .at_point = true,
                                              .intensity_q8 = 200,
                                              .in_model_space = number % 2 == 0,
                                              .place = { 0, 1 << 22, -(1 << 20) } } },
                                .light_count = (uint8_t)(1 + number % 2) };
        draw_bands(tree, view, &look, order ? &ow_format_rgb565 : &ow_format_xrgb8888,
                   number % 2 ? 2 : 0);
    }
}

enum ow_status blob_exercise(const uint8_t *bytes, uint32_t size)
{
    struct ow_tree tree;
    enum ow_status status = ow_tree_open_instances(&tree, bytes, size);
    if (status != OW_OK) {
        static const struct ow_tree nothing;
        insist(memcmp(&tree, &nothing, sizeof tree) == 0, "a refused tree is not all zero");
        return status;
    }
    for (uint32_t i = 0; i < CAMERAS + 1; i++) {
        struct ow_camera camera = cameras[i % CAMERAS];
        struct ow_view view;
        if (i == CAMERAS) {
            ow_camera_orbit(&camera, &tree, 0x12345678, 0x08000000);
        }
        camera.width_pixels = WIDTH;
        camera.height_pixels = HEIGHT;
        /* A box without extent leaves the orbit's eye where it looks: no view then. */
        enum ow_status made = ow_view_make(&view, &camera);
        insist(made == OW_OK || i == CAMERAS, "a view was refused");
        if (made == OW_OK && (i < 2 || tree.face_count < MANY_FACES)) {
            use_view(&tree, &view, i);
        }
    }
    return OW_OK;
}
