/* SPDX-License-Identifier: 0BSD */
/*
 * The arrangement: all vertices, the lines they lie on, and on which side of a
 * plane a vertex is. Vertices that cutting makes stay exact, as the line and
 * the plane that made them; each is rounded to the lattice once.
 *
 * A line is a segment between two lattice points (an edge of the model, or a
 * cut that runs from corner to corner), or a chord: the line that a plane cuts
 * out of a polygon. All polygons on an edge and both pieces of a cut polygon
 * use the same line, so all get the same vertices in the same order: repair.c
 * puts in what one of them lacks.
 */
#ifndef OWC_ARRANGEMENT_H
#define OWC_ARRANGEMENT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "exact.h"
#include "map64.h"
#include "mesh.h"
#include "plane.h"

#define LINE_NONE 0xFFFFFFFFu

enum vertex_kind {
    VERTEX_POINT,   /* a point of the mesh */
    VERTEX_EDGE,    /* where a plane meets a segment between lattice points */
    VERTEX_MEETING, /* where a plane meets a chord: common to three planes */
    VERTEX_ROUNDED  /* likewise, but three planes do not tell where: a lattice point */
};

struct vertex {
    uint32_t line; /* made on this line, by this plane; VERTEX_POINT: LINE_NONE */
    uint32_t plane;
    int16_t lattice[3]; /* rounded */
    uint8_t kind;
};

struct line {
    uint32_t ends[2]; /* all vertices of the line lie between these two */
    uint32_t carrier; /* the cut polygon's plane; MESH_NONE for a segment */
    uint32_t cutter;  /* the cutting plane */
};

/* A corner where a plane cuts through a concave polygon's outline, inside its chord. */
struct crossing {
    uint32_t line;
    uint32_t vertex;
};

struct arrangement {
    const struct planes *planes;
    struct vertex *vertices; /* the mesh's points first, with the same numbers */
    double (*at)[3];         /* where they are, the nearest binary64 */
    uint32_t vertex_count;
    size_t vertex_capacity;
    size_t at_capacity;
    struct line *lines;
    uint32_t line_count;
    size_t line_capacity;
    struct crossing *crossings;
    size_t crossing_count;
    size_t crossing_capacity;
    struct map64 segments; /* lines by their two points */
    struct map64 cuts;     /* vertices by line and plane */
    size_t *record_first;  /* planes of the polygons at each point of the mesh */
    uint32_t *records;
    uint32_t point_count;
    uint32_t rounded; /* vertices of that kind */
};

void arrangement_begin(struct arrangement *arrangement, const struct mesh *mesh,
                       const struct planes *planes);
void arrangement_free(struct arrangement *arrangement);

/* The segment between two points of the mesh, either way round. */
uint32_t arrangement_segment(struct arrangement *arrangement, uint32_t a, uint32_t b);

/*
 * The line on which a plane cuts a polygon, given the count >= 2 vertices
 * where the cut enters or leaves the polygon.
 */
uint32_t arrangement_chord(struct arrangement *arrangement, uint32_t carrier, uint32_t cutter,
                           const uint32_t *vertices, uint32_t count);

/* The vertex at which a plane cuts a line between vertices u and v, which it separates. */
uint32_t arrangement_cut(struct arrangement *arrangement, uint32_t line, uint32_t plane, uint32_t u,
                         uint32_t v);

/*
 * How far a vertex made on this line lies from its first end to its second, as
 * share[0] / share[1], 0 .. 1: exact on segments, rounded on chords. Also for
 * crossings of the line.
 */
void arrangement_share(const struct arrangement *arrangement, uint32_t line, uint32_t vertex,
                       int64_t share[2]);

/* n.v + d, rounded: exact for points of the mesh. */
static inline double arrangement_height(const struct arrangement *arrangement,
                                        const struct plane *plane, uint32_t vertex)
{
    const double *at = arrangement->at[vertex];
    return plane->normal[0] * at[0] + plane->normal[1] * at[1] + plane->normal[2] * at[2] +
           plane->offset;
}

/* The slow part of arrangement_side: all that a rounded height does not decide. */
int arrangement_side_exactly(const struct arrangement *arrangement, uint32_t plane,
                             uint32_t vertex);

/*
 * The side of a plane on which a vertex lies: 1, 0 on it, -1. Exact. On it
 * are: what is within the tolerance, the corners of the plane's own polygons
 * with all that lies between two of them, and what the plane itself cut
 * (VERTEX_ROUNDED excepted: such a vertex is where it was put).
 */
static inline int arrangement_side(const struct arrangement *arrangement, uint32_t plane,
                                   uint32_t vertex)
{
    const struct plane *p = &arrangement->planes->all[plane];
    double height = arrangement_height(arrangement, p, vertex);
    if (height > p->sure) {
        return 1;
    }
    if (height < -p->sure) {
        return -1;
    }
    return arrangement_side_exactly(arrangement, plane, vertex);
}

#endif
