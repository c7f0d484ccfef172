/* SPDX-License-Identifier: 0BSD */
/*
 * Cutting a piece by a plane. Corners have a side: 1, 0 (on the plane) or -1.
 * Corners on the plane go with their neighbours, to the front where these
 * differ, so that each edge of the outline goes into one of the two pieces
 * alone. Where the outline passes from one side to the other there is a
 * crossing: a corner on the plane or a new vertex. Each piece runs along the
 * outline on its side and from crossing to crossing along the cut.
 */
#include "split.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/common/xalloc.h"

enum split_side split_side_of(const struct arrangement *arrangement, const struct pieces *pieces,
                              uint32_t number, uint32_t plane)
{
    const struct piece *piece = &pieces->all[number];
    const uint32_t *vertices = pieces->vertices + piece->first;
    unsigned seen = SPLIT_ON;
    if (piece->record == plane) {
        return SPLIT_ON;
    }
    for (uint32_t i = 0; i < piece->count; i++) {
        int side = arrangement_side(arrangement, plane, vertices[i]);
        seen |= side > 0 ? SPLIT_FRONT : side < 0 ? SPLIT_BACK : SPLIT_ON;
        if (seen == SPLIT_ACROSS) {
            break;
        }
    }
    return seen;
}

/* A cut under way. */
struct cut {
    struct splitter *splitter;
    struct arrangement *arrangement;
    struct pieces *pieces;
    struct piece piece; /* the piece being cut */
    uint32_t plane;
    uint32_t crossing_count;
    uint32_t chord; /* edge word of the cut */
};

static uint32_t after(const struct cut *cut, uint32_t corner)
{
    return corner + 1 < cut->piece.count ? corner + 1 : 0;
}

/* Sides 2 and -2 stand for corners on the plane that go to the front and back. */
static void find_sides(struct cut *cut)
{
    uint32_t count = cut->piece.count;
    const uint32_t *vertices = cut->pieces->vertices + cut->piece.first;
    cut->splitter->sides = xgrow(cut->splitter->sides, &cut->splitter->side_capacity, count, 1);
    int8_t *sides = cut->splitter->sides;
    uint32_t start = count;
    for (uint32_t i = 0; i < count; i++) {
        sides[i] = (int8_t)arrangement_side(cut->arrangement, cut->plane, vertices[i]);
        start = sides[i] != 0 ? i : start;
    }
    /* Round the outline from a corner that is not on the plane. */
    int8_t before = sides[start];
    for (uint32_t n = 0, i = start; n < count;) {
        uint32_t run = i;
        uint32_t length = 0;
        while (sides[run] == 0) {
            run = after(cut, run);
            length++;
        }
        int8_t side = before < 0 && sides[run] < 0 ? -2 : 2;
        for (uint32_t k = i; k != run; k = after(cut, k)) {
            sides[k] = side;
        }
        before = sides[run];
        i = after(cut, run);
        n += length + 1;
    }
}

static uint32_t vertex_at(const struct cut *cut, uint32_t corner)
{
    return cut->pieces->vertices[cut->piece.first + corner];
}

static uint32_t edge_at(const struct cut *cut, uint32_t corner)
{
    return cut->pieces->edges[cut->piece.first + corner];
}

static void add_crossing(struct cut *cut, uint32_t vertex)
{
    struct splitter *s = cut->splitter;
    s->crossings = xgrow(s->crossings, &s->crossing_capacity, (size_t)cut->crossing_count + 1,
                         sizeof *s->crossings);
    s->crossings[cut->crossing_count++] = vertex;
}

/* The crossings, one for each change of side from a corner to the next, in order. */
static void find_crossings(struct cut *cut)
{
    const int8_t *sides = cut->splitter->sides;
    for (uint32_t i = 0; i < cut->piece.count; i++) {
        uint32_t next = after(cut, i);
        if ((sides[i] > 0) == (sides[next] > 0)) {
            continue;
        }
        if (sides[i] == 2) {
            add_crossing(cut, vertex_at(cut, i));
        } else if (sides[next] == 2) {
            add_crossing(cut, vertex_at(cut, next));
        } else {
            add_crossing(cut, arrangement_cut(cut->arrangement, edge_at(cut, i) >> 1, cut->plane,
                                              vertex_at(cut, i), vertex_at(cut, next)));
        }
    }
}

/* The cut's line: only where two crossings differ is there one. */
static void find_chord(struct cut *cut)
{
    const uint32_t *crossings = cut->splitter->crossings;
    for (uint32_t i = 1; i < cut->crossing_count; i++) {
        if (crossings[i] != crossings[0]) {
            uint32_t line = arrangement_chord(cut->arrangement, cut->piece.record, cut->plane,
                                              crossings, cut->crossing_count);
            cut->chord = line << 1 | 1;
            return;
        }
    }
}

/* A corner of the new piece; an edge of the cut that leads from a vertex to itself is left out. */
static void put_corner(struct cut *cut, uint32_t vertex, uint32_t edge, const float *normal)
{
    struct pieces *pieces = cut->pieces;
    struct piece *piece = &pieces->all[pieces->count - 1];
    if (piece->count > 0 && pieces->vertices[pieces->corner_count - 1] == vertex) {
        pieces->corner_count--;
        piece->count--;
    }
    pieces_add_corner(pieces, vertex, edge, normal);
}

/* The normal at the crossing between two corners. */
static void normal_between(const struct cut *cut, uint32_t corner, float normal[3])
{
    const struct plane *plane = &cut->arrangement->planes->all[cut->plane];
    uint32_t next = after(cut, corner);
    const float *a = cut->pieces->normals[cut->piece.first + corner];
    const float *b = cut->pieces->normals[cut->piece.first + next];
    double s = fabs(arrangement_height(cut->arrangement, plane, vertex_at(cut, corner)));
    double t = fabs(arrangement_height(cut->arrangement, plane, vertex_at(cut, next)));
    double share = s + t > 0 ? s / (s + t) : 0;
    for (int k = 0; k < 3; k++) {
        normal[k] = (float)(a[k] + share * ((double)b[k] - a[k]));
    }
}

static void put_own(struct cut *cut, uint32_t corner, uint32_t edge)
{
    float normal[3] = { 0, 0, 0 };
    if (cut->pieces->with_normals) {
        memcpy(normal, cut->pieces->normals[cut->piece.first + corner], sizeof normal);
    }
    put_corner(cut, vertex_at(cut, corner), edge, normal);
}

static void put_crossing(struct cut *cut, uint32_t corner, uint32_t vertex, uint32_t edge)
{
    float normal[3] = { 0, 0, 0 };
    if (cut->pieces->with_normals) {
        normal_between(cut, corner, normal);
    }
    put_corner(cut, vertex, edge, normal);
}

/* What a piece gets of the edge from a corner to the next; front: the front piece. */
static void put_edge(struct cut *cut, uint32_t corner, bool front, uint32_t *crossing)
{
    const int8_t *sides = cut->splitter->sides;
    uint32_t next = after(cut, corner);
    bool here = (sides[corner] > 0) == front;
    bool there = (sides[next] > 0) == front;
    uint32_t edge = edge_at(cut, corner);
    if (here && there) {
        put_own(cut, corner, edge);
    }
    if (here == there) {
        return;
    }
    uint32_t vertex = cut->splitter->crossings[(*crossing)++];
    if (sides[corner] == 2) { /* the crossing is this corner; the edge belongs to the back */
        put_own(cut, corner, front ? cut->chord : edge);
    } else if (sides[next] == 2) { /* the crossing is the next corner; likewise */
        if (!front) {
            put_own(cut, corner, edge);
            put_own(cut, next, cut->chord);
        }
    } else if (here) {
        put_own(cut, corner, edge);
        put_crossing(cut, corner, vertex, cut->chord);
    } else {
        put_crossing(cut, corner, vertex, edge);
    }
}

static uint32_t put_piece(struct cut *cut, bool front)
{
    struct pieces *pieces = cut->pieces;
    uint32_t number = pieces_add(pieces, cut->piece.polygon, cut->piece.record);
    uint32_t crossing = 0;
    for (uint32_t i = 0; i < cut->piece.count; i++) {
        put_edge(cut, i, front, &crossing);
    }
    struct piece *piece = &pieces->all[number];
    if (piece->count > 1 &&
        pieces->vertices[pieces->corner_count - 1] == pieces->vertices[piece->first]) {
        piece->count--;
        pieces->corner_count--;
    }
    return number;
}

void split_piece(struct splitter *splitter, struct arrangement *arrangement, struct pieces *pieces,
                 uint32_t piece, uint32_t plane, uint32_t *front, uint32_t *back)
{
    struct cut cut = { splitter, arrangement, pieces, pieces->all[piece], plane, 0, 0 };
    find_sides(&cut);
    find_crossings(&cut);
    find_chord(&cut);
    *front = put_piece(&cut, true);
    *back = put_piece(&cut, false);
    pieces->cuts = xgrow(pieces->cuts, &pieces->cut_capacity, (size_t)pieces->splits + 1,
                         sizeof *pieces->cuts);
    pieces->cuts[pieces->splits++] = (struct piece_cut){
        cut.piece.polygon,
        plane,
        { splitter->crossings[0], splitter->crossings[cut.crossing_count - 1] },
    };
}

void splitter_free(struct splitter *splitter)
{
    free(splitter->sides);
    free(splitter->crossings);
    *splitter = (struct splitter){ 0 };
}
