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
enum outcome { SAME, EDGE, NEAR_STEP, TIE, SLANT, RIM, STRIP, WRONG };

/* A view with so many faults has failed: the search goes on coarsely, to be done in time. */
enum { ENOUGH_FAULTS = 200 };

struct search {
    const struct scene *scene;
    double tie;  /* lattice steps */
    double x, y; /* the pixel's centre */
    bool rims;   /* outlines that end at a rim may be off by rounding */
    enum outcome best;
    enum outcome enough; /* the search ends with this */
};

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
        if (p->id == s->id || p->z_min >= z ||
            !(search->rims ? shape_covers_surely : shape_covers)(scene, p, x, y)) {
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
    double step = scene_step(search->scene->camera, z);
    /* A back shows by rounding alone: that and a lattice step are all it may be off. */
    if (distance > (s->facing ? fmax(1, step) : ROUNDING + step)) {
        return;
    }
    enum outcome outcome = compare(search, s, x, y, z);
    if (outcome == EDGE && distance > 1) {
        outcome = NEAR_STEP;
    }
    if (search->rims && outcome != WRONG) {
        outcome = RIM;
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
    for (uint32_t i = 0, j = s->count - 1; i < s->count && search->best > search->enough; j = i++) {
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
    if (!s->facing && !search->rims) {
        return;
    }
    double reach = fmax(1, scene_step(search->scene->camera, s->z_min));
    double low[2] = { fmax(s->x_min, search->x - reach), fmax(s->y_min, search->y - reach) };
    double high[2] = { fmin(s->x_max, search->x + reach), fmin(s->y_max, search->y + reach) };
    if (low[0] > high[0] || low[1] > high[1]) {
        return;
    }
    for (int i = 0; i <= level && s->facing && search->best > search->enough; i++) {
        for (int k = 0; k <= level && search->best > search->enough; k++) {
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

static void try_all(struct search *search, uint32_t id, int level)
{
    const struct scene *scene = search->scene;
    for (uint32_t i = scene->id_first[id]; i < scene->id_first[id + 1]; i++) {
        try_shape(search, &scene->shapes[scene->id_shapes[i]], level);
    }
}

/* ---- planes seen edge-on -------------------------------------------------------------------- */
static struct vec point_at(const struct camera *c, double x, double y, double z)
{
    struct vec r = scene_ray(c, x, y);
    return c->parallel ? (struct vec){ r.x, r.y, z } : (struct vec){ r.x * z, r.y * z, z };
}

/* The tolerance, or the rounding of outlines at this depth. */
static double plane_bound(const struct search *search, double z)
{
    return fmax(search->tie / 2, ROUNDING / scene_step(search->scene->camera, z));
}

/* A shape's plane holds both points within the bound. */
static bool holds(const struct search *search, const struct shape *plane, struct vec a,
                  struct vec b)
{
    return fabs(vec_dot(plane->normal, a) + plane->offset) <= plane_bound(search, a.z) &&
           fabs(vec_dot(plane->normal, b) + plane->offset) <= plane_bound(search, b.z);
}

static bool share_a_plane(const struct search *search, const struct shape *plane, struct vec a,
                          struct vec b)
{
    const struct scene *scene = search->scene;
    for (size_t i = 0; !plane && i < scene->shape_count; i++) {
        if (holds(search, &scene->shapes[i], a, b)) {
            return true;
        }
    }
    return plane && holds(search, plane, a, b);
}

/* Does all that hides s at a point lie on one plane with s there? NULL: on any plane. */
static bool strip_at(const struct search *search, const struct shape *s, const struct shape *plane,
                     double x, double y)
{
    const struct scene *scene = search->scene;
    uint32_t count;
    const uint32_t *items = scene_candidates(scene, x, y, &count);
    double z = shape_depth(scene, s, x, y);
    bool found = false;
    for (uint32_t i = 0; i < count; i++) {
        const struct shape *p = &scene->shapes[items[i]];
        if (p->id == s->id || p->z_min >= z || !shape_covers(scene, p, x, y)) {
            continue;
        }
        double at = shape_depth(scene, p, x, y);
        if (z - at > search->tie + s->slack + p->slack) {
            if (!share_a_plane(search, plane, point_at(scene->camera, x, y, z),
                               point_at(scene->camera, x, y, at))) {
                return false;
            }
            found = true;
        }
    }
    return found;
}

/*
 * A plane seen edge-on cuts s: the compiler may have cut s there. The point to
 * look at is the one next to the pixel where s meets the plane.
 */
static bool plane_cuts(const struct search *search, const struct shape *s,
                       const struct shape *plane)
{
    const struct camera *c = search->scene->camera;
    struct vec r = scene_ray(c, search->x, search->y), n = plane->normal;
    double across = hypot(n.x, n.y);
    double z = shape_depth(search->scene, s, search->x, search->y);
    if (c->parallel || across == 0 || fabs(plane->offset) > plane_bound(search, z)) {
        return false;
    }
    double off = (vec_dot(n, r) + plane->offset / z) / across;
    double x = search->x - off * n.x / across * c->focal;
    double y = search->y + off * n.y / across * c->focal;
    return hypot(x - search->x, y - search->y) <= 1 && shape_covers(search->scene, s, x, y) &&
           strip_at(search, s, plane, x, y);
}

static void try_cuts(struct search *search, uint32_t id)
{
    const struct scene *scene = search->scene;
    for (uint32_t n = scene->id_first[id]; n < scene->id_first[id + 1]; n++) {
        for (size_t i = 0; i < scene->shape_count; i++) {
            if (plane_cuts(search, &scene->shapes[scene->id_shapes[n]], &scene->shapes[i])) {
                search->best = STRIP;
                return;
            }
        }
    }
}

/* Points of one shape's outline near the pixel. */
static bool strip_along(const struct search *search, const struct shape *s)
{
    const struct spot *p = search->scene->spots + s->first;
    double reach = s->facing ? 1 : ROUNDING;
    const double low[2] = { search->x - reach, search->y - reach };
    const double high[2] = { search->x + reach, search->y + reach };
    for (uint32_t i = 0, j = s->count - 1; i < s->count; j = i++) {
        double range[2];
        if (!clip_line(p[j], p[i], low, high, range)) {
            continue;
        }
        for (int k = 0; k <= 16; k++) {
            double t = range[0] + (range[1] - range[0]) * k / 16;
            if (strip_at(search, s, NULL, p[j].x + t * (p[i].x - p[j].x),
                         p[j].y + t * (p[i].y - p[j].y))) {
                return true;
            }
        }
    }
    return false;
}

static void try_strip(struct search *search, uint32_t id)
{
    const struct scene *scene = search->scene;
    for (uint32_t n = scene->id_first[id]; n < scene->id_first[id + 1]; n++) {
        if (strip_along(search, &scene->shapes[scene->id_shapes[n]])) {
            search->best = STRIP;
        }
    }
}

/* ---- polygons shown ------------------------------------------------------------------------- */
/* The pixel shows polygon `id`. */
static enum outcome judge_polygon(const struct scene *scene, double tie, int64_t x, int64_t y,
                                  uint32_t id, bool coarse)
{
    if (id > scene->id_count) {
        return WRONG;
    }
    if (id_at(scene, x - 1, y) == id || id_at(scene, x + 1, y) == id ||
        id_at(scene, x, y - 1) == id || id_at(scene, x, y + 1) == id) {
        return EDGE;
    }
    struct search search = { scene, tie, (double)x + 0.5, (double)y + 0.5, false, WRONG, TIE };
    for (int level = 4; level <= (coarse ? 4 : 64) && search.best > TIE; level *= 4) {
        try_all(&search, id, level);
    }
    if (coarse) {
        return search.best;
    }
    search.rims = true;
    search.enough = RIM;
    for (int level = 16; level <= 64 && search.best == WRONG; level *= 4) {
        try_all(&search, id, level);
    }
    if (search.best == WRONG) {
        try_strip(&search, id);
    }
    if (search.best == WRONG) {
        try_cuts(&search, id);
    }
    return search.best;
}

/* ---- background ----------------------------------------------------------------------------- */
static bool is_empty(const struct scene *scene, double x, double y, bool rims)
{
    uint32_t count;
    const uint32_t *items = scene_candidates(scene, x, y, &count);
    for (uint32_t i = 0; i < count; i++) {
        const struct shape *p = &scene->shapes[items[i]];
        if ((rims ? shape_covers_surely : shape_covers)(scene, p, x, y)) {
            return false;
        }
    }
    return true;
}

/* Background somewhere in the square (or disc) of this reach about the point? */
static bool find_empty(const struct scene *scene, double x, double y, double reach, bool disc,
                       bool rims, int level)
{
    for (int i = -level; i <= level; i++) {
        for (int k = -level; k <= level; k++) {
            if (disc && i * i + k * k > level * level) {
                continue;
            }
            if (is_empty(scene, x + reach * i / level, y + reach * k / level, rims)) {
                return true;
            }
        }
    }
    return false;
}

/* The pixel shows background where the oracle shows the model. */
static enum outcome judge_background(const struct scene *scene, int64_t x, int64_t y, bool coarse)
{
    double cx = (double)x + 0.5, cy = (double)y + 0.5;
    if (find_empty(scene, cx, cy, 1, false, false, 1) ||
        find_empty(scene, cx, cy, 1, false, false, 16)) {
        return EDGE;
    }
    if (coarse) {
        return WRONG;
    }
    double z = scene->depth[(size_t)y * scene->camera->width + (size_t)x];
    double reach = scene_step(scene->camera, z);
    if (reach > 1 && find_empty(scene, cx, cy, reach, true, false, 24)) {
        return NEAR_STEP;
    }
    return find_empty(scene, cx, cy, 1, false, true, 16) ? RIM : WRONG;
}

/* ---- the frame ------------------------------------------------------------------------------ */
static void paint(uint8_t *rgb, enum outcome outcome, bool model, bool hole)
{
    static const uint8_t colours[8][3] = { { 90, 90, 90 },   { 60, 90, 160 },  { 150, 60, 150 },
                                           { 60, 140, 60 },  { 150, 150, 40 }, { 40, 150, 150 },
                                           { 200, 120, 40 }, { 255, 0, 0 } };
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
    case RIM:
        v->rim++;
        break;
    case STRIP:
        v->strip++;
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
                bool coarse = verdict->wrong + verdict->holes >= ENOUGH_FAULTS;
                outcome = shown ? judge_polygon(scene, tie, x, y, shown, coarse)
                                : judge_background(scene, x, y, coarse);
            }
            if (due || shown) {
                verdict->model += due != 0;
                count_outcome(verdict, outcome, shown == 0, (struct example){ x, y, shown, due });
            }
            if (difference) {
                paint(difference + 3 * at, outcome, due != 0, shown == 0);
            }
        }
    }
}
