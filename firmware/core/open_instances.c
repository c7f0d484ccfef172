/* SPDX-License-Identifier: 0BSD */
/*
 * Stage "open", for trees with instances: that each object has its vertices
 * for itself and in its sphere, and none below another.
 */
#include "ow_instance.h"
#include "ow_open.h"
#include "ow_read.h"

/* What is found in some nodes that lie together: all of one level below a node, or all. */
struct found {
    uint64_t corners;        /* of faces */
    uint64_t own;            /* of these, vertices in the range asked for */
    uint32_t instances;      /* instance items */
    uint32_t first_child_at; /* the nodes that node items refer to; */
    uint32_t end_child_at;   /* they lie together too */
};

static void look_at_face(const struct ow_tree *tree, uint32_t at, const uint32_t range[2],
                         struct found *found)
{
    uint32_t corners = ow_read_u8(tree->bytes, at);
    bool wide = (tree->flags & OW_TREE_INDEX32) != 0;
    at += tree->corners_in_record;
    for (uint32_t i = 0; i < corners; i++) {
        uint32_t vertex =
            wide ? ow_read_u32(tree->bytes, at + 4 * i) : ow_read_u16(tree->bytes, at + 2 * i);
        found->own += vertex >= range[0] && vertex < range[1];
    }
    found->corners += corners;
}

static void look_at_item(const struct ow_tree *tree, uint32_t item, const uint32_t range[2],
                         struct found *found)
{
    uint32_t value = item >> OW_ITEM_TAG_BITS;
    if (item == OW_ITEM_NONE) {
        return;
    }
    switch (item & 3) {
    case OW_ITEM_INSTANCE:
        found->instances++;
        break;
    case OW_ITEM_NODE: {
        uint32_t at = tree->nodes_at + 4 * value;
        found->first_child_at = found->first_child_at == 0 ? at : found->first_child_at;
        found->end_child_at = at + ow_node_bytes(tree, at);
        break;
    }
    default:
        look_at_face(tree, tree->polygons_at + 2 * value, range, found);
    }
}

/* Looks at all items of the nodes from at to end_at. */
static void look(const struct ow_tree *tree, uint32_t at, uint32_t end_at, const uint32_t range[2],
                 struct found *found)
{
    while (at < end_at) {
        uint32_t word = ow_read_u32(tree->bytes, at);
        uint32_t bytes = ow_node_bytes(tree, at);
        uint32_t count = word >> OW_NODE_COUNT_SHIFT;
        if ((word & OW_NODE_KIND_MASK) == OW_NODE_SWITCH) {
            uint32_t children_at =
                at + OW_NODE_WORD_BYTES + ((word & OW_NODE_BOUNDED) ? OW_NODE_BOUNDS_BYTES : 0);
            look_at_item(tree, ow_read_u32(tree->bytes, children_at), range, found);
            look_at_item(tree, ow_read_u32(tree->bytes, children_at + 4), range, found);
        }
        for (uint32_t i = 0; i < count; i++) {
            look_at_item(tree, ow_read_u32(tree->bytes, at + bytes - 4 * (count - i)), range,
                         found);
        }
        at += bytes;
    }
}

/*
 * The object's faces have the vertices of the range alone. Since the nodes lie
 * level by level, those of one level below a node lie together.
 */
static bool object_keeps_apart(const struct ow_tree *tree, const struct ow_instance *instance,
                               uint64_t *own)
{
    const uint32_t range[2] = { instance->first_vertex, instance->end_vertex };
    uint32_t at = instance->node_at;
    uint32_t end_at = at + ow_node_bytes(tree, at);
    while (at < end_at) {
        struct found found = { 0, 0, 0, 0, 0 };
        look(tree, at, end_at, range, &found);
        if (found.instances > 0 || found.own != found.corners) {
            return false;
        }
        *own += found.own;
        at = found.first_child_at;
        end_at = found.end_child_at;
    }
    return true;
}

static bool is_in_sphere(const struct ow_tree *tree, const struct ow_instance *instance)
{
    uint64_t most = (uint64_t)instance->radius * instance->radius;
    for (uint32_t v = instance->first_vertex; v < instance->end_vertex; v++) {
        uint64_t squares = 0;
        for (uint32_t i = 0; i < 3; i++) {
            int64_t d = ow_read_i16(tree->bytes + tree->vertices_at + v * OW_VERTEX_BYTES, 2 * i) -
                        instance->centre[i];
            squares += (uint64_t)(d * d);
        }
        if (squares > most) {
            return false;
        }
    }
    return true;
}

static bool instances_are_valid(const struct ow_tree *tree)
{
    uint64_t own = 0;
    uint32_t vertex = 0; /* where the ranges have come to */
    for (uint32_t k = 0; k < tree->instance_count; k++) {
        struct ow_instance instance = ow_read_instance(tree, k);
        if (instance.zero != 0 || instance.first_vertex < vertex ||
            instance.end_vertex < instance.first_vertex ||
            instance.end_vertex > tree->vertex_count || !is_in_sphere(tree, &instance) ||
            !object_keeps_apart(tree, &instance, &own)) {
            return false;
        }
        for (uint32_t i = 0; i < 3; i++) {
            if (instance.region_min[i] < -OW_LATTICE_MAX ||
                instance.region_min[i] > instance.region_max[i]) {
                return false;
            }
        }
        vertex = instance.end_vertex;
    }
    /* Then nobody else has a vertex of an object. */
    const uint32_t objects[2] = { ow_read_instance(tree, 0).first_vertex, tree->vertex_count };
    struct found all = { 0, 0, 0, 0, 0 };
    look(tree, tree->nodes_at, tree->polygons_at, objects, &all);
    return all.own == own;
}

enum ow_status ow_tree_open_instances(struct ow_tree *tree, const void *bytes, uint32_t size)
{
    return ow_open(tree, bytes, size, instances_are_valid);
}
