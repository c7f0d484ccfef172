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

struct shader {
    struct mesh_around around;
    double *angles;     /* of each use, radians */
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

static void find_units(struct shader *s, const struct mesh *mesh)
{
    s->units = xalloc_zero(mesh->polygon_count, sizeof *s->units);
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        const struct mesh_polygon *polygon = &mesh->polygons[p];
        int64_t area[3];
        mesh_area((const int16_t(*)[3])mesh->points, mesh->corners + polygon->first, polygon->count,
                  area);
        for (int k = 0; k < 3; k++) {
            s->units[p][k] = (double)area[k];
        }
        make_unit(s->units[p]);
    }
}

static void find_angles(struct shader *s, const struct mesh *mesh)
{
    mesh_around_find(&s->around, mesh);
    size_t count = s->around.first[mesh->point_count];
    s->angles = xalloc(count, sizeof *s->angles);
    for (size_t i = 0; i < count; i++) {
        const struct mesh_use *use = &s->around.all[i];
        s->angles[i] = angle_at(mesh, &mesh->polygons[use->polygon], use->corner);
    }
}

static void sum_normals(const struct shader *s, uint32_t polygon, uint32_t point,
                        double least_cosine, float normal[3])
{
    double sum[3] = { 0, 0, 0 };
    for (size_t u = s->around.first[point]; u < s->around.first[point + 1]; u++) {
        uint32_t other = s->around.all[u].polygon;
        const double *unit = s->units[other];
        if (other == polygon || dot(s->units[polygon], unit) >= least_cosine) {
            for (int k = 0; k < 3; k++) {
                sum[k] += s->angles[u] * unit[k];
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
    struct shader shader;
    find_units(&shader, mesh);
    find_angles(&shader, mesh);
    /* A hair wider, so that an angle given exactly is within. */
    double least_cosine = cos(crease * 3.14159265358979323846 / 180) - 1e-9;
    free(mesh->normals);
    mesh->normals = xalloc_zero(mesh->corner_count, sizeof *mesh->normals);
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        const struct mesh_polygon *polygon = &mesh->polygons[p];
        for (uint32_t i = 0; i < polygon->count; i++) {
            size_t at = polygon->first + i;
            sum_normals(&shader, p, mesh->corners[at], least_cosine, mesh->normals[at]);
        }
    }
    mesh_around_free(&shader.around);
    free(shader.angles);
    free(shader.units);
}
