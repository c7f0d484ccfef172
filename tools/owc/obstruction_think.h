/* SPDX-License-Identifier: 0BSD */
/*
 * The part of building an obstruction tree that changes nothing: what becomes
 * of a list of faces. Lists can be thought about at the same time.
 */
#ifndef OWC_OBSTRUCTION_THINK_H
#define OWC_OBSTRUCTION_THINK_H

#include <stdbool.h>
#include <stdint.h>

#include "obstruction_plane.h"
#include "tree.h"

/* What all lists have in common; planes may be overwritten behind the last one. */
struct obstruction_world {
    const struct mesh *mesh;
    const struct arrangement *arrangement;
    const struct pieces *pieces;
    struct planes *planes;
    double tolerance; /* of the relation, lattice steps */
    struct obstruction_effort effort;
};

enum obstruction_kind { OBSTRUCTION_FACE, OBSTRUCTION_CHUNK, OBSTRUCTION_SWITCH };

/* What becomes one item of a sequence: a face, a chunk of faces, or a switch of a component. */
struct obstruction_entry {
    enum obstruction_kind kind;
    uint32_t first; /* of the thought's items */
    uint32_t count;
    struct obstruction_choice choice; /* of a switch */
    uint8_t *places;                  /* where its items go */
};

/* Farthest first. */
struct obstruction_thought {
    tree_item *items;
    struct obstruction_entry *entries;
    uint32_t entry_count;
    uint64_t relations; /* pairs that were compared */
};

/*
 * Thinks about count >= 2 faces. spare: a plane record behind the last one
 * that nobody else uses meanwhile. The same seed gives the same thought.
 */
void obstruction_think(struct obstruction_thought *thought, const struct obstruction_world *world,
                       const tree_item *items, uint32_t count, uint64_t seed, uint32_t spare);
void obstruction_thought_free(struct obstruction_thought *thought);

#endif
