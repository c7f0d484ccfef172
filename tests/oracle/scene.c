/* SPDX-License-Identifier: 0BSD */
/*
 * One view in double precision: polygons on the screen, clipped by the
 * near plane and the cutting plane; bins that say which polygons may cover a point; the z-buffer at pixel
 * centres. Coverage is the winding number of the outline at the point, which
 * also decides facing; depth comes from the polygon's plane.
 */
#include "tests/oracle/oracle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BIN = 4, MARGIN = 4 }; /* pixels; bins reach MARGIN beyond the screen */

/* ---- one polygon ---------------------------------------------------------------------------- */
static struct vec to_camera(const struct camera *c, struct vec p)
{
    struct vec d = vec_sub(p, c->eye);
    return (struct vec){ vec_dot(c->axis[0], d), vec_dot(c->axis[1], d), vec_dot(c->axis[2], d) };
}

/* A corner in camera axes, and the model's corner where its edge begins. */
struct kept {
    struct vec at;
    uint32_t corner;
};

/* Keeps where normal.p + offset >= 0. */
static uint32_t clip(const struct kept *in, uint32_t count, struct vec normal, double offset,
                     struct kept *out)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < count; i++) {
        struct vec a = in[i].at, b = in[(i + 1) % count].at;
        double from = vec_dot(normal, a) + offset, to = vec_dot(normal, b) + offset;
        if (from >= 0) {
            out[n++] = in[i];
        }
        if ((from >= 0) != (to >= 0)) {
            double t = from / (from - to);
            out[n].at =
                (struct vec){ a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z) };
            out[n++].corner = from >= 0 ? CUT : in[i].corner;
        }
    }
    return n;
}

/* By the near plane and the cutting plane, in place; other: as large as kept. */
static uint32_t clip_shape(const struct camera *c, struct kept *kept, uint32_t count,
                           struct kept *other)
{
    if (!c->parallel) {
        count = clip(kept, count, (struct vec){ 0, 0, 1 }, -c->near_z, other);
        memcpy(kept, other, count * sizeof *kept);
    }
    if (c->cuts && count > 0) {
        count = clip(kept, count, c->cut, c->cut_offset, other);
        memcpy(kept, other, count * sizeof *kept);
    }
    return count;
}

/* The plane by Newell's method about the first corner; false for a polygon without area. */
static bool set_plane(struct shape *s, const struct vec *p, uint32_t count)
{
    struct vec n = { 0, 0, 0 }, middle = { 0, 0, 0 };
    for (uint32_t i = 0; i < count; i++) {
        struct vec a = vec_sub(p[i], p[0]), b = vec_sub(p[(i + 1) % count], p[0]);
        n.x += (a.y - b.y) * (a.z + b.z);
        n.y += (a.z - b.z) * (a.x + b.x);
        n.z += (a.x - b.x) * (a.y + b.y);
        middle.x += p[i].x / count;
        middle.y += p[i].y / count;
        middle.z += p[i].z / count;
    }
    double length = sqrt(vec_dot(n, n));
    if (!(length > 1e-9)) {
        return false;
    }
    s->normal = (struct vec){ n.x / length, n.y / length, n.z / length };
    s->offset = -vec_dot(s->normal, middle);
    return true;
}

static struct spot project(const struct camera *c, struct kept k)
{
    double f = c->parallel ? c->focal : c->focal / k.at.z;
    return (struct spot){ c->width / 2.0 + k.at.x * f, c->height / 2.0 - k.at.y * f, k.corner,
                          true };
}

static void set_bounds(struct shape *s, const struct spot *spots, bool two_sided, enum tells tells)
{
    double area = 0, perimeter = 0;
    s->x_min = s->y_min = INFINITY;
    s->x_max = s->y_max = -INFINITY;
    for (uint32_t i = 0; i < s->count; i++) {
        struct spot a = spots[i], b = spots[(i + 1) % s->count];
        s->x_min = fmin(s->x_min, a.x);
        s->x_max = fmax(s->x_max, a.x);
        s->y_min = fmin(s->y_min, a.y);
        s->y_max = fmax(s->y_max, a.y);
        area += (a.x - spots[0].x) * (b.y - spots[0].y) - (b.x - spots[0].x) * (a.y - spots[0].y);
        perimeter += hypot(b.x - a.x, b.y - a.y);
    }
    /* Mean width: the area is at most half the perimeter times that. */
    s->thin = fabs(area) / 2 <= perimeter / 2 * ROUNDING;
    s->facing = two_sided || s->thin || area < 0; /* y runs down: counter-clockwise is negative */
    if (tells == TELLS_SIDE) {
        s->id = area < 0 ? SIDE_FRONT : SIDE_BACK;
    }
}

/* kept: two rows with room for each corner four times. */
static void add_shape(struct scene *scene, uint32_t number, struct vec *work,
                      struct kept *const kept[2])
{
    const struct camera *c = scene->camera;
    const struct model *m = scene->model;
    const struct polygon *p = &m->polygons[number];
    for (uint32_t i = 0; i < p->count; i++) {
        work[i] = to_camera(c, m->points[m->corners[p->first + i]]);
        kept[0][i] = (struct kept){ work[i], p->first + i };
    }
    struct shape s = {
        .id = p->id, .slack = p->slack, .polygon = number, .z_min = INFINITY, .z_max = -INFINITY
    };
    if (!set_plane(&s, work, p->count)) {
        return;
    }
    s.count = clip_shape(c, kept[0], p->count, kept[1]);
    if (s.count < 3) {
        return;
    }
    s.first = (uint32_t)scene->spot_count;
    scene->spots = more(scene->spots, scene->spot_count + s.count, sizeof *scene->spots);
    for (uint32_t i = 0; i < s.count; i++) {
        s.z_min = fmin(s.z_min, kept[0][i].at.z);
        s.z_max = fmax(s.z_max, kept[0][i].at.z);
        scene->spots[s.first + i] = project(c, kept[0][i]);
    }
    set_bounds(&s, scene->spots + s.first, scene->two_sided, scene->tells);
    scene->spot_count += s.count;
    scene->shapes = more(scene->shapes, scene->shape_count + 1, sizeof *scene->shapes);
    scene->shapes[scene->shape_count++] = s;
}

/* Marks the edges that some other drawn polygon has too: rounding moves both alike. */
static void find_rims(struct scene *scene)
{
    const struct model *m = scene->model;
    bool *drawn = need(m->polygon_count, sizeof *drawn);
    for (size_t i = 0; i < scene->shape_count; i++) {
        drawn[scene->shapes[i].polygon] = scene->shapes[i].facing && !scene->shapes[i].thin;
    }
    for (size_t i = 0; i < scene->spot_count; i++) {
        struct spot *spot = &scene->spots[i];
        if (spot->corner == CUT) {
            continue;
        }
        uint32_t at = m->edge_of[spot->corner], low = at;
        while (low > 0 && compare_ends(&m->edges[low - 1], &m->edges[at]) == 0) {
            low--;
        }
        for (; low < m->corner_count && compare_ends(&m->edges[low], &m->edges[at]) == 0; low++) {
            spot->rim = spot->rim && (m->edges[low].polygon == m->edges[at].polygon ||
                                      !drawn[m->edges[low].polygon]);
        }
    }
    free(drawn);
}

int shape_winding(const struct scene *scene, const struct shape *s, double x, double y)
{
    const struct spot *p = scene->spots + s->first;
    int winding = 0;
    for (uint32_t i = 0, j = s->count - 1; i < s->count; j = i++) {
        bool was_above = p[j].y <= y, is_above = p[i].y <= y;
        if (was_above == is_above) {
            continue;
        }
        if (p[j].x + (y - p[j].y) / (p[i].y - p[j].y) * (p[i].x - p[j].x) > x) {
            winding += is_above ? 1 : -1; /* the edge runs up the screen: counter-clockwise */
        }
    }
    return winding;
}

bool shape_covers(const struct scene *scene, const struct shape *s, double x, double y)
{
    if (x < s->x_min || x > s->x_max || y < s->y_min || y > s->y_max) {
        return false;
    }
    int winding = shape_winding(scene, s, x, y);
    return scene->two_sided ? winding != 0 : winding > 0;
}

double scene_step(const struct camera *c, double z)
{
    return c->parallel ? c->focal : c->focal / fmax(z, c->near_z);
}

static double distance_to(struct spot a, struct spot b, double x, double y)
{
    double wx = b.x - a.x, wy = b.y - a.y, square = wx * wx + wy * wy;
    double t = square > 0 ? ((x - a.x) * wx + (y - a.y) * wy) / square : 0;
    t = fmin(1, fmax(0, t));
    return hypot(a.x + t * wx - x, a.y + t * wy - y);
}

bool shape_covers_surely(const struct scene *scene, const struct shape *s, double x, double y)
{
    if (!shape_covers(scene, s, x, y)) {
        return false;
    }
    const struct spot *p = scene->spots + s->first;
    double bound = ROUNDING + scene_step(scene->camera, shape_depth(scene, s, x, y));
    for (uint32_t i = 0; i < s->count; i++) {
        if (p[i].rim && distance_to(p[i], p[(i + 1) % s->count], x, y) <= bound) {
            return false;
        }
    }
    return true;
}

struct vec scene_ray(const struct camera *c, double x, double y)
{
    return (struct vec){ (x - c->width / 2.0) / c->focal, (c->height / 2.0 - y) / c->focal, 1 };
}

double shape_depth(const struct scene *scene, const struct shape *s, double x, double y)
{
    struct vec r = scene_ray(scene->camera, x, y);
    double base = s->offset, along = s->normal.z;
    if (scene->camera->parallel) {
        base += s->normal.x * r.x + s->normal.y * r.y;
    } else {
        along = vec_dot(s->normal, r);
    }
    double z = -base / along;
    return z >= s->z_min ? (z <= s->z_max ? z : s->z_max) : s->z_min;
}

double shape_slope(const struct scene *scene, const struct shape *s, double x, double y)
{
    if (scene->camera->parallel) {
        return fabs(s->normal.z);
    }
    return fabs(vec_dot(s->normal, scene_ray(scene->camera, x, y)));
}

/* ---- bins and the index by source polygon --------------------------------------------------- */
static uint32_t bin_of(double v, uint32_t bins)
{
    double b = floor((v + MARGIN) / BIN);
    return b < 0 ? 0 : b >= bins ? bins - 1 : (uint32_t)b;
}

static bool off_screen(const struct scene *scene, const struct shape *s)
{
    return s->x_max < -MARGIN || s->y_max < -MARGIN || s->x_min > scene->camera->width + MARGIN ||
           s->y_min > scene->camera->height + MARGIN;
}

/* Calls for each bin that the shape's box touches: counts, or fills in. */
static void bin_shape(struct scene *scene, uint32_t number, uint32_t *cursor, bool fill)
{
    const struct shape *s = &scene->shapes[number];
    if (off_screen(scene, s)) {
        return;
    }
    uint32_t x1 = bin_of(s->x_max, scene->bins_across), y1 = bin_of(s->y_max, scene->bins_down);
    for (uint32_t y = bin_of(s->y_min, scene->bins_down); y <= y1; y++) {
        for (uint32_t x = bin_of(s->x_min, scene->bins_across); x <= x1; x++) {
            uint32_t bin = y * scene->bins_across + x;
            if (fill) {
                scene->bin_items[cursor[bin]] = number;
            }
            cursor[bin]++;
        }
    }
}

static void make_bins(struct scene *scene)
{
    scene->bins_across = (scene->camera->width + 2 * MARGIN) / BIN + 1;
    scene->bins_down = (scene->camera->height + 2 * MARGIN) / BIN + 1;
    uint32_t bins = scene->bins_across * scene->bins_down;
    uint32_t *cursor = need(bins, sizeof *cursor);
    for (uint32_t i = 0; i < scene->shape_count; i++) {
        bin_shape(scene, i, cursor, false);
    }
    scene->bin_start = need(bins + 1, sizeof *scene->bin_start);
    for (uint32_t i = 0; i < bins; i++) {
        scene->bin_start[i + 1] = scene->bin_start[i] + cursor[i];
        cursor[i] = scene->bin_start[i];
    }
    scene->bin_items = need(scene->bin_start[bins] + 1, sizeof *scene->bin_items);
    for (uint32_t i = 0; i < scene->shape_count; i++) {
        bin_shape(scene, i, cursor, true);
    }
    free(cursor);
}

static void index_ids(struct scene *scene)
{
    scene->id_first = need(scene->id_count + 2, sizeof *scene->id_first);
    for (size_t i = 0; i < scene->shape_count; i++) {
        scene->id_first[scene->shapes[i].id + 1]++;
    }
    for (uint32_t i = 0; i <= scene->id_count; i++) {
        scene->id_first[i + 1] += scene->id_first[i];
    }
    uint32_t *cursor = need(scene->id_count + 1, sizeof *cursor);
    scene->id_shapes = need(scene->shape_count + 1, sizeof *scene->id_shapes);
    for (uint32_t i = 0; i < scene->shape_count; i++) {
        uint32_t id = scene->shapes[i].id;
        scene->id_shapes[scene->id_first[id] + cursor[id]++] = i;
    }
    free(cursor);
}

/* The shapes that may cover a point; every shape for points far off the screen. */
const uint32_t *scene_candidates(const struct scene *scene, double x, double y, uint32_t *count)
{
    if (x < -MARGIN || y < -MARGIN || x > scene->camera->width + MARGIN ||
        y > scene->camera->height + MARGIN) {
        *count = (uint32_t)scene->shape_count;
        return scene->id_shapes;
    }
    uint32_t bin = bin_of(y, scene->bins_down) * scene->bins_across + bin_of(x, scene->bins_across);
    *count = scene->bin_start[bin + 1] - scene->bin_start[bin];
    return scene->bin_items + scene->bin_start[bin];
}

/* ---- the z-buffer --------------------------------------------------------------------------- */
struct crossing {
    double x;
    int turn;
};

static int by_x(const void *a, const void *b)
{
    double d = ((const struct crossing *)a)->x - ((const struct crossing *)b)->x;
    return (d > 0) - (d < 0);
}

static uint32_t crossings_of(const struct scene *scene, const struct shape *s, double y,
                             struct crossing *out)
{
    const struct spot *p = scene->spots + s->first;
    uint32_t n = 0;
    for (uint32_t i = 0, j = s->count - 1; i < s->count; j = i++) {
        bool was_above = p[j].y <= y, is_above = p[i].y <= y;
        if (was_above != is_above) {
            out[n].x = p[j].x + (y - p[j].y) / (p[i].y - p[j].y) * (p[i].x - p[j].x);
            out[n++].turn = is_above ? 1 : -1;
        }
    }
    qsort(out, n, sizeof *out, by_x);
    return n;
}

static void draw_span(struct scene *scene, uint32_t number, uint32_t row, double x0, double x1)
{
    double width = scene->camera->width;
    if (x1 < 0.5 || x0 > width) {
        return;
    }
    uint32_t first = x0 <= 0.5 ? 0 : (uint32_t)ceil(x0 - 0.5);
    uint32_t end = x1 >= width ? (uint32_t)width : (uint32_t)ceil(x1 - 0.5);
    for (uint32_t x = first; x < end; x++) {
        double z = shape_depth(scene, &scene->shapes[number], x + 0.5, row + 0.5);
        size_t at = (size_t)row * scene->camera->width + x;
        if (z < scene->depth[at]) {
            scene->depth[at] = z;
            scene->seen[at] = number + 1;
        }
    }
}

static void draw_shape(struct scene *scene, uint32_t number, struct crossing *work)
{
    const struct shape *s = &scene->shapes[number];
    if (off_screen(scene, s)) {
        return;
    }
    double y0 = fmax(0, floor(s->y_min - 0.5));
    double y1 = fmin(scene->camera->height, s->y_max + 0.5);
    for (uint32_t row = (uint32_t)y0; row < y1; row++) {
        uint32_t n = crossings_of(scene, s, row + 0.5, work);
        int winding = 0;
        for (uint32_t i = 0; i + 1 < n; i++) {
            winding -= work[i].turn; /* shape_winding counts from the right */
            if (scene->two_sided ? winding != 0 : winding > 0) {
                draw_span(scene, number, row, work[i].x, work[i + 1].x);
            }
        }
    }
}

void scene_make(struct scene *scene, const struct model *model, const struct camera *camera,
                bool two_sided, enum tells tells)
{
    memset(scene, 0, sizeof *scene);
    scene->camera = camera;
    scene->model = model;
    scene->two_sided = two_sided;
    scene->tells = tells;
    scene->id_count = tells == TELLS_ID ? model->source_count : SIDE_BACK;
    uint32_t most = 0;
    for (size_t i = 0; i < model->polygon_count; i++) {
        most = model->polygons[i].count > most ? model->polygons[i].count : most;
    }
    struct vec *work = need(most, sizeof *work);
    struct kept *kept[2] = { need((size_t)most * 4, sizeof **kept),
                             need((size_t)most * 4, sizeof **kept) };
    for (uint32_t i = 0; i < model->polygon_count; i++) {
        add_shape(scene, i, work, kept);
    }
    free(work);
    free(kept[0]);
    free(kept[1]);
    find_rims(scene);
    make_bins(scene);
    index_ids(scene);
    size_t pixels = (size_t)camera->width * camera->height;
    scene->seen = need(pixels, sizeof *scene->seen);
    scene->depth = need(pixels, sizeof *scene->depth);
    for (size_t i = 0; i < pixels; i++) {
        scene->depth[i] = INFINITY;
    }
    struct crossing *crossings = need((size_t)most * 4 + 2, sizeof *crossings);
    for (uint32_t i = 0; i < scene->shape_count; i++) {
        draw_shape(scene, i, crossings);
    }
    free(crossings);
}

void scene_free(struct scene *scene)
{
    free(scene->shapes);
    free(scene->spots);
    free(scene->bin_start);
    free(scene->bin_items);
    free(scene->id_first);
    free(scene->id_shapes);
    free(scene->seen);
    free(scene->depth);
}
