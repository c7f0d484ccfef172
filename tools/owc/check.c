/* SPDX-License-Identifier: 0BSD */
/* Whether a mesh is sound: its edges, its parts and their winding. */
#include "check.h"

#include <stdlib.h>
#include <string.h>

#include "closed.h"
#include "crossings.h"
#include "exact.h"
#include "tools/common/fail.h"
#include "tools/common/xalloc.h"

enum { MOST_COMPARED = 200000000 };

/* An edge of a polygon, from the lower point number to the higher one. */
struct side {
    uint32_t low;
    uint32_t high;
    uint32_t polygon;
    bool backwards; /* the polygon runs from high to low */
};

/* Two polygons at an edge. */
struct link {
    uint32_t polygons[2];
    bool twisted;
};

struct part {
    wide volume; /* six times */
    int16_t low[3];
    int16_t high[3];
    bool closed; /* each edge has two polygons */
    bool orientable;
    bool mixed; /* its polygons' windings disagree */
};

struct checker {
    struct mesh *mesh;
    struct mesh_check *check;
    struct side *sides;
    size_t side_count;
    struct link *links;
    size_t link_count;
    uint32_t *part_of; /* of each polygon: a union-find forest, then the part's number */
    bool *turned;      /* polygons that run against the first of their part */
    struct part *parts;
    uint64_t compared; /* pairs of parts */
};

static int compare_sides(const void *left, const void *right)
{
    const struct side *a = left;
    const struct side *b = right;
    return a->low != b->low     ? (a->low > b->low) - (a->low < b->low)
           : a->high != b->high ? (a->high > b->high) - (a->high < b->high)
                                : (a->polygon > b->polygon) - (a->polygon < b->polygon);
}

static void list_sides(struct checker *c)
{
    const struct mesh *mesh = c->mesh;
    c->sides = xalloc(mesh->corner_count, sizeof *c->sides);
    for (uint32_t i = 0; i < mesh->polygon_count; i++) {
        const struct mesh_polygon *polygon = &mesh->polygons[i];
        const uint32_t *corners = mesh->corners + polygon->first;
        for (uint32_t k = 0; k < polygon->count; k++) {
            uint32_t a = corners[k];
            uint32_t b = corners[k + 1 < polygon->count ? k + 1 : 0];
            c->sides[c->side_count++] =
                a < b ? (struct side){ a, b, i, false } : (struct side){ b, a, i, true };
        }
    }
    qsort(c->sides, c->side_count, sizeof *c->sides, compare_sides);
}

static void judge_edges(struct checker *c)
{
    c->links = xalloc(c->side_count / 2, sizeof *c->links);
    for (size_t i = 0, end; i < c->side_count; i = end) {
        const struct side *side = &c->sides[i];
        end = i + 1;
        while (end < c->side_count && c->sides[end].low == side->low &&
               c->sides[end].high == side->high) {
            end++;
        }
        c->check->open_edges += end - i == 1;
        c->check->forked_edges += end - i > 2;
        if (end - i == 2) {
            bool twisted = side->backwards == side[1].backwards;
            c->check->twisted_edges += twisted;
            c->links[c->link_count++] =
                (struct link){ { side->polygon, side[1].polygon }, twisted };
        }
    }
}

/* ---- parts ---- */

static uint32_t find_root(uint32_t *parents, uint32_t i)
{
    while (parents[i] != i) {
        parents[i] = parents[parents[i]];
        i = parents[i];
    }
    return i;
}

static void find_parts(struct checker *c)
{
    uint32_t count = c->mesh->polygon_count;
    c->part_of = xalloc(count, sizeof *c->part_of);
    for (uint32_t i = 0; i < count; i++) {
        c->part_of[i] = i;
    }
    for (size_t i = 0; i < c->link_count; i++) {
        uint32_t a = find_root(c->part_of, c->links[i].polygons[0]);
        uint32_t b = find_root(c->part_of, c->links[i].polygons[1]);
        c->part_of[a > b ? a : b] = a < b ? a : b;
    }
    for (uint32_t i = 0; i < count; i++) { /* roots come before what hangs on them */
        uint32_t root = find_root(c->part_of, i);
        c->part_of[i] = root == i ? i : root;
    }
    uint32_t *numbers = xalloc(count, sizeof *numbers);
    for (uint32_t i = 0; i < count; i++) {
        numbers[i] = c->part_of[i] == i ? c->check->parts++ : numbers[c->part_of[i]];
    }
    free(c->part_of);
    c->part_of = numbers;
}

/* Finds which polygons to turn over so that all of a part agree. */
static void compare_windings(struct checker *c)
{
    uint32_t count = c->mesh->polygon_count;
    size_t *first = xalloc_zero((size_t)count + 2, sizeof *first);
    uint32_t *of = xalloc(2 * c->link_count, sizeof *of); /* links of each polygon */
    bool *seen = xalloc_zero(count, sizeof *seen);
    uint32_t *queue = xalloc(count, sizeof *queue);
    for (size_t i = 0; i < 2 * c->link_count; i++) {
        first[c->links[i / 2].polygons[i % 2] + 2]++;
    }
    for (uint32_t i = 0; i < count; i++) {
        first[i + 2] += first[i + 1];
    }
    for (size_t i = 0; i < 2 * c->link_count; i++) {
        of[first[c->links[i / 2].polygons[i % 2] + 1]++] = (uint32_t)(i / 2);
    }
    for (uint32_t start = 0; start < count; start++) {
        uint32_t filled = 0;
        if (!seen[start]) {
            queue[filled++] = start;
            seen[start] = true;
        }
        for (uint32_t k = 0; k < filled; k++) {
            uint32_t here = queue[k];
            for (size_t i = first[here]; i < first[here + 1]; i++) {
                const struct link *link = &c->links[of[i]];
                uint32_t there = link->polygons[link->polygons[0] == here];
                bool turned = c->turned[here] != link->twisted;
                if (!seen[there]) {
                    seen[there] = true;
                    c->turned[there] = turned;
                    queue[filled++] = there;
                } else if (c->turned[there] != turned) {
                    c->parts[c->part_of[here]].orientable = false;
                }
            }
        }
    }
    free(first);
    free(of);
    free(seen);
    free(queue);
}

static void add_polygon_to_part(struct checker *c, uint32_t number)
{
    const struct mesh *mesh = c->mesh;
    const struct mesh_polygon *polygon = &mesh->polygons[number];
    const uint32_t *corners = mesh->corners + polygon->first;
    struct part *part = &c->parts[c->part_of[number]];
    int64_t area[3];
    mesh_area((const int16_t(*)[3])mesh->points, corners, polygon->count, area);
    const int16_t *a = mesh->points[corners[0]];
    wide volume = (wide)area[0] * a[0] + (wide)area[1] * a[1] + (wide)area[2] * a[2];
    part->volume += c->turned[number] ? -volume : volume;
    part->mixed = part->mixed || c->turned[number];
    for (uint32_t i = 0; i < polygon->count; i++) {
        for (int k = 0; k < 3; k++) {
            int16_t at = mesh->points[corners[i]][k];
            part->low[k] = at < part->low[k] ? at : part->low[k];
            part->high[k] = at > part->high[k] ? at : part->high[k];
        }
    }
}

static void measure_parts(struct checker *c)
{
    c->parts = xalloc(c->check->parts, sizeof *c->parts);
    c->turned = xalloc_zero(c->mesh->polygon_count, sizeof *c->turned);
    for (uint32_t i = 0; i < c->check->parts; i++) {
        c->parts[i] = (struct part){
            0, { 32767, 32767, 32767 }, { -32767, -32767, -32767 }, true, true, false
        };
    }
    compare_windings(c);
    for (uint32_t i = 0; i < c->mesh->polygon_count; i++) {
        add_polygon_to_part(c, i);
    }
    for (size_t i = 0, end; i < c->side_count; i = end) {
        end = i + 1;
        while (end < c->side_count && c->sides[end].low == c->sides[i].low &&
               c->sides[end].high == c->sides[i].high) {
            end++;
        }
        for (size_t k = i; end - i != 2 && k < end; k++) {
            c->parts[c->part_of[c->sides[k].polygon]].closed = false;
        }
    }
}

static bool lies_in(const struct part *inner, const struct part *outer)
{
    for (int k = 0; k < 3; k++) {
        if (inner->low[k] < outer->low[k] || inner->high[k] > outer->high[k]) {
            return false;
        }
    }
    return true;
}

/* Beyond MOST_COMPARED pairs of parts it says yes, so that nothing is turned that may be right. */
static bool is_in_another(struct checker *c, uint32_t number)
{
    for (uint32_t i = 0; i < c->check->parts; i++) {
        const struct part *other = &c->parts[i];
        if (i != number && other->closed && other->volume > 0 &&
            lies_in(&c->parts[number], other)) {
            return true;
        }
    }
    c->compared += c->check->parts;
    return c->compared > MOST_COMPARED;
}

/* ---- turning over ---- */

static void reverse_words(uint32_t *words, uint32_t count)
{
    for (uint32_t i = 0; i < count / 2; i++) {
        uint32_t word = words[i];
        words[i] = words[count - 1 - i];
        words[count - 1 - i] = word;
    }
}

static void reverse_normals(float (*normals)[3], uint32_t count)
{
    float copy[3];
    for (uint32_t i = 0; i < count / 2; i++) {
        memcpy(copy, normals[i], sizeof copy);
        memcpy(normals[i], normals[count - 1 - i], sizeof copy);
        memcpy(normals[count - 1 - i], copy, sizeof copy);
    }
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            normals[i][k] = -normals[i][k];
        }
    }
}

/* Corner i becomes corner count - 1 - i, so edge i becomes edge count - 2 - i. */
static void turn_over(struct mesh *mesh, struct mesh_polygon *polygon)
{
    uint8_t *marks = mesh->marks + polygon->first;
    uint32_t edges = polygon->count - 1; /* the last one stays the last */
    reverse_words(mesh->corners + polygon->first, polygon->count);
    reverse_words(mesh->sources + polygon->source_first, polygon->source_count);
    for (uint32_t i = 0; i < edges / 2; i++) {
        uint8_t mark = marks[i];
        marks[i] = marks[edges - 1 - i];
        marks[edges - 1 - i] = mark;
    }
    if (mesh->normals != NULL) {
        reverse_normals(mesh->normals + polygon->first, polygon->count);
    }
}

/* A part is turned over if it is closed, and inward whole or in places. */
static void judge_parts(struct checker *c, bool repair)
{
    bool *over = xalloc_zero(c->check->parts, sizeof *over);   /* all of it */
    bool *agree = xalloc_zero(c->check->parts, sizeof *agree); /* what disagrees */
    for (uint32_t i = 0; i < c->check->parts; i++) {
        const struct part *part = &c->parts[i];
        if (!part->closed || !part->orientable) {
            continue;
        }
        agree[i] = true;
        over[i] = part->volume < 0;
        if (part->volume < 0 && !part->mixed) {
            bool cavity = is_in_another(c, i);
            over[i] = !cavity;
            c->check->cavities += cavity;
            c->check->inward_parts += !cavity;
        }
    }
    for (uint32_t i = 0; i < c->mesh->polygon_count; i++) {
        uint32_t part = c->part_of[i];
        if (agree[part] && c->turned[i] != over[part]) {
            c->check->to_turn++;
            if (repair) {
                turn_over(c->mesh, &c->mesh->polygons[i]);
            }
        }
    }
    c->check->repaired = repair;
    free(over);
    free(agree);
}

void check_mesh(struct mesh_check *check, struct mesh *mesh, bool repair)
{
    struct checker c = { .mesh = mesh, .check = check };
    *check = (struct mesh_check){ .repeated = mesh->repeated_dropped };
    list_sides(&c);
    judge_edges(&c);
    find_parts(&c);
    measure_parts(&c);
    judge_parts(&c, repair);
    check->crossings = crossings_count(mesh, &check->crossings_counted);
    if (repair && check->to_turn > 0) {
        mesh->closed = closed_mesh(mesh);
    }
    check->closed = mesh->closed;
    free(c.sides);
    free(c.links);
    free(c.part_of);
    free(c.turned);
    free(c.parts);
}

/* ---- the report ---- */

void check_report(const struct mesh_check *check, const char *file)
{
    if (check->open_edges > 0) {
        warn_line(file, 0, "is not closed: %u edges belong to one polygon only", check->open_edges);
    }
    if (check->forked_edges > 0) {
        warn_line(file, 0, "is not manifold: %u edges belong to more than two polygons",
                  check->forked_edges);
    }
    if (check->twisted_edges > 0) {
        warn_line(file, 0, "the winding changes across %u edges%s", check->twisted_edges,
                  check->to_turn > 0 ? "" : ": no closed part that could be put right");
    }
    if (check->inward_parts > 0) {
        warn_line(file, 0, "the normals of %u of %u parts look inwards", check->inward_parts,
                  check->parts);
    }
    if (check->to_turn > 0) {
        warn_line(file, 0,
                  check->repaired ? "%u polygons were turned over"
                                  : "%u polygons look inwards, --repair turns them over",
                  check->to_turn);
    }
    if (check->cavities > 0) {
        warn_line(file, 0, "%u parts inside others look inwards and were left so: cavities",
                  check->cavities);
    }
    if (check->repeated > 0) {
        warn_line(file, 0, "%u polygons repeat others and were dropped", check->repeated);
    }
    if (check->crossings > 0) {
        warn_line(file, 0, "%s%u pairs of polygons run through one another: they are split",
                  check->crossings_counted ? "" : "at least ", check->crossings);
    }
}
