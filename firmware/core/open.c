/* SPDX-License-Identifier: 0BSD */
/*
 * Stage "open": checks a blob whole, once, so that no later stage needs to.
 * The nodes are read in one pass. Their level order makes one cursor enough:
 * each node item must refer to the cursor, which then moves on by one node.
 */
#include <stdbool.h>

#include "ow_memory.h"
#include "ow_open.h"
#include "ow_read.h"
#include "ow_tree.h"

#define FIELD(name) ((uint32_t)offsetof(struct ow_disk_header, name))

/* What is found while the nodes are read, to be held against the header. */
struct tally {
    uint32_t faces;
    uint32_t switches;
    uint32_t nodes;
    uint32_t depth;
    uint32_t max_corners;
    uint32_t instances;
    uint32_t next_child; /* offset of the first node that nothing has referred to yet */
};

static enum ow_status check_identity(const ow_byte *bytes, uint32_t size)
{
    if (size < sizeof(struct ow_disk_header)) {
        return OW_TRUNCATED;
    }
    if (ow_read_u32(bytes, FIELD(magic)) != OW_BLOB_MAGIC) {
        return OW_MAGIC;
    }
    if (ow_read_u16(bytes, FIELD(version)) != OW_BLOB_VERSION ||
        ow_read_u16(bytes, FIELD(header_bytes)) != sizeof(struct ow_disk_header)) {
        return OW_VERSION;
    }
    uint32_t blob_bytes = ow_read_u32(bytes, FIELD(blob_bytes));
    if (blob_bytes > size) {
        return OW_TRUNCATED;
    }
    if (blob_bytes < sizeof(struct ow_disk_header) || blob_bytes > OW_MAX_BLOB_BYTES) {
        return OW_CORRUPT;
    }
    uint32_t after = FIELD(crc32) + 4;
    uint32_t crc = ow_crc32_blob(0, bytes, FIELD(crc32));
    crc = ow_crc32_blob(crc, bytes + after, blob_bytes - after);
    return crc == ow_read_u32(bytes, FIELD(crc32)) ? OW_OK : OW_CHECKSUM;
}

static void read_header(struct ow_tree *tree, const ow_byte *bytes)
{
    tree->bytes = bytes;
    tree->blob_bytes = ow_read_u32(bytes, FIELD(blob_bytes));
    tree->flags = ow_read_u32(bytes, FIELD(flags));
    tree->polygon_count = ow_read_u32(bytes, FIELD(polygon_count));
    tree->face_count = ow_read_u32(bytes, FIELD(face_count));
    tree->vertex_count = ow_read_u32(bytes, FIELD(vertex_count));
    tree->node_count = ow_read_u32(bytes, FIELD(node_count));
    tree->switch_count = ow_read_u32(bytes, FIELD(switch_count));
    tree->depth = ow_read_u32(bytes, FIELD(depth));
    tree->max_corners = ow_read_u32(bytes, FIELD(max_corners));
    tree->colour_count = ow_read_u32(bytes, FIELD(colour_count));
    tree->nodes_at = ow_read_u32(bytes, FIELD(nodes_at));
    tree->polygons_at = ow_read_u32(bytes, FIELD(polygons_at));
    tree->vertices_at = ow_read_u32(bytes, FIELD(vertices_at));
    tree->normals_at = ow_read_u32(bytes, FIELD(normals_at));
    tree->colours_at = ow_read_u32(bytes, FIELD(colours_at));
    tree->instances_at = ow_read_u32(bytes, FIELD(instances_at));
    tree->instance_count = ow_read_u32(bytes, FIELD(instance_count));
    tree->corners_in_record = OW_POLYGON_HEAD_BYTES + ((tree->flags & OW_TREE_IDS) ? 4 : 0);
    for (uint32_t i = 0; i < 3; i++) {
        tree->box_min[i] = (int16_t)ow_read_i16(bytes, FIELD(box_min) + 2 * i);
        tree->box_max[i] = (int16_t)ow_read_i16(bytes, FIELD(box_max) + 2 * i);
    }
}

/* count records of each bytes fill the section from begin to end, but for padding, which is 0. */
static bool section_fits(const struct ow_tree *tree, uint32_t begin, uint32_t end, uint32_t count,
                         uint32_t each)
{
    uint64_t needed = (uint64_t)count * each;
    if (begin > end || begin % 4 != 0 || end > tree->blob_bytes || needed > end - begin ||
        end - begin - needed >= 4) {
        return false;
    }
    for (uint32_t at = begin + (uint32_t)needed; at < end; at++) {
        if (ow_read_u8(tree->bytes, at) != 0) {
            return false;
        }
    }
    return true;
}

static enum ow_status check_header(const struct ow_tree *tree)
{
    uint32_t normal_count = (tree->flags & OW_TREE_NORMALS) ? tree->vertex_count : 0;
    bool sections =
        tree->nodes_at == sizeof(struct ow_disk_header) && tree->nodes_at <= tree->polygons_at &&
        tree->polygons_at % 4 == 0 && tree->polygons_at <= tree->vertices_at &&
        section_fits(tree, tree->vertices_at, tree->normals_at, tree->vertex_count,
                     OW_VERTEX_BYTES) &&
        section_fits(tree, tree->normals_at, tree->colours_at, normal_count, OW_NORMAL_BYTES) &&
        section_fits(tree, tree->colours_at, tree->instances_at, tree->colour_count,
                     OW_COLOUR_BYTES) &&
        section_fits(tree, tree->instances_at, tree->blob_bytes, tree->instance_count,
                     OW_INSTANCE_BYTES);
    bool limits = (tree->flags & ~(uint32_t)OW_TREE_FLAGS_KNOWN) == 0 &&
                  tree->instance_count <= OW_MAX_INSTANCES &&
                  tree->vertex_count <= OW_MAX_VERTICES && tree->colour_count <= OW_MAX_COLOURS &&
                  tree->depth <= OW_MAX_DEPTH && tree->max_corners <= OW_MAX_CORNERS;
    for (uint32_t i = 0; i < 3; i++) {
        limits =
            limits && tree->box_min[i] <= tree->box_max[i] && tree->box_min[i] >= -OW_LATTICE_MAX;
    }
    return sections && limits ? OW_OK : OW_CORRUPT;
}

static uint32_t corner_bytes(const struct ow_tree *tree)
{
    return (tree->flags & OW_TREE_INDEX32) ? 4 : 2;
}

uint32_t ow_polygon_bytes(const struct ow_tree *tree, uint32_t at)
{
    uint32_t corners = ow_read_u8(tree->bytes, at);
    uint32_t marks =
        (ow_read_u16(tree->bytes, at + 4) & OW_POLYGON_MARKED) ? (corners + 15) / 16 : 0;
    return tree->corners_in_record + corners * corner_bytes(tree) + 2 * marks;
}

static bool polygon_is_valid(const struct ow_tree *tree, uint32_t value, struct tally *tally)
{
    uint32_t bytes = tree->vertices_at - tree->polygons_at;
    if (bytes < tree->corners_in_record || value > (bytes - tree->corners_in_record) / 2) {
        return false;
    }
    uint32_t at = tree->polygons_at + 2 * value;
    uint32_t corners = ow_read_u8(tree->bytes, at);
    uint32_t look = ow_read_u16(tree->bytes, at + 4);
    if (corners < 3 || (look >> 12 << 12 & ~(uint32_t)OW_POLYGON_FLAGS_KNOWN) != 0 ||
        (look & OW_POLYGON_COLOUR_MASK) >= tree->colour_count ||
        ow_polygon_bytes(tree, at) > tree->vertices_at - at) {
        return false;
    }
    uint32_t step = corner_bytes(tree);
    for (uint32_t i = 0; i < corners; i++) {
        uint32_t corner_at = at + tree->corners_in_record + i * step;
        uint32_t vertex =
            step == 4 ? ow_read_u32(tree->bytes, corner_at) : ow_read_u16(tree->bytes, corner_at);
        if (vertex >= tree->vertex_count) {
            return false;
        }
    }
    tally->faces++;
    if (corners > tally->max_corners) {
        tally->max_corners = corners;
    }
    return true;
}

/* Bytes of the node at this offset of the blob; 0 if it does not fit its section. */
uint32_t ow_node_bytes(const struct ow_tree *tree, uint32_t at)
{
    if (tree->polygons_at - at < 4) {
        return 0;
    }
    uint32_t word = ow_read_u32(tree->bytes, at);
    uint32_t fixed = OW_NODE_WORD_BYTES + ((word & OW_NODE_BOUNDED) ? OW_NODE_BOUNDS_BYTES : 0);
    if ((word & OW_NODE_KIND_MASK) == OW_NODE_SWITCH) {
        fixed += OW_SWITCH_CHILDREN_BYTES + OW_SWITCH_PLANE_BYTES;
    }
    uint32_t bytes = fixed + 4 * (word >> OW_NODE_COUNT_SHIFT); /* below 2^27: no overflow */
    return bytes <= tree->polygons_at - at ? bytes : 0;
}

/* The node that an item refers to, in 4 bytes from the first one, is the next. */
static bool child_is_valid(const struct ow_tree *tree, uint32_t value, struct tally *tally)
{
    uint32_t at = tally->next_child;
    if (at >= tree->polygons_at || value != (at - tree->nodes_at) / 4) {
        return false;
    }
    uint32_t bytes = ow_node_bytes(tree, at);
    tally->next_child = at + bytes;
    return bytes != 0;
}

/* An item of a node: a valid face, or the next node that nothing has referred to. */
static bool item_is_valid(const struct ow_tree *tree, uint32_t item, struct tally *tally)
{
    uint32_t value = item >> OW_ITEM_TAG_BITS;
    switch (item & 3) {
    case OW_ITEM_REVERSE:
        return (tree->flags & OW_TREE_TWO_SIDED) && polygon_is_valid(tree, value, tally);
    case OW_ITEM_FACE:
        return polygon_is_valid(tree, value, tally);
    case OW_ITEM_NODE:
        return child_is_valid(tree, value, tally);
    default:
        return value == tally->instances++ && value < tree->instance_count &&
               child_is_valid(
                   tree, ow_read_u32(tree->bytes, tree->instances_at + value * OW_INSTANCE_BYTES),
                   tally);
    }
}

static bool node_is_valid(const struct ow_tree *tree, uint32_t at, struct tally *tally)
{
    uint32_t word = ow_read_u32(tree->bytes, at);
    uint32_t count = word >> OW_NODE_COUNT_SHIFT;
    bool is_switch = (word & OW_NODE_KIND_MASK) == OW_NODE_SWITCH;
    if ((word & 0xF8) != 0 || (word & OW_NODE_KIND_MASK) > OW_NODE_SWITCH) {
        return false;
    }
    uint32_t items_at =
        at + OW_NODE_WORD_BYTES + ((word & OW_NODE_BOUNDED) ? OW_NODE_BOUNDS_BYTES : 0);
    if (is_switch) {
        tally->switches++;
        for (uint32_t i = 0; i < 2; i++) {
            uint32_t item = ow_read_u32(tree->bytes, items_at + 4 * i);
            if (item != OW_ITEM_NONE && !item_is_valid(tree, item, tally)) {
                return false;
            }
        }
        items_at += OW_SWITCH_CHILDREN_BYTES + OW_SWITCH_PLANE_BYTES;
        if (ow_read_u8(tree->bytes, items_at - OW_SWITCH_PLANE_BYTES + 11) != 0) {
            return false; /* the spare byte of the plane's word 2 */
        }
    }
    bool ordered = count > 1 && !is_switch;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t item = ow_read_u32(tree->bytes, items_at + 4 * i);
        if (is_switch && (item & 3) > OW_ITEM_REVERSE) {
            return false; /* only faces are coplanar with a plane */
        }
        if (ordered && (tree->flags & OW_TREE_SWITCH_ONLY) && !(tree->flags & OW_TREE_TWO_SIDED)) {
            return false;
        }
        if (!item_is_valid(tree, item, tally)) {
            return false;
        }
    }
    return true;
}

static bool nodes_are_valid(const struct ow_tree *tree, struct tally *tally)
{
    uint32_t at = tree->nodes_at;
    uint32_t level_end = at;
    tally->next_child = at + ow_node_bytes(tree, at);
    if (tally->next_child == at) {
        return false;
    }
    while (at < tally->next_child) {
        if (at == level_end) {
            tally->depth++;
            level_end = tally->next_child;
        }
        if (!node_is_valid(tree, at, tally)) {
            return false;
        }
        tally->nodes++;
        at += ow_node_bytes(tree, at);
    }
    return at == tree->polygons_at;
}

/* Whoever has looked at the box need not look at each vertex: it holds them all. */
static bool vertices_are_valid(const struct ow_tree *tree)
{
    const ow_byte *place = tree->bytes + tree->vertices_at;
    for (uint32_t v = 0; v < tree->vertex_count; v++) {
        for (uint32_t i = 0; i < 3; i++, place += 2) {
            int32_t coordinate = ow_read_i16(place, 0);
            if (coordinate < tree->box_min[i] || coordinate > tree->box_max[i]) {
                return false;
            }
        }
    }
    return true;
}

enum ow_status ow_open(struct ow_tree *tree, const void *bytes, uint32_t size,
                       bool (*instances_are_valid)(const struct ow_tree *tree))
{
    struct ow_tree found;
    memset(&found, 0, sizeof found);
    *tree = found;
    enum ow_status status = check_identity(bytes, size);
    if (status != OW_OK) {
        return status;
    }
    read_header(&found, bytes);
    status = check_header(&found);
    if (status != OW_OK) {
        return status;
    }
    struct tally tally;
    memset(&tally, 0, sizeof tally);
    if (!nodes_are_valid(&found, &tally) || tally.faces != found.face_count ||
        tally.instances != found.instance_count || tally.switches != found.switch_count ||
        tally.nodes != found.node_count || tally.depth != found.depth ||
        tally.max_corners != found.max_corners || !vertices_are_valid(&found)) {
        return OW_CORRUPT;
    }
    if (found.instance_count > 0 && instances_are_valid == NULL) {
        return OW_UNSUPPORTED;
    }
    if (found.instance_count > 0 && !instances_are_valid(&found)) {
        return OW_CORRUPT;
    }
    *tree = found;
    return OW_OK;
}

enum ow_status ow_tree_open(struct ow_tree *tree, const void *bytes, uint32_t size)
{
    return ow_open(tree, bytes, size, NULL);
}
