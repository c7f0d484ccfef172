/* SPDX-License-Identifier: 0BSD */
/*
 * Dividing planes [FKN80]: switches that no polygon gave, which part a scene into
 * clusters. The user names them, or they are found where nothing is in between.
 */
#ifndef OWC_DIVIDING_H
#define OWC_DIVIDING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "arrangement.h"
#include "lattice.h"
#include "pieces.h"
#include "plane.h"
#include "problem.h"

/* Planes ax + by + cz + d = 0 in model units. */
struct user_planes {
    double (*all)[4];
    size_t count;
    size_t capacity;
};

/* Reads "a,b,c,d" a line; blanks, empty lines and what follows a # are skipped. */
bool user_planes_read(struct user_planes *planes, const char *text, struct problem *problem);
bool user_planes_read_file(struct user_planes *planes, const char *path, struct problem *problem);
void user_planes_free(struct user_planes *planes);

/* Adds the planes that meet the lattice's cube; writes their numbers and returns how many. */
uint32_t user_planes_add(const struct user_planes *from, const struct lattice *lattice,
                         struct planes *planes, uint32_t *numbers);

/*
 * Adds the plane along an axis that parts the list, cuts nothing and leaves the
 * most pieces on its emptier side; of equal ones that in the widest gap.
 * MESH_NONE: there is none.
 */
uint32_t dividing_axis_plane(const struct arrangement *arrangement, const struct pieces *pieces,
                             const uint32_t *list, uint32_t count, struct planes *planes);

#endif
