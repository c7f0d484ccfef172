/* SPDX-License-Identifier: 0BSD */
/* Small blobs by hand: see blob_builder.h. */
#include "tests/property/blob_builder.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "ow_blob.h"

/* ---- what is added -------------------------------------------------------------------------- */
struct builder *builder_new(uint32_t flags)
{
    struct builder *b = calloc(1, sizeof *b);
    assert(b != NULL);
    b->flags = flags;
    b->step = 1;
    return b;
}

uint32_t builder_vertex(struct builder *b, int x, int y, int z)
{
    assert(b->vertex_count < BUILDER_VERTICES);
    b->vertices[b->vertex_count][0] = (int16_t)x;
    b->vertices[b->vertex_count][1] = (int16_t)y;
    b->vertices[b->vertex_count][2] = (int16_t)z;
    return b->vertex_count++;
}

uint32_t builder_colour(struct builder *b, uint32_t rgb)
{
    assert(b->colour_count < BUILDER_COLOURS);
    b->colours[b->colour_count] = rgb;
    return b->colour_count++;
}

/* Newell's normal, exact. */
static void newell(const struct builder *b, const struct built_polygon *p, int64_t n[3])
{
    n[0] = n[1] = n[2] = 0;
    for (uint32_t i = 0; i < p->count; i++) {
        const int16_t *u = b->vertices[b->corners[p->first + i]];
        const int16_t *v = b->vertices[b->corners[p->first + (i + 1) % p->count]];
        for (int k = 0; k < 3; k++) {
            int y = (k + 1) % 3, z = (k + 2) % 3;
            n[k] += (int64_t)(u[y] - v[y]) * (u[z] + v[z]);
        }
    }
}

uint32_t builder_polygon(struct builder *b, const uint32_t *corners, uint32_t count,
                         uint32_t colour, uint32_t id)
{
    assert(b->polygon_count < BUILDER_POLYGONS && b->corner_count + count <= BUILDER_CORNERS);
    struct built_polygon *p = &b->polygons[b->polygon_count];
    p->first = b->corner_count;
    p->count = count;
    p->id = id;
    p->look = (uint16_t)colour;
    memcpy(b->corners + b->corner_count, corners, count * sizeof *corners);
    b->corner_count += count;
    int64_t n[3];
    newell(b, p, n);
    double length = sqrt((double)n[0] * (double)n[0] + (double)n[1] * (double)n[1] +
                         (double)n[2] * (double)n[2]);
    for (int i = 0; i < 3 && length > 0; i++) {
        p->normal[i] = (int8_t)lround(127 * (double)n[i] / length);
    }
    return b->polygon_count++;
}

uint32_t builder_triangle(struct builder *b, const int v[3][3], uint32_t colour, uint32_t id)
{
    uint32_t corners[3];
    for (int i = 0; i < 3; i++) {
        corners[i] = builder_vertex(b, v[i][0], v[i][1], v[i][2]);
    }
    return builder_polygon(b, corners, 3, colour, id);
}

void builder_mark(struct builder *b, uint32_t polygon, uint32_t edge)
{
    b->polygons[polygon].look |= OW_POLYGON_MARKED;
    b->polygons[polygon].marks[edge / 16] |= (uint16_t)(1u << edge % 16);
}

static uint32_t new_node(struct builder *b, uint32_t kind)
{
    assert(b->node_count < BUILDER_NODES);
    b->nodes[b->node_count].kind = kind;
    return b->node_count++;
}

uint32_t builder_sequence(struct builder *b)
{
    return new_node(b, OW_NODE_SEQUENCE);
}

uint32_t builder_switch(struct builder *b, const int64_t plane[4])
{
    uint32_t node = new_node(b, OW_NODE_SWITCH);
    memcpy(b->nodes[node].plane, plane, sizeof b->nodes[node].plane);
    return node;
}

static int64_t divisor(int64_t a, int64_t b)
{
    a = a < 0 ? -a : a;
    b = b < 0 ? -b : b;
    while (b != 0) {
        int64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

void builder_plane(const struct builder *b, uint32_t polygon, int64_t plane[4])
{
    const struct built_polygon *p = &b->polygons[polygon];
    const int16_t *v = b->vertices[b->corners[p->first]];
    newell(b, p, plane);
    int64_t common = divisor(divisor(plane[0], plane[1]), plane[2]);
    plane[3] = 0;
    for (int i = 0; i < 3; i++) {
        plane[i] /= common ? common : 1;
        plane[3] -= plane[i] * v[i];
    }
}

static uint32_t new_item(struct builder *b, uint32_t kind, uint32_t number)
{
    assert(b->item_count < BUILDER_ITEMS);
    b->items[++b->item_count] = (struct built_item){ kind, number, 0 };
    return b->item_count;
}

void builder_add(struct builder *b, uint32_t node, uint32_t kind, uint32_t number)
{
    struct built_node *n = &b->nodes[node];
    uint32_t item = new_item(b, kind, number);
    *(n->count ? &b->items[n->last].next : &n->first) = item;
    n->last = item;
    n->count++;
}

void builder_child(struct builder *b, uint32_t node, uint32_t side, uint32_t kind, uint32_t number)
{
    b->nodes[node].children[side] = new_item(b, kind, number);
}

void builder_bound(struct builder *b, uint32_t node)
{
    struct built_node *n = &b->nodes[node];
    n->kind |= OW_NODE_BOUNDED;
    n->radius = 65535;
    n->cosine = -128;
    n->axis[2] = 127;
}

uint32_t builder_begin_instance(struct builder *b)
{
    assert(b->instance_count < BUILDER_INSTANCES);
    b->instances[b->instance_count].first_vertex = b->vertex_count;
    return b->instance_count++;
}

void builder_end_instance(struct builder *b, uint32_t root, const int region[2][3])
{
    struct built_instance *o = &b->instances[b->instance_count - 1];
    int low[3], high[3];
    o->root = root;
    for (int i = 0; i < 3; i++) {
        low[i] = 32767;
        high[i] = -32767;
        for (uint32_t v = o->first_vertex; v < b->vertex_count; v++) {
            low[i] = b->vertices[v][i] < low[i] ? b->vertices[v][i] : low[i];
            high[i] = b->vertices[v][i] > high[i] ? b->vertices[v][i] : high[i];
        }
        o->centre[i] = (int16_t)((low[i] + high[i]) / 2);
        o->region[0][i] = (int16_t)region[0][i];
        o->region[1][i] = (int16_t)region[1][i];
    }
    for (uint32_t v = o->first_vertex; v < b->vertex_count; v++) {
        double squares = 0;
        for (int i = 0; i < 3; i++) {
            squares += pow(b->vertices[v][i] - o->centre[i], 2);
        }
        o->radius = sqrt(squares) > o->radius ? (uint16_t)ceil(sqrt(squares)) : o->radius;
    }
}

/* ---- bytes ---------------------------------------------------------------------------------- */
struct bytes {
    uint8_t *data;
    size_t size;
    size_t room;
};

static void put(struct bytes *out, uint64_t value, size_t count)
{
    if (out->size + count > out->room) {
        out->room = 2 * out->room + 256;
        out->data = realloc(out->data, out->room);
        assert(out->data != NULL);
    }
    for (size_t i = 0; i < count; i++) {
        out->data[out->size++] = (uint8_t)(value >> 8 * i);
    }
}

static void set(struct bytes *out, size_t at, uint64_t value, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        out->data[at + i] = (uint8_t)(value >> 8 * i);
    }
}

static void pad(struct bytes *out)
{
    while (out->size % 4 != 0) {
        put(out, 0, 1);
    }
}

static uint32_t crc_of(uint32_t crc, const uint8_t *bytes, size_t count)
{
    crc = ~crc;
    for (size_t i = 0; i < count; i++) {
        crc ^= bytes[i];
        for (int k = 0; k < 8; k++) {
            crc = (crc & 1) ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
        }
    }
    return ~crc;
}

void blob_seal(uint8_t *bytes, uint32_t size)
{
    struct bytes out = { bytes, size, size };
    size_t at = offsetof(struct ow_disk_header, crc32);
    size_t said_at = offsetof(struct ow_disk_header, blob_bytes);
    uint32_t said = bytes[said_at] | (uint32_t)bytes[said_at + 1] << 8 |
                    (uint32_t)bytes[said_at + 2] << 16 | (uint32_t)bytes[said_at + 3] << 24;
    size = said >= sizeof(struct ow_disk_header) && said < size ? said : size;
    set(&out, at, crc_of(crc_of(0, bytes, at), bytes + at + 4, size - at - 4), 4);
}

/* ---- layout --------------------------------------------------------------------------------- */
struct layout {
    const struct builder *b;
    uint32_t order[BUILDER_NODES]; /* nodes level by level */
    uint32_t level[BUILDER_NODES]; /* of the n-th in that order, from 1 */
    uint32_t node_at[BUILDER_NODES];
    uint32_t polygon_at[BUILDER_POLYGONS];
    uint32_t count;
    uint32_t faces, switches, depth, max_corners, instances;
};

static uint32_t node_size(const struct built_node *n)
{
    uint32_t bytes = OW_NODE_WORD_BYTES + 4 * n->count;
    bytes += (n->kind & OW_NODE_BOUNDED) ? OW_NODE_BOUNDS_BYTES : 0;
    bytes += (n->kind & OW_NODE_KIND_MASK) == OW_NODE_SWITCH
                 ? OW_SWITCH_CHILDREN_BYTES + OW_SWITCH_PLANE_BYTES
                 : 0;
    return bytes;
}

static void meet_item(struct layout *l, uint32_t item, uint32_t level)
{
    const struct built_item *i = &l->b->items[item];
    if (item == 0) {
        return;
    }
    if (i->kind == OW_ITEM_NODE || i->kind == OW_ITEM_INSTANCE) {
        bool is_node = i->kind == OW_ITEM_NODE;
        assert(l->count < BUILDER_NODES);
        l->order[l->count] = is_node ? i->number : l->b->instances[i->number].root;
        l->instances += !is_node;
        l->level[l->count++] = level + 1;
    } else {
        const struct built_polygon *p = &l->b->polygons[i->number];
        l->faces++;
        l->max_corners = p->count > l->max_corners ? p->count : l->max_corners;
    }
}

static void order_nodes(struct layout *l, uint32_t root)
{
    l->order[0] = root;
    l->level[0] = 1;
    l->count = 1;
    uint32_t at = 0;
    for (uint32_t k = 0; k < l->count; k++) {
        const struct built_node *n = &l->b->nodes[l->order[k]];
        l->node_at[l->order[k]] = at;
        l->depth = l->level[k];
        at += node_size(n);
        if ((n->kind & OW_NODE_KIND_MASK) == OW_NODE_SWITCH) {
            l->switches++;
            meet_item(l, n->children[0], l->level[k]);
            meet_item(l, n->children[1], l->level[k]);
        }
        for (uint32_t i = n->first; i != 0; i = l->b->items[i].next) {
            meet_item(l, i, l->level[k]);
        }
    }
}

static uint32_t polygon_size(const struct builder *b, const struct built_polygon *p)
{
    uint32_t bytes = OW_POLYGON_HEAD_BYTES + ((b->flags & OW_TREE_IDS) ? 4 : 0);
    bytes += p->count * ((b->flags & OW_TREE_INDEX32) ? 4 : 2);
    return bytes + ((p->look & OW_POLYGON_MARKED) ? (p->count + 15) / 16 * 2 : 0);
}

static void order_polygons(struct layout *l)
{
    uint32_t at = 0;
    for (uint32_t i = 0; i < l->b->polygon_count; i++) {
        l->polygon_at[i] = at;
        at += polygon_size(l->b, &l->b->polygons[i]);
    }
}

static uint32_t item_word(const struct layout *l, uint32_t item)
{
    if (item == 0) {
        return OW_ITEM_NONE;
    }
    const struct built_item *i = &l->b->items[item];
    uint32_t value = i->kind == OW_ITEM_INSTANCE ? i->number
                     : i->kind == OW_ITEM_NODE   ? l->node_at[i->number] / 4
                                                 : l->polygon_at[i->number] / 2;
    return i->kind | value << OW_ITEM_TAG_BITS;
}

static void put_node(struct bytes *out, const struct layout *l, const struct built_node *n)
{
    put(out, n->kind | (uint64_t)n->count << OW_NODE_COUNT_SHIFT, 4);
    if (n->kind & OW_NODE_BOUNDED) {
        for (int i = 0; i < 3; i++) {
            put(out, (uint16_t)n->centre[i], 2);
        }
        put(out, n->radius, 2);
        for (int i = 0; i < 3; i++) {
            put(out, (uint8_t)n->axis[i], 1);
        }
        put(out, (uint8_t)n->cosine, 1);
    }
    if ((n->kind & OW_NODE_KIND_MASK) == OW_NODE_SWITCH) {
        put(out, item_word(l, n->children[0]), 4);
        put(out, item_word(l, n->children[1]), 4);
        uint64_t d = (uint64_t)n->plane[3];
        for (int i = 0; i < 3; i++) {
            put(out, (uint64_t)n->plane[i], 3);
            put(out, i < 2 ? d >> (32 + 8 * i) : 0, 1);
        }
        put(out, d, 4);
    }
    for (uint32_t i = n->first; i != 0; i = l->b->items[i].next) {
        put(out, item_word(l, i), 4);
    }
}

static void put_polygon(struct bytes *out, const struct builder *b, const struct built_polygon *p)
{
    put(out, p->count, 1);
    for (int i = 0; i < 3; i++) {
        put(out, (uint8_t)p->normal[i], 1);
    }
    put(out, p->look, 2);
    if (b->flags & OW_TREE_IDS) {
        put(out, p->id, 4);
    }
    for (uint32_t i = 0; i < p->count; i++) {
        put(out, b->corners[p->first + i], (b->flags & OW_TREE_INDEX32) ? 4 : 2);
    }
    for (uint32_t i = 0; (p->look & OW_POLYGON_MARKED) && i < (p->count + 15) / 16; i++) {
        put(out, p->marks[i], 2);
    }
}

#define HEAD(name) offsetof(struct ow_disk_header, name)

static void put_counts(struct bytes *out, const struct layout *l)
{
    const struct builder *b = l->b;
    set(out, HEAD(magic), OW_BLOB_MAGIC, 4);
    set(out, HEAD(version), OW_BLOB_VERSION, 2);
    set(out, HEAD(header_bytes), sizeof(struct ow_disk_header), 2);
    set(out, HEAD(flags), b->flags, 4);
    set(out, HEAD(polygon_count), b->polygon_count, 4);
    set(out, HEAD(face_count), l->faces, 4);
    set(out, HEAD(vertex_count), b->vertex_count, 4);
    set(out, HEAD(node_count), l->count, 4);
    set(out, HEAD(switch_count), l->switches, 4);
    set(out, HEAD(depth), l->depth, 4);
    set(out, HEAD(max_corners), l->max_corners, 4);
    set(out, HEAD(colour_count), b->colour_count, 4);
    set(out, HEAD(instance_count), l->instances, 4);
    set(out, HEAD(tolerance_q8), 256, 4);
    uint64_t bits;
    for (size_t i = 0; i < 3; i++) {
        memcpy(&bits, &b->origin[i], 8);
        set(out, HEAD(origin_bits) + 8 * i, bits, 8);
    }
    memcpy(&bits, &b->step, 8);
    set(out, HEAD(step_bits), bits, 8);
}

static void put_box(struct bytes *out, const struct builder *b)
{
    for (size_t i = 0; i < 3; i++) {
        int16_t low = b->vertex_count ? b->vertices[0][i] : 0, high = low;
        for (uint32_t k = 1; k < b->vertex_count; k++) {
            low = b->vertices[k][i] < low ? b->vertices[k][i] : low;
            high = b->vertices[k][i] > high ? b->vertices[k][i] : high;
        }
        set(out, HEAD(box_min) + 2 * i, (uint16_t)low, 2);
        set(out, HEAD(box_max) + 2 * i, (uint16_t)high, 2);
    }
}

static void put_sections(struct bytes *out, const struct layout *l)
{
    const struct builder *b = l->b;
    set(out, HEAD(nodes_at), out->size, 4);
    for (uint32_t i = 0; i < l->count; i++) {
        put_node(out, l, &b->nodes[l->order[i]]);
    }
    set(out, HEAD(polygons_at), out->size, 4);
    for (uint32_t i = 0; i < b->polygon_count; i++) {
        put_polygon(out, b, &b->polygons[i]);
    }
    pad(out);
    set(out, HEAD(vertices_at), out->size, 4);
    for (uint32_t i = 0; i < 3 * b->vertex_count; i++) {
        put(out, (uint16_t)b->vertices[i / 3][i % 3], 2);
    }
    pad(out);
    set(out, HEAD(normals_at), out->size, 4);
    for (uint32_t i = 0; (b->flags & OW_TREE_NORMALS) && i < 3 * b->vertex_count; i++) {
        put(out, i % 3 == 2 ? 127 : 0, 1);
    }
    pad(out);
    set(out, HEAD(colours_at), out->size, 4);
    for (uint32_t i = 0; i < b->colour_count; i++) {
        put(out, b->colours[i], 4);
    }
    set(out, HEAD(instances_at), out->size, 4);
    for (uint32_t i = 0; i < b->instance_count; i++) {
        const struct built_instance *o = &b->instances[i];
        put(out, l->node_at[o->root] / 4, 4);
        put(out, o->first_vertex, 4);
        put(out, 0, 4);
        for (int k = 0; k < 9; k++) {
            put(out, (uint16_t)(k < 6 ? o->region[k / 3][k % 3] : o->centre[k % 3]), 2);
        }
        put(out, o->radius, 2);
    }
}

uint8_t *builder_finish(const struct builder *b, uint32_t root, uint32_t *size)
{
    struct layout *l = calloc(1, sizeof *l);
    assert(l != NULL);
    l->b = b;
    order_nodes(l, root);
    order_polygons(l);
    struct bytes out = { NULL, 0, 0 };
    for (size_t i = 0; i < sizeof(struct ow_disk_header); i++) {
        put(&out, 0, 1);
    }
    put_sections(&out, l);
    put_counts(&out, l);
    put_box(&out, b);
    set(&out, HEAD(blob_bytes), out.size, 4);
    free(l);
    *size = (uint32_t)out.size;
    /* Exactly as large as the blob, so that a sanitizer sees a read beyond it. */
    uint8_t *exact = malloc(out.size);
    assert(exact != NULL);
    memcpy(exact, out.data, out.size);
    free(out.data);
    blob_seal(exact, *size);
    return exact;
}

/* ---- the sample ----------------------------------------------------------------------------- */
/*
 * A switch on z = 0 with a two-sided square in the plane; in front a bounded
 * sequence of two triangles; behind a second switch with a marked pentagon.
 */
uint8_t *builder_sample(uint32_t flags, uint32_t *size)
{
    static const int square[4][3] = {
        { -900, -900, 0 }, { 900, -900, 0 }, { 900, 900, 0 }, { -900, 900, 0 }
    };
    static const int five[5][3] = { { -800, -700, -500 },
                                    { 700, -800, -500 },
                                    { 900, 300, -500 },
                                    { 0, 950, -500 },
                                    { -900, 200, -500 } };
    static const int near_one[3][3] = { { -500, -400, 300 }, { 600, -300, 300 }, { 0, 700, 300 } };
    static const int near_two[3][3] = { { -300, -600, 600 },
                                        { 500, 100, 600 },
                                        { -200, 500, 600 } };
    static const int far_one[3][3] = { { -900, -900, -800 },
                                       { 900, -900, -900 },
                                       { 0, 900, -850 } };
    struct builder *b = builder_new(flags | OW_TREE_TWO_SIDED);
    uint32_t corners[5];
    uint32_t red = builder_colour(b, 0xC04030), blue = builder_colour(b, 0x3040C0);
    for (int i = 0; i < 4; i++) {
        corners[i] = builder_vertex(b, square[i][0], square[i][1], square[i][2]);
    }
    uint32_t middle = builder_polygon(b, corners, 4, red, 1);
    for (int i = 0; i < 5; i++) {
        corners[i] = builder_vertex(b, five[i][0], five[i][1], five[i][2]);
    }
    uint32_t pentagon = builder_polygon(b, corners, 5, blue, 2);
    builder_mark(b, pentagon, 3);
    uint32_t one = builder_triangle(b, near_one, blue, 3);
    uint32_t two = builder_triangle(b, near_two, red, 4);
    uint32_t far = builder_triangle(b, far_one, red, 5);
    uint32_t root = builder_switch(b, (const int64_t[4]){ 0, 0, 1, 0 });
    builder_add(b, root, OW_ITEM_FACE, middle);
    builder_add(b, root, OW_ITEM_REVERSE, middle);
    uint32_t front = builder_sequence(b),
             back = builder_switch(b, (const int64_t[4]){ 0, 0, 1, 500 });
    builder_bound(b, front);
    builder_bound(b, back);
    builder_child(b, root, 0, OW_ITEM_NODE, front);
    builder_child(b, root, 1, OW_ITEM_NODE, back);
    builder_add(b, front, OW_ITEM_FACE, one);
    builder_add(b, front, OW_ITEM_FACE, two);
    builder_add(b, front, OW_ITEM_REVERSE, two);
    builder_add(b, front, OW_ITEM_REVERSE, one);
    builder_add(b, back, OW_ITEM_FACE, pentagon);
    builder_add(b, back, OW_ITEM_REVERSE, pentagon);
    builder_child(b, back, 1, OW_ITEM_FACE, far);
    uint8_t *bytes = builder_finish(b, root, size);
    free(b);
    return bytes;
}
