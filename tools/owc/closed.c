/* SPDX-License-Identifier: 0BSD */
/* Whether a mesh bounds a volume. */
#include "closed.h"

#include <stdlib.h>

#include "exact.h"
#include "map64.h"
#include "tools/common/xalloc.h"

/* Each edge: how often it runs from the lower point number to the higher, less the reverse. */
static bool edges_match(const struct mesh *mesh)
{
    struct map64 edges = { 0 };
    int64_t *sums = NULL;
    size_t capacity = 0;
    for (uint32_t i = 0; i < mesh->polygon_count; i++) {
        const struct mesh_polygon *polygon = &mesh->polygons[i];
        const uint32_t *corners = mesh->corners + polygon->first;
        for (uint32_t k = 0; k < polygon->count; k++) {
            uint32_t a = corners[k];
            uint32_t b = corners[k + 1 < polygon->count ? k + 1 : 0];
            uint64_t key = a < b ? map64_key(a, b) : map64_key(b, a);
            uint32_t fresh = (uint32_t)edges.count;
            uint32_t edge = map64_put(&edges, key, fresh);
            sums = xgrow(sums, &capacity, (size_t)fresh + 1, sizeof *sums);
            sums[edge] = (edge == fresh ? 0 : sums[edge]) + (a < b ? 1 : -1);
        }
    }
    bool match = true;
    for (uint64_t i = 0; i < edges.count; i++) {
        match = match && sums[i] == 0;
    }
    free(sums);
    map64_free(&edges);
    return match;
}

/* Six times the volume: tetrahedra over fans. */
static wide volume(const struct mesh *mesh)
{
    wide sum = 0;
    for (uint32_t i = 0; i < mesh->polygon_count; i++) {
        const struct mesh_polygon *polygon = &mesh->polygons[i];
        const uint32_t *corners = mesh->corners + polygon->first;
        const int16_t *a = mesh->points[corners[0]];
        int64_t area[3];
        mesh_area((const int16_t(*)[3])mesh->points, corners, polygon->count, area);
        sum += (wide)area[0] * a[0] + (wide)area[1] * a[1] + (wide)area[2] * a[2];
    }
    return sum;
}

bool closed_mesh(const struct mesh *mesh)
{
    return edges_match(mesh) && volume(mesh) > 0;
}
