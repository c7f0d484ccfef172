/* SPDX-License-Identifier: 0BSD */
/*
 * The judge judged: frames with known faults must be reported as such, and the
 * right frame, drawn here by the oracle itself, must not.
 */
#include "tests/oracle/oracle.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 160, HEIGHT = 120, PIXELS = WIDTH * HEIGHT };

static int failures;

static void expect(const char *name, bool good)
{
    printf("%s %s\n", good ? "ok" : "not ok", name);
    failures += !good;
}

static uint32_t add_point(struct model *m, double x, double y, double z)
{
    m->points = more(m->points, m->point_count + 1, sizeof *m->points);
    m->unsnapped = more(m->unsnapped, m->point_count + 1, sizeof *m->unsnapped);
    m->points[m->point_count] = m->unsnapped[m->point_count] = (struct vec){ x, y, z };
    return (uint32_t)m->point_count++;
}

static void add_outline(struct model *m, const double (*p)[3], uint32_t count)
{
    uint32_t corners[16];
    for (uint32_t i = 0; i < count; i++) {
        corners[i] = add_point(m, p[i][0], p[i][1], p[i][2]);
    }
    model_add_polygon(m, corners, count, ++m->source_count);
}

/*
 * 1: a wall with a hole (its outline runs into the hole and back); 2 and 3: two
 * triangles that make one square behind it; 4: a back that nobody sees; 5: a
 * slanted square that stands through the hole.
 */
static void make_model(struct model *m)
{
    static const double wall[10][3] = { { -9000, -9000, 0 }, { 9000, -9000, 0 },
                                        { 9000, 9000, 0 },   { -9000, 9000, 0 },
                                        { -9000, -9000, 0 }, { -3000, -3000, 0 },
                                        { -3000, 3000, 0 },  { 3000, 3000, 0 },
                                        { 3000, -3000, 0 },  { -3000, -3000, 0 } };
    static const double lower[3][3] = { { -12000, -12000, -4000 },
                                        { 12000, -12000, -4000 },
                                        { 12000, 12000, -4000 } };
    static const double upper[3][3] = { { -12000, -12000, -4000 },
                                        { 12000, 12000, -4000 },
                                        { -12000, 12000, -4000 } };
    static const double back[3][3] = { { -8000, -8000, 2000 },
                                       { 0, 8000, 2000 },
                                       { 8000, -8000, 2000 } };
    static const double slant[4][3] = {
        { -2000, -1000, -3000 }, { 2000, -1000, 3000 }, { 2000, 1000, 3000 }, { -2000, 1000, -3000 }
    };
    memset(m, 0, sizeof *m);
    add_outline(m, wall, 10);
    add_outline(m, lower, 3);
    add_outline(m, upper, 3);
    add_outline(m, back, 3);
    add_outline(m, slant, 4);
    model_join(m);
}

static struct camera make_camera(double x, double y, double z, double turned)
{
    struct camera c = {
        .eye = { x, y, z }, .near_z = 16, .focal = 130, .width = WIDTH, .height = HEIGHT
    };
    c.axis[0] = (struct vec){ cos(turned), 0, -sin(turned) };
    c.axis[1] = (struct vec){ 0, 1, 0 };
    c.axis[2] = (struct vec){ -sin(turned), 0, -cos(turned) };
    return c;
}

static void draw(const struct scene *scene, uint32_t *frame)
{
    for (size_t i = 0; i < PIXELS; i++) {
        frame[i] = scene->seen[i] ? scene->shapes[scene->seen[i] - 1].id : 0;
    }
}

static struct verdict judged(const struct scene *scene, const uint32_t *frame)
{
    struct verdict v;
    judge(scene, frame, 2, &v, NULL);
    return v;
}

static struct verdict with_pixel(const struct scene *scene, uint32_t *frame, uint32_t x, uint32_t y,
                                 uint32_t id)
{
    uint32_t kept = frame[y * WIDTH + x];
    frame[y * WIDTH + x] = id;
    struct verdict v = judged(scene, frame);
    frame[y * WIDTH + x] = kept;
    return v;
}

static struct verdict shifted(const struct scene *scene, const uint32_t *frame, uint32_t by)
{
    static uint32_t moved[PIXELS];
    memset(moved, 0, sizeof moved);
    for (size_t y = 0; y < HEIGHT; y++) {
        memcpy(moved + y * WIDTH + by, frame + y * WIDTH, (WIDTH - by) * sizeof *moved);
    }
    return judged(scene, moved);
}

static void single_pixels(const struct scene *scene, uint32_t *frame)
{
    /* (50, 60) and (80, 35) lie inside the wall, (2, 2) outside all. */
    expect("the picture's wall is where the test takes it to be",
           frame[60 * WIDTH + 50] == 1 && frame[35 * WIDTH + 80] == 1 && frame[2 * WIDTH + 2] == 0);
    bool back = false;
    for (size_t i = 0; i < PIXELS; i++) {
        back = back || frame[i] == 4;
    }
    expect("no culled back is seen", !back);
    struct verdict v = with_pixel(scene, frame, 50, 60, 2);
    expect("a wrong polygon inside is 1 wrong", v.wrong == 1 && v.holes == 0);
    v = with_pixel(scene, frame, 50, 60, 4);
    expect("a culled polygon is 1 wrong", v.wrong == 1 && v.holes == 0);
    v = with_pixel(scene, frame, 50, 60, 99);
    expect("a polygon that does not exist is 1 wrong", v.wrong == 1 && v.holes == 0);
    v = with_pixel(scene, frame, 80, 35, 0);
    expect("background inside is 1 hole", v.wrong == 0 && v.holes == 1);
    v = with_pixel(scene, frame, 2, 2, 1);
    expect("a polygon far off itself is 1 wrong", v.wrong == 1 && v.holes == 0);
}

/* The wall's pixels show what stands behind it. */
static void hidden_shown(const struct model *m, const struct camera *camera, uint32_t *frame)
{
    struct model behind = *m;
    behind.polygons = m->polygons + 1;
    behind.polygon_count = m->polygon_count - 1;
    model_join(&behind);
    struct scene whole, part;
    scene_make(&whole, m, camera, false, TELLS_ID);
    scene_make(&part, &behind, camera, false, TELLS_ID);
    draw(&part, frame);
    struct verdict v = judged(&whole, frame);
    expect("a hidden polygon shown is wrong all over", v.wrong > 1000);
    scene_free(&whole);
    scene_free(&part);
    free(behind.edges);
    free(behind.edge_of);
}

/* The wall cut at x = 0: a picture that was not cut is wrong, and so is one of the other half. */
static void cut_open(const struct model *m, const struct camera *camera, uint32_t *frame)
{
    struct camera cut = *camera;
    struct scene half, whole;
    cut.cuts = true;
    cut.cut = (struct vec){ 1, 0, 0 };
    scene_make(&half, m, &cut, true, TELLS_ID);
    scene_make(&whole, m, camera, true, TELLS_ID);
    draw(&half, frame);
    struct verdict v = judged(&half, frame);
    expect("the right picture of a cut model is right", v.wrong + v.holes == 0 && v.model > 2000);
    expect("nothing is left of what was cut off", frame[60 * WIDTH + 50] == 0);
    draw(&whole, frame);
    v = judged(&half, frame);
    expect("a picture that was not cut is reported", v.wrong > 2000);
    scene_free(&half);
    cut.cut.x = -1;
    scene_make(&half, m, &cut, true, TELLS_ID);
    v = judged(&half, frame);
    expect("nor is the other half right", v.wrong > 2000);
    draw(&half, frame);
    scene_free(&half);
    scene_free(&whole);
    cut.cut.x = 1;
    scene_make(&half, m, &cut, true, TELLS_SIDE);
    draw(&half, frame);
    v = judged(&half, frame);
    uint32_t at = 60 * WIDTH + 110;
    expect("the right picture of sides is right",
           v.wrong + v.holes == 0 && frame[at] == SIDE_FRONT);
    v = with_pixel(&half, frame, 110, 60, SIDE_BACK);
    expect("a cap in the wrong place is 1 wrong", v.wrong == 1 && v.holes == 0);
    v = with_pixel(&half, frame, 110, 60, 0);
    expect("a cap that is missing is 1 hole", v.wrong == 0 && v.holes == 1);
    scene_free(&half);
}

int self_test(void)
{
    static uint32_t frame[PIXELS];
    struct model model;
    make_model(&model);
    struct camera front = make_camera(0, 0, 30000, 0);
    struct scene scene;
    scene_make(&scene, &model, &front, false, TELLS_ID);
    draw(&scene, frame);
    struct verdict v = judged(&scene, frame);
    expect("the right picture is right", v.wrong == 0 && v.holes == 0 && v.model == v.same);
    expect("the right picture shows much", v.model > PIXELS / 4);
    single_pixels(&scene, frame);
    v = shifted(&scene, frame, 1);
    expect("a shift by 1 pixel passes as edges", v.wrong == 0 && v.holes == 0 && v.edge > 50);
    v = shifted(&scene, frame, 2);
    expect("a shift by 2 pixels is reported", v.wrong + v.holes > 50);
    scene_free(&scene);
    hidden_shown(&model, &front, frame);

    struct camera inside = make_camera(200, 100, 60, 0.4);
    scene_make(&scene, &model, &inside, true, TELLS_ID);
    draw(&scene, frame);
    v = judged(&scene, frame);
    expect("the right picture from inside is right", v.wrong == 0 && v.holes == 0 && v.model > 0);
    v = shifted(&scene, frame, 40);
    expect("from inside a shift by 40 pixels is reported", v.wrong + v.holes > 50);
    scene_free(&scene);
    cut_open(&model, &front, frame);
    model_free(&model);
    return failures ? 1 : 0;
}
