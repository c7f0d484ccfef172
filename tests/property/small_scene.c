/* SPDX-License-Identifier: 0BSD */
/* Random small scenes. */
#include "small_scene.h"

#include <math.h>
#include <string.h>

#include "ow_blob.h"
#include "tools/owc/random.h"

struct maker {
    struct small_scene *scene;
    struct random random;
    int32_t reach;  /* coordinates are from -reach to reach */
    int32_t grid;   /* and multiples of this */
    int32_t jitter; /* but for so much, now and then */
};

static double coordinate(struct maker *m)
{
    int32_t steps = 2 * (m->reach / m->grid) + 1;
    int32_t at = (int32_t)random_below(&m->random, (uint32_t)steps) * m->grid;
    at -= m->reach / m->grid * m->grid;
    if (m->jitter > 0 && random_below(&m->random, 4) == 0) {
        at += (int32_t)random_below(&m->random, 2 * (uint32_t)m->jitter + 1) - m->jitter;
    }
    return fmax(-m->reach, fmin(m->reach, at));
}

static void add_corner(struct maker *m, const double at[3])
{
    struct model *model = &m->scene->model;
    memcpy(m->scene->vertices[model->vertex_count], at, sizeof m->scene->vertices[0]);
    m->scene->corners[model->corner_count++] = (uint32_t)model->vertex_count++;
    m->scene->polygons[model->polygon_count].count++;
}

/* A corner that is new, or one of an earlier polygon. */
static void choose(struct maker *m, bool touching, double at[3])
{
    size_t count = m->scene->model.vertex_count;
    for (int k = 0; k < 3; k++) {
        at[k] = coordinate(m);
    }
    if (touching && count > 0 && random_below(&m->random, 2) == 0) {
        memcpy(at, m->scene->vertices[random_below(&m->random, (uint32_t)count)], 3 * sizeof *at);
    }
}

static void add_triangle(struct maker *m)
{
    bool touching = random_below(&m->random, 3) == 0;
    for (int i = 0; i < 3; i++) {
        double at[3];
        choose(m, touching, at);
        add_corner(m, at);
    }
}

/* On one of three planes along an axis. */
static void add_coplanar(struct maker *m)
{
    static const double levels[] = { 0, 0.5, -0.5 };
    uint32_t axis = random_below(&m->random, 3);
    double level = floor(levels[random_below(&m->random, 3)] * m->reach);
    for (int i = 0; i < 3; i++) {
        double at[3];
        choose(m, false, at);
        at[axis] = level;
        add_corner(m, at);
    }
}

/* The third corner lies near the line through the first two, or near one of them. */
static void add_needle(struct maker *m)
{
    double at[3][3];
    choose(m, true, at[0]);
    choose(m, true, at[1]);
    uint32_t share = random_below(&m->random, 5);
    for (int k = 0; k < 3; k++) {
        at[2][k] = floor((at[0][k] * (4 - share) + at[1][k] * share) / 4);
        at[2][k] += random_below(&m->random, 5);
        at[2][k] = fmax(-m->reach, fmin(m->reach, at[2][k] - 2));
    }
    for (int i = 0; i < 3; i++) {
        add_corner(m, at[i]);
    }
}

/* Along an axis: a rectangle, or an L, which is concave. */
static void add_rectilinear(struct maker *m, bool concave)
{
    static const int shape[6][2] = { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } };
    uint32_t axis = random_below(&m->random, 3);
    bool turned = random_below(&m->random, 2) == 0;
    double from[3];
    double size[2];
    for (int k = 0; k < 3; k++) {
        from[k] = coordinate(m);
    }
    for (int k = 0; k < 2; k++) {
        size[k] = floor((m->reach - from[(axis + 1 + (uint32_t)k) % 3]) / 2);
    }
    for (int i = 0; i < 6; i++) {
        const int *step = shape[turned ? 5 - i : i];
        double at[3];
        if (!concave && (step[0] == 1 || step[1] == 1) && step[0] + step[1] != 2) {
            continue;
        }
        bool outer = !concave && step[0] == 1;
        at[axis] = from[axis];
        at[(axis + 1) % 3] = from[(axis + 1) % 3] + size[0] * (outer ? 2 : step[0]);
        at[(axis + 2) % 3] = from[(axis + 2) % 3] + size[1] * (outer ? 2 : step[1]);
        add_corner(m, at);
    }
}

static void add_polygon(struct maker *m)
{
    struct model *model = &m->scene->model;
    m->scene->polygons[model->polygon_count] =
        (struct model_polygon){ model->corner_count, 0, (uint16_t)0 };
    switch (random_below(&m->random, 8)) {
    case 0:
        add_coplanar(m);
        break;
    case 1:
        add_needle(m);
        break;
    case 2:
        add_rectilinear(m, random_below(&m->random, 2) == 0);
        break;
    default:
        add_triangle(m);
        break;
    }
    model->polygon_count++;
}

void small_scene_make(struct small_scene *scene, uint64_t number)
{
    /* Small ones, where all planes are exact, and large ones. */
    static const int32_t shapes[][3] = { { 600, 200, 0 },     { 600, 1, 0 },
                                         { 700, 100, 0 },     { OW_LATTICE_MAX, 1, 0 },
                                         { 30000, 10000, 3 }, { OW_LATTICE_MAX, 8000, 40 } };
    uint32_t shape = (uint32_t)(number % (sizeof shapes / sizeof shapes[0]));
    struct maker m = { .scene = scene,
                       .random = { number << 20 },
                       .reach = shapes[shape][0],
                       .grid = shapes[shape][1],
                       .jitter = shapes[shape][2] };
    memset(scene, 0, sizeof *scene);
    scene->exact = shape < 3;
    scene->lattice = (struct lattice){ { 0, 0, 0 }, 1 };
    scene->model.vertices = scene->vertices;
    scene->model.normals = scene->normals;
    scene->model.corners = scene->corners;
    scene->model.polygons = scene->polygons;
    uint32_t count = 3 + random_below(&m.random, SMALL_SCENE_POLYGONS - 3);
    for (uint32_t i = 0; i < count; i++) {
        add_polygon(&m);
    }
}

void small_scene_print(FILE *out, const struct small_scene *scene)
{
    const struct model *model = &scene->model;
    for (size_t i = 0; i < model->vertex_count; i++) {
        fprintf(out, "v %g %g %g\n", scene->vertices[i][0], scene->vertices[i][1],
                scene->vertices[i][2]);
    }
    for (size_t i = 0; i < model->polygon_count; i++) {
        fprintf(out, "f");
        for (uint32_t k = 0; k < scene->polygons[i].count; k++) {
            fprintf(out, " %u", scene->corners[scene->polygons[i].first + k] + 1);
        }
        fprintf(out, "\n");
    }
}
