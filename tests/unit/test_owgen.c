/* SPDX-License-Identifier: 0BSD */
/* The generator's models: counts, closed solids, flat and convex polygons, no overlaps. */
#define _XOPEN_SOURCE 700
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#undef fail /* the helpers have a function of this name */

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "tests/unit/child.h"
#include "tools/owgen/models.h"
#include "tools/owgen/write.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

struct vector {
    double at[3];
};

/* ---- geometry for the checks ---- */

static struct vector minus(struct vector a, struct vector b)
{
    return (struct vector){ { a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2] } };
}

static double dot(struct vector a, struct vector b)
{
    return a.at[0] * b.at[0] + a.at[1] * b.at[1] + a.at[2] * b.at[2];
}

static struct vector cross(struct vector a, struct vector b)
{
    return (struct vector){ {
        a.at[1] * b.at[2] - a.at[2] * b.at[1],
        a.at[2] * b.at[0] - a.at[0] * b.at[2],
        a.at[0] * b.at[1] - a.at[1] * b.at[0],
    } };
}

static struct vector along(struct vector a, double share, struct vector b)
{
    for (int i = 0; i < 3; i++) {
        a.at[i] += share * b.at[i];
    }
    return a;
}

static double length(struct vector a)
{
    return sqrt(dot(a, a));
}

static struct vector corner(const struct mesh *mesh, const struct mesh_polygon *polygon, size_t i)
{
    struct vector v;
    mesh_position(mesh, mesh->corners[polygon->first + i % polygon->count], v.at);
    return v;
}

/* Newell's normal: its length is twice the polygon's area. */
static struct vector area_vector(const struct mesh *mesh, const struct mesh_polygon *polygon)
{
    struct vector sum = { { 0, 0, 0 } };
    struct vector origin = corner(mesh, polygon, 0);
    for (size_t i = 1; i + 1 < polygon->count; i++) {
        struct vector part = cross(minus(corner(mesh, polygon, i), origin),
                                   minus(corner(mesh, polygon, i + 1), origin));
        sum = along(sum, 1, part);
    }
    return sum;
}

static struct vector unit_normal(const struct mesh *mesh, const struct mesh_polygon *polygon)
{
    struct vector normal = area_vector(mesh, polygon);
    struct vector none = { { 0, 0, 0 } };
    return along(none, 1 / length(normal), normal);
}

struct box {
    struct vector low, high;
};

static struct box box_of(const struct mesh *mesh, size_t first_vertex, size_t end)
{
    struct box box = { { { INFINITY, INFINITY, INFINITY } },
                       { { -INFINITY, -INFINITY, -INFINITY } } };
    for (size_t v = first_vertex; v < end; v++) {
        struct vector p;
        mesh_position(mesh, v, p.at);
        for (int i = 0; i < 3; i++) {
            box.low.at[i] = fmin(box.low.at[i], p.at[i]);
            box.high.at[i] = fmax(box.high.at[i], p.at[i]);
        }
    }
    return box;
}

/* The longest side of the model's bounding box. */
static double size_of(const struct mesh *mesh)
{
    struct box box = box_of(mesh, 0, mesh->vertex_count);
    struct vector sides = minus(box.high, box.low);
    return fmax(sides.at[0], fmax(sides.at[1], sides.at[2]));
}

/* ---- the models under test ---- */

struct subject {
    const struct model_kind *kind;
    struct model_options options;
    struct mesh mesh;
    size_t promised;
};

/* Calls `check` for every kind, for both details where there are two. */
static void for_each_model(void (*check)(const struct subject *subject), unsigned traits)
{
    for (size_t k = 0; k < model_kind_count; k++) {
        const struct model_kind *kind = &model_kinds[k];
        int details = (kind->traits & MODEL_DETAIL) != 0 ? 2 : 1;
        for (int d = 0; d < details && (kind->traits & traits) == traits; d++) {
            struct subject subject = {
                .kind = kind,
                .options = { d == 0 ? DETAIL_LOW : DETAIL_HIGH, 700, 300, 42 },
            };
            bool random = (kind->traits & MODEL_RANDOM) != 0;
            subject.promised = random ? 700 : kind->polygons[d];
            mesh_init(&subject.mesh);
            kind->build(&subject.mesh, &subject.options);
            check(&subject);
            mesh_free(&subject.mesh);
        }
    }
}

/* Says which polygon is wrong before the assertion stops the test. */
static void expect(bool good, const struct subject *subject, size_t polygon, const char *what)
{
    if (!good) {
        const struct mesh *mesh = &subject->mesh;
        int part = mesh->polygons[polygon].part;
        print_error("%s: polygon %zu of part %s: %s\n", subject->kind->name, polygon + 1,
                    mesh->parts[part].name, what);
    }
    assert_true(good);
}

static void check_count(const struct subject *subject)
{
    if (subject->mesh.polygon_count != subject->promised) {
        print_error("%s has %zu polygons\n", subject->kind->name, subject->mesh.polygon_count);
    }
    assert_int_equal(subject->mesh.polygon_count, subject->promised);
    assert_true(subject->mesh.part_count > 0);
}

static void test_counts(void **state)
{
    (void)state;
    for_each_model(check_count, 0);
    /* What the papers' models had. */
    assert_int_equal(model_find("oldwell")->polygons[DETAIL_LOW], 356);
    assert_int_equal(model_find("oldwell")->polygons[DETAIL_HIGH], 1000);
    assert_int_equal(model_find("cubes")->polygons[0], 216);
    assert_int_equal(model_find("klein")->polygons[0], 450);
    assert_int_equal(model_find("ribbon")->polygons[0], 368);
    assert_int_equal(model_find("robot")->polygons[0], 258);
    assert_int_equal(model_find("vise")->polygons[0], 304);
    assert_int_equal(model_find("house")->polygons[0], 736);
    assert_null(model_find("no such model"));
}

/* ---- each polygon by itself ---- */

static void check_materials(const struct subject *subject)
{
    const struct mesh *mesh = &subject->mesh;
    bool used[64] = { false };
    assert_true(mesh->material_count <= COUNT(used));
    for (size_t i = 0; i < mesh->polygon_count; i++) {
        int material = mesh->polygons[i].material;
        expect(material >= 0 && (size_t)material < mesh->material_count, subject, i,
               "no such material");
        used[material] = true;
    }
    size_t unused = 0;
    for (size_t i = 0; i < mesh->material_count; i++) {
        unused += !used[i];
        assert_true(mesh->materials[i].name[0] != '\0');
        assert_null(strpbrk(mesh->materials[i].name, " \t#"));
        for (size_t k = 0; k < i; k++) {
            assert_string_not_equal(mesh->materials[i].name, mesh->materials[k].name);
        }
    }
    /* The two details of the Old Well share one list. */
    assert_true(unused == 0 || (subject->kind->traits & MODEL_DETAIL) != 0);
}

static void test_materials(void **state)
{
    (void)state;
    for_each_model(check_materials, 0);
}

/* Every vertex is used; a polygon has area, and its corners differ by more than a trifle. */
static void check_not_degenerate(const struct subject *subject)
{
    const struct mesh *mesh = &subject->mesh;
    double trifle = 1e-5 * size_of(mesh);
    bool *used = calloc(mesh->vertex_count, sizeof *used);
    assert_non_null(used);
    for (size_t i = 0; i < mesh->polygon_count; i++) {
        const struct mesh_polygon *polygon = &mesh->polygons[i];
        double longest = 0;
        expect(polygon->count >= 3, subject, i, "fewer than three corners");
        for (size_t k = 0; k < polygon->count; k++) {
            size_t vertex = mesh->corners[polygon->first + k];
            expect(vertex < mesh->vertex_count, subject, i, "no such vertex");
            used[vertex] = true;
            double side = length(minus(corner(mesh, polygon, k + 1), corner(mesh, polygon, k)));
            expect(side > trifle, subject, i, "two corners at one place");
            longest = fmax(longest, side);
        }
        expect(length(area_vector(mesh, polygon)) / longest > trifle, subject, i, "no area");
    }
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        assert_true(used[v]);
    }
    free(used);
}

static void test_not_degenerate(void **state)
{
    (void)state;
    for_each_model(check_not_degenerate, 0);
}

static void check_flat(const struct subject *subject)
{
    const struct mesh *mesh = &subject->mesh;
    double size = size_of(mesh);
    for (size_t i = 0; i < mesh->polygon_count; i++) {
        const struct mesh_polygon *polygon = &mesh->polygons[i];
        struct vector normal = unit_normal(mesh, polygon);
        double low = INFINITY;
        double high = -INFINITY;
        for (size_t k = 0; k < polygon->count; k++) {
            double height = dot(normal, minus(corner(mesh, polygon, k), corner(mesh, polygon, 0)));
            low = fmin(low, height);
            high = fmax(high, height);
        }
        expect(high - low <= 1e-6 * size, subject, i, "is not flat");
    }
}

static void test_flat(void **state)
{
    (void)state;
    for_each_model(check_flat, MODEL_FLAT);
}

/* Convex: it turns left at every corner, and once around in all. */
static bool is_convex(const struct mesh *mesh, const struct mesh_polygon *polygon)
{
    struct vector normal = unit_normal(mesh, polygon);
    double whole = 0;
    for (size_t k = 0; k < polygon->count; k++) {
        struct vector in = minus(corner(mesh, polygon, k + 1), corner(mesh, polygon, k));
        struct vector out = minus(corner(mesh, polygon, k + 2), corner(mesh, polygon, k + 1));
        double turn = atan2(dot(normal, cross(in, out)), dot(in, out));
        if (turn < 1e-3) {
            return false;
        }
        whole += turn;
    }
    return fabs(whole - 2 * acos(-1)) < 1e-3;
}

static void check_convex(const struct subject *subject)
{
    for (size_t i = 0; i < subject->mesh.polygon_count; i++) {
        expect(is_convex(&subject->mesh, &subject->mesh.polygons[i]), subject, i, "is not convex");
    }
}

static void test_convex(void **state)
{
    (void)state;
    for_each_model(check_convex, MODEL_CONVEX);
}

/* ---- parts ---- */

static size_t part_end_polygon(const struct mesh *mesh, size_t part)
{
    return part + 1 < mesh->part_count ? mesh->parts[part + 1].first_polygon : mesh->polygon_count;
}

static size_t part_end_vertex(const struct mesh *mesh, size_t part)
{
    return part + 1 < mesh->part_count ? mesh->parts[part + 1].first_vertex : mesh->vertex_count;
}

/* How many times the directed edge from a to b occurs in polygons first to end - 1. */
static int edge_uses(const struct mesh *mesh, size_t first, size_t end, size_t a, size_t b)
{
    int uses = 0;
    for (size_t i = first; i < end; i++) {
        const struct mesh_polygon *polygon = &mesh->polygons[i];
        const size_t *corners = mesh->corners + polygon->first;
        for (size_t k = 0; k < polygon->count; k++) {
            uses += corners[k] == a && corners[(k + 1) % polygon->count] == b;
        }
    }
    return uses;
}

static void check_part_closed(const struct subject *subject, size_t part)
{
    const struct mesh *mesh = &subject->mesh;
    size_t first = mesh->parts[part].first_polygon;
    size_t end = part_end_polygon(mesh, part);
    double volume = 0;
    assert_true(mesh->parts[part].closed);
    for (size_t i = first; i < end; i++) {
        const struct mesh_polygon *polygon = &mesh->polygons[i];
        const size_t *corners = mesh->corners + polygon->first;
        for (size_t k = 0; k < polygon->count; k++) {
            size_t a = corners[k];
            size_t b = corners[(k + 1) % polygon->count];
            expect(edge_uses(mesh, first, end, a, b) == 1 && edge_uses(mesh, first, end, b, a) == 1,
                   subject, i, "an edge without its reverse");
        }
        volume += dot(corner(mesh, polygon, 0), area_vector(mesh, polygon)) / 6;
    }
    expect(volume > 0, subject, first, "the part is inside out");
}

static void check_closed(const struct subject *subject)
{
    for (size_t part = 0; part < subject->mesh.part_count; part++) {
        check_part_closed(subject, part);
    }
}

static void test_closed(void **state)
{
    (void)state;
    for_each_model(check_closed, MODEL_CLOSED);
}

/* ---- overlaps ---- */

/* How often the outline, seen along its normal, goes around a point near its plane. */
static int winding_around(const struct mesh *mesh, const struct mesh_polygon *polygon,
                          struct vector normal, struct vector p)
{
    double sum = 0;
    for (size_t k = 0; k < polygon->count; k++) {
        struct vector a = minus(corner(mesh, polygon, k), p);
        struct vector b = minus(corner(mesh, polygon, k + 1), p);
        a = along(a, -dot(a, normal), normal);
        b = along(b, -dot(b, normal), normal);
        sum += atan2(dot(normal, cross(a, b)), dot(a, b));
    }
    return (int)lround(sum / (2 * acos(-1)));
}

/* Distance from p to the polygon's outline. */
static double outline_distance(const struct mesh *mesh, const struct mesh_polygon *polygon,
                               struct vector p)
{
    double nearest = INFINITY;
    for (size_t k = 0; k < polygon->count; k++) {
        struct vector a = corner(mesh, polygon, k);
        struct vector side = minus(corner(mesh, polygon, k + 1), a);
        double share = fmin(1, fmax(0, dot(minus(p, a), side) / dot(side, side)));
        nearest = fmin(nearest, length(minus(p, along(a, share, side))));
    }
    return nearest;
}

enum { SAMPLES_ACROSS = 9 };

/*
 * Points inside a polygon, well off its outline: a grid over its box in its own plane. The first
 * side is one axis of the grid. Returns how many there are.
 */
static size_t inner_points(const struct mesh *mesh, const struct mesh_polygon *polygon,
                           double margin, struct vector *points)
{
    struct vector normal = unit_normal(mesh, polygon);
    struct vector origin = corner(mesh, polygon, 0);
    struct vector side = minus(corner(mesh, polygon, 1), origin);
    struct vector none = { { 0, 0, 0 } };
    struct vector u = along(none, 1 / length(side), side);
    struct vector v = cross(normal, u);
    double low[2] = { INFINITY, INFINITY };
    double high[2] = { -INFINITY, -INFINITY };
    size_t count = 0;
    for (size_t k = 0; k < polygon->count; k++) {
        struct vector p = minus(corner(mesh, polygon, k), origin);
        const double flat[2] = { dot(p, u), dot(p, v) };
        for (int i = 0; i < 2; i++) {
            low[i] = fmin(low[i], flat[i]);
            high[i] = fmax(high[i], flat[i]);
        }
    }
    for (int i = 0; i < SAMPLES_ACROSS * SAMPLES_ACROSS; i++) {
        double su = (i % SAMPLES_ACROSS + 0.53) / SAMPLES_ACROSS;
        double sv = ((double)(i / SAMPLES_ACROSS) + 0.47) / SAMPLES_ACROSS;
        struct vector p = along(origin, low[0] + su * (high[0] - low[0]), u);
        p = along(p, low[1] + sv * (high[1] - low[1]), v);
        if (winding_around(mesh, polygon, normal, p) == 1 &&
            outline_distance(mesh, polygon, p) > margin) {
            points[count++] = p;
        }
    }
    return count;
}

/* True if an inner point of `a` lies in `b`, which faces the same way in the same plane. */
static bool covers_part(const struct mesh *mesh, const struct mesh_polygon *a,
                        const struct mesh_polygon *b, double margin)
{
    struct vector points[SAMPLES_ACROSS * SAMPLES_ACROSS];
    struct vector normal = unit_normal(mesh, b);
    size_t count = inner_points(mesh, a, margin, points);
    for (size_t i = 0; i < count; i++) {
        if (outline_distance(mesh, b, points[i]) > margin &&
            winding_around(mesh, b, normal, points[i]) == 1) {
            return true;
        }
    }
    return false;
}

static bool same_plane(const struct mesh *mesh, const struct mesh_polygon *a,
                       const struct mesh_polygon *b, double margin)
{
    struct vector normal = unit_normal(mesh, a);
    if (dot(normal, unit_normal(mesh, b)) < 0.9999999) {
        return false;
    }
    for (size_t k = 0; k < b->count; k++) {
        if (fabs(dot(normal, minus(corner(mesh, b, k), corner(mesh, a, 0)))) > margin) {
            return false;
        }
    }
    return true;
}

/* The first polygon that shares a plane and ground with another one, or the count. */
static size_t find_overlap(const struct mesh *mesh)
{
    double margin = 1e-5 * size_of(mesh);
    for (size_t i = 0; i < mesh->polygon_count; i++) {
        for (size_t k = i + 1; k < mesh->polygon_count; k++) {
            const struct mesh_polygon *a = &mesh->polygons[i];
            const struct mesh_polygon *b = &mesh->polygons[k];
            if (same_plane(mesh, a, b, margin) &&
                (covers_part(mesh, a, b, margin) || covers_part(mesh, b, a, margin))) {
                return k;
            }
        }
    }
    return mesh->polygon_count;
}

static void check_no_overlap(const struct subject *subject)
{
    size_t found = find_overlap(&subject->mesh);
    expect(found == subject->mesh.polygon_count, subject,
           found == subject->mesh.polygon_count ? 0 : found, "lies on another polygon");
}

static void test_no_overlap(void **state)
{
    (void)state;
    for_each_model(check_no_overlap, MODEL_FLAT);
}

/* The solid angle of a triangle seen from p, by Van Oosterom and Strackee's formula. */
static double solid_angle(struct vector p, struct vector a, struct vector b, struct vector c)
{
    a = minus(a, p);
    b = minus(b, p);
    c = minus(c, p);
    double la = length(a);
    double lb = length(b);
    double lc = length(c);
    double above = dot(a, cross(b, c));
    double below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    return 2 * atan2(above, below);
}

static bool part_contains(const struct mesh *mesh, size_t part, struct vector p)
{
    double sum = 0;
    for (size_t i = mesh->parts[part].first_polygon; i < part_end_polygon(mesh, part); i++) {
        const struct mesh_polygon *polygon = &mesh->polygons[i];
        for (size_t k = 1; k + 1 < polygon->count; k++) {
            sum += solid_angle(p, corner(mesh, polygon, 0), corner(mesh, polygon, k),
                               corner(mesh, polygon, k + 1));
        }
    }
    return sum > 2 * acos(-1);
}

/* The first polygon of part a that has a point, just under its surface, inside part b. */
static size_t find_intrusion(const struct mesh *mesh, size_t a, size_t b, double depth)
{
    struct vector points[SAMPLES_ACROSS * SAMPLES_ACROSS];
    struct box box = box_of(mesh, mesh->parts[b].first_vertex, part_end_vertex(mesh, b));
    for (size_t i = mesh->parts[a].first_polygon; i < part_end_polygon(mesh, a); i++) {
        const struct mesh_polygon *polygon = &mesh->polygons[i];
        struct vector normal = unit_normal(mesh, polygon);
        size_t count = inner_points(mesh, polygon, depth, points);
        for (size_t s = 0; s < count; s++) {
            struct vector p = along(points[s], -depth, normal);
            bool near = true;
            for (int x = 0; x < 3; x++) {
                near = near && p.at[x] > box.low.at[x] && p.at[x] < box.high.at[x];
            }
            if (near && part_contains(mesh, b, p)) {
                return i;
            }
        }
    }
    return mesh->polygon_count;
}

/* True if the two parts' boxes share more than a common side. */
static bool boxes_meet(const struct mesh *mesh, size_t a, size_t b, double margin)
{
    struct box first = box_of(mesh, mesh->parts[a].first_vertex, part_end_vertex(mesh, a));
    struct box second = box_of(mesh, mesh->parts[b].first_vertex, part_end_vertex(mesh, b));
    for (int i = 0; i < 3; i++) {
        if (first.low.at[i] > second.high.at[i] - margin ||
            second.low.at[i] > first.high.at[i] - margin) {
            return false;
        }
    }
    return true;
}

static void check_apart(const struct subject *subject)
{
    const struct mesh *mesh = &subject->mesh;
    double depth = 1e-4 * size_of(mesh);
    for (size_t a = 0; a < mesh->part_count; a++) {
        for (size_t b = 0; b < mesh->part_count; b++) {
            if (a != b && boxes_meet(mesh, a, b, depth)) {
                size_t found = find_intrusion(mesh, a, b, depth);
                expect(found == mesh->polygon_count, subject,
                       found == mesh->polygon_count ? 0 : found, mesh->parts[b].name);
            }
        }
    }
}

static void test_apart(void **state)
{
    (void)state;
    for_each_model(check_apart, MODEL_APART);
}

/* The checks themselves must notice what they look for. */
static void test_checks_notice(void **state)
{
    struct mesh mesh;
    (void)state;
    mesh_init(&mesh);
    int grey = mesh_material(&mesh, "grey", 0x808080);
    for (int i = 0; i < 2; i++) {
        mesh_part(&mesh, "square", false);
        double z = 0.5 * i;
        size_t corners[4];
        corners[0] = mesh_vertex(&mesh, i, z, 0);
        corners[1] = mesh_vertex(&mesh, i, z, 2);
        corners[2] = mesh_vertex(&mesh, 2 + i, z, 2);
        corners[3] = mesh_vertex(&mesh, 2 + i, z, 0);
        mesh_quad(&mesh, grey, corners);
    }
    assert_int_equal(find_overlap(&mesh), 2);
    for (size_t v = 4; v < 8; v++) {
        mesh.vertices[v].at[1] = 0;
    }
    assert_int_equal(find_overlap(&mesh), 1);
    size_t bent[4] = { 0, 1, mesh_vertex(&mesh, 0.5, 0, 0.5), 3 };
    mesh_polygon(&mesh, grey, 4, bent);
    assert_true(is_convex(&mesh, &mesh.polygons[0]));
    assert_false(is_convex(&mesh, &mesh.polygons[2]));
    mesh_free(&mesh);
}

/* ---- what single kinds promise ---- */

static void build(struct mesh *mesh, const char *kind, uint64_t count, double size, uint64_t seed)
{
    const struct model_options options = { DETAIL_LOW, count, size, seed };
    mesh_init(mesh);
    model_find(kind)->build(mesh, &options);
}

/* Every edge has two polygons, the characteristic is 0, and no turning makes the edges pair up. */
static void test_klein(void **state)
{
    struct mesh mesh;
    size_t edges = 0;
    size_t clashes = 0;
    (void)state;
    build(&mesh, "klein", 0, 0, 0);
    for (size_t i = 0; i < mesh.polygon_count; i++) {
        const struct mesh_polygon *polygon = &mesh.polygons[i];
        assert_int_equal(polygon->count, 4);
        for (size_t k = 0; k < 4; k++) {
            size_t a = mesh.corners[polygon->first + k];
            size_t b = mesh.corners[polygon->first + (k + 1) % 4];
            int same = edge_uses(&mesh, 0, mesh.polygon_count, a, b);
            int reverse = edge_uses(&mesh, 0, mesh.polygon_count, b, a);
            assert_int_equal(same + reverse, 2);
            clashes += same == 2;
            edges++;
        }
    }
    assert_int_equal(mesh.vertex_count + mesh.polygon_count, edges / 2);
    /* One seam of 15 edges where the surface meets its other side. */
    assert_int_equal(clashes, 2 * 15);
    mesh_free(&mesh);
}

/* A polygon with a hole visits both ends of its bridge twice. */
static size_t repeated_corners(const struct mesh *mesh, const struct mesh_polygon *polygon)
{
    size_t repeated = 0;
    for (size_t i = 0; i < polygon->count; i++) {
        for (size_t k = i + 1; k < polygon->count; k++) {
            repeated += mesh->corners[polygon->first + i] == mesh->corners[polygon->first + k];
        }
    }
    return repeated;
}

static void test_concave_and_holes(void **state)
{
    const char *const kinds[] = { "house", "vise" };
    const size_t holes_promised[] = { 2 * (2 + 2 + 3 + 1 + 1 + 2), 2 * (4 + 1 + 1 + 1) };
    const size_t concave_promised[] = { 24, 4 };
    (void)state;
    for (size_t n = 0; n < COUNT(kinds); n++) {
        struct mesh mesh;
        size_t concave = 0;
        size_t holes = 0;
        build(&mesh, kinds[n], 0, 0, 0);
        for (size_t i = 0; i < mesh.polygon_count; i++) {
            const struct mesh_polygon *polygon = &mesh.polygons[i];
            size_t repeated = repeated_corners(&mesh, polygon);
            assert_int_equal(repeated % 2, 0);
            holes += repeated / 2;
            concave += repeated == 0 && !is_convex(&mesh, polygon);
        }
        assert_int_equal(holes, holes_promised[n]);
        assert_int_equal(concave, concave_promised[n]);
        mesh_free(&mesh);
    }
}

/* The triangle's extent on an axis, and its middle there. */
static void span(const struct mesh *mesh, size_t polygon, int axis, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (size_t k = 0; k < 3; k++) {
        double at = corner(mesh, &mesh->polygons[polygon], k).at[axis];
        *low = fmin(*low, at);
        *high = fmax(*high, at);
    }
}

static void test_random_space(void **state)
{
    struct mesh mesh;
    double mean[3] = { 0, 0, 0 };
    const double size = 200;
    (void)state;
    build(&mesh, "random", 4000, size, 3);
    for (size_t i = 0; i < mesh.polygon_count; i++) {
        for (int axis = 0; axis < 3; axis++) {
            double low;
            double high;
            span(&mesh, i, axis, &low, &high);
            assert_true(high - low <= size);
            assert_true(low >= -size / 2 && high <= 1000 + size / 2);
            mean[axis] += (low + high) / 2 / (double)mesh.polygon_count;
        }
        assert_int_equal(mesh.polygons[i].material, (int)(i % 16));
    }
    for (int axis = 0; axis < 3; axis++) {
        assert_true(fabs(mean[axis] - 500) < 30);
    }
    mesh_free(&mesh);
}

static void test_parallel_planes(void **state)
{
    struct mesh mesh;
    const size_t count = 4000;
    (void)state;
    build(&mesh, "parallel", count, 50, 3);
    assert_int_equal(mesh.polygon_count, count);
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < 3; k++) {
            size_t vertex = mesh.corners[mesh.polygons[i].first + k];
            assert_int_equal(mesh.vertices[vertex].at[2],
                             (int64_t)i * 1000 * MESH_SCALE / (int64_t)count);
        }
        assert_true(area_vector(&mesh, &mesh.polygons[i]).at[2] > 0);
    }
    mesh_free(&mesh);
}

/* FNV-1a over coordinates, corners and materials. */
static uint64_t hash_of(const struct mesh *mesh)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (size_t v = 0; v < 3 * mesh->vertex_count; v++) {
        hash = (hash ^ (uint64_t)mesh->vertices[v / 3].at[v % 3]) * UINT64_C(0x100000001b3);
    }
    for (size_t i = 0; i < mesh->polygon_count; i++) {
        const struct mesh_polygon *polygon = &mesh->polygons[i];
        hash = (hash ^ polygon->count) * UINT64_C(0x100000001b3);
        hash = (hash ^ (uint64_t)polygon->material) * UINT64_C(0x100000001b3);
        for (size_t k = 0; k < polygon->count; k++) {
            hash = (hash ^ mesh->corners[polygon->first + k]) * UINT64_C(0x100000001b3);
        }
    }
    return hash;
}

/* The models are the same on every machine; these are to change only when a model does. */
static void test_same_everywhere(void **state)
{
    static const struct {
        const char *kind;
        enum model_detail detail;
        uint64_t hash;
    } cases[] = {
        { "oldwell", DETAIL_LOW, UINT64_C(0xacfabe695f21b0ce) },
        { "oldwell", DETAIL_HIGH, UINT64_C(0x4bb5c20e21a102fe) },
        { "cubes", DETAIL_LOW, UINT64_C(0xbb8051178277710d) },
        { "klein", DETAIL_LOW, UINT64_C(0xad915933135a4f5f) },
        { "ribbon", DETAIL_LOW, UINT64_C(0x57312e361bd43245) },
        { "atoms", DETAIL_LOW, UINT64_C(0x54a3e320e7a3d677) },
        { "robot", DETAIL_LOW, UINT64_C(0xe7b8e838d0162195) },
        { "vise", DETAIL_LOW, UINT64_C(0x8ee7cee859ccec55) },
        { "house", DETAIL_LOW, UINT64_C(0x0de7630a0e1e7f1d) },
        { "random", DETAIL_LOW, UINT64_C(0xacd1a7928e2c8544) },
        { "parallel", DETAIL_LOW, UINT64_C(0xdfe49f3a90e54a37) },
    };
    bool all_good = true;
    (void)state;
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct mesh mesh;
        const struct model_options options = { cases[i].detail, 500, 500, 1 };
        mesh_init(&mesh);
        model_find(cases[i].kind)->build(&mesh, &options);
        uint64_t hash = hash_of(&mesh);
        if (hash != cases[i].hash) {
            print_error("%s %d: 0x%016" PRIx64 "\n", cases[i].kind, (int)cases[i].detail, hash);
            all_good = false;
        }
        mesh_free(&mesh);
    }
    assert_true(all_good);
}

static void test_seeds(void **state)
{
    const char *const kinds[] = { "random", "parallel" };
    (void)state;
    for (size_t n = 0; n < COUNT(kinds); n++) {
        struct mesh mesh[3];
        build(&mesh[0], kinds[n], 50, 100, 7);
        build(&mesh[1], kinds[n], 50, 100, 7);
        build(&mesh[2], kinds[n], 50, 100, 8);
        assert_true(hash_of(&mesh[0]) == hash_of(&mesh[1]));
        assert_true(hash_of(&mesh[0]) != hash_of(&mesh[2]));
        for (int i = 0; i < 3; i++) {
            mesh_free(&mesh[i]);
        }
    }
}

/* ---- files ---- */

static void write_cubes(void *context)
{
    struct mesh mesh;
    build(&mesh, "cubes", 0, 0, 0);
    write_model(&mesh, "test", context);
    mesh_free(&mesh);
}

struct obj_count {
    size_t vertices, polygons, libraries, materials;
};

/* Counts an OBJ's or an MTL's statements, and checks that every material used is defined. */
static struct obj_count count_statements(FILE *stream, const char *mtl)
{
    struct obj_count count = { 0 };
    char line[256];
    while (fgets(line, sizeof line, stream) != NULL) {
        char name[64];
        count.vertices += strncmp(line, "v ", 2) == 0;
        count.polygons += strncmp(line, "f ", 2) == 0;
        count.libraries += strncmp(line, "mtllib ", 7) == 0;
        if (sscanf(line, "usemtl %63s", name) == 1) {
            char wanted[80];
            snprintf(wanted, sizeof wanted, "newmtl %s\nKd ", name);
            assert_non_null(mtl);
            assert_non_null(strstr(mtl, wanted));
            count.materials++;
        }
    }
    return count;
}

static void test_files(void **state)
{
    char folder[CHILD_PATH];
    char path[CHILD_PATH];
    char mtl[4096] = "";
    (void)state;
    folder_make(folder);
    folder_path(path, folder, "a.mtl");
    char obj[CHILD_PATH];
    folder_path(obj, folder, "a.obj");
    struct child_result result = child_run(write_cubes, obj);
    assert_int_equal(result.status, 0);
    assert_int_equal(folder_entries(folder), 2);
    FILE *stream = fopen(path, "r");
    assert_non_null(stream);
    mtl[fread(mtl, 1, sizeof mtl - 1, stream)] = '\0';
    fclose(stream);
    stream = fopen(obj, "r");
    assert_non_null(stream);
    struct obj_count count = count_statements(stream, mtl);
    fclose(stream);
    assert_int_equal(count.vertices, 192);
    assert_int_equal(count.polygons, 216);
    assert_int_equal(count.libraries, 1);
    assert_true(count.materials >= 6);
    folder_remove(folder);
}

/* Standard output gets the OBJ alone, and names no materials. */
static void test_standard_output(void **state)
{
    char dash[] = "-";
    (void)state;
    struct child_result result = child_run(write_cubes, dash);
    assert_int_equal(result.status, 0);
    FILE *stream = fmemopen(result.out, strlen(result.out), "r");
    assert_non_null(stream);
    struct obj_count count = count_statements(stream, NULL);
    fclose(stream);
    assert_int_equal(count.libraries, 0);
    assert_int_equal(count.vertices, 192);
}

/* If the MTL cannot be written there is no OBJ either. */
static void test_files_together(void **state)
{
    char folder[CHILD_PATH];
    char obj[CHILD_PATH];
    char mtl[CHILD_PATH];
    (void)state;
    folder_make(folder);
    folder_path(obj, folder, "a.obj");
    folder_path(mtl, folder, "a.mtl");
    assert_int_equal(mkdir(mtl, 0777), 0);
    struct child_result result = child_run(write_cubes, obj);
    assert_int_equal(result.status, 1);
    assert_int_equal(child_lines(result.err), 1);
    assert_int_equal(folder_entries(folder), 1);
    assert_false(folder_has(folder, "a.obj"));
    folder_remove(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_counts),
        cmocka_unit_test(test_materials),
        cmocka_unit_test(test_not_degenerate),
        cmocka_unit_test(test_flat),
        cmocka_unit_test(test_convex),
        cmocka_unit_test(test_closed),
        cmocka_unit_test(test_no_overlap),
        cmocka_unit_test(test_apart),
        cmocka_unit_test(test_checks_notice),
        cmocka_unit_test(test_klein),
        cmocka_unit_test(test_concave_and_holes),
        cmocka_unit_test(test_random_space),
        cmocka_unit_test(test_parallel_planes),
        cmocka_unit_test(test_same_everywhere),
        cmocka_unit_test(test_seeds),
        cmocka_unit_test(test_files),
        cmocka_unit_test(test_standard_output),
        cmocka_unit_test(test_files_together),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
