/* SPDX-License-Identifier: 0BSD */
/* Flatness of polygons, and polygons cut into triangles by clipping ears. */
#include "triangulate.h"

#include <math.h>
#include <stdlib.h>

#include "tools/common/xalloc.h"

enum { MOST_EARS = 8192 }; /* clipping takes the square of the corners: above this, a fan */

void outline_area(const double (*points)[3], uint32_t count, double area[3])
{
    const double *o = points[0];
    area[0] = area[1] = area[2] = 0;
    for (uint32_t i = 1; i + 1 < count; i++) {
        double a[3];
        double b[3];
        for (int k = 0; k < 3; k++) {
            a[k] = points[i][k] - o[k];
            b[k] = points[i + 1][k] - o[k];
        }
        area[0] += a[1] * b[2] - a[2] * b[1];
        area[1] += a[2] * b[0] - a[0] * b[2];
        area[2] += a[0] * b[1] - a[1] * b[0];
    }
}

bool outline_is_flat(const double (*points)[3], uint32_t count, double limit)
{
    double area[3];
    if (count <= 3) {
        return true;
    }
    outline_area(points, count, area);
    double length = sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
    double low = INFINITY;
    double high = -INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        double height = 0;
        for (int k = 0; k < 3; k++) {
            height += area[k] / length * (points[i][k] - points[0][k]);
        }
        low = fmin(low, height);
        high = fmax(high, height);
    }
    return length > 0 && high - low <= 2 * limit; /* false for a normal that is no number */
}

/* An outline in two dimensions that loses its ears; it runs counter-clockwise. */
struct ears {
    double (*at)[2];
    uint32_t *next;
    uint32_t *before;
};

static double turn(const struct ears *ears, uint32_t a, uint32_t b, uint32_t c)
{
    const double *p = ears->at[a];
    const double *q = ears->at[b];
    const double *r = ears->at[c];
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

static bool same(const struct ears *ears, uint32_t a, uint32_t b)
{
    return ears->at[a][0] == ears->at[b][0] && ears->at[a][1] == ears->at[b][1];
}

/* Is corner b the tip of a triangle that holds no other corner? */
static bool is_ear(const struct ears *ears, uint32_t b)
{
    uint32_t a = ears->before[b];
    uint32_t c = ears->next[b];
    if (turn(ears, a, b, c) <= 0) {
        return false;
    }
    for (uint32_t p = ears->next[c]; p != a; p = ears->next[p]) {
        if (!same(ears, p, a) && !same(ears, p, b) && !same(ears, p, c) &&
            turn(ears, a, b, p) >= 0 && turn(ears, b, c, p) >= 0 && turn(ears, c, a, p) >= 0) {
            return false;
        }
    }
    return true;
}

/* Drops the axis along which the area is largest; keeps the way round. */
static void flatten(const double (*points)[3], uint32_t count, double (*at)[2])
{
    double area[3];
    outline_area(points, count, area);
    int axis = 0;
    for (int k = 1; k < 3; k++) {
        axis = fabs(area[k]) > fabs(area[axis]) ? k : axis;
    }
    int u = (axis + 1) % 3;
    int v = (axis + 2) % 3;
    for (uint32_t i = 0; i < count; i++) {
        at[i][area[axis] < 0] = points[i][u];
        at[i][area[axis] >= 0] = points[i][v];
    }
}

static void clip_ears(struct ears *ears, uint32_t count, uint32_t (*triangles)[3])
{
    uint32_t made = 0;
    uint32_t b = 1;
    uint32_t tries = 0;
    uint32_t left = count;
    while (left > 3) {
        /* After a whole round without an ear (an outline that crosses itself) take any corner. */
        if (is_ear(ears, b) || tries >= left) {
            uint32_t a = ears->before[b];
            uint32_t c = ears->next[b];
            triangles[made][0] = a;
            triangles[made][1] = b;
            triangles[made++][2] = c;
            ears->next[a] = c;
            ears->before[c] = a;
            left--;
            tries = 0;
            b = ears->next[c];
        } else {
            tries++;
            b = ears->next[b];
        }
    }
    triangles[made][0] = ears->before[b];
    triangles[made][1] = b;
    triangles[made][2] = ears->next[b];
}

static bool is_convex(const struct ears *ears, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (turn(ears, ears->before[i], i, ears->next[i]) < 0) {
            return false;
        }
    }
    return true;
}

void outline_triangulate(const double (*points)[3], uint32_t count, uint32_t (*triangles)[3])
{
    struct ears ears = { xalloc(count, sizeof *ears.at), xalloc(count, sizeof *ears.next),
                         xalloc(count, sizeof *ears.before) };
    flatten(points, count, ears.at);
    for (uint32_t i = 0; i < count; i++) {
        ears.next[i] = i + 1 < count ? i + 1 : 0;
        ears.before[i] = i > 0 ? i - 1 : count - 1;
    }
    if (count <= MOST_EARS && !is_convex(&ears, count)) {
        clip_ears(&ears, count, triangles);
    } else {
        for (uint32_t i = 0; i + 2 < count; i++) {
            triangles[i][0] = 0;
            triangles[i][1] = i + 1;
            triangles[i][2] = i + 2;
        }
    }
    free(ears.at);
    free(ears.next);
    free(ears.before);
}
