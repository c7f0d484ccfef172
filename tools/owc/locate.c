/* SPDX-License-Identifier: 0BSD */
/* The location problem: one step a switch, then a count of the regions before the one found. */
#include "locate.h"

#include "ow_read.h"

/* A node's first word, and where what follows word and bounds begins. */
static uint32_t node_word(const struct ow_tree *tree, uint32_t at, uint32_t *rest_at)
{
    uint32_t word = ow_read_u32(tree->bytes, at);
    *rest_at = at + OW_NODE_WORD_BYTES + ((word & OW_NODE_BOUNDED) ? OW_NODE_BOUNDS_BYTES : 0);
    return word;
}

static bool is_switch(uint32_t word)
{
    return (word & OW_NODE_KIND_MASK) == OW_NODE_SWITCH;
}

static void read_plane(const struct ow_tree *tree, uint32_t at, struct locate_side *side)
{
    const uint8_t *bytes = tree->bytes;
    for (uint32_t i = 0; i < 3; i++) {
        side->n[i] = (int32_t)(ow_read_u32(bytes, at + 4 * i) << 8) >> 8;
    }
    int64_t high = (int64_t)ow_read_i8(bytes, at + 7) * 256 + ow_read_u8(bytes, at + 3);
    side->d = high * 4294967296 + ow_read_u32(bytes, at + 12);
}

/* The switch that an item leads to: its place, or 0: the item is a region. */
static uint32_t switch_at(const struct ow_tree *tree, uint32_t item)
{
    uint32_t rest_at;
    if (item == OW_ITEM_NONE || (item & ((1u << OW_ITEM_TAG_BITS) - 1)) != OW_ITEM_NODE) {
        return 0;
    }
    uint32_t at = tree->nodes_at + 4 * (item >> OW_ITEM_TAG_BITS);
    return is_switch(node_word(tree, at, &rest_at)) ? at : 0;
}

/* The number of a region, given where the item that leads to it stands. */
static uint32_t number_of(const struct ow_tree *tree, uint32_t child_at)
{
    uint32_t number = 0;
    for (uint32_t at = tree->nodes_at; at <= child_at;) {
        uint32_t rest_at;
        uint32_t word = node_word(tree, at, &rest_at);
        at = rest_at + 4 * (word >> OW_NODE_COUNT_SHIFT);
        if (is_switch(word)) {
            at += OW_SWITCH_CHILDREN_BYTES + OW_SWITCH_PLANE_BYTES;
            for (uint32_t i = 0; i < 2 && rest_at + 4 * i <= child_at; i++) {
                number += switch_at(tree, ow_read_u32(tree->bytes, rest_at + 4 * i)) == 0;
            }
        }
    }
    return number;
}

enum ow_status locate_point(const struct ow_tree *tree, const int32_t point_q8[3],
                            struct locate_side *sides, struct locate_region *region)
{
    uint32_t rest_at;
    uint32_t at = tree->nodes_at;
    uint32_t child_at = 0;
    *region = (struct locate_region){ 1, 0 };
    if (!(tree->flags & OW_TREE_SWITCH_ONLY)) {
        return OW_UNSUPPORTED;
    }
    if (!is_switch(node_word(tree, at, &rest_at))) {
        return OW_OK; /* no switch: all of space is one region */
    }
    while (at != 0) {
        struct locate_side *side = &sides[region->side_count++];
        (void)node_word(tree, at, &rest_at);
        read_plane(tree, rest_at + OW_SWITCH_CHILDREN_BYTES, side);
        int64_t height = side->d * 256;
        for (int i = 0; i < 3; i++) {
            height += (int64_t)side->n[i] * point_q8[i];
        }
        side->front = height >= 0;
        child_at = rest_at + (side->front ? 0 : 4);
        at = switch_at(tree, ow_read_u32(tree->bytes, child_at));
    }
    region->leaf = number_of(tree, child_at);
    return OW_OK;
}
