/* SPDX-License-Identifier: 0BSD */
/*
 * Instances: a tree with two objects under poses against one tree in which they
 * stand where the poses put them. Quarter turns and whole steps give equal
 * pixels; poses that are no good give statuses.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ow_frame.h"
#include "tests/property/blob_builder.h"

enum { WIDTH = 203, HEIGHT = 149, OBJECTS = 2, VERTICES = 400, TURNS = 24, ONE = 1 << 30 };

/* Where an object stands: whole numbers. */
struct stand {
    int turn[3][3];
    int place[3];
};

struct scene {
    uint8_t *blob;
    uint32_t size;
    struct ow_tree tree;
};

static uint64_t random_state = 7;

static uint32_t random_below(uint32_t n)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((random_state >> 33) % n);
}

/* ---- quarter turns -------------------------------------------------------------------------- */
static int turns[TURNS][3][3];

/* All 24: the signed permutations with determinant 1. */
static int make_turns(void **state)
{
    (void)state;
    static const int order[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 },
                                     { 0, 2, 1 }, { 2, 1, 0 }, { 1, 0, 2 } };
    int count = 0;
    for (int n = 0; n < 48; n++) {
        int sign[3] = { n & 1 ? -1 : 1, n & 2 ? -1 : 1, n & 4 ? -1 : 1 };
        int determinant = sign[0] * sign[1] * sign[2] * (n / 8 < 3 ? 1 : -1);
        for (int i = 0; i < 3 && determinant == 1; i++) {
            turns[count][i][order[n / 8][i]] = sign[i];
        }
        count += determinant == 1;
    }
    assert_int_equal(count, TURNS);
    return 0;
}

static void stand_at(int out[3], const struct stand *stand, const int v[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = stand->place[i];
        for (int k = 0; k < 3; k++) {
            out[i] += stand->turn[i][k] * v[k];
        }
    }
}

static struct ow_pose pose_of(const struct stand *stand)
{
    struct ow_pose pose;
    for (int i = 0; i < 3; i++) {
        pose.place[i] = stand->place[i] * 256;
        for (int k = 0; k < 3; k++) {
            pose.rotation[i][k] = stand->turn[i][k] * ONE;
        }
    }
    return pose;
}

/* ---- two objects in a room ------------------------------------------------------------------ */
static const struct stand home = { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, { 0, 0, 0 } };

/* A box between two corners as six squares, standing somewhere; they go into a sequence. */
static void add_box(struct builder *b, uint32_t node, const int low[3], const int high[3],
                    const struct stand *stand, uint32_t *id)
{
    static const int sides[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
                                     { 2, 6, 7, 3 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
    uint32_t corners[8];
    for (int n = 0; n < 8; n++) {
        const int v[3] = { n & 1 ? high[0] : low[0], n & 2 ? high[1] : low[1],
                           n & 4 ? high[2] : low[2] };
        int at[3];
        stand_at(at, stand, v);
        corners[n] = builder_vertex(b, at[0], at[1], at[2]);
    }
    for (int s = 0; s < 6; s++) {
        uint32_t square[4];
        for (int k = 0; k < 4; k++) {
            square[k] = corners[sides[s][k]];
        }
        uint32_t colour = builder_colour(b, 0x404040 + 0x1F2B37 * (*id % 6));
        builder_add(b, node, OW_ITEM_FACE, builder_polygon(b, square, 4, colour, ++*id));
    }
}

/* A switch on the plane x = 300 of the object's space between two boxes. Returns the root. */
static uint32_t add_object(struct builder *b, const struct stand *stand, uint32_t *id, bool bounds)
{
    static const int boxes[2][2][3] = { { { 400, -900, -1500 }, { 2200, 1300, 1000 } },
                                        { { -2000, -1800, -400 }, { 200, 700, 1700 } } };
    int64_t plane[4] = { 0, 0, 0, -300 };
    for (int i = 0; i < 3; i++) {
        plane[i] = stand->turn[i][0];
        plane[3] -= stand->turn[i][0] * stand->place[i];
    }
    uint32_t root = builder_switch(b, plane);
    for (uint32_t k = 0; k < 2; k++) {
        uint32_t box = builder_sequence(b);
        add_box(b, box, boxes[k][0], boxes[k][1], stand, id);
        builder_child(b, root, k, OW_ITEM_NODE, box);
        if (bounds) { /* in the object's own space, as tight as they can be */
            double squares = 0;
            builder_bound(b, box);
            for (int i = 0; i < 3; i++) {
                b->nodes[box].centre[i] = (int16_t)((boxes[k][0][i] + boxes[k][1][i]) / 2);
                squares += pow(boxes[k][1][i] - boxes[k][0][i], 2);
            }
            b->nodes[box].radius = (uint16_t)ceil(sqrt(squares) / 2);
        }
    }
    return root;
}

static const int regions[OBJECTS][2][3] = { { { 100, -12000, -15000 }, { 15000, 12000, -100 } },
                                            { { -15000, -12000, -15000 }, { -100, 12000, -100 } } };

/*
 * A wall behind; two regions left and right of x = 0 before it; a box before
 * z = 0. stands NULL: the objects are instances.
 */
static void make_scene(struct scene *scene, const struct stand *stands, bool bounds)
{
    static const int wall[4][3] = { { -16000, -13000, -15500 },
                                    { 16000, -13000, -15500 },
                                    { 16000, 13000, -15500 },
                                    { -16000, 13000, -15500 } };
    static const int before[2][3] = { { -2500, -2000, 1000 }, { 3000, 1000, 4000 } };
    struct builder *b = builder_new(OW_TREE_IDS | OW_TREE_NORMALS);
    uint32_t corners[4];
    uint32_t id = 0;
    for (int i = 0; i < 4; i++) {
        corners[i] = builder_vertex(b, wall[i][0], wall[i][1], wall[i][2]);
    }
    uint32_t root = builder_switch(b, (const int64_t[4]){ 0, 0, 1, 0 });
    uint32_t near = builder_sequence(b);
    uint32_t far = builder_sequence(b);
    uint32_t middle = builder_switch(b, (const int64_t[4]){ 1, 0, 0, 0 });
    uint32_t back = builder_polygon(b, corners, 4, builder_colour(b, 0x707880), ++id);
    add_box(b, near, before[0], before[1], &home, &id);
    builder_child(b, root, 0, OW_ITEM_NODE, near);
    builder_child(b, root, 1, OW_ITEM_NODE, far);
    builder_add(b, far, OW_ITEM_FACE, back);
    builder_add(b, far, OW_ITEM_NODE, middle);
    for (uint32_t k = 0; k < OBJECTS; k++) {
        uint32_t object;
        if (stands == NULL) {
            object = builder_begin_instance(b);
            builder_end_instance(b, add_object(b, &home, &id, bounds), regions[k]);
        } else {
            object = add_object(b, &stands[k], &id, false);
        }
        builder_child(b, middle, k, stands ? OW_ITEM_NODE : OW_ITEM_INSTANCE, object);
    }
    scene->blob = builder_finish(b, root, &scene->size);
    free(b);
}

/* Vertex normals that vary; those of objects turn with them. */
static void set_normals(struct scene *scene, const struct stand *stands)
{
    struct ow_tree tree;
    assert_int_equal(ow_tree_open_instances(&tree, scene->blob, scene->size), OW_OK);
    uint32_t each = 16;
    uint32_t first = tree.vertex_count - OBJECTS * each;
    for (uint32_t v = 0; v < tree.vertex_count; v++) {
        const int given[3] = { (int)(v * 37 % 181) - 90, (int)(v * 53 % 171) - 85,
                               v % 3 ? 60 : -60 };
        const struct stand *stand = v >= first && stands ? &stands[(v - first) / each] : &home;
        for (uint32_t i = 0; i < 3; i++) {
            int n = 0;
            for (uint32_t k = 0; k < 3; k++) {
                n += stand->turn[i][k] * given[k];
            }
            scene->blob[tree.normals_at + 3 * v + i] = (uint8_t)n;
        }
    }
    blob_seal(scene->blob, scene->size);
}

static void open_scene(struct scene *scene, const struct stand *stands, bool bounds)
{
    make_scene(scene, stands, bounds);
    set_normals(scene, stands);
    assert_int_equal(ow_tree_open_instances(&scene->tree, scene->blob, scene->size), OW_OK);
}

/* ---- drawing -------------------------------------------------------------------------------- */
static struct ow_view view_of(uint32_t number)
{
    struct ow_camera camera = {
        .eye = { ((int)(number * 7919 % 40000) - 20000) * 256,
                 ((int)(number * 104729 % 30000) - 15000) * 256,
                 (number % 5 == 4 ? -14000 : 9000 + (int)(number * 31 % 25000)) * 256 },
        .at = { 0, 0, -8000 * 256 },
        .up = { 0, 256, 20 },
        .projection = number % 4 == 3 ? OW_PARALLEL : OW_PERSPECTIVE,
        .fov = 1u << 29,
        .height = 33000 * 256,
        .width_pixels = WIDTH,
        .height_pixels = HEIGHT,
    };
    struct ow_view view;
    assert_int_equal(ow_view_make(&view, &camera), OW_OK);
    return view;
}

/* Lights whose numbers turn without rounding. */
static struct ow_look look_of(enum ow_shade shade)
{
    return (struct ow_look){ .order = OW_FRONT_TO_BACK,
                             .shade = shade,
                             .background = 0x102030,
                             .foreground = 0xFFFFFF,
                             .ambient_q8 = 64,
                             .specular_q8 = 100,
                             .shininess = 3,
                             .light_count = 2,
                             .lights = { { .direction_q14 = { -8192, 8192, 8192 },
                                           .intensity_q8 = 256,
                                           .in_model_space = true },
                                         { .direction_q14 = { 8192, 0, 8192 },
                                           .intensity_q8 = 64,
                                           .in_model_space = true } } };
}

static enum ow_status draw(const struct scene *scene, const struct ow_view *view,
                           const struct ow_look *look, uint32_t band, uint32_t cached,
                           uint32_t *pixels, struct ow_stats *stats)
{
    enum { WORKERS = 2, CANARY = 64 };
    struct ow_workspace_config config = { .parts = &ow_parts_all,
                                          .width = WIDTH,
                                          .lines = (uint16_t)band,
                                          .height = HEIGHT,
                                          .cached_vertices = cached,
                                          .coverage = look->coverage,
                                          .listed_faces = ow_listed_faces_max(&scene->tree) };
    uint32_t bytes = ow_workspace_bytes_needed(&scene->tree, &config);
    struct ow_workspace workspaces[WORKERS];
    uint8_t *memory[WORKERS];
    enum ow_status status = OW_OK;
    memset(pixels, 0xA5, WIDTH * HEIGHT * sizeof *pixels);
    for (int w = 0; w < WORKERS; w++) { /* as two threads have it: bands by turns */
        memory[w] = malloc(bytes + CANARY);
        memset(memory[w], 0x5C, bytes + CANARY);
        assert_int_equal(
            ow_workspace_place(&workspaces[w], &scene->tree, &config, memory[w], bytes), OW_OK);
        assert_int_equal(ow_draw_begin(&scene->tree, view, look, &workspaces[w]), OW_OK);
    }
    for (uint32_t line = 0; line < HEIGHT; line += band) {
        struct ow_target target = { .pixels = (uint8_t *)(pixels + line * WIDTH),
                                    .stride = 4 * WIDTH,
                                    .first_line = (uint16_t)line,
                                    .line_count =
                                        (uint16_t)(HEIGHT - line < band ? HEIGHT - line : band),
                                    .format = &ow_format_xrgb8888 };
        status = ow_draw_band(&workspaces[line / band % WORKERS], &target, stats);
    }
    for (int w = 0; w < WORKERS; w++) {
        for (int i = 0; i < CANARY; i++) {
            assert_int_equal(memory[w][bytes + (uint32_t)i], 0x5C);
        }
        free(memory[w]);
    }
    return status;
}

static uint32_t expected[WIDTH * HEIGHT];
static uint32_t got[WIDTH * HEIGHT];

/* The most that any channel differs. */
static int difference(void)
{
    int most = 0;
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        for (uint32_t shift = 0; shift < 24; shift += 8) {
            int d = (int)(expected[i] >> shift & 255) - (int)(got[i] >> shift & 255);
            most = abs(d) > most ? abs(d) : most;
        }
    }
    return most;
}

static void random_stands(struct stand stands[OBJECTS])
{
    for (int k = 0; k < OBJECTS; k++) {
        memcpy(stands[k].turn, turns[random_below(TURNS)], sizeof stands[k].turn);
        stands[k].place[0] = (k ? -1 : 1) * (3900 + (int)random_below(7000));
        stands[k].place[1] = (int)random_below(12000) - 6000;
        stands[k].place[2] = -4000 - (int)random_below(7000);
    }
}

static const enum ow_order orders[] = { OW_BACK_TO_FRONT, OW_FRONT_TO_BACK, OW_SCAN_LINE };

/* Numbers, flat and Gouraud shading: the same bits, in all orders, bands and caches. */
static void quarter_turns_give_equal_pixels(void **state)
{
    (void)state;
    static const enum ow_shade shades[] = { OW_SHADE_ID, OW_SHADE_FLAT, OW_SHADE_GOURAUD,
                                            OW_SHADE_LINES };
    struct scene instances;
    open_scene(&instances, NULL, true);
    for (uint32_t n = 0; n < 48; n++) {
        struct stand stands[OBJECTS];
        struct scene one;
        random_stands(stands);
        const struct ow_pose poses[OBJECTS] = { pose_of(&stands[0]), pose_of(&stands[1]) };
        open_scene(&one, stands, false);
        struct ow_view view = view_of(n);
        struct ow_look look = look_of(shades[n / 3 % 4]);
        look.coverage = n % 7 == 6 && look.shade != OW_SHADE_ID && look.shade != OW_SHADE_LINES;
        look.order = look.coverage ? OW_FRONT_TO_BACK : orders[n % 3];
        struct ow_stats stats;
        assert_int_equal(draw(&one, &view, &look, HEIGHT, 0, expected, &stats), OW_OK);
        assert_true(stats.pixels_written > 1000);
        look.poses = poses;
        static const uint32_t bands[] = { HEIGHT, 40, 9 };
        for (uint32_t k = 0; k < 3; k++) {
            assert_int_equal(draw(&instances, &view, &look, bands[k], k == 1 ? 8 : 0, got, &stats),
                             OW_OK);
            assert_memory_equal(got, expected, sizeof got);
        }
        assert_int_equal(stats.instances_outside, 0);
        free(one.blob);
    }
    free(instances.blob);
}

/* Bands that are full while the walk is in an object: the next one begins in the tree again. */
static void a_band_may_end_in_an_object(void **state)
{
    (void)state;
    struct scene scene;
    struct scene one;
    struct stand stands[OBJECTS] = { { .place = { 7000, 0, -7000 } },
                                     { .place = { -7000, 0, -7000 } } };
    memcpy(stands[0].turn, home.turn, sizeof home.turn);
    memcpy(stands[1].turn, home.turn, sizeof home.turn);
    const struct ow_pose poses[OBJECTS] = { pose_of(&stands[0]), pose_of(&stands[1]) };
    struct ow_camera camera = { .eye = { 8300 * 256, 200 * 256, 10000 * 256 },
                                .at = { 8300 * 256, 200 * 256, 0 },
                                .up = { 0, 256, 0 },
                                .projection = OW_PARALLEL,
                                .height = 900 * 256,
                                .width_pixels = WIDTH,
                                .height_pixels = HEIGHT };
    struct ow_view view;
    struct ow_stats stats;
    struct ow_look look = look_of(OW_SHADE_GOURAUD);
    assert_int_equal(ow_view_make(&view, &camera), OW_OK);
    open_scene(&scene, NULL, true);
    open_scene(&one, stands, false);
    for (uint32_t k = 0; k < 3; k++) {
        look.order = orders[k];
        look.poses = NULL;
        assert_int_equal(draw(&one, &view, &look, HEIGHT, 0, expected, &stats), OW_OK);
        look.poses = poses;
        assert_int_equal(draw(&scene, &view, &look, 7, k, got, &stats), OW_OK);
        assert_true(look.order == OW_BACK_TO_FRONT || stats.pixels_background == 0);
        assert_memory_equal(got, expected, sizeof got);
    }
    free(scene.blob);
    free(one.blob);
}

/* What rounds another way when it is turned is off by a level at most. */
static void other_lights_are_as_good_as_equal(void **state)
{
    (void)state;
    struct scene instances;
    open_scene(&instances, NULL, false);
    for (uint32_t n = 0; n < 24; n++) {
        struct stand stands[OBJECTS];
        struct scene one;
        random_stands(stands);
        const struct ow_pose poses[OBJECTS] = { pose_of(&stands[0]), pose_of(&stands[1]) };
        open_scene(&one, stands, false);
        struct ow_view view = view_of(n);
        struct ow_look look = look_of(n % 2 ? OW_SHADE_PHONG : OW_SHADE_GOURAUD);
        look.lights[1] = (struct ow_light){ .at_point = true,
                                            .in_model_space = n % 4 < 2,
                                            .intensity_q8 = 150,
                                            .place = { 900 * 256, 7000 * 256, -3000 * 256 } };
        look.lights[0].in_model_space = n % 3 == 0;
        look.depth_far = n % 5 ? 0 : 60000 * 256;
        assert_int_equal(draw(&one, &view, &look, HEIGHT, 0, expected, NULL), OW_OK);
        look.poses = poses;
        assert_int_equal(draw(&instances, &view, &look, HEIGHT, 0, got, NULL), OW_OK);
        assert_true(difference() <= 2);
        free(one.blob);
    }
    free(instances.blob);
}

static struct ow_pose turned_freely(double a, double b)
{
    const double r[3][3] = { { cos(a), -sin(a) * cos(b), sin(a) * sin(b) },
                             { sin(a), cos(a) * cos(b), -cos(a) * sin(b) },
                             { 0, sin(b), cos(b) } };
    struct ow_pose pose;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            pose.rotation[i][k] = (ow_q30)lround(r[i][k] * ONE);
        }
    }
    return pose;
}

/* A free turn, there and seen with its own inverse: a turn about the eye changes nothing. */
static void free_turns_show_all_sides(void **state)
{
    (void)state;
    struct scene scene;
    uint32_t seen[32] = { 0 };
    open_scene(&scene, NULL, true);
    for (uint32_t n = 0; n < 60; n++) {
        struct ow_pose poses[OBJECTS];
        struct ow_look look = look_of(OW_SHADE_ID);
        struct ow_view view = view_of(n * 5);
        struct ow_stats stats;
        for (int k = 0; k < OBJECTS; k++) {
            poses[k] = turned_freely(n * 0.7 + k, n * 0.41);
            poses[k].place[0] = (k ? -7000 : 7000) * 256 + 77;
            poses[k].place[1] = 1000 * 256 + 13;
            poses[k].place[2] = -7000 * 256 + 99;
        }
        look.poses = poses;
        look.order = OW_BACK_TO_FRONT;
        assert_int_equal(draw(&scene, &view, &look, HEIGHT, 0, expected, &stats), OW_OK);
        look.order = OW_FRONT_TO_BACK;
        assert_int_equal(draw(&scene, &view, &look, 40, 8, got, &stats), OW_OK);
        assert_memory_equal(got, expected, sizeof got);
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
            seen[got[i] < 32 ? got[i] : 0]++;
        }
    }
    for (uint32_t id = 8; id < 32; id++) { /* the objects' 24 faces */
        assert_true(seen[id] > 0);
    }
    free(scene.blob);
}

/* Outside the region: drawn and said. Outside the cube, or no rotation: left out and said. */
static void bad_poses_are_reported(void **state)
{
    (void)state;
    struct scene scene;
    open_scene(&scene, NULL, false);
    struct stand stands[OBJECTS] = { { .place = { 7000, 0, -7000 } },
                                     { .place = { -7000, 0, -7000 } } };
    memcpy(stands[0].turn, turns[0], sizeof turns[0]);
    memcpy(stands[1].turn, turns[5], sizeof turns[5]);
    struct ow_pose poses[OBJECTS] = { pose_of(&stands[0]), pose_of(&stands[1]) };
    struct ow_view view = view_of(0);
    struct ow_look look = look_of(OW_SHADE_ID);
    struct ow_stats stats;
    look.poses = poses;
    assert_int_equal(draw(&scene, &view, &look, HEIGHT, 0, expected, &stats), OW_OK);
    poses[0].place[0] = 2000 * 256; /* across x = 0 */
    assert_int_equal(draw(&scene, &view, &look, HEIGHT, 0, got, &stats), OW_REGION);
    assert_int_equal(stats.instances_outside, 1);
    assert_true(difference() > 0);
    /* Left out as a tree without the object is. */
    poses[0].place[0] = 40000 * 256;
    assert_int_equal(draw(&scene, &view, &look, HEIGHT, 0, expected, &stats), OW_REGION);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        assert_true(expected[i] < 8 || expected[i] >= 20 || expected[i] == look.background);
    }
    poses[0] = pose_of(&stands[0]);
    poses[0].rotation[1][1] = 0;
    poses[0].rotation[1][2] = 0;
    assert_int_equal(draw(&scene, &view, &look, HEIGHT, 0, got, &stats), OW_REGION);
    assert_memory_equal(got, expected, sizeof got);
    look.poses = NULL;
    assert_int_equal(draw(&scene, &view, &look, HEIGHT, 0, got, &stats), OW_OK);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        assert_true(got[i] < 8 || got[i] == look.background);
    }
    free(scene.blob);
}

/* Any numbers at all: nothing but the picture may suffer. */
static void wild_poses_do_no_harm(void **state)
{
    (void)state;
    struct scene scene;
    open_scene(&scene, NULL, true);
    for (uint32_t n = 0; n < 300; n++) {
        struct ow_pose poses[OBJECTS];
        for (int k = 0; k < OBJECTS; k++) {
            poses[k] = turned_freely(random_below(7), random_below(7));
            for (int i = 0; i < 3; i++) {
                poses[k].place[i] = n % 3 ? (ow_q8)(random_below(1 << 24)) - (1 << 23)
                                          : (ow_q8)((random_below(1u << 31) << 1) - (1u << 31));
                poses[k].rotation[i][i] =
                    n % 4 ? poses[k].rotation[i][i] : (ow_q30)(random_below(1u << 31) << 1);
            }
        }
        struct ow_view view = view_of(n);
        struct ow_look look = look_of((enum ow_shade)(n % 5));
        look.order = orders[n % 3];
        look.poses = poses;
        (void)draw(&scene, &view, &look, 50, n % 2 ? 4 : 0, got, NULL);
    }
    free(scene.blob);
}

/* ---- opening -------------------------------------------------------------------------------- */
static enum ow_status opened(const struct scene *scene)
{
    struct ow_tree tree;
    return ow_tree_open_instances(&tree, scene->blob, scene->size);
}

/* The blob with one number changed, and as it was. */
/*
 * An object comes through the near plane, which the tree's own box does not reach: with all
 * vertices projected at once the picture is that of few, whose faces go the ordinary way.
 */
static void an_object_is_cut_by_the_near_plane(void **state)
{
    (void)state;
    struct ow_camera camera = { .eye = { 0, 0, 12000 * 256 },
                                .at = { 0, 0, 0 },
                                .up = { 0, 256, 0 },
                                .projection = OW_PERSPECTIVE,
                                .fov = 1u << 29,
                                .near = 7000 * 256,
                                .width_pixels = WIDTH,
                                .height_pixels = HEIGHT };
    struct scene scene;
    struct ow_view view;
    open_scene(&scene, NULL, false);
    assert_int_equal(ow_view_make(&view, &camera), OW_OK);
    for (int z = 0; z <= 12000; z += 500) {
        struct ow_pose poses[OBJECTS] = { turned_freely(0.4, 0.7), turned_freely(0.1, 0.2) };
        for (int k = 0; k < OBJECTS; k++) {
            memcpy(poses[k].place, (const ow_q8[3]){ 0, 0, -7000 * 256 }, sizeof poses[k].place);
        }
        poses[0].place[2] = z * 256;
        struct ow_look look = look_of(OW_SHADE_ID);
        look.poses = poses;
        for (uint32_t i = 0; i < 2; i++) {
            look.order = orders[i];
            (void)draw(&scene, &view, &look, HEIGHT, 0, got, NULL);
            (void)draw(&scene, &view, &look, HEIGHT, 4, expected, NULL);
            assert_int_equal(difference(), 0);
        }
    }
    free(scene.blob);
}

static void refuses(struct scene *scene, uint32_t at, uint32_t count, int32_t value)
{
    uint8_t kept[4];
    memcpy(kept, scene->blob + at, count);
    for (uint32_t i = 0; i < count; i++) {
        scene->blob[at + i] = (uint8_t)((uint32_t)value >> 8 * i);
    }
    blob_seal(scene->blob, scene->size);
    assert_int_equal(opened(scene), OW_CORRUPT);
    memcpy(scene->blob + at, kept, count);
    blob_seal(scene->blob, scene->size);
    assert_int_equal(opened(scene), OW_OK);
}

static void opening_checks_instances(void **state)
{
    (void)state;
    struct scene scene;
    struct ow_tree tree;
    open_scene(&scene, NULL, false);
    assert_int_equal(ow_tree_open(&tree, scene.blob, scene.size), OW_UNSUPPORTED);
    uint32_t at = scene.tree.instances_at;
    uint32_t first = scene.tree.vertex_count - 32;
    assert_int_equal(scene.tree.instance_count, 2);
    refuses(&scene, at, 4, 0);                       /* not its node */
    refuses(&scene, at + 4, 4, (int32_t)first + 1);  /* a vertex of its is before */
    refuses(&scene, at + 4, 4, (int32_t)first - 1);  /* one of the tree's is within */
    refuses(&scene, at + 36, 4, (int32_t)first - 1); /* ranges go back */
    refuses(&scene, at + 36, 4, 1 << 20);
    refuses(&scene, at + 8, 4, 1);       /* zero */
    refuses(&scene, at + 12, 2, 15001);  /* a region inside out */
    refuses(&scene, at + 12, 2, -32768); /* beyond the cube */
    refuses(&scene, at + 24, 2, 9000);   /* a sphere beside the vertices */
    refuses(&scene, at + 30, 2, 100);    /* one that is too small */
    refuses(&scene, offsetof(struct ow_disk_header, instance_count), 4, 1);
    refuses(&scene, offsetof(struct ow_disk_header, instance_count), 4, 3);
    /* A face of the tree gets a vertex of an object: the wall's record comes first. */
    refuses(&scene, scene.tree.polygons_at + scene.tree.corners_in_record, 2, (int32_t)first);
    free(scene.blob);
}

/* An instance below an instance is refused. */
static void objects_have_no_objects(void **state)
{
    (void)state;
    struct scene scene;
    struct builder *b = builder_new(0);
    uint32_t id = 0;
    uint32_t root = builder_sequence(b);
    uint32_t outer = builder_begin_instance(b);
    uint32_t object = add_object(b, &home, &id, false);
    uint32_t holder = builder_sequence(b);
    builder_add(b, holder, OW_ITEM_NODE, object);
    builder_end_instance(b, holder, regions[0]);
    uint32_t inner = builder_begin_instance(b);
    builder_end_instance(b, add_object(b, &home, &id, false), regions[0]);
    builder_add(b, root, OW_ITEM_INSTANCE, outer);
    builder_add(b, holder, OW_ITEM_INSTANCE, inner);
    scene.blob = builder_finish(b, root, &scene.size);
    assert_int_equal(opened(&scene), OW_CORRUPT);
    free(scene.blob);
    free(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quarter_turns_give_equal_pixels),
        cmocka_unit_test(a_band_may_end_in_an_object),
        cmocka_unit_test(other_lights_are_as_good_as_equal),
        cmocka_unit_test(free_turns_show_all_sides),
        cmocka_unit_test(bad_poses_are_reported),
        cmocka_unit_test(wild_poses_do_no_harm),
        cmocka_unit_test(an_object_is_cut_by_the_near_plane),
        cmocka_unit_test(opening_checks_instances),
        cmocka_unit_test(objects_have_no_objects),
    };
    return cmocka_run_group_tests(tests, make_turns, NULL);
}
