/* SPDX-License-Identifier: 0BSD */
/* The location problem: one step a switch, then a count of the regions before the one found. */
#include "locate.h"

#include "blob_node.h"

/* The switch that an item leads to: its place, or 0: the item is a region. */
static uint32_t switch_at(const struct ow_tree *tree, uint32_t item)
{
    if (item == OW_ITEM_NONE || blob_item_tag(item) != OW_ITEM_NODE) {
        return 0;
    }
    uint32_t at = blob_item_node_at(tree, item);
    return blob_node_at(tree, at).is_switch ? at : 0;
}

/* The number of a region, given where the item that leads to it stands. */
static uint32_t number_of(const struct ow_tree *tree, uint32_t child_at)
{
    uint32_t number = 0;
    for (uint32_t at = tree->nodes_at; at <= child_at;) {
        struct blob_node node = blob_node_at(tree, at);
        for (uint32_t i = 0; node.is_switch && i < 2; i++) {
            uint32_t item_at = node.children_at + 4 * i;
            number +=
                item_at <= child_at && switch_at(tree, ow_read_u32(tree->bytes, item_at)) == 0;
        }
        at = node.end_at;
    }
    return number;
}

enum ow_status locate_point(const struct ow_tree *tree, const int32_t point_q8[3],
                            struct locate_side *sides, struct locate_region *region)
{
    uint32_t at = tree->nodes_at;
    uint32_t child_at = 0;
    *region = (struct locate_region){ 1, 0 };
    if (!(tree->flags & OW_TREE_SWITCH_ONLY)) {
        return OW_UNSUPPORTED;
    }
    if (!blob_node_at(tree, at).is_switch) {
        return OW_OK; /* no switch: all of space is one region */
    }
    while (at != 0) {
        struct locate_side *side = &sides[region->side_count++];
        struct blob_node node = blob_node_at(tree, at);
        side->d = blob_plane(tree, node.plane_at, side->n);
        int64_t height = side->d * 256;
        for (int i = 0; i < 3; i++) {
            height += (int64_t)side->n[i] * point_q8[i];
        }
        side->front = height >= 0;
        child_at = node.children_at + (side->front ? 0 : 4);
        at = switch_at(tree, ow_read_u32(tree->bytes, child_at));
    }
    region->leaf = number_of(tree, child_at);
    return OW_OK;
}
