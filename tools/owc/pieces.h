/* SPDX-License-Identifier: 0BSD */
/* Pieces: polygons and what cutting makes of them, while a tree is built. */
#ifndef OWC_PIECES_H
#define OWC_PIECES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "arrangement.h"
#include "mesh.h"

struct piece {
    size_t first;     /* of its corners */
    uint32_t count;   /* corners, at least 2: two where nothing but a sliver was cut off */
    uint32_t polygon; /* of the mesh */
    uint32_t record;  /* its plane */
};

/* What was cut, by which plane, and from where to where. */
struct piece_cut {
    uint32_t polygon; /* of the mesh */
    uint32_t plane;
    uint32_t ends[2]; /* vertices of the arrangement; concave outlines: the first and the last */
};

/* Corner arrays run in parallel. An edge word is line << 1 | mark, of the edge to the next corner. */
struct pieces {
    struct piece *all;
    uint32_t count;
    size_t capacity;
    uint32_t *vertices;
    uint32_t *edges;
    float (*normals)[3]; /* NULL unless normals are kept */
    size_t corner_count;
    size_t vertex_capacity;
    size_t edge_capacity;
    size_t normal_capacity;
    bool with_normals;
    struct piece_cut *cuts; /* in their order */
    size_t cut_capacity;
    uint32_t splits; /* so many */
};

/* One piece for each polygon of the mesh, with the same number. */
void pieces_begin(struct pieces *pieces, const struct mesh *mesh, struct arrangement *arrangement);
void pieces_free(struct pieces *pieces);

/* Begins a new piece; corners are then appended to it. */
uint32_t pieces_add(struct pieces *pieces, uint32_t polygon, uint32_t record);
void pieces_add_corner(struct pieces *pieces, uint32_t vertex, uint32_t edge, const float *normal);

#endif
