/* SPDX-License-Identifier: 0BSD */
/*
 * Writing the blob: the nodes are laid out level by level, polygon records in
 * the order in which nodes refer to them, vertices in the order in which
 * records do; then everything is written in one go.
 */
#include "blob_write.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "blob_bounds.h"
#include "map64.h"
#include "ow_tree.h"
#include "tools/common/xalloc.h"

#define UNPLACED 0xFFFFFFFFu

/* ---- layout ---- */

struct layout {
    const struct blob_parts *parts;
    struct blob *blob;
    uint32_t *nodes; /* tree nodes, level by level */
    uint32_t node_count;
    uint32_t *switches_above; /* for each of nodes: switches on the path, itself included */
    uint32_t *outlines;       /* in the order of their records */
    uint32_t outline_count;
    uint32_t *record_at; /* of each outline: bytes from the first record, or UNPLACED */
    uint64_t node_bytes;
    uint64_t polygon_bytes;
    uint32_t face_count;
    uint32_t depth;
    uint32_t max_corners;
    uint32_t *corners; /* vertex numbers, for each corner of repaired */
    int16_t (*vertices)[3];
    int8_t (*normals)[3];
    uint32_t vertex_count;
    size_t vertex_capacity;
    size_t normal_capacity;
    uint8_t *at; /* where writing goes on */
};

static uint32_t outlines_of(const struct layout *l, tree_item item)
{
    const uint32_t *first = l->parts->repaired->first + tree_item_value(item);
    return first[1] - first[0];
}

/* Items that a node has in the blob, a switch's children excepted. */
static uint32_t count_items(const struct layout *l, const struct tree_node *node)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < node->count; i++) {
        tree_item item = l->parts->tree->items[node->first + i];
        count += tree_item_tag(item) == OW_ITEM_NODE ? 1 : outlines_of(l, item);
    }
    return count;
}

/* Of a node's bytes those before its items. */
static uint32_t head_bytes(const struct layout *l, const struct tree_node *node)
{
    uint32_t bytes = OW_NODE_WORD_BYTES;
    if (node->plane != MESH_NONE) {
        bytes += OW_SWITCH_CHILDREN_BYTES + OW_SWITCH_PLANE_BYTES;
    }
    return bytes + (blob_is_bounded(l->parts->tree, node) ? OW_NODE_BOUNDS_BYTES : 0u);
}

static const struct blob_limits format_limits = { OW_MAX_BLOB_BYTES, OW_MAX_DEPTH, OW_MAX_VERTICES,
                                                  OW_NODE_MAX_ITEMS };

static const struct blob_limits *limits_of(const struct layout *l)
{
    return l->parts->limits != NULL ? l->parts->limits : &format_limits;
}

/* What is too much, and what may help. */
static bool too_large(struct problem *problem, uint64_t count, const char *what, uint32_t most,
                      const char *help)
{
    return problem_set(problem, 0, "the tree has %llu %s, at most %u can be: %s",
                       (unsigned long long)count, what, most, help);
}

static void meet_node(struct layout *l, uint32_t node, uint32_t above)
{
    l->switches_above[l->node_count] = above + (l->parts->tree->nodes[node].plane != MESH_NONE);
    l->nodes[l->node_count++] = node;
}

static void meet_item(struct layout *l, tree_item item, uint32_t above)
{
    if (item == OW_ITEM_NONE) {
        return;
    }
    if (tree_item_tag(item) == OW_ITEM_NODE) {
        meet_node(l, tree_item_value(item), above);
        return;
    }
    const struct repaired *repaired = l->parts->repaired;
    uint32_t first = repaired->first[tree_item_value(item)];
    for (uint32_t i = first; i < first + outlines_of(l, item); i++) {
        l->face_count++;
        if (l->record_at[i] == UNPLACED) {
            l->record_at[i] = 0;
            l->outlines[l->outline_count++] = i;
            if (repaired->outlines[i].count > l->max_corners) {
                l->max_corners = repaired->outlines[i].count;
            }
        }
    }
}

static bool lay_out_nodes(struct layout *l, struct problem *problem)
{
    const struct tree *tree = l->parts->tree;
    uint32_t level_end = 0;
    meet_node(l, tree_item_value(tree->root), 0);
    for (uint32_t i = 0; i < l->node_count; i++) {
        const struct tree_node *node = &tree->nodes[l->nodes[i]];
        uint32_t above = l->switches_above[i];
        uint32_t items = count_items(l, node);
        if (i == level_end) {
            l->depth++;
            level_end = l->node_count;
        }
        if (items > limits_of(l)->node_items) {
            return too_large(problem, items, "faces in one plane", limits_of(l)->node_items,
                             "make the model of fewer polygons, or try --merge");
        }
        l->node_bytes += head_bytes(l, node) + 4ull * items;
        if (node->plane != MESH_NONE) {
            l->blob->switches++;
            meet_item(l, node->front, above);
            meet_item(l, node->back, above);
        }
        for (uint32_t k = 0; k < node->count; k++) {
            meet_item(l, tree->items[node->first + k], above);
        }
        l->blob->switch_depth = above > l->blob->switch_depth ? above : l->blob->switch_depth;
    }
    if (l->depth > limits_of(l)->levels) {
        return too_large(problem, l->depth, "levels", limits_of(l)->levels,
                         "try --method obstruction, or --method bsp with another --seed");
    }
    return true;
}

/* ---- vertices ---- */

static void unit_bytes(const float *normal, const int8_t *instead, int8_t out[3])
{
    double square = 0;
    for (int k = 0; k < 3; k++) {
        square += (double)normal[k] * normal[k];
    }
    double length = sqrt(square);
    for (int k = 0; k < 3; k++) {
        out[k] = length > 0 ? (int8_t)floor(normal[k] / length * 127 + 0.5) : instead[k];
    }
}

static void add_vertex(struct layout *l, const int16_t at[3], const int8_t *normal)
{
    size_t needed = (size_t)l->vertex_count + 1;
    l->vertices = xgrow(l->vertices, &l->vertex_capacity, needed, sizeof *l->vertices);
    memcpy(l->vertices[l->vertex_count], at, sizeof l->vertices[0]);
    if (normal != NULL) {
        l->normals = xgrow(l->normals, &l->normal_capacity, needed, sizeof *l->normals);
        memcpy(l->normals[l->vertex_count], normal, sizeof l->normals[0]);
    }
    l->vertex_count++;
}

struct vertex_maps {
    struct map64 points;  /* lattice coordinates to numbers */
    struct map64 normals; /* the number of a point and a normal to the vertex */
};

static uint32_t number_vertex(struct layout *l, struct vertex_maps *maps, size_t corner,
                              const int8_t *flat)
{
    const struct repaired *repaired = l->parts->repaired;
    const int16_t *at = repaired->corners[corner];
    uint64_t key =
        (uint64_t)(uint16_t)at[0] << 32 | (uint64_t)(uint16_t)at[1] << 16 | (uint16_t)at[2];
    if (repaired->normals == NULL) {
        uint32_t vertex = map64_put(&maps->points, key, l->vertex_count);
        if (vertex == l->vertex_count) {
            add_vertex(l, at, NULL);
        }
        return vertex;
    }
    int8_t normal[3];
    unit_bytes(repaired->normals[corner], flat, normal);
    uint32_t point = map64_put(&maps->points, key, (uint32_t)maps->points.count);
    uint32_t packed =
        (uint32_t)(uint8_t)normal[0] << 16 | (uint32_t)(uint8_t)normal[1] << 8 | (uint8_t)normal[2];
    uint32_t vertex = map64_put(&maps->normals, map64_key(point, packed), l->vertex_count);
    if (vertex == l->vertex_count) {
        add_vertex(l, at, normal);
    }
    return vertex;
}

static bool number_vertices(struct layout *l, struct problem *problem)
{
    struct vertex_maps maps = { { 0 }, { 0 } };
    const struct repaired *repaired = l->parts->repaired;
    l->corners = xalloc(repaired->corner_count, sizeof *l->corners);
    for (uint32_t i = 0; i < l->outline_count; i++) {
        const struct outline_final *outline = &repaired->outlines[l->outlines[i]];
        for (uint32_t k = 0; k < outline->count; k++) {
            l->corners[outline->first + k] =
                number_vertex(l, &maps, outline->first + k, outline->normal);
        }
    }
    map64_free(&maps.points);
    map64_free(&maps.normals);
    if (l->vertex_count > limits_of(l)->vertices) {
        return too_large(problem, l->vertex_count, "vertices", limits_of(l)->vertices,
                         "make the model of fewer polygons, or try --method obstruction");
    }
    return true;
}

/* ---- records ---- */

static bool wide_corners(const struct layout *l)
{
    return l->vertex_count > 1u << 16;
}

static uint32_t mark_words(const struct layout *l, const struct outline_final *outline)
{
    for (uint32_t k = 0; k < outline->count; k++) {
        if (l->parts->repaired->marks[outline->first + k]) {
            return (outline->count + 15) / 16;
        }
    }
    return 0;
}

static void lay_out_records(struct layout *l)
{
    uint32_t fixed = OW_POLYGON_HEAD_BYTES + (l->parts->keep_ids ? 4 : 0);
    for (uint32_t i = 0; i < l->outline_count; i++) {
        const struct outline_final *outline = &l->parts->repaired->outlines[l->outlines[i]];
        l->record_at[l->outlines[i]] = (uint32_t)l->polygon_bytes;
        l->polygon_bytes +=
            fixed + outline->count * (wide_corners(l) ? 4u : 2u) + 2u * mark_words(l, outline);
        if (l->polygon_bytes > OW_MAX_BLOB_BYTES) {
            return; /* refused later, with the other sections */
        }
    }
}

/* ---- bytes ---- */

static void put8(struct layout *l, int value)
{
    *l->at++ = (uint8_t)value;
}

static void put16(struct layout *l, uint32_t value)
{
    put8(l, (int)(value & 255));
    put8(l, (int)(value >> 8 & 255));
}

static void put32(struct layout *l, uint32_t value)
{
    put16(l, value & 0xFFFF);
    put16(l, value >> 16);
}

static void put64(struct layout *l, uint64_t value)
{
    put32(l, (uint32_t)value);
    put32(l, (uint32_t)(value >> 32));
}

static void put_double(struct layout *l, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put64(l, bits);
}

static void put_plane(struct layout *l, const struct plane *plane)
{
    uint64_t d = (uint64_t)plane->d;
    for (int k = 0; k < 3; k++) {
        uint32_t high = k < 2 ? (uint32_t)(d >> (32 + 8 * k)) & 255 : 0; /* d has 48 bits */
        put32(l, ((uint32_t)plane->n[k] & 0xFFFFFF) | high << 24);
    }
    put32(l, (uint32_t)d);
}

static void put_bounds(struct layout *l, const struct tree_node *node)
{
    struct blob_bounds bounds;
    blob_bounds_find(&bounds, l->parts->repaired, l->parts->tree, node);
    for (int k = 0; k < 3; k++) {
        put16(l, (uint16_t)bounds.centre[k]);
    }
    put16(l, bounds.radius);
    for (int k = 0; k < 3; k++) {
        put8(l, bounds.axis[k]);
    }
    put8(l, bounds.cosine);
}

static void put_item(struct layout *l, tree_item item, uint64_t *next_child, uint32_t *met)
{
    uint32_t tag = tree_item_tag(item);
    if (item == OW_ITEM_NONE) {
        put32(l, item);
    } else if (tag == OW_ITEM_NODE) {
        const struct tree_node *child = &l->parts->tree->nodes[l->nodes[(*met)++]];
        put32(l, tree_item_of(OW_ITEM_NODE, (uint32_t)(*next_child / 4)));
        *next_child += head_bytes(l, child) + 4ull * count_items(l, child);
    } else {
        uint32_t first = l->parts->repaired->first[tree_item_value(item)];
        for (uint32_t i = first; i < first + outlines_of(l, item); i++) {
            put32(l, tree_item_of(tag, l->record_at[i] / 2));
        }
    }
}

static void put_nodes(struct layout *l)
{
    const struct tree *tree = l->parts->tree;
    const struct tree_node *root = &tree->nodes[l->nodes[0]];
    uint64_t next_child = head_bytes(l, root) + 4ull * count_items(l, root);
    uint32_t met = 1;
    for (uint32_t i = 0; i < l->node_count; i++) {
        const struct tree_node *node = &tree->nodes[l->nodes[i]];
        bool is_switch = node->plane != MESH_NONE;
        bool bounded = blob_is_bounded(tree, node);
        put32(l, (is_switch ? OW_NODE_SWITCH : OW_NODE_SEQUENCE) |
                     (bounded ? (uint32_t)OW_NODE_BOUNDED : 0u) |
                     count_items(l, node) << OW_NODE_COUNT_SHIFT);
        if (bounded) {
            put_bounds(l, node);
        }
        if (is_switch) {
            put_item(l, node->front, &next_child, &met);
            put_item(l, node->back, &next_child, &met);
            put_plane(l, &l->parts->planes->all[node->plane]);
        }
        for (uint32_t k = 0; k < node->count; k++) {
            put_item(l, tree->items[node->first + k], &next_child, &met);
        }
    }
}

static void put_marks(struct layout *l, const struct outline_final *outline)
{
    const uint8_t *marks = l->parts->repaired->marks + outline->first;
    for (uint32_t k = 0; k < outline->count; k += 16) {
        uint32_t word = 0;
        for (uint32_t bit = 0; bit < 16 && k + bit < outline->count; bit++) {
            word |= (uint32_t)marks[k + bit] << bit;
        }
        put16(l, word);
    }
}

/* Which of the mesh's polygons each outline is of. */
static uint32_t *polygons_of_outlines(const struct layout *l)
{
    const struct repaired *repaired = l->parts->repaired;
    uint32_t *polygons = xalloc(repaired->outline_count, sizeof *polygons);
    for (uint32_t i = 0; i < l->parts->piece_count; i++) {
        for (uint32_t k = repaired->first[i]; k < repaired->first[i + 1]; k++) {
            polygons[k] = l->parts->pieces->all[i].polygon;
        }
    }
    return polygons;
}

static void put_records(struct layout *l)
{
    uint32_t *polygons = polygons_of_outlines(l);
    for (uint32_t i = 0; i < l->outline_count; i++) {
        uint32_t number = l->outlines[i];
        const struct outline_final *outline = &l->parts->repaired->outlines[number];
        const struct mesh_polygon *polygon = &l->parts->mesh->polygons[polygons[number]];
        bool marked = mark_words(l, outline) > 0;
        put8(l, (int)outline->count);
        for (int k = 0; k < 3; k++) {
            put8(l, outline->normal[k]);
        }
        put16(l, polygon->colour | (marked ? OW_POLYGON_MARKED : 0u) |
                     (outline->uneven ? OW_POLYGON_UNEVEN : 0u));
        if (l->parts->keep_ids) {
            put32(l, polygon->source);
        }
        for (uint32_t k = 0; k < outline->count; k++) {
            if (wide_corners(l)) {
                put32(l, l->corners[outline->first + k]);
            } else {
                put16(l, l->corners[outline->first + k]);
            }
        }
        if (marked) {
            put_marks(l, outline);
        }
    }
    free(polygons);
}

/* Where sections begin: nodes, polygons, vertices, normals, colours, instances, end. */
struct sections {
    uint64_t at[7];
};

static uint64_t padded(uint64_t bytes)
{
    return (bytes + 3) / 4 * 4;
}

static struct sections find_sections(const struct layout *l)
{
    bool normals = l->parts->repaired->normals != NULL;
    uint64_t bytes[6] = { l->node_bytes,
                          padded(l->polygon_bytes),
                          padded((uint64_t)l->vertex_count * OW_VERTEX_BYTES),
                          normals ? padded((uint64_t)l->vertex_count * OW_NORMAL_BYTES) : 0,
                          (uint64_t)l->parts->colour_count * OW_COLOUR_BYTES,
                          0 };
    struct sections sections;
    sections.at[0] = sizeof(struct ow_disk_header);
    for (int i = 0; i < 6; i++) {
        sections.at[i + 1] = sections.at[i] + bytes[i];
    }
    return sections;
}

static void put_box(struct layout *l)
{
    int16_t low[3];
    int16_t high[3];
    memcpy(low, l->vertices[0], sizeof low);
    memcpy(high, l->vertices[0], sizeof high);
    for (uint32_t i = 1; i < l->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            low[k] = l->vertices[i][k] < low[k] ? l->vertices[i][k] : low[k];
            high[k] = l->vertices[i][k] > high[k] ? l->vertices[i][k] : high[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        put16(l, (uint16_t)low[k]);
    }
    for (int k = 0; k < 3; k++) {
        put16(l, (uint16_t)high[k]);
    }
}

static uint32_t flags_of(const struct layout *l)
{
    const struct blob_parts *parts = l->parts;
    return (parts->two_sided ? OW_TREE_TWO_SIDED : 0u) |
           (parts->switch_only ? OW_TREE_SWITCH_ONLY : 0u) |
           (parts->mesh->closed ? OW_TREE_CLOSED : 0u) | (wide_corners(l) ? OW_TREE_INDEX32 : 0u) |
           (parts->keep_ids ? OW_TREE_IDS : 0u) |
           (parts->repaired->normals != NULL ? OW_TREE_NORMALS : 0u);
}

/* The fields of struct ow_disk_header, one after the other. */
static void put_header(struct layout *l, const struct sections *sections)
{
    const struct blob_parts *parts = l->parts;
    put32(l, OW_BLOB_MAGIC);
    put16(l, OW_BLOB_VERSION);
    put16(l, sizeof(struct ow_disk_header));
    put32(l, (uint32_t)sections->at[6]);
    put32(l, 0); /* crc32: when all the rest stands */
    put32(l, flags_of(l));
    put32(l, l->outline_count);
    put32(l, l->face_count);
    put32(l, l->vertex_count);
    put32(l, l->node_count);
    put32(l, l->blob->switches);
    put32(l, l->depth);
    put32(l, l->max_corners);
    put32(l, parts->colour_count);
    put32(l, 0); /* instances */
    for (int i = 0; i < 6; i++) {
        put32(l, (uint32_t)sections->at[i]);
    }
    put_box(l);
    put32(l, parts->tolerance_q8);
    for (int k = 0; k < 3; k++) {
        put_double(l, parts->mesh->lattice.origin[k]);
    }
    put_double(l, parts->mesh->lattice.step);
}

static void put_vertices(struct layout *l, const struct sections *sections)
{
    l->at = l->blob->bytes + sections->at[2];
    for (uint32_t i = 0; i < l->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            put16(l, (uint16_t)l->vertices[i][k]);
        }
    }
    l->at = l->blob->bytes + sections->at[3];
    for (uint32_t i = 0; l->normals != NULL && i < l->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            put8(l, l->normals[i][k]);
        }
    }
}

static void put_crc(struct layout *l)
{
    uint8_t *bytes = l->blob->bytes;
    uint32_t at = (uint32_t)offsetof(struct ow_disk_header, crc32);
    uint32_t crc = ow_crc32(0, bytes, at);
    crc = ow_crc32(crc, bytes + at + 4, l->blob->size - at - 4);
    l->at = bytes + at;
    put32(l, crc);
}

static bool put_all(struct layout *l, struct problem *problem)
{
    struct sections sections = find_sections(l);
    if (sections.at[6] > limits_of(l)->bytes) {
        return too_large(problem, sections.at[6], "bytes or more", limits_of(l)->bytes,
                         "make the model of fewer polygons, or try --method obstruction");
    }
    l->blob->size = (uint32_t)sections.at[6];
    l->blob->bytes = xalloc_zero(l->blob->size, 1); /* zero: the padding */
    l->at = l->blob->bytes;
    put_header(l, &sections);
    put_nodes(l);
    put_records(l);
    put_vertices(l, &sections);
    l->at = l->blob->bytes + sections.at[4];
    for (uint32_t i = 0; i < l->parts->colour_count; i++) {
        put32(l, l->parts->colours[i]);
    }
    put_crc(l);
    return true;
}

bool blob_write(struct blob *blob, const struct blob_parts *parts, struct problem *problem)
{
    *blob = (struct blob){ 0 };
    if (parts->tree->root == OW_ITEM_NONE) {
        return problem_set(problem, 0, "nothing is left of it on the lattice");
    }
    struct layout l = { .parts = parts, .blob = blob };
    uint32_t outlines = parts->repaired->outline_count;
    l.nodes = xalloc(parts->tree->node_count, sizeof *l.nodes);
    l.switches_above = xalloc(parts->tree->node_count, sizeof *l.switches_above);
    l.outlines = xalloc(outlines, sizeof *l.outlines);
    l.record_at = xalloc(outlines, sizeof *l.record_at);
    memset(l.record_at, 0xFF, outlines * sizeof *l.record_at);
    bool fine = lay_out_nodes(&l, problem) && number_vertices(&l, problem);
    if (fine) {
        lay_out_records(&l);
        fine = put_all(&l, problem);
    }
    blob->polygons = l.outline_count;
    blob->vertices = l.vertex_count;
    blob->nodes = l.node_count;
    free(l.nodes);
    free(l.switches_above);
    free(l.outlines);
    free(l.record_at);
    free(l.corners);
    free(l.vertices);
    free(l.normals);
    return fine;
}

void blob_free(struct blob *blob)
{
    free(blob->bytes);
    *blob = (struct blob){ 0 };
}
