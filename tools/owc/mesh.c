/* SPDX-License-Identifier: 0BSD */
/* The model on the lattice. */
#include "mesh.h"

#include <stdlib.h>
#include <string.h>

#include "tools/common/xalloc.h"

void mesh_discard(struct mesh *mesh)
{
    free(mesh->points);
    free(mesh->polygons);
    free(mesh->corners);
    free(mesh->marks);
    free(mesh->normals);
    free(mesh->sources);
    memset(mesh, 0, sizeof *mesh);
}

void mesh_around_find(struct mesh_around *around, const struct mesh *mesh)
{
    size_t *first = xalloc_zero((size_t)mesh->point_count + 2, sizeof *first);
    size_t *next = first + 1; /* counts, then where a list begins, which moves on to its end */
    size_t all = 0;
    for (uint32_t i = 0; i < mesh->polygon_count; i++) {
        for (uint32_t k = 0; k < mesh->polygons[i].count; k++) {
            next[mesh->corners[mesh->polygons[i].first + k] + 1]++;
        }
        all += mesh->polygons[i].count;
    }
    for (uint32_t i = 0; i < mesh->point_count; i++) {
        next[i + 1] += next[i];
    }
    *around = (struct mesh_around){ first, xalloc(all, sizeof *around->all) };
    for (uint32_t i = 0; i < mesh->polygon_count; i++) {
        for (uint32_t k = 0; k < mesh->polygons[i].count; k++) {
            uint32_t point = mesh->corners[mesh->polygons[i].first + k];
            around->all[next[point]++] = (struct mesh_use){ i, k };
        }
    }
}

void mesh_around_free(struct mesh_around *around)
{
    free(around->first);
    free(around->all);
    *around = (struct mesh_around){ 0 };
}

void mesh_area(const int16_t (*points)[3], const uint32_t *corners, uint32_t count, int64_t area[3])
{
    const int16_t *o = points[corners[0]];
    area[0] = area[1] = area[2] = 0;
    for (uint32_t i = 1; i + 1 < count; i++) {
        int64_t a[3];
        int64_t b[3];
        for (int k = 0; k < 3; k++) {
            a[k] = points[corners[i]][k] - o[k];
            b[k] = points[corners[i + 1]][k] - o[k];
        }
        area[0] += a[1] * b[2] - a[2] * b[1];
        area[1] += a[2] * b[0] - a[0] * b[2];
        area[2] += a[0] * b[1] - a[1] * b[0];
    }
}
