/* SPDX-License-Identifier: 0BSD */
/*
 * Trees in bit planes: the tree lies in one byte of each pixel and is read there
 * while the picture is painted into the others. Whatever these hold, the tree is
 * the same, its pictures are those of a tree in memory, and painting changes
 * none of its bytes. The core is linked three times, the copies that read from
 * planes under names of their own.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "random_scene.h"

enum { WIDTH = 200, HEIGHT = 160, PIXELS = WIDTH * HEIGHT, FACES = 60, FRAMES = 10000 };

/* The functions of one copy, and how it lays pixels. */
struct reader {
    uint32_t pixel_bytes;
    const struct ow_pixel_format *format;
    const struct ow_pixel_format *plain; /* the same picture without the tree's byte */
    enum ow_status (*open)(struct ow_tree *tree, const void *bytes, uint32_t size);
    enum ow_status (*begin)(const struct ow_tree *tree, const struct ow_view *view,
                            const struct ow_look *look, struct ow_workspace *workspace);
    enum ow_status (*band)(struct ow_workspace *workspace, const struct ow_target *target,
                           struct ow_stats *stats);
    const struct ow_parts *parts;
    const struct ow_surface_kind *segments;
};

/* Those of the copies are declared as the build names them. */
#define DECLARE(prefix)                                                                          \
    extern const struct ow_parts prefix##ow_parts_all;                                           \
    extern const struct ow_surface_kind prefix##ow_surface_segments;                             \
    enum ow_status prefix##ow_tree_open(struct ow_tree *tree, const void *bytes, uint32_t size); \
    enum ow_status prefix##ow_draw_begin(const struct ow_tree *tree, const struct ow_view *view, \
                                         const struct ow_look *look,                             \
                                         struct ow_workspace *workspace);                        \
    enum ow_status prefix##ow_draw_band(struct ow_workspace *workspace,                          \
                                        const struct ow_target *target, struct ow_stats *stats);
DECLARE(planes3_)
DECLARE(planes4_)

static const struct reader readers[] = {
    { 3, &ow_format_x8rgb565_kept, &ow_format_rgb565, planes3_ow_tree_open, planes3_ow_draw_begin,
      planes3_ow_draw_band, &planes3_ow_parts_all, &planes3_ow_surface_segments },
    { 4, &ow_format_xrgb8888_kept, &ow_format_xrgb8888, planes4_ow_tree_open, planes4_ow_draw_begin,
      planes4_ow_draw_band, &planes4_ow_parts_all, &planes4_ow_surface_segments },
};
enum { READERS = sizeof readers / sizeof readers[0] };

/* A frame buffer with a tree in it. */
struct planes {
    const struct reader *reader;
    uint8_t *pixels; /* PIXELS of them, and a byte behind */
    uint8_t *tree;   /* the first pixel's last byte */
    struct ow_parts parts;
};

enum filling { ZEROS, ONES, RANDOM, FILLINGS };

static uint32_t random_state = 1;

static uint8_t random_byte(void)
{
    random_state = random_state * 1664525 + 1013904223;
    return (uint8_t)(random_state >> 24);
}

static void make_planes(struct planes *planes, const struct reader *reader, const uint8_t *blob,
                        uint32_t bytes, enum filling filling)
{
    size_t size = (size_t)PIXELS * reader->pixel_bytes;
    planes->reader = reader;
    planes->parts = *reader->parts;
    planes->pixels = malloc(size);
    assert_non_null(planes->pixels);
    assert_true(bytes <= PIXELS);
    for (size_t i = 0; i < size; i++) {
        planes->pixels[i] = filling == ZEROS ? 0 : filling == ONES ? 0xFF : random_byte();
    }
    planes->tree = planes->pixels + reader->pixel_bytes - 1;
    for (uint32_t i = 0; i < bytes; i++) {
        planes->tree[(size_t)i * reader->pixel_bytes] = blob[i];
    }
}

static bool holds(const struct planes *planes, const uint8_t *blob, uint32_t bytes)
{
    for (uint32_t i = 0; i < bytes; i++) {
        if (planes->tree[(size_t)i * planes->reader->pixel_bytes] != blob[i]) {
            return false;
        }
    }
    return true;
}

/* All fields but where the bytes lie. */
static void assert_same_tree(struct ow_tree a, struct ow_tree b)
{
    a.bytes = NULL;
    b.bytes = NULL;
    assert_memory_equal(&a, &b, sizeof a);
}

static void test_open(void **state)
{
    (void)state;
    struct random_scene scene;
    random_scene_make(&scene, FACES, true);
    for (uint32_t r = 0; r < READERS; r++) {
        for (int filling = 0; filling < FILLINGS; filling++) {
            struct planes planes;
            struct ow_tree tree;
            make_planes(&planes, &readers[r], scene.tree.bytes, scene.tree.blob_bytes,
                        (enum filling)filling);
            assert_int_equal(readers[r].open(&tree, planes.tree, PIXELS), OW_OK);
            assert_same_tree(tree, scene.tree);
            free(planes.pixels);
        }
    }
    random_scene_free(&scene);
}

/* Each byte wrong: the same status as in memory. */
static void test_wrong_bytes(void **state)
{
    (void)state;
    struct random_scene scene;
    random_scene_make(&scene, 4, true);
    uint32_t bytes = scene.tree.blob_bytes;
    uint8_t *blob = malloc(bytes);
    assert_non_null(blob);
    memcpy(blob, scene.tree.bytes, bytes);
    for (uint32_t r = 0; r < READERS; r++) {
        struct planes planes;
        make_planes(&planes, &readers[r], blob, bytes, RANDOM);
        for (uint32_t i = 0; i < bytes; i++) {
            struct ow_tree linear;
            struct ow_tree tree;
            blob[i] ^= 0x41;
            planes.tree[(size_t)i * readers[r].pixel_bytes] ^= 0x41;
            enum ow_status status = ow_tree_open(&linear, blob, bytes);
            assert_int_not_equal(status, OW_OK);
            assert_int_equal(readers[r].open(&tree, planes.tree, bytes), status);
            blob[i] ^= 0x41;
            planes.tree[(size_t)i * readers[r].pixel_bytes] ^= 0x41;
        }
        free(planes.pixels);
    }
    free(blob);
    random_scene_free(&scene);
}

/* ---- pictures ---- */

/* A frame of the scene in memory, by the core that reads memory. */
static void draw_plain(struct random_scene *scene, const struct ow_view *view,
                       const struct ow_look *look, const struct ow_pixel_format *format,
                       uint8_t *pixels)
{
    struct ow_target target = { pixels, WIDTH * format->bits / 8u, 0, HEIGHT, format, NULL };
    assert_int_equal(ow_draw_begin(&scene->tree, view, look, &scene->workspace), OW_OK);
    assert_true(ow_draw_band(&scene->workspace, &target, NULL) == OW_OK);
}

/* The same in the planes beside the tree. */
static void draw_beside(struct planes *planes, struct random_scene *scene,
                        const struct ow_tree *tree, const struct ow_view *view,
                        const struct ow_look *look)
{
    const struct reader *reader = planes->reader;
    struct ow_target target = {
        planes->pixels, WIDTH * reader->pixel_bytes, 0, HEIGHT, reader->format, NULL
    };
    scene->workspace.parts = &planes->parts;
    assert_int_equal(reader->begin(tree, view, look, &scene->workspace), OW_OK);
    assert_int_equal(reader->band(&scene->workspace, &target, NULL), OW_OK);
    scene->workspace.parts = &ow_parts_all;
}

static const struct ow_workspace_config config = {
    .parts = &ow_parts_all,
    .width = WIDTH,
    .lines = HEIGHT,
    .height = HEIGHT,
    .listed_faces = 1024,
};

static void check_picture(struct planes *planes, struct random_scene *scene,
                          const struct ow_tree *tree, const struct ow_view *view,
                          const struct ow_look *look)
{
    static uint32_t plain[PIXELS];
    const struct reader *reader = planes->reader;
    uint32_t plain_stride = WIDTH * reader->plain->bits / 8u;
    draw_plain(scene, view, look, reader->plain, (uint8_t *)plain);
    draw_beside(planes, scene, tree, view, look);
    assert_true(holds(planes, scene->tree.bytes, scene->tree.blob_bytes));
    for (uint32_t y = 0; y < HEIGHT; y++) {
        const uint8_t *row = (const uint8_t *)plain + (size_t)y * plain_stride;
        const uint8_t *beside = planes->pixels + (size_t)y * WIDTH * reader->pixel_bytes;
        for (uint32_t x = 0; x < WIDTH; x++) {
            assert_int_equal(reader->format->get(beside, x), reader->plain->get(row, x));
        }
    }
}

static void test_pictures(void **state)
{
    (void)state;
    struct random_scene scene;
    random_scene_make(&scene, FACES, true);
    random_scene_place(&scene, &config);
    for (uint32_t r = 0; r < READERS; r++) {
        struct planes planes;
        struct ow_tree tree;
        make_planes(&planes, &readers[r], scene.tree.bytes, scene.tree.blob_bytes, RANDOM);
        assert_int_equal(readers[r].open(&tree, planes.tree, PIXELS), OW_OK);
        for (uint32_t i = 0; i < 24; i++) {
            struct ow_view view = random_scene_view(&scene, i, WIDTH, HEIGHT);
            struct ow_look look = random_scene_look((enum ow_shade)(OW_SHADE_FLAT + i % 4));
            look.order = (enum ow_order)(i / 4 % 3);
            planes.parts.dynamic = i % 3 == 0 ? readers[r].segments : readers[r].parts->dynamic;
            look.dither = i % 2 == 1 && look.shade != OW_SHADE_ID;
            check_picture(&planes, &scene, &tree, &view, &look);
        }
        free(planes.pixels);
    }
    random_scene_free(&scene);
}

/* The tree's checksum is what it was, after many frames in all orders. */
static void test_many_frames(void **state)
{
    (void)state;
    struct random_scene scene;
    random_scene_make(&scene, FACES, true);
    random_scene_place(&scene, &config);
    struct ow_view views[8];
    for (uint32_t i = 0; i < 8; i++) {
        views[i] = random_scene_view(&scene, i, WIDTH, HEIGHT);
    }
    for (uint32_t r = 0; r < READERS; r++) {
        struct planes planes;
        struct ow_tree tree;
        make_planes(&planes, &readers[r], scene.tree.bytes, scene.tree.blob_bytes, RANDOM);
        assert_int_equal(readers[r].open(&tree, planes.tree, PIXELS), OW_OK);
        for (uint32_t i = 0; i < FRAMES; i++) {
            struct ow_look look = random_scene_look(i % 64 == 0 ? OW_SHADE_PHONG : OW_SHADE_FLAT);
            look.order = (enum ow_order)(i / 8 % 2);
            draw_beside(&planes, &scene, &tree, &views[i % 8], &look);
        }
        assert_true(holds(&planes, scene.tree.bytes, scene.tree.blob_bytes));
        assert_int_equal(readers[r].open(&tree, planes.tree, PIXELS), OW_OK);
        free(planes.pixels);
    }
    random_scene_free(&scene);
}

/* ---- the formats alone ---- */

static void test_formats_keep(void **state)
{
    (void)state;
    enum { SHORT = 21 };
    for (uint32_t r = 0; r < READERS; r++) {
        const struct ow_pixel_format *format = readers[r].format;
        const uint32_t step = readers[r].pixel_bytes;
        assert_true(format->keeps);
        for (uint32_t first = 0; first < SHORT; first++) {
            for (uint32_t end = first; end <= SHORT; end++) {
                uint8_t row[4 * SHORT];
                uint8_t before[4 * SHORT];
                uint32_t rgb[SHORT];
                for (uint32_t i = 0; i < sizeof row; i++) {
                    before[i] = random_byte();
                }
                for (uint32_t i = 0; i < SHORT; i++) {
                    rgb[i] = (uint32_t)random_byte() << 16 | random_byte();
                }
                for (int how = 0; how < 2; how++) {
                    memcpy(row, before, sizeof row);
                    if (how == 0) {
                        format->fill(row, first, end, format->pack(rgb[0]));
                    } else {
                        format->store(row, first, end, rgb);
                    }
                    for (uint32_t x = 0; x < SHORT; x++) {
                        bool inside = x >= first && x < end;
                        uint32_t is = format->pack(rgb[how == 0 || !inside ? 0 : x - first]);
                        uint32_t was = format->get(before, x);
                        assert_int_equal(format->get(row, x), inside ? is : was);
                        assert_int_equal(row[step * (x + 1) - 1], before[step * (x + 1) - 1]);
                    }
                }
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_open),         cmocka_unit_test(test_wrong_bytes),
        cmocka_unit_test(test_pictures),     cmocka_unit_test(test_many_frames),
        cmocka_unit_test(test_formats_keep),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
