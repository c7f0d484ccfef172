/* SPDX-License-Identifier: 0BSD */
/* The tree in memory: a checked view of a blob, which stays where it is. */
#ifndef OW_TREE_H
#define OW_TREE_H

#include <stdint.h>

#include "ow_blob.h"
#include "ow_read.h"
#include "ow_status.h"

/* Filled by ow_tree_open; all fields are read-only for others. */
struct ow_tree {
    const ow_byte *bytes; /* the blob; must stay and not change while the tree is used */
    uint32_t blob_bytes;
    uint32_t flags; /* OW_TREE_... */
    uint32_t polygon_count;
    uint32_t face_count;
    uint32_t vertex_count;
    uint32_t node_count;
    uint32_t switch_count;
    uint32_t depth; /* levels of nodes */
    uint32_t max_corners;
    uint32_t colour_count;
    uint32_t nodes_at;
    uint32_t polygons_at;
    uint32_t vertices_at;
    uint32_t normals_at;
    uint32_t colours_at;
    uint32_t instances_at;
    uint32_t instance_count;
    uint32_t corners_in_record; /* where a polygon's corners begin: 6, or 10 with ids */
    int16_t box_min[3];         /* lattice units */
    int16_t box_max[3];
};

/*
 * Checks the blob in bytes[0 .. size-1] whole, once: checksum, every index,
 * count, child and depth. After OW_OK, walking and drawing need no check and
 * cannot leave the blob. Uses no memory but *tree. size may exceed the blob.
 * Errors: OW_TRUNCATED, OW_MAGIC, OW_VERSION, OW_CHECKSUM, OW_CORRUPT; *tree
 * is then all zero. OW_UNSUPPORTED: it has instances.
 */
enum ow_status ow_tree_open(struct ow_tree *tree, const void *bytes, uint32_t size);

/* The same for trees that may have instances. */
enum ow_status ow_tree_open_instances(struct ow_tree *tree, const void *bytes, uint32_t size);

/* zlib's CRC-32 of size bytes, continued from crc (0 to start); of bytes of a blob. */
uint32_t ow_crc32(uint32_t crc, const void *bytes, uint32_t size);
uint32_t ow_crc32_blob(uint32_t crc, const ow_byte *bytes, uint32_t size);

/* Bytes of the polygon record at byte offset at of the blob. */
uint32_t ow_polygon_bytes(const struct ow_tree *tree, uint32_t at);

#endif
