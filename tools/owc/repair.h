/* SPDX-License-Identifier: 0BSD */
/*
 * From pieces to what is drawn: every vertex that cutting put on a line goes
 * into all outlines along that line, and vertices become lattice points. For a
 * closed mesh each edge of the result has its reverse, so no view shows a hole.
 */
#ifndef OWC_REPAIR_H
#define OWC_REPAIR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "arrangement.h"
#include "pieces.h"
#include "plane.h"

/* An outline of at most OW_MAX_CORNERS corners. */
struct outline_final {
    size_t first; /* of its corners */
    uint32_t count;
    bool uneven; /* OW_POLYGON_UNEVEN */
    int8_t normal[3];
};

struct repaired {
    struct outline_final *outlines;
    uint32_t outline_count;
    size_t outline_capacity;
    uint32_t *first; /* outlines of piece i: first[i] .. first[i + 1] - 1, mostly one */
    int16_t (*corners)[3];
    uint8_t *marks;      /* of the edge to the next corner */
    float (*normals)[3]; /* NULL unless normals are kept */
    size_t corner_count;
    size_t corner_capacity;
    size_t mark_capacity;
    size_t normal_capacity;
    uint32_t vanished; /* pieces that rounded to less than three points */
    uint32_t uneven;
    uint32_t inserted; /* corners that came from neighbours */
    uint32_t long_cut; /* cuts of pieces with too many corners for one record */
};

/*
 * drawn[i]: piece i is in the tree. Pieces with too many corners are cut, which
 * adds pieces, vertices and planes. first knows the pieces that there were.
 */
void repair_pieces(struct repaired *repaired, struct arrangement *arrangement,
                   struct planes *planes, struct pieces *pieces, const struct mesh *mesh,
                   const bool *drawn);
void repaired_free(struct repaired *repaired);

#endif
