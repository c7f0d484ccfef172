/* SPDX-License-Identifier: 0BSD */
/*
 * The obstruction relation. A face is one side of a piece. Face P can obstruct
 * face Q if P has a point strictly in front of Q's plane and Q has a point
 * strictly behind P's plane: only then is there a viewpoint in front of both
 * from which P hides a part of Q.
 *
 * "Strictly" is by the exact side tests with the tolerance T. What reaches
 * across a plane by less than T counts only where it overlaps the other face
 * as seen along the plane's normal, so that stacked layers stay in order.
 */
#ifndef OWC_OBSTRUCTION_FACES_H
#define OWC_OBSTRUCTION_FACES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "arrangement.h"
#include "mesh.h"
#include "pieces.h"
#include "tree.h"

/* Rounded heights are good to far less than this, in lattice steps. */
#define OBSTRUCTION_DOUBT 1e-6

struct obstruction_face {
    double normal[3]; /* unit, towards where the face is seen from */
    double offset;    /* normal.x + offset: the height of x above the face, lattice steps */
    double sure;      /* a rounded height beyond this decides the side */
    double on;        /* and one up to this is on the plane */
    double centre[3];
    double radius; /* of a sphere about the centre with all corners */
    size_t first;  /* corners: points of the set */
    uint32_t count;
    uint32_t piece;
    uint32_t plane;
    uint32_t polygon; /* place in the file */
    tree_item item;
    int sign;   /* -1: it looks against its plane's normal */
    bool rough; /* a part that was cut off in floating point: its corners are not the piece's */
};

struct obstruction_set {
    const struct mesh *mesh;
    const struct arrangement *arrangement;
    const struct pieces *pieces;
    struct obstruction_face *faces;
    uint32_t count;
    double (*points)[3];
    double tolerance;   /* of the relation, lattice steps */
    double step;        /* of the planes' side tests */
    double slack;       /* reaching across a switch's plane by so little does no harm */
    uint64_t relations; /* pairs that were compared */
};

/* The faces of a list of items. tolerance: lattice steps, not less than that of the planes. */
void obstruction_set_begin(struct obstruction_set *set, const struct mesh *mesh,
                           const struct arrangement *arrangement, const struct pieces *pieces,
                           double tolerance, const tree_item *items, uint32_t count);

/* Some faces of a set, as a set. */
void obstruction_set_part(struct obstruction_set *part, const struct obstruction_set *set,
                          const uint32_t *faces, uint32_t count);
void obstruction_set_free(struct obstruction_set *set);

/* Can p obstruct q? Not for two faces of one plane record. */
bool obstruction_holds(struct obstruction_set *set, const struct obstruction_face *p,
                       const struct obstruction_face *q);

/* Does the part of p in front of q's plane (way 1; behind it: -1) lie above or below q? */
bool obstruction_stacked(const struct obstruction_set *set, const struct obstruction_face *p,
                         const struct obstruction_face *q, int way);

/*
 * Do parts of two faces overlap as seen along a normal: of p what lies where
 * normal.x + p_offset >= 0, of q likewise? INFINITY: all of it.
 */
bool obstruction_parts_overlap(const struct obstruction_set *set, const struct obstruction_face *p,
                               double p_offset, const struct obstruction_face *q, double q_offset,
                               const double normal[3]);

/* Do two faces of one plane record that look the same way overlap? */
bool obstruction_overlap(const struct obstruction_set *set, const struct obstruction_face *p,
                         const struct obstruction_face *q);

/* fmin and fmax of numbers, in line. */
static inline double smaller(double a, double b)
{
    return a < b ? a : b;
}

static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

static inline double obstruction_height(const struct obstruction_face *face, const double at[3])
{
    return face->normal[0] * at[0] + face->normal[1] * at[1] + face->normal[2] * at[2] +
           face->offset;
}

#endif
