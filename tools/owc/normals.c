/* SPDX-License-Identifier: 0BSD */
/*
 * Vertex normals with a crease angle. Only shading sees them, so binary64
 * will do. Weights are angles: how a surface is cut into polygons does not
 * show, since the angles of a polygon's pieces at a point add up to its own.
 */
#include "normals.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/common/xalloc.h"

/* A polygon's corner at a point. */
struct use {
    uint32_t polygon;
    double angle; /* radians */
};

/* uses[first[p]] .. uses[first[p + 1] - 1] are the corners at point p. */
struct around {
    size_t *first;
    struct use *uses;
    double (*units)[3]; /* of each polygon */
};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void make_unit(double v[3])
{
    double length = sqrt(dot(v, v));
    for (int k = 0; k < 3 && length > 0; k++) {
        v[k] /= length;
    }
}

static void towards(const struct mesh *mesh, uint32_t from, uint32_t to, double v[3])
{
    for (int k = 0; k < 3; k++) {
        v[k] = (double)mesh->points[to][k] - mesh->points[from][k];
    }
    make_unit(v);
}

static double angle_at(const struct mesh *mesh, const struct mesh_polygon *polygon, uint32_t i)
{
    const uint32_t *corners = mesh->corners + polygon->first;
    double before[3];
    double after[3];
    towards(mesh, corners[i], corners[(i + polygon->count - 1) % polygon->count], before);
    towards(mesh, corners[i], corners[(i + 1) % polygon->count], after);
    double cosine = dot(before, after);
    return acos(cosine > 1 ? 1 : cosine < -1 ? -1 : cosine);
}

static void find_units(struct around *around, const struct mesh *mesh)
{
    around->units = xalloc_zero(mesh->polygon_count, sizeof *around->units);
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        const struct mesh_polygon *polygon = &mesh->polygons[p];
        int64_t area[3];
        mesh_area((const int16_t(*)[3])mesh->points, mesh->corners + polygon->first, polygon->count,
                  area);
        for (int k = 0; k < 3; k++) {
            around->units[p][k] = (double)area[k];
        }
        make_unit(around->units[p]);
    }
}

static void find_uses(struct around *around, const struct mesh *mesh)
{
    around->first = xalloc_zero((size_t)mesh->point_count + 2, sizeof *around->first);
    around->uses = xalloc_zero(mesh->corner_count + 1, sizeof *around->uses);
    size_t *next = around->first + 1; /* counts, then ends, while the list is filled */
    for (size_t i = 0; i < mesh->corner_count; i++) {
        next[mesh->corners[i] + 1]++;
    }
    for (uint32_t p = 0; p < mesh->point_count; p++) {
        next[p + 1] += next[p];
    }
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        const struct mesh_polygon *polygon = &mesh->polygons[p];
        for (uint32_t i = 0; i < polygon->count; i++) {
            uint32_t point = mesh->corners[polygon->first + i];
            around->uses[next[point]++] = (struct use){ p, angle_at(mesh, polygon, i) };
        }
    }
}

static void sum_normals(const struct around *around, uint32_t polygon, uint32_t point,
                        double least_cosine, float normal[3])
{
    double sum[3] = { 0, 0, 0 };
    for (size_t u = around->first[point]; u < around->first[point + 1]; u++) {
        const struct use *use = &around->uses[u];
        const double *unit = around->units[use->polygon];
        if (use->polygon == polygon || dot(around->units[polygon], unit) >= least_cosine) {
            for (int k = 0; k < 3; k++) {
                sum[k] += use->angle * unit[k];
            }
        }
    }
    make_unit(sum);
    for (int k = 0; k < 3; k++) {
        normal[k] = (float)sum[k];
    }
}

void normals_compute(struct mesh *mesh, double crease)
{
    struct around around;
    find_units(&around, mesh);
    find_uses(&around, mesh);
    /* A hair wider, so that an angle given exactly is within. */
    double least_cosine = cos(crease * 3.14159265358979323846 / 180) - 1e-9;
    free(mesh->normals);
    mesh->normals = xalloc_zero(mesh->corner_count, sizeof *mesh->normals);
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        const struct mesh_polygon *polygon = &mesh->polygons[p];
        for (uint32_t i = 0; i < polygon->count; i++) {
            size_t at = polygon->first + i;
            sum_normals(&around, p, mesh->corners[at], least_cosine, mesh->normals[at]);
        }
    }
    free(around.units);
    free(around.uses);
    free(around.first);
}
