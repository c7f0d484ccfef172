/* SPDX-License-Identifier: 0BSD */
/* The tree while it is built. */
#include "tree.h"

#include <stdbool.h>
#include <stdlib.h>

#include "tools/common/fail.h"
#include "tools/common/xalloc.h"

uint32_t tree_add_node(struct tree *tree, uint32_t plane)
{
    if (tree->node_count == 1u << 30) {
        fail(FAIL_INPUT, NULL, 0, "the tree has more than %u nodes", 1u << 30);
    }
    tree->nodes =
        xgrow(tree->nodes, &tree->node_capacity, (size_t)tree->node_count + 1, sizeof *tree->nodes);
    tree->nodes[tree->node_count] =
        (struct tree_node){ plane, OW_ITEM_NONE, OW_ITEM_NONE, tree->item_count, 0 };
    return tree->node_count++;
}

void tree_add_item(struct tree *tree, uint32_t node, tree_item item)
{
    tree->items =
        xgrow(tree->items, &tree->item_capacity, tree->item_count + 1, sizeof *tree->items);
    tree->items[tree->item_count++] = item;
    tree->nodes[node].count++;
}

/* What a child is after pruning. pruned[i]: what node i became; nodes added here stay as they are. */
static tree_item prune_child(struct tree *tree, tree_item item, const tree_item *pruned,
                             const uint32_t *first_outline, const uint32_t *plane_of)
{
    if (item == OW_ITEM_NONE) {
        return item;
    }
    uint32_t value = tree_item_value(item);
    if (tree_item_tag(item) == OW_ITEM_NODE) {
        return pruned[value];
    }
    uint32_t outlines = first_outline[value + 1] - first_outline[value];
    if (outlines > 1) { /* faces in one plane: a switch, since a child is one item */
        uint32_t node = tree_add_node(tree, plane_of[value]);
        tree_add_item(tree, node, item);
        return tree_item_of(OW_ITEM_NODE, node);
    }
    return outlines == 1 ? item : OW_ITEM_NONE;
}

/* Drops items that lead nowhere; returns how many faces and nodes the others come to. */
static uint32_t prune_items(struct tree *tree, struct tree_node *node, const tree_item *pruned,
                            const uint32_t *first_outline)
{
    uint32_t kept = 0;
    uint32_t outlines = 0;
    for (uint32_t i = 0; i < node->count; i++) {
        tree_item item = tree->items[node->first + i];
        uint32_t value = tree_item_value(item);
        bool is_node = tree_item_tag(item) == OW_ITEM_NODE;
        item = is_node ? pruned[value] : item;
        uint32_t more =
            is_node ? item != OW_ITEM_NONE : first_outline[value + 1] - first_outline[value];
        if (more > 0) {
            tree->items[node->first + kept++] = item;
        }
        outlines += more;
    }
    node->count = kept;
    return outlines;
}

static tree_item prune_node(struct tree *tree, uint32_t number, const tree_item *pruned,
                            const uint32_t *first_outline, const uint32_t *plane_of)
{
    tree_item front = prune_child(tree, tree->nodes[number].front, pruned, first_outline, plane_of);
    tree_item back = prune_child(tree, tree->nodes[number].back, pruned, first_outline, plane_of);
    struct tree_node *node = &tree->nodes[number];
    node->front = front;
    node->back = back;
    uint32_t outlines = prune_items(tree, node, pruned, first_outline);
    if (front == OW_ITEM_NONE && back == OW_ITEM_NONE && outlines < 2) {
        return outlines == 0 ? OW_ITEM_NONE : tree->items[node->first];
    }
    if (outlines == 0 && (front == OW_ITEM_NONE || back == OW_ITEM_NONE)) {
        return front == OW_ITEM_NONE ? back : front;
    }
    return tree_item_of(OW_ITEM_NODE, number);
}

void tree_prune(struct tree *tree, const uint32_t *first_outline, const uint32_t *plane_of)
{
    tree_item *pruned = xalloc(tree->node_count, sizeof *pruned);
    for (uint32_t i = tree->node_count; i > 0; i--) {
        pruned[i - 1] = prune_node(tree, i - 1, pruned, first_outline, plane_of);
    }
    tree_item root = prune_child(tree, tree->root, pruned, first_outline, plane_of);
    if (root != OW_ITEM_NONE && tree_item_tag(root) != OW_ITEM_NODE) {
        uint32_t node = tree_add_node(tree, MESH_NONE);
        tree_add_item(tree, node, root);
        root = tree_item_of(OW_ITEM_NODE, node);
    }
    tree->root = root;
    free(pruned);
}

bool tree_is_switch_only(const struct tree *tree)
{
    for (uint32_t i = 0; i < tree->node_count; i++) {
        const struct tree_node *node = &tree->nodes[i];
        const tree_item *items = tree->items + node->first;
        for (uint32_t k = 1; node->plane == MESH_NONE && k < node->count; k++) {
            if (tree_item_tag(items[0]) == OW_ITEM_NODE ||
                tree_item_tag(items[k]) == OW_ITEM_NODE ||
                tree_item_value(items[0]) != tree_item_value(items[k])) {
                return false;
            }
        }
    }
    return true;
}

void tree_free(struct tree *tree)
{
    free(tree->nodes);
    free(tree->items);
    *tree = (struct tree){ 0 };
}
