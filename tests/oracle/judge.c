/* SPDX-License-Identifier: 0BSD */
/*
 * Right or wrong, pixel by pixel: the rule stands in main.c. A pixel is called
 * right only where a witness was found: a point of the screen, near enough,
 * where the oracle shows what the pixel shows. Witnesses are sought coarsely
 * first, then ever finer.
 */
#include "tests/oracle/oracle.h"

#include <math.h>
#include <string.h>

/* From the best to the worst. */
enum outcome { SAME, EDGE, NEAR_STEP, TIE, SLANT, WRONG };

struct search {
    const struct scene *scene;
    double tie; /* lattice steps */
    double x, y; /* the pixel's centre */
    enum outcome best;
};

/* Pixels that a lattice step covers at this depth. */
static double step_at(const struct camera *c, double z)
{
    return c->parallel ? c->focal : c->focal / fmax(z, c->near_z);
}

/* How shape s, seen at depth z at a point, stands against all that cover the point. */
static enum outcome compare(const struct search *search, const struct shape *s, double x, double y,
                            double z)
{
    const struct scene *scene = search->scene;
    enum outcome worst = EDGE;
    uint32_t count;
    const uint32_t *items = scene_candidates(scene, x, y, &count);
    double slope = shape_slope(scene, s, x, y);
    for (uint32_t i = 0; i < count; i++) {
        const struct shape *p = &scene->shapes[items[i]];
        if (p->id == s->id || p->z_min >= z || !shape_covers(scene, p, x, y)) {
            continue;
        }
        double gap = z - shape_depth(scene, p, x, y);
        double bound = search->tie + s->slack + p->slack;
        if (gap <= 1e-6) {
            continue;
        } else if (gap <= bound) {
            worst = worst < TIE ? TIE : worst;
        } else if (gap * fmin(slope, shape_slope(scene, p, x, y)) <= bound) {
            worst = SLANT;
        } else {
            return WRONG;
        }
    }
    return worst;
}

/* A point of shape s, on its edge or inside: is it a witness? */
static void try_point(struct search *search, const struct shape *s, double x, double y)
{
    double z = shape_depth(search->scene, s, x, y);
    double distance = hypot(x - search->x, y - search->y);
    if (distance > 1 && distance > step_at(search->scene->camera, z)) {
        return;
    }
    enum outcome outcome = compare(search, s, x, y, z);
    if (outcome == EDGE && distance > 1) {
        outcome = NEAR_STEP;
    }
    if (outcome < search->best) {
        search->best = outcome;
    }
}

/* The part of the line a-b inside the window, as a range of its parameter. */
static bool clip_line(struct spot a, struct spot b, const double low[2], const double high[2],
                      double range[2])
{
    double from[2] = { a.x, a.y }, way[2] = { b.x - a.x, b.y - a.y };
    range[0] = 0;
    range[1] = 1;
    for (int i = 0; i < 2; i++) {
        if (way[i] == 0) {
            if (from[i] < low[i] || from[i] > high[i]) {
                return false;
            }
            continue;
        }
        double t0 = (low[i] - from[i]) / way[i], t1 = (high[i] - from[i]) / way[i];
        range[0] = fmax(range[0], fmin(t0, t1));
        range[1] = fmin(range[1], fmax(t0, t1));
    }
    return range[0] <= range[1];
}

static void try_outline(struct search *search, const struct shape *s, const double low[2],
                        const double high[2], int level)
{
    const struct spot *p = search->scene->spots + s->first;
    for (uint32_t i = 0, j = s->count - 1; i < s->count && search->best > TIE; j = i++) {
        double range[2];
        if (!clip_line(p[j], p[i], low, high, range)) {
            continue;
        }
        for (int k = 0; k <= level; k++) {
            double t = range[0] + (range[1] - range[0]) * k / level;
            try_point(search, s, p[j].x + t * (p[i].x - p[j].x), p[j].y + t * (p[i].y - p[j].y));
        }
    }
}

static void try_shape(struct search *search, const struct shape *s, int level)
{
    if (!s->facing) {
        return;
    }
    double reach = fmax(1, step_at(search->scene->camera, s->z_min));
    double low[2] = { fmax(s->x_min, search->x - reach), fmax(s->y_min, search->y - reach) };
    double high[2] = { fmin(s->x_max, search->x + reach), fmin(s->y_max, search->y + reach) };
    if (low[0] > high[0] || low[1] > high[1]) {
        return;
    }
    for (int i = 0; i <= level && search->best > TIE; i++) {
        for (int k = 0; k <= level && search->best > TIE; k++) {
            double x = low[0] + (high[0] - low[0]) * i / level;
            double y = low[1] + (high[1] - low[1]) * k / level;
            if (shape_winding(search->scene, s, x, y) != 0) {
                try_point(search, s, x, y);
            }
        }
    }
    try_outline(search, s, low, high, level);
}

static uint32_t id_at(const struct scene *scene, int64_t x, int64_t y)
{
    const struct camera *c = scene->camera;
    if (x < 0 || y < 0 || x >= c->width || y >= c->height) {
        return 0;
    }
    uint32_t seen = scene->seen[(size_t)y * c->width + (size_t)x];
    return seen ? scene->shapes[seen - 1].id : 0;
}

/* The pixel shows polygon `id`. */
static enum outcome judge_polygon(const struct scene *scene, double tie, int64_t x, int64_t y,
                                  uint32_t id)
{
    if (id > scene->id_count) {
        return WRONG;
    }
    if (id_at(scene, x - 1, y) == id || id_at(scene, x + 1, y) == id ||
        id_at(scene, x, y - 1) == id || id_at(scene, x, y + 1) == id) {
        return EDGE;
    }
    struct search search = { scene, tie, (double)x + 0.5, (double)y + 0.5, WRONG };
    for (int level = 4; level <= 64 && search.best > TIE; level *= 4) {
        for (uint32_t i = scene->id_first[id]; i < scene->id_first[id + 1]; i++) {
            try_shape(&search, &scene->shapes[scene->id_shapes[i]], level);
        }
    }
    return search.best;
}

/* ---- background ------------------------------------------------------------------------------- */
static bool is_empty(const struct scene *scene, double x, double y)
{
    uint32_t count;
    const uint32_t *items = scene_candidates(scene, x, y, &count);
    for (uint32_t i = 0; i < count; i++) {
        if (shape_covers(scene, &scene->shapes[items[i]], x, y)) {
            return false;
        }
    }
    return true;
}

/* Background somewhere in the square (or disc) of this reach about the point? */
static bool find_empty(const struct scene *scene, double x, double y, double reach, bool disc,
                       int level)
{
    for (int i = -level; i <= level; i++) {
        for (int k = -level; k <= level; k++) {
            if (disc && i * i + k * k > level * level) {
                continue;
            }
            if (is_empty(scene, x + reach * i / level, y + reach * k / level)) {
                return true;
            }
        }
    }
    return false;
}

/* The pixel shows background where the oracle shows the model. */
static enum outcome judge_background(const struct scene *scene, int64_t x, int64_t y)
{
    double cx = (double)x + 0.5, cy = (double)y + 0.5;
    if (find_empty(scene, cx, cy, 1, false, 1) || find_empty(scene, cx, cy, 1, false, 16)) {
        return EDGE;
    }
    double z = scene->depth[(size_t)y * scene->camera->width + (size_t)x];
    double reach = step_at(scene->camera, z);
    return reach > 1 && find_empty(scene, cx, cy, reach, true, 24) ? NEAR_STEP : WRONG;
}

/* ---- the frame -------------------------------------------------------------------------------- */
static void paint(uint8_t *rgb, enum outcome outcome, bool model, bool hole)
{
    static const uint8_t colours[6][3] = { { 90, 90, 90 }, { 60, 90, 160 }, { 150, 60, 150 },
                                           { 60, 140, 60 }, { 150, 150, 40 }, { 255, 0, 0 } };
    static const uint8_t hole_colour[3] = { 255, 255, 0 }, nothing[3] = { 0, 0, 0 };
    const uint8_t *c = colours[outcome];
    if (outcome == WRONG && hole) {
        c = hole_colour;
    } else if (outcome == SAME && !model) {
        c = nothing;
    }
    memcpy(rgb, c, 3);
}

static void count_outcome(struct verdict *v, enum outcome outcome, bool hole,
                          struct example example)
{
    switch (outcome) {
    case SAME:
        v->same++;
        break;
    case EDGE:
        v->edge++;
        break;
    case NEAR_STEP:
        v->near++;
        break;
    case TIE:
        v->tie++;
        break;
    case SLANT:
        v->slant++;
        break;
    case WRONG:
        if (v->wrong + v->holes < EXAMPLES) {
            v->examples[v->wrong + v->holes] = example;
        }
        *(hole ? &v->holes : &v->wrong) += 1;
        break;
    }
}

void judge(const struct scene *scene, const uint32_t *frame, double tie, struct verdict *verdict,
           uint8_t *difference)
{
    uint32_t width = scene->camera->width, height = scene->camera->height;
    memset(verdict, 0, sizeof *verdict);
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            size_t at = (size_t)y * width + x;
            uint32_t due = id_at(scene, x, y), shown = frame[at];
            enum outcome outcome = SAME;
            if (shown != due) {
                outcome = shown ? judge_polygon(scene, tie, x, y, shown)
                                : judge_background(scene, x, y);
            }
            if (due || shown) {
                verdict->model += due != 0;
                count_outcome(verdict, outcome, shown == 0,
                              (struct example){ x, y, shown, due });
            }
            if (difference) {
                paint(difference + 3 * at, outcome, due != 0, shown == 0);
            }
        }
    }
}
