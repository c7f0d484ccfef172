/* SPDX-License-Identifier: 0BSD */
/*
 * Small blobs by hand, for tests: vertices, polygons and nodes are added one by
 * one, and builder_finish lays them out as ow_blob.h says. It shares no code with
 * the compiler, and builds wrong trees as willingly as right ones.
 */
#ifndef OLDWELL_TESTS_BLOB_BUILDER_H
#define OLDWELL_TESTS_BLOB_BUILDER_H

#include <stddef.h>
#include <stdint.h>

enum {
    BUILDER_VERTICES = 8192,
    BUILDER_POLYGONS = 4096,
    BUILDER_CORNERS = 32768,
    BUILDER_NODES = 4096,
    BUILDER_ITEMS = 16384,
    BUILDER_COLOURS = 64,
    BUILDER_INSTANCES = 8
};

/* An item before its place is known: its kind is one of OW_ITEM_... */
struct built_item {
    uint32_t kind;
    uint32_t number; /* of the polygon, node or instance */
    uint32_t next;   /* in the node's list, from 1; 0: the last */
};

struct built_node {
    uint32_t kind; /* OW_NODE_SEQUENCE or OW_NODE_SWITCH, plus OW_NODE_BOUNDED */
    uint32_t first, last, count;
    uint32_t children[2]; /* front and back: items from 1, or 0 */
    int64_t plane[4];     /* n.x, n.y, n.z, d */
    int16_t centre[3];
    uint16_t radius;
    int8_t axis[3];
    int8_t cosine;
};

struct built_polygon {
    uint32_t first, count;
    uint32_t id;
    uint16_t look; /* colour and flags */
    int8_t normal[3];
    uint16_t marks[16];
};

struct built_instance {
    uint32_t root; /* node */
    uint32_t first_vertex;
    int16_t region[2][3];
    int16_t centre[3];
    uint16_t radius;
};

struct builder {
    uint32_t flags; /* OW_TREE_... */
    int16_t vertices[BUILDER_VERTICES][3];
    uint32_t vertex_count;
    struct built_polygon polygons[BUILDER_POLYGONS];
    uint32_t polygon_count;
    uint32_t corners[BUILDER_CORNERS];
    uint32_t corner_count;
    struct built_node nodes[BUILDER_NODES];
    uint32_t node_count;
    struct built_item items[BUILDER_ITEMS + 1];
    uint32_t item_count;
    uint32_t colours[BUILDER_COLOURS];
    uint32_t colour_count;
    struct built_instance instances[BUILDER_INSTANCES];
    uint32_t instance_count;
    double origin[3];
    double step;
};

/* An empty builder (free it with free). Flags: OW_TREE_... */
struct builder *builder_new(uint32_t flags);

uint32_t builder_vertex(struct builder *b, int x, int y, int z);
uint32_t builder_colour(struct builder *b, uint32_t rgb);

/* A polygon; its normal is Newell's. id: the source polygon's number. */
uint32_t builder_polygon(struct builder *b, const uint32_t *corners, uint32_t count,
                         uint32_t colour, uint32_t id);
uint32_t builder_triangle(struct builder *b, const int v[3][3], uint32_t colour, uint32_t id);

/* Sets the bit of edge i in the polygon's marks. */
void builder_mark(struct builder *b, uint32_t polygon, uint32_t edge);

uint32_t builder_sequence(struct builder *b);
uint32_t builder_switch(struct builder *b, const int64_t plane[4]);

/* The polygon's plane with a normal short enough for the format, exact for small polygons. */
void builder_plane(const struct builder *b, uint32_t polygon, int64_t plane[4]);

/* Adds an item at the end of a sequence or of a switch's coplanar faces. */
void builder_add(struct builder *b, uint32_t node, uint32_t kind, uint32_t number);

/* Sets a switch's child: side 0 front, 1 back. */
void builder_child(struct builder *b, uint32_t node, uint32_t side, uint32_t kind, uint32_t number);

/*
 * The vertices added from now on are an instance's. Items must name instances in
 * the order in which they were begun. Returns its number.
 */
uint32_t builder_begin_instance(struct builder *b);

/* Ends it: its root, and its region; its sphere holds its vertices. */
void builder_end_instance(struct builder *b, uint32_t root, const int region[2][3]);

/* Gives a node bounds that hold no matter what lies in it. */
void builder_bound(struct builder *b, uint32_t node);

/* The blob, malloc'ed and of exactly *size bytes, with the root given and a right checksum. */
uint8_t *builder_finish(const struct builder *b, uint32_t root, uint32_t *size);

/* Puts the right checksum into bytes that were changed: of as many as they say, if those exist. */
void blob_seal(uint8_t *bytes, uint32_t size);

/* A small tree with all that the format knows: both node kinds, bounds, coplanar and two-sided
 * faces, marks, normals, ids. flags are added to OW_TREE_TWO_SIDED. */
uint8_t *builder_sample(uint32_t flags, uint32_t *size);

#endif
