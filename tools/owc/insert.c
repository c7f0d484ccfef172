/* SPDX-License-Identifier: 0BSD */
/*
 * Adding polygons to a tree that was read back. Its records become polygons of
 * the mesh again: those that lie in a switch's plane belong to that plane, the
 * others get planes of their own. Then every new piece sinks through the switches.
 */
#include "insert.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "blob_node.h"
#include "closed.h"
#include "map64.h"
#include "online.h"
#include "tools/common/xalloc.h"

enum { NORMAL_LIMIT = (1 << NORMAL_BITS) - 1 };

/* ---- beginning ---- */

/* Every node is a switch, or a sequence of faces that needs none. */
static bool has_plain_nodes(const struct ow_tree *tree)
{
    uint32_t at = tree->nodes_at;
    for (uint32_t i = 0; i < tree->node_count; i++) {
        struct blob_node node = blob_node_at(tree, at);
        if (!node.is_switch && node.count == 0) {
            return false;
        }
        for (uint32_t k = 0; k < node.count; k++) {
            if (blob_item_tag(ow_read_u32(tree->bytes, node.items_at + 4 * k)) == OW_ITEM_NODE) {
                return false;
            }
        }
        at = node.end_at;
    }
    return tree->polygon_count > 0;
}

bool insertion_begin(struct insertion *insertion, const struct blob_file *file,
                     struct problem *problem)
{
    const struct ow_tree *tree = &file->tree;
    *insertion = (struct insertion){ .file = file };
    if (!(tree->flags & OW_TREE_SWITCH_ONLY) || !has_plain_nodes(tree)) {
        return problem_set(problem, 0,
                           "sequences order its faces: only trees of --method bsp or "
                           "online can be added to, compile all models together");
    }
    insertion->record_at = xalloc(tree->polygon_count, sizeof *insertion->record_at);
    insertion->plane_of = xalloc(tree->node_count, sizeof *insertion->plane_of);
    uint32_t at = tree->polygons_at;
    for (uint32_t i = 0; i < tree->polygon_count; i++) {
        insertion->record_at[i] = at;
        at += ow_polygon_bytes(tree, at);
    }
    return true;
}

void insertion_free(struct insertion *insertion)
{
    free(insertion->record_at);
    free(insertion->plane_of);
    *insertion = (struct insertion){ 0 };
}

/* ---- the model ---- */

static bool lies_in_cube(const struct lattice *lattice, const double at[3])
{
    double scaled[3];
    lattice_scale(lattice, at, scaled);
    for (int k = 0; k < 3; k++) {
        if (!(fabs(scaled[k]) <= OW_LATTICE_MAX + 0.5)) {
            return false;
        }
    }
    return true;
}

/* The tree's colours come first, so that its records keep their numbers. */
static uint16_t add_colour(struct model *model, uint32_t *colours, uint32_t *count, uint32_t colour)
{
    uint32_t nearest = 0;
    int64_t least = INT64_MAX;
    for (uint32_t i = 0; i < *count; i++) {
        int64_t distance = 0;
        for (int shift = 0; shift < 24; shift += 8) {
            int64_t step = (int64_t)(colours[i] >> shift & 255) - (int64_t)(colour >> shift & 255);
            distance += step * step;
        }
        if (distance < least) {
            least = distance;
            nearest = i;
        }
    }
    if (least > 0 && *count < OW_MAX_COLOURS) {
        colours[*count] = colour;
        return (uint16_t)(*count)++;
    }
    model->colours_changed += least > 0;
    return (uint16_t)nearest;
}

static void add_colours(const struct ow_tree *tree, struct model *model)
{
    uint32_t *colours = xalloc(OW_MAX_COLOURS, sizeof *colours);
    uint16_t *changed = xalloc(model->colour_count, sizeof *changed);
    uint32_t count = tree->colour_count;
    for (uint32_t i = 0; i < count; i++) {
        colours[i] = ow_read_u32(tree->bytes, tree->colours_at + 4 * i);
    }
    for (size_t i = 0; i < model->colour_count; i++) {
        changed[i] = add_colour(model, colours, &count, model->colours[i]);
    }
    for (size_t i = 0; i < model->polygon_count; i++) {
        model->polygons[i].colour = changed[model->polygons[i].colour];
    }
    free(changed);
    free(model->colours);
    model->colours = colours;
    model->colour_count = count;
    model->colour_capacity = OW_MAX_COLOURS;
}

bool insertion_take(const struct insertion *insertion, struct model *model, struct problem *problem)
{
    const struct lattice *lattice = &insertion->file->lattice;
    for (size_t i = 0; i < model->polygon_count; i++) {
        const struct model_polygon *polygon = &model->polygons[i];
        for (uint32_t k = 0; k < polygon->count; k++) {
            const double *at = model->vertices[model->corners[polygon->first + k]];
            if (!lies_in_cube(lattice, at)) {
                return problem_set(problem, 0,
                                   "polygon %zu has a corner at %g,%g,%g, outside the tree's "
                                   "cube: recompile the models together",
                                   i + 1, at[0], at[1], at[2]);
            }
        }
    }
    add_colours(&insertion->file->tree, model);
    return true;
}

/* ---- the mesh ---- */

struct joiner {
    const struct ow_tree *tree;
    const struct insertion *insertion;
    struct mesh *mesh;   /* the joined one */
    struct map64 points; /* lattice coordinates to point numbers */
    size_t point_capacity;
    size_t corner_capacity;
    size_t mark_capacity;
    size_t normal_capacity;
};

static uint32_t number_point(struct joiner *j, const int16_t at[3])
{
    uint64_t key =
        (uint64_t)(uint16_t)at[0] << 32 | (uint64_t)(uint16_t)at[1] << 16 | (uint16_t)at[2];
    uint32_t point = map64_put(&j->points, key, j->mesh->point_count);
    if (point == j->mesh->point_count) {
        j->mesh->points =
            xgrow(j->mesh->points, &j->point_capacity, point + 1u, sizeof *j->mesh->points);
        memcpy(j->mesh->points[point], at, sizeof j->mesh->points[0]);
        j->mesh->point_count++;
    }
    return point;
}

static void put_corner(struct joiner *j, const int16_t at[3], uint8_t mark, const float *normal)
{
    struct mesh *mesh = j->mesh;
    size_t corner = mesh->corner_count++;
    mesh->corners = xgrow(mesh->corners, &j->corner_capacity, corner + 1, sizeof *mesh->corners);
    mesh->marks = xgrow(mesh->marks, &j->mark_capacity, corner + 1, sizeof *mesh->marks);
    mesh->corners[corner] = number_point(j, at);
    mesh->marks[corner] = mark;
    if (normal != NULL) {
        mesh->normals =
            xgrow(mesh->normals, &j->normal_capacity, corner + 1, sizeof *mesh->normals);
        memcpy(mesh->normals[corner], normal, sizeof mesh->normals[0]);
    }
}

static void read_corner(struct joiner *j, uint32_t vertex, uint8_t mark)
{
    const struct ow_tree *tree = j->tree;
    int16_t at[3];
    float normal[3];
    for (uint32_t k = 0; k < 3; k++) {
        at[k] =
            (int16_t)ow_read_i16(tree->bytes, tree->vertices_at + vertex * OW_VERTEX_BYTES + 2 * k);
    }
    if (!(tree->flags & OW_TREE_NORMALS)) {
        put_corner(j, at, mark, NULL);
        return;
    }
    for (uint32_t k = 0; k < 3; k++) {
        int32_t byte = ow_read_i8(tree->bytes, tree->normals_at + vertex * OW_NORMAL_BYTES + k);
        normal[k] = (float)byte / 127;
    }
    put_corner(j, at, mark, normal);
}

static void read_record(struct joiner *j, uint32_t number, struct mesh_polygon *polygon)
{
    const struct ow_tree *tree = j->tree;
    const uint8_t *bytes = tree->bytes;
    uint32_t at = j->insertion->record_at[number];
    uint32_t look = ow_read_u16(bytes, at + 4);
    uint32_t wide_corner = (tree->flags & OW_TREE_INDEX32) ? 4 : 2;
    uint32_t corner_at = at + tree->corners_in_record;
    uint32_t count = ow_read_u8(bytes, at);
    uint32_t marks_at = corner_at + count * wide_corner;
    *polygon = (struct mesh_polygon){
        .first = j->mesh->corner_count,
        .count = count,
        .source = (tree->flags & OW_TREE_IDS) ? ow_read_u32(bytes, at + OW_POLYGON_HEAD_BYTES)
                                              : number + 1,
        .record = MESH_NONE,
        .colour = (uint16_t)(look & OW_POLYGON_COLOUR_MASK),
    };
    for (uint32_t i = 0; i < count; i++, corner_at += wide_corner) {
        uint32_t mark = (look & OW_POLYGON_MARKED)
                            ? ow_read_u16(bytes, marks_at + i / 16 * 2) >> i % 16 & 1
                            : 0;
        read_corner(
            j, wide_corner == 4 ? ow_read_u32(bytes, corner_at) : ow_read_u16(bytes, corner_at),
            (uint8_t)mark);
    }
}

/* New polygons are numbered on from the tree's highest number. */
static void join_meshes(struct joiner *j, const struct mesh *added)
{
    struct mesh *mesh = j->mesh;
    uint32_t old = j->tree->polygon_count;
    uint32_t highest = 0;
    mesh->polygon_count = old + added->polygon_count;
    mesh->polygons = xalloc(mesh->polygon_count, sizeof *mesh->polygons);
    for (uint32_t i = 0; i < old; i++) {
        read_record(j, i, &mesh->polygons[i]);
        highest = mesh->polygons[i].source > highest ? mesh->polygons[i].source : highest;
    }
    for (uint32_t i = 0; i < added->polygon_count; i++) {
        struct mesh_polygon *polygon = &mesh->polygons[old + i];
        const struct mesh_polygon *from = &added->polygons[i];
        *polygon = *from;
        polygon->first = mesh->corner_count;
        polygon->source += highest;
        for (size_t k = from->first; k < from->first + from->count; k++) {
            put_corner(j, added->points[added->corners[k]], added->marks[k],
                       added->normals ? added->normals[k] : NULL);
        }
    }
}

/* ---- planes ---- */

static int64_t height(const struct mesh *mesh, size_t corner, const int32_t n[3], int64_t d)
{
    const int16_t *p = mesh->points[mesh->corners[corner]];
    return (int64_t)n[0] * p[0] + (int64_t)n[1] * p[1] + (int64_t)n[2] * p[2] + d;
}

static bool looks_against(const struct mesh *mesh, const struct mesh_polygon *polygon,
                          const int32_t n[3])
{
    int64_t area[3];
    mesh_area((const int16_t(*)[3])mesh->points, mesh->corners + polygon->first, polygon->count,
              area);
    return (double)area[0] * n[0] + (double)area[1] * n[1] + (double)area[2] * n[2] < 0;
}

static uint32_t polygon_of(const struct insertion *insertion, uint32_t item)
{
    const struct ow_tree *tree = &insertion->file->tree;
    uint32_t at = tree->polygons_at + 2 * (item >> OW_ITEM_TAG_BITS);
    uint32_t low = 0;
    uint32_t high = tree->polygon_count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (insertion->record_at[middle] <= at) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

/* A switch's plane; its faces belong to it, as far off it as rounding left their corners. */
static uint32_t add_switch_plane(const struct insertion *insertion, struct mesh *mesh,
                                 struct planes *planes, const struct blob_node *node)
{
    const struct ow_tree *tree = &insertion->file->tree;
    int32_t n[3];
    int64_t d = blob_plane(tree, node->plane_at, n);
    int64_t reach = 0;
    for (uint32_t k = 0; k < node->count; k++) {
        uint32_t item = ow_read_u32(tree->bytes, node->items_at + 4 * k);
        struct mesh_polygon *polygon = &mesh->polygons[polygon_of(insertion, item)];
        polygon->record = planes->count;
        polygon->reversed = looks_against(mesh, polygon, n);
        for (size_t i = polygon->first; i < polygon->first + polygon->count; i++) {
            int64_t size = llabs(height(mesh, i, n, d));
            reach = size > reach ? size : reach;
        }
    }
    return plane_add(planes, n, d, reach);
}

/* A plane through the middle of a polygon's corners, for a record that no switch belongs to. */
static void add_own_plane(struct mesh *mesh, struct planes *planes, struct mesh_polygon *polygon)
{
    int16_t(*points)[3] = mesh->points;
    const uint32_t *corners = mesh->corners + polygon->first;
    int32_t n[3];
    int64_t d = 0;
    polygon->record = planes->count;
    if (polygon->count == 3 &&
        plane_of_triangle(points[corners[0]], points[corners[1]], points[corners[2]], n, &d)) {
        plane_add(planes, n, d, 0);
        return;
    }
    int64_t area[3];
    int64_t range[2] = { INT64_MAX, INT64_MIN };
    mesh_area((const int16_t(*)[3])points, corners, polygon->count, area);
    int64_t greatest = llabs(area[0]) > llabs(area[1]) ? llabs(area[0]) : llabs(area[1]);
    greatest = llabs(area[2]) > greatest ? llabs(area[2]) : greatest;
    for (int k = 0; k < 3; k++) { /* without an area any plane will do */
        double share = greatest > 0 ? (double)area[k] / (double)greatest : k == 2;
        n[k] = (int32_t)floor(share * NORMAL_LIMIT + 0.5);
    }
    for (size_t i = polygon->first; i < polygon->first + polygon->count; i++) {
        int64_t value = height(mesh, i, n, 0);
        range[0] = value < range[0] ? value : range[0];
        range[1] = value > range[1] ? value : range[1];
    }
    d = -(range[0] + range[1]) / 2;
    int64_t low = llabs(range[0] + d);
    int64_t high = llabs(range[1] + d);
    plane_add(planes, n, d, low > high ? low : high);
}

void insertion_join(struct insertion *insertion, struct mesh *mesh, struct planes *planes)
{
    const struct ow_tree *tree = &insertion->file->tree;
    struct mesh added = *mesh;
    struct joiner joiner = { .tree = tree, .insertion = insertion, .mesh = mesh };
    *mesh = (struct mesh){ .lattice = added.lattice,
                           .uneven_cut = added.uneven_cut,
                           .degenerate_dropped = added.degenerate_dropped,
                           .degenerate_kept = added.degenerate_kept,
                           .repeated_dropped = added.repeated_dropped };
    join_meshes(&joiner, &added);
    mesh->closed = (tree->flags & OW_TREE_CLOSED) && added.closed && closed_mesh(mesh);
    insertion->new_first = tree->polygon_count;
    uint32_t at = tree->nodes_at;
    for (uint32_t i = 0; i < tree->node_count; i++) {
        struct blob_node node = blob_node_at(tree, at);
        insertion->plane_of[i] =
            node.is_switch ? add_switch_plane(insertion, mesh, planes, &node) : MESH_NONE;
        at = node.end_at;
    }
    for (uint32_t i = 0; i < insertion->new_first; i++) {
        if (mesh->polygons[i].record == MESH_NONE) {
            add_own_plane(mesh, planes, &mesh->polygons[i]);
        }
    }
    map64_free(&joiner.points);
    mesh_discard(&added);
}

/* ---- the tree ---- */

struct reader {
    const struct insertion *insertion;
    struct online *online;
    const struct pieces *pieces;
    uint32_t *number_of; /* of each node of the tree: its number in online */
    uint32_t met;        /* nodes met so far: the next node item is the node of this number */
};

static void add_items(struct reader *r, uint32_t number, const struct blob_node *node)
{
    const struct ow_tree *tree = &r->insertion->file->tree;
    for (uint32_t i = 0; i < node->count; i++) {
        uint32_t item = ow_read_u32(tree->bytes, node->items_at + 4 * i);
        if (blob_item_tag(item) == OW_ITEM_FACE) { /* its reverse comes of itself */
            online_add_face(r->online, number, polygon_of(r->insertion, item));
        }
    }
}

/* A node that a node item leads to; a sequence takes the plane of its first face. */
static uint32_t add_node(struct reader *r, uint32_t at)
{
    const struct ow_tree *tree = &r->insertion->file->tree;
    struct blob_node node = blob_node_at(tree, at);
    uint32_t plane = r->insertion->plane_of[r->met];
    if (!node.is_switch) {
        uint32_t item = ow_read_u32(tree->bytes, node.items_at);
        plane = r->pieces->all[polygon_of(r->insertion, item)].record;
    }
    uint32_t number = online_add_node(r->online, plane);
    r->number_of[r->met++] = number;
    add_items(r, number, &node);
    return number;
}

static uint32_t add_child(struct reader *r, uint32_t item)
{
    if (item == OW_ITEM_NONE) {
        return MESH_NONE;
    }
    if (blob_item_tag(item) == OW_ITEM_NODE) {
        return add_node(r, blob_item_node_at(&r->insertion->file->tree, item));
    }
    uint32_t piece = polygon_of(r->insertion, item);
    uint32_t number = online_add_node(r->online, r->pieces->all[piece].record);
    online_add_face(r->online, number, piece);
    return number;
}

static void read_tree(struct online *online, const struct insertion *insertion)
{
    const struct ow_tree *tree = &insertion->file->tree;
    struct reader r = { .insertion = insertion, .online = online, .pieces = online->pieces };
    r.number_of = xalloc(tree->node_count, sizeof *r.number_of);
    add_node(&r, tree->nodes_at);
    uint32_t at = tree->nodes_at;
    for (uint32_t i = 0; i < tree->node_count; i++) {
        struct blob_node node = blob_node_at(tree, at);
        if (node.is_switch) {
            uint32_t front = add_child(&r, ow_read_u32(tree->bytes, node.children_at));
            uint32_t back = add_child(&r, ow_read_u32(tree->bytes, node.children_at + 4));
            online->nodes[r.number_of[i]].front = front;
            online->nodes[r.number_of[i]].back = back;
        }
        at = node.end_at;
    }
    free(r.number_of);
}

void insertion_build(struct tree *tree, const struct insertion *insertion,
                     struct arrangement *arrangement, struct pieces *pieces, bool two_sided,
                     struct progress *progress)
{
    struct online online;
    uint32_t count = pieces->count;
    online_begin(&online, arrangement, pieces);
    read_tree(&online, insertion);
    for (uint32_t i = insertion->new_first; i < count; i++) {
        online_insert(&online, i);
        if (progress != NULL) {
            progress_show(progress, "adding", i - insertion->new_first,
                          count - insertion->new_first);
        }
    }
    online_to_tree(tree, &online, two_sided);
    online_free(&online);
}
