/* SPDX-License-Identifier: 0BSD */
/* The tree while it is built: what every strategy makes and blob_write.c takes. */
#ifndef OWC_TREE_H
#define OWC_TREE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "mesh.h"
#include "ow_blob.h"

/* The blob's tags; the value is a piece's or a node's number. */
typedef uint32_t tree_item;

static inline tree_item tree_item_of(uint32_t tag, uint32_t value)
{
    return value << OW_ITEM_TAG_BITS | tag;
}

static inline uint32_t tree_item_tag(tree_item item)
{
    return item & ((1u << OW_ITEM_TAG_BITS) - 1);
}

static inline uint32_t tree_item_value(tree_item item)
{
    return item >> OW_ITEM_TAG_BITS;
}

struct tree_node {
    uint32_t plane;  /* of a switch; MESH_NONE: a sequence */
    tree_item front; /* of a switch: children, or OW_ITEM_NONE */
    tree_item back;
    size_t first; /* items: a sequence's, or the faces in a switch's plane */
    uint32_t count;
};

/* Children have greater numbers than their parents. */
struct tree {
    struct tree_node *nodes;
    uint32_t node_count;
    size_t node_capacity;
    tree_item *items;
    size_t item_count;
    size_t item_capacity;
    tree_item root;     /* a face or a node */
    uint64_t relations; /* polygons that were compared with a plane */
};

uint32_t tree_add_node(struct tree *tree, uint32_t plane);

/* Appends an item to the last node. */
void tree_add_item(struct tree *tree, uint32_t node, tree_item item);

/*
 * Takes out what leads to no face, once it is known how many outlines each
 * piece has: first_outline[i + 1] - first_outline[i]. A switch's child is then
 * a node, a face with one outline, or OW_ITEM_NONE; the root is a node, or
 * OW_ITEM_NONE if nothing is left. plane_of[i]: the plane of piece i.
 */
void tree_prune(struct tree *tree, const uint32_t *first_outline, const uint32_t *plane_of);

/*
 * True if no sequence orders faces: each holds at most the two sides of one
 * piece. The switches alone then order back faces too.
 */
bool tree_is_switch_only(const struct tree *tree);

void tree_free(struct tree *tree);

#endif
