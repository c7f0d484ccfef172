/* SPDX-License-Identifier: 0BSD */
/* Pieces: polygons and what cutting makes of them. */
#include "pieces.h"

#include <stdlib.h>
#include <string.h>

#include "tools/common/fail.h"
#include "tools/common/xalloc.h"

enum { MOST_PIECES = 1 << 30 }; /* tree items keep two bits beside the number */

uint32_t pieces_add(struct pieces *pieces, uint32_t polygon, uint32_t record)
{
    if (pieces->count == MOST_PIECES) {
        fail(FAIL_INPUT, NULL, 0, "cutting made more than %d polygons", MOST_PIECES);
    }
    pieces->all =
        xgrow(pieces->all, &pieces->capacity, (size_t)pieces->count + 1, sizeof *pieces->all);
    pieces->all[pieces->count] = (struct piece){ pieces->corner_count, 0, polygon, record };
    return pieces->count++;
}

void pieces_add_corner(struct pieces *pieces, uint32_t vertex, uint32_t edge, const float *normal)
{
    size_t at = pieces->corner_count++;
    pieces->vertices =
        xgrow(pieces->vertices, &pieces->vertex_capacity, at + 1, sizeof *pieces->vertices);
    pieces->edges = xgrow(pieces->edges, &pieces->edge_capacity, at + 1, sizeof *pieces->edges);
    pieces->vertices[at] = vertex;
    pieces->edges[at] = edge;
    if (pieces->with_normals && normal != NULL) {
        pieces->normals =
            xgrow(pieces->normals, &pieces->normal_capacity, at + 1, sizeof *pieces->normals);
        memcpy(pieces->normals[at], normal, sizeof pieces->normals[at]);
    }
    pieces->all[pieces->count - 1].count++;
}

void pieces_begin(struct pieces *pieces, const struct mesh *mesh, struct arrangement *arrangement)
{
    *pieces = (struct pieces){ .with_normals = mesh->normals != NULL };
    for (uint32_t i = 0; i < mesh->polygon_count; i++) {
        const struct mesh_polygon *polygon = &mesh->polygons[i];
        pieces_add(pieces, i, polygon->record);
        for (uint32_t k = 0; k < polygon->count; k++) {
            size_t at = polygon->first + k;
            size_t next = polygon->first + (k + 1 < polygon->count ? k + 1 : 0);
            uint32_t line =
                arrangement_segment(arrangement, mesh->corners[at], mesh->corners[next]);
            pieces_add_corner(pieces, mesh->corners[at], line << 1 | mesh->marks[at],
                              mesh->normals ? mesh->normals[at] : NULL);
        }
    }
}

void pieces_free(struct pieces *pieces)
{
    free(pieces->all);
    free(pieces->vertices);
    free(pieces->edges);
    free(pieces->normals);
    free(pieces->cuts);
    *pieces = (struct pieces){ 0 };
}
