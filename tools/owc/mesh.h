/* SPDX-License-Identifier: 0BSD */
/* The model on the lattice: what cleaning makes and the strategies build trees of. */
#ifndef OWC_MESH_H
#define OWC_MESH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "lattice.h"
#include "model.h"

#define MESH_NONE 0xFFFFFFFFu

struct mesh_polygon {
    size_t first;        /* of its corners */
    uint32_t count;      /* corners */
    uint32_t source;     /* number in the file, from 1 */
    size_t source_first; /* of its corners as they were read, in sources */
    uint32_t source_count;
    uint32_t record; /* its plane's number, set by plane_group */
    uint16_t colour;
    bool reversed; /* it faces against its plane's normal */
};

/* Corner arrays run in parallel. Points are the distinct lattice points. */
struct mesh {
    struct lattice lattice;
    int16_t (*points)[3];
    uint32_t point_count;
    struct mesh_polygon *polygons; /* in the file's order */
    uint32_t polygon_count;
    uint32_t *corners;   /* point numbers */
    uint8_t *marks;      /* 1: the edge from this corner to the next was not in the file */
    float (*normals)[3]; /* of the corners; NULL unless they are kept */
    size_t corner_count;
    uint32_t *sources; /* vertex numbers of the model */
    size_t source_corner_count;
    bool closed;         /* each directed edge has its reverse, and the volume is positive */
    uint32_t uneven_cut; /* polygons that were not flat and became triangles */
    uint32_t degenerate_dropped; /* no area on the lattice */
    uint32_t degenerate_kept;    /* no area, but too many neighbours to do without */
    uint32_t repeated_dropped;   /* the same corners as a later polygon */
};

/* A polygon's corner at a point. */
struct mesh_use {
    uint32_t polygon;
    uint32_t corner; /* its place among the polygon's corners */
};

/* The polygons around each point: those of point p are all[first[p]] .. all[first[p + 1] - 1]. */
struct mesh_around {
    size_t *first;
    struct mesh_use *all; /* by polygon */
};

void mesh_discard(struct mesh *mesh);

void mesh_around_find(struct mesh_around *around, const struct mesh *mesh);
void mesh_around_free(struct mesh_around *around);

/* The polygon's area vector times 2 (Newell): exact, since lattice coordinates are small. */
void mesh_area(const int16_t (*points)[3], const uint32_t *corners, uint32_t count,
               int64_t area[3]);

#endif
