/* SPDX-License-Identifier: 0BSD */
/* Reading the nodes of a tree that was opened: where the parts of each lie. */
#ifndef OWC_BLOB_NODE_H
#define OWC_BLOB_NODE_H

#include <stdbool.h>
#include <stdint.h>

#include "ow_read.h"
#include "ow_tree.h"

/* All places count bytes from the blob's first one. */
struct blob_node {
    bool is_switch;
    uint32_t children_at; /* of a switch: two items, then its plane */
    uint32_t plane_at;
    uint32_t items_at;
    uint32_t count;  /* items */
    uint32_t end_at; /* where the next node begins */
};

static inline struct blob_node blob_node_at(const struct ow_tree *tree, uint32_t at)
{
    uint32_t word = ow_read_u32(tree->bytes, at);
    struct blob_node node = { .is_switch = (word & OW_NODE_KIND_MASK) == OW_NODE_SWITCH,
                              .count = word >> OW_NODE_COUNT_SHIFT };
    node.children_at = at + OW_NODE_WORD_BYTES;
    node.children_at += (word & OW_NODE_BOUNDED) ? OW_NODE_BOUNDS_BYTES : 0u;
    node.plane_at = node.children_at + OW_SWITCH_CHILDREN_BYTES;
    node.items_at = node.is_switch ? node.plane_at + OW_SWITCH_PLANE_BYTES : node.children_at;
    node.end_at = node.items_at + 4 * node.count;
    return node;
}

/* An item's tag; OW_ITEM_NONE has that of an instance. */
static inline uint32_t blob_item_tag(uint32_t item)
{
    return item & ((1u << OW_ITEM_TAG_BITS) - 1);
}

/* Where the node of a node item lies. */
static inline uint32_t blob_item_node_at(const struct ow_tree *tree, uint32_t item)
{
    return tree->nodes_at + 4 * (item >> OW_ITEM_TAG_BITS);
}

/* The plane n.v + d = 0 that lies at a place; returns d. */
static inline int64_t blob_plane(const struct ow_tree *tree, uint32_t at, int32_t n[3])
{
    const uint8_t *bytes = tree->bytes;
    for (uint32_t i = 0; i < 3; i++) {
        n[i] = (int32_t)(ow_read_u32(bytes, at + 4 * i) << 8) >> 8;
    }
    int64_t high = (int64_t)ow_read_i8(bytes, at + 7) * 256 + ow_read_u8(bytes, at + 3);
    return high * 4294967296 + ow_read_u32(bytes, at + 12);
}

#endif
