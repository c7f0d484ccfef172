/* SPDX-License-Identifier: 0BSD */
/*
 * The blob (.owt) as it lies on disk, in flash or in bit planes: the one
 * description that the compiler writes by and the core reads by.
 * docs/FORMAT.md specifies the same on its own; a test compares the two.
 *
 * Little-endian, no pointers, every offset counted in bytes from the blob's
 * first byte. Nothing here is overlaid on memory: fields are read and written
 * byte by byte at offsetof(), so alignment and byte order never matter.
 */
#ifndef OW_BLOB_H
#define OW_BLOB_H

#include <stddef.h>
#include <stdint.h>

#define OW_BLOB_MAGIC 0x54574F7Fu /* bytes 7F 'O' 'W' 'T' */

enum {
    OW_BLOB_VERSION = 1,
    OW_LATTICE_MAX = 32767,      /* lattice coordinates are -32767 .. 32767 */
    OW_PLANE_NORMAL_BITS = 23,   /* magnitude bits of a plane's normal component */
    OW_MAX_CORNERS = 255,        /* of one polygon record */
    OW_MAX_COLOURS = 4096,       /* of one tree */
    OW_MAX_VERTICES = 1 << 24,   /* a vertex number leaves 8 bits for the cache's stamp */
    OW_MAX_BLOB_BYTES = 1 << 30, /* an item holds a 30-bit offset in units of 2 or 4 bytes */
    OW_MAX_DEPTH = 1 << 24,      /* levels of nodes */
    OW_MAX_INSTANCES = 4096      /* of one tree */
};

/* struct ow_disk_header.flags */
enum {
    OW_TREE_TWO_SIDED = 1 << 0,   /* both sides of each polygon are placed as faces */
    OW_TREE_SWITCH_ONLY = 1 << 1, /* no sequence orders faces: back faces are ordered too */
    OW_TREE_CLOSED = 1 << 2,      /* the source model bounds a volume */
    OW_TREE_INDEX32 = 1 << 3,     /* corners are 32-bit vertex numbers, otherwise 16-bit */
    OW_TREE_IDS = 1 << 4,         /* each polygon record carries its source polygon's number */
    OW_TREE_NORMALS = 1 << 5,     /* there is one normal a vertex */
    OW_TREE_FLAGS_KNOWN = (1 << 6) - 1
};

/*
 * Sections follow the header in the order of their fields, each starts at a
 * multiple of 4 and ends where the next begins (the last at blob_bytes), with
 * zero bytes as padding. A section that is absent has the next one's offset.
 */
struct ow_disk_header {
    uint32_t magic;
    uint16_t version;
    uint16_t header_bytes;
    uint32_t blob_bytes;
    uint32_t crc32; /* zlib's CRC-32 of all bytes of the blob but these four */
    uint32_t flags;
    uint32_t polygon_count;
    uint32_t face_count; /* face items in all nodes */
    uint32_t vertex_count;
    uint32_t node_count;
    uint32_t switch_count;
    uint32_t depth; /* levels of nodes, the root's is 1: what the walk's stack needs */
    uint32_t max_corners;
    uint32_t colour_count;
    uint32_t instance_count; /* instance items in all nodes */
    uint32_t nodes_at;
    uint32_t polygons_at;
    uint32_t vertices_at; /* int16 x, y, z */
    uint32_t normals_at;  /* int8 x, y, z, 127 times the unit vector, one for each vertex */
    uint32_t colours_at;  /* uint32 0x00RRGGBB */
    uint32_t instances_at;
    int16_t box_min[3]; /* bounding box of all vertices */
    int16_t box_max[3];
    uint32_t tolerance_q8;   /* the compiler's tolerance, lattice steps with 8 fraction bits */
    uint64_t origin_bits[3]; /* IEEE 754 binary64: model coordinates of lattice point 0,0,0 */
    uint64_t step_bits;      /* IEEE 754 binary64: model units in a lattice step */
};
_Static_assert(sizeof(struct ow_disk_header) == 128, "the header has no hidden padding");
_Static_assert(offsetof(struct ow_disk_header, box_min) == 80, "the offsets FORMAT.md states");
_Static_assert(offsetof(struct ow_disk_header, origin_bits) == 96, "the offsets FORMAT.md states");

/*
 * Items, 32 bits: what stands in sequences, in coplanar lists and as a
 * switch's two children.
 */
enum {
    OW_ITEM_FACE = 0,     /* a polygon's front; value: offset from polygons_at, in 2 bytes */
    OW_ITEM_REVERSE = 1,  /* a polygon's back; value likewise */
    OW_ITEM_NODE = 2,     /* value: offset from nodes_at, in 4 bytes */
    OW_ITEM_INSTANCE = 3, /* value: number of the instance */
    OW_ITEM_TAG_BITS = 2
};
#define OW_ITEM_NONE 0xFFFFFFFFu /* a switch has no child on that side */

/*
 * Nodes. The first lies at nodes_at; they lie level by level: the n-th node
 * item or instance item met while reading the nodes in order refers to the
 * n-th node after the root. So each node has one parent, before it, and a reader can check
 * this with one cursor.
 *
 *   word 0   kind in bits 0-1, OW_NODE_BOUNDED, count of items in bits 8-31
 *   [bounds  12 bytes if OW_NODE_BOUNDED: int16 centre x, y, z; uint16 radius;
 *            int8 axis x, y, z (127 times the unit vector); int8 cosine (127
 *            times the smallest cosine between the axis and a face's normal,
 *            rounded down; -128: the faces look everywhere)]
 *   sequence: count items, farthest first from every viewpoint
 *   switch:   item front, item back; plane (16 bytes); count faces coplanar
 *             with the plane, in the order in which later ones win
 *
 * A plane is the set of lattice points v with n.v + d = 0; its front is where
 * the sum is positive. Four words: normal component i in the low 24 bits of
 * word i, two's complement; d, 48-bit two's complement: bits 0-31 in word 3, bits
 * 32-39 and 40-47 in the high bytes of words 0 and 1; word 2's high byte is 0.
 */
enum {
    OW_NODE_SEQUENCE = 0,
    OW_NODE_SWITCH = 1,
    OW_NODE_KIND_MASK = 3,
    OW_NODE_BOUNDED = 4,
    OW_NODE_COUNT_SHIFT = 8,
    OW_NODE_MAX_ITEMS = (1 << 24) - 1,
    OW_NODE_WORD_BYTES = 4,
    OW_NODE_BOUNDS_BYTES = 12,
    OW_SWITCH_CHILDREN_BYTES = 8,
    OW_SWITCH_PLANE_BYTES = 16
};

/*
 * An instance: an object that moves as a whole, under a pose that the program
 * gives when it draws. Its root is the node that its item refers to; the n-th
 * instance item met refers to instance n, from 0. Its nodes have no instance items.
 * Its vertices reach from first_vertex to the next instance's, or to the last
 * one; no other face has them, and it has no others. They have a lattice of their
 * own, with the tree's step; its point 0,0,0 is what the pose places. All of them
 * lie in the sphere about centre. Wherever the pose puts that sphere within the
 * region, a box in the tree's lattice, the order is right.
 */
struct ow_disk_instance {
    uint32_t node; /* of the object's root: offset from nodes_at, in 4 bytes */
    uint32_t first_vertex;
    uint32_t zero; /* kept for the scale of the object's lattice */
    int16_t region_min[3];
    int16_t region_max[3];
    int16_t centre[3];
    uint16_t radius;
};
_Static_assert(sizeof(struct ow_disk_instance) == 32, "an instance has no hidden padding");

/*
 * Polygon records, each at a multiple of 2 bytes:
 *
 *   uint8  corner count, 3 .. 255
 *   int8   normal x, y, z: 127 times the unit vector
 *   uint16 colour number in bits 0-11, flags in bits 12-15
 *   [uint32 source polygon's number, if OW_TREE_IDS]
 *   corners: vertex numbers, counter-clockwise seen from the front
 *   [uint16 marks ..., if OW_POLYGON_MARKED: bit i%16 of word i/16 set if the
 *    edge from corner i to the next was not in the source model]
 */
enum {
    OW_POLYGON_HEAD_BYTES = 6,
    OW_POLYGON_COLOUR_MASK = 0x0FFF,
    OW_POLYGON_MARKED = 0x1000,
    OW_POLYGON_UNEVEN = 0x2000, /* rounding bent it: its normal may not reject it early */
    OW_POLYGON_FLAGS_KNOWN = 0x3000,
    OW_VERTEX_BYTES = 6,
    OW_NORMAL_BYTES = 3,
    OW_COLOUR_BYTES = 4,
    OW_INSTANCE_BYTES = 32
};

#endif
