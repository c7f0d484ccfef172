/* SPDX-License-Identifier: 0BSD */
/*
 * The walk's order, pair by pair. Random triangles are placed into trees of
 * switches and sequences by exact integer side tests, independent of the
 * compiler; then, for many eyes, whatever a face hides a part of must come
 * before it, farthest first. Nearest first is the exact reverse, and each face
 * that looks at the eye is met once.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ow_draw.h"
#include "ow_tree.h"
#include "ow_view.h"
#include "ow_walk.h"
#include "tests/property/blob_builder.h"

enum { SCENES = 60, EYES = 40, CUBE = 1000, MOST = 80 };

static uint64_t random_state;

static uint32_t random_below(uint32_t n)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((random_state >> 33) % n);
}

static int random_in(int low, int high)
{
    return low + (int)random_below((uint32_t)(high - low + 1));
}

/* ---- scenes --------------------------------------------------------------------------------- */
struct triangle {
    int v[3][3];
    int64_t plane[4];
    uint32_t polygon;
};

struct scene {
    struct builder *b;
    struct triangle triangles[MOST];
    uint32_t count;
    bool two_sided;
    bool sequences;
    uint32_t placed; /* triangles that found a place in the tree */
    bool in_tree[MOST];
};

static int64_t value_at(const int64_t plane[4], const int v[3])
{
    return plane[0] * v[0] + plane[1] * v[1] + plane[2] * v[2] + plane[3];
}

/* Bits: 1 a corner strictly in front, 2 one strictly behind. */
static unsigned sides_of(const int64_t plane[4], const struct triangle *t)
{
    unsigned sides = 0;
    for (int i = 0; i < 3; i++) {
        int64_t value = value_at(plane, t->v[i]);
        sides |= value > 0 ? 1u : value < 0 ? 2u : 0;
    }
    return sides;
}

static bool random_triangle(struct scene *s, int size)
{
    struct triangle *t = &s->triangles[s->count];
    int centre[3];
    for (int k = 0; k < 3; k++) {
        centre[k] = random_in(-CUBE, CUBE);
    }
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            t->v[i][k] = centre[k] + random_in(-size, size);
        }
    }
    /* Some triangles lie in a common plane, axis-parallel ones too. */
    if (random_below(4) == 0) {
        t->v[0][2] = t->v[1][2] = t->v[2][2] = 100 * random_in(-6, 6);
    }
    t->polygon = builder_triangle(s->b, (const int(*)[3])t->v, 0, s->count + 1);
    builder_plane(s->b, t->polygon, t->plane);
    for (int k = 0; k < 3; k++) {
        if (t->plane[k] > 8388607 || t->plane[k] < -8388607) {
            return false;
        }
    }
    return t->plane[0] != 0 || t->plane[1] != 0 || t->plane[2] != 0;
}

/* May p hide a part of q from an eye in front of both [design of the obstruction order]? */
static bool can_obstruct(const struct triangle *p, const struct triangle *q)
{
    return (sides_of(q->plane, p) & 1) && (sides_of(p->plane, q) & 2);
}

/*
 * Takes from the list, farthest first, triangles that hide nothing of those
 * taken before: a sequence. What is left in the list belongs to a cycle.
 */
static uint32_t take_sequence(struct scene *s, uint32_t *list, uint32_t *count, uint32_t *taken)
{
    uint32_t n = 0;
    for (bool found = true; found;) {
        found = false;
        for (uint32_t i = 0; i < *count && !found; i++) {
            bool hides = false;
            for (uint32_t k = 0; k < *count; k++) {
                hides = hides ||
                        (k != i && can_obstruct(&s->triangles[list[i]], &s->triangles[list[k]]));
            }
            if (!hides) {
                taken[n++] = list[i];
                list[i] = list[--*count];
                found = true;
            }
        }
    }
    return n;
}

static void place(struct scene *s, uint32_t node, uint32_t kind, uint32_t number)
{
    builder_add(s->b, node, kind, s->triangles[number].polygon);
    s->in_tree[number] = true;
}

/* A sequence of fronts alone; what lies in a cycle is left out of the scene. */
static uint32_t make_sequence(struct scene *s, uint32_t *list, uint32_t count)
{
    uint32_t taken[MOST];
    uint32_t n = take_sequence(s, list, &count, taken);
    uint32_t node = builder_sequence(s->b);
    if (random_below(2)) {
        builder_bound(s->b, node);
    }
    /* Nested: a part of the run stands in a sequence of its own. */
    uint32_t inner = n > 3 && random_below(2) ? builder_sequence(s->b) : node;
    for (uint32_t i = 0; i < n; i++) {
        if (inner != node && i == 1) {
            builder_add(s->b, node, OW_ITEM_NODE, inner);
        }
        place(s, i == 1 || i == 2 ? inner : node, OW_ITEM_FACE, taken[i]);
    }
    return node;
}

/* What a plane costs: triangles cut (they are left out of the scene), then imbalance. */
static uint32_t cost_of(const struct scene *s, const int64_t plane[4], const uint32_t *list,
                        uint32_t count)
{
    uint32_t parts[4] = { 0, 0, 0, 0 };
    for (uint32_t i = 0; i < count; i++) {
        parts[sides_of(plane, &s->triangles[list[i]])]++;
    }
    if (parts[0] == 0 && (parts[1] == 0 || parts[2] == 0)) {
        return UINT32_MAX; /* divides nothing */
    }
    return 16 * parts[3] + (parts[1] > parts[2] ? parts[1] - parts[2] : parts[2] - parts[1]);
}

/* A triangle's own plane, or a dividing plane through its highest corner along an axis. */
static void choose_plane(const struct scene *s, const uint32_t *list, uint32_t count,
                         int64_t best[4])
{
    uint32_t best_cost = UINT32_MAX;
    for (uint32_t i = 0; i < 4 * count; i++) {
        const struct triangle *t = &s->triangles[list[i / 4]];
        int64_t plane[4] = { 0, 0, 0, 0 };
        if (i % 4 == 3) {
            memcpy(plane, t->plane, sizeof plane);
        } else {
            int high = t->v[0][i % 4];
            high = t->v[1][i % 4] > high ? t->v[1][i % 4] : high;
            high = t->v[2][i % 4] > high ? t->v[2][i % 4] : high;
            plane[i % 4] = i / 4 % 2 ? -1 : 1;
            plane[3] = -high * plane[i % 4];
        }
        uint32_t cost = cost_of(s, plane, list, count);
        if (cost < best_cost) {
            best_cost = cost;
            memcpy(best, plane, sizeof plane);
        }
    }
}

static void place_coplanar(struct scene *s, uint32_t node, uint32_t number)
{
    place(s, node, OW_ITEM_FACE, number);
    if (s->two_sided) {
        builder_add(s->b, node, OW_ITEM_REVERSE, s->triangles[number].polygon);
    }
}

static uint32_t make_tree(struct scene *s, uint32_t *list, uint32_t count)
{
    if (s->sequences && (count < 9 || random_below(8) == 0)) {
        return make_sequence(s, list, count);
    }
    int64_t plane[4] = { 0, 0, 1, 0 };
    choose_plane(s, list, count, plane);
    uint32_t node = builder_switch(s->b, plane);
    uint32_t parts[2][MOST], sizes[2] = { 0, 0 };
    for (uint32_t i = 0; i < count; i++) {
        unsigned sides = sides_of(plane, &s->triangles[list[i]]);
        if (sides == 0) {
            place_coplanar(s, node, list[i]);
        } else if (sides != 3) {
            parts[sides - 1][sizes[sides - 1]++] = list[i];
        }
    }
    if (random_below(3) == 0) {
        builder_bound(s->b, node);
    }
    for (uint32_t side = 0; side < 2; side++) {
        if (sizes[side] > 0) {
            uint32_t child = make_tree(s, parts[side], sizes[side]);
            builder_child(s->b, node, side, OW_ITEM_NODE, child);
        }
    }
    return node;
}

static uint8_t *make_scene(struct scene *s, uint32_t seed, uint32_t *size)
{
    memset(s, 0, sizeof *s);
    random_state = seed * 7919u + 17;
    s->two_sided = seed % 3 == 0;
    s->sequences = seed % 3 != 0;
    uint32_t flags = OW_TREE_IDS | (s->two_sided ? OW_TREE_TWO_SIDED : 0) |
                     (s->sequences ? 0 : OW_TREE_SWITCH_ONLY) | (seed % 2 ? OW_TREE_INDEX32 : 0);
    s->b = builder_new(flags);
    (void)builder_colour(s->b, 0xFFFFFF);
    uint32_t wanted = 3 + random_below(MOST - 3), list[MOST];
    while (s->count < wanted) {
        if (random_triangle(s, 20 + (int)random_below(random_below(8) ? 250 : 900))) {
            list[s->count] = s->count;
            s->count++;
        }
    }
    uint32_t root = make_tree(s, list, s->count);
    for (uint32_t i = 0; i < s->count; i++) {
        s->placed += s->in_tree[i];
    }
    uint8_t *blob = builder_finish(s->b, root, size);
    free(s->b);
    return blob;
}

/* ---- brute force ---------------------------------------------------------------------------- */
struct eye {
    bool parallel;
    double p[3]; /* the eye's point, or the direction towards it */
};

static void corner(const struct triangle *t, int i, double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = t->v[i][k];
    }
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        int y = (k + 1) % 3, z = (k + 2) % 3;
        out[k] = a[y] * b[z] - a[z] * b[y];
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Cuts a polygon (at most 8 corners) by n.x + d > margin; returns the count left. */
static int cut(double polygon[12][3], int count, const double n[3], double d, double margin)
{
    double out[12][3];
    int left = 0;
    for (int i = 0; i < count; i++) {
        const double *a = polygon[i], *b = polygon[(i + 1) % count];
        double va = dot(n, a) + d - margin, vb = dot(n, b) + d - margin;
        if (va > 0) {
            memcpy(out[left++], a, sizeof out[0]);
        }
        if ((va > 0) != (vb > 0)) {
            for (int k = 0; k < 3; k++) {
                out[left][k] = a[k] + (b[k] - a[k]) * va / (va - vb);
            }
            left++;
        }
    }
    memcpy(polygon, out, sizeof out);
    return left;
}

static double length(const double v[3])
{
    double square = dot(v, v), root = square;
    for (int i = 0; i < 60 && root > 0; i++) {
        root = (root + square / root) / 2;
    }
    return root;
}

/*
 * Does a hide a part of b from the eye? b is cut by the planes through the eye
 * and a's edges and by a's own plane, each moved inwards by a margin.
 */
static bool hides(const struct triangle *a, const struct triangle *b, const struct eye *eye)
{
    double polygon[12][3], n[3];
    int count = 3;
    for (int i = 0; i < 3; i++) {
        corner(b, i, polygon[i]);
    }
    for (int i = 0; i < 3 && count > 2; i++) {
        double u[3], v[3], w[3], to_u[3], to_v[3];
        corner(a, i, u);
        corner(a, (i + 1) % 3, v);
        corner(a, (i + 2) % 3, w);
        for (int k = 0; k < 3; k++) {
            to_u[k] = eye->parallel ? eye->p[k] : u[k] - eye->p[k];
            to_v[k] = v[k] - (eye->parallel ? u[k] : eye->p[k]);
        }
        cross(to_u, to_v, n);
        double size = length(n);
        if (size < 1e-6) {
            return false;
        }
        for (int k = 0; k < 3; k++) {
            n[k] /= size;
        }
        double d = -dot(n, u);
        if (dot(n, w) + d < 0) {
            n[0] = -n[0], n[1] = -n[1], n[2] = -n[2], d = -d;
        }
        count = cut(polygon, count, n, d, 0.01);
    }
    for (int k = 0; k < 3; k++) {
        n[k] = (double)a->plane[k];
    }
    double size = length(n), d = (double)a->plane[3] / size;
    double towards = dot(n, eye->p) / size + (eye->parallel ? 0 : d);
    for (int k = 0; k < 3; k++) {
        n[k] /= towards > 0 ? -size : size;
    }
    return count > 2 && cut(polygon, count, n, towards > 0 ? -d : d, 0.01) > 2;
}

/* ---- the walk ------------------------------------------------------------------------------- */
static struct ow_view random_view(struct eye *eye, const struct scene *s, bool parallel)
{
    struct ow_camera camera = { .up = { 3, 250, 7 },
                                .projection = OW_PERSPECTIVE,
                                .fov = 1u << 29,
                                .height = 4000 * 256,
                                .near = 256,
                                .width_pixels = 64,
                                .height_pixels = 48 };
    camera.projection = parallel ? OW_PARALLEL : OW_PERSPECTIVE;
    int reach = (int[]){ 800, 3000, 200000 }[random_below(3)] * 256;
    const struct triangle *t = &s->triangles[random_below(s->count)];
    bool on_plane = random_below(4) == 0;
    for (int k = 0; k < 3; k++) {
        camera.eye[k] = random_in(-reach, reach);
        camera.at[k] = random_in(-1000, 1000) * 256;
        if (on_plane) { /* exactly on a triangle's plane */
            camera.eye[k] = (2 * t->v[0][k] - t->v[1][k]) * 256;
        }
    }
    struct ow_view view;
    assert_int_equal(ow_view_make(&view, &camera), OW_OK);
    eye->parallel = parallel;
    for (int k = 0; k < 3; k++) {
        eye->p[k] = parallel ? -(double)view.forward[k] / 1073741824.0 : view.eye[k] / 256.0;
    }
    return view;
}

/* 1: the eye sees the front, -1 the back, 0: edge-on. Exact. */
static int seen_side(const struct triangle *t, const struct ow_view *view)
{
    int64_t sum = 0;
    for (int k = 0; k < 3; k++) {
        int64_t towards = view->projection == OW_PARALLEL ? -(int64_t)view->forward[k]
                                                          : view->eye[k] - 256 * t->v[0][k];
        sum += t->plane[k] * towards;
    }
    return (sum > 0) - (sum < 0);
}

struct met {
    uint32_t at;
    bool reverse;
};

static uint32_t walk_all(const struct ow_tree *tree, const struct ow_view *view,
                         enum ow_direction direction, struct met *met, uint32_t room)
{
    struct ow_walk walk;
    struct ow_face face;
    struct ow_walk_run *stack = malloc(ow_walk_stack_bytes(tree));
    assert_non_null(stack);
    assert_int_equal(ow_walk_begin(&walk, tree, view, direction, OW_CULL_AUTO, stack), OW_OK);
    uint32_t count = 0;
    while (ow_walk_next(&walk, &face)) {
        assert_true(count < room);
        met[count++] = (struct met){ face.at, face.reverse };
    }
    assert_int_equal(walk.faces_met, tree->face_count);
    free(stack);
    return count;
}

static uint32_t id_of(const struct ow_tree *tree, uint32_t at)
{
    const uint8_t *p = tree->bytes + at + OW_POLYGON_HEAD_BYTES;
    return p[0] | (uint32_t)p[1] << 8;
}

/* Place of each triangle's seen side in the walk; checks that each is met once. */
static void find_places(const struct scene *s, const struct ow_tree *tree,
                        const struct ow_view *view, const struct met *met, uint32_t count,
                        int *place)
{
    for (uint32_t i = 0; i < s->count; i++) {
        place[i] = -1;
    }
    for (uint32_t i = 0; i < count; i++) {
        uint32_t number = id_of(tree, met[i].at) - 1;
        assert_true(number < s->count);
        int side = seen_side(&s->triangles[number], view);
        if (side == (met[i].reverse ? -1 : 1)) {
            assert_int_equal(place[number], -1);
            place[number] = (int)i;
        }
    }
    for (uint32_t i = 0; i < s->count; i++) {
        int side = seen_side(&s->triangles[i], view);
        bool due = s->in_tree[i] && (side > 0 || (side < 0 && s->two_sided));
        assert_int_equal(place[i] >= 0, due);
    }
}

static uint64_t check_view(const struct scene *s, const struct ow_tree *tree, bool parallel)
{
    struct eye eye;
    struct ow_view view = random_view(&eye, s, parallel);
    struct met far_first[2 * MOST], near_first[2 * MOST];
    int place[MOST];
    uint32_t count = walk_all(tree, &view, OW_FARTHEST_FIRST, far_first, 2 * MOST);
    assert_int_equal(walk_all(tree, &view, OW_NEAREST_FIRST, near_first, 2 * MOST), count);
    for (uint32_t i = 0; i < count; i++) {
        assert_int_equal(far_first[i].at, near_first[count - 1 - i].at);
        assert_int_equal(far_first[i].reverse, near_first[count - 1 - i].reverse);
    }
    find_places(s, tree, &view, far_first, count, place);
    uint64_t pairs = 0;
    for (uint32_t a = 0; a < s->count; a++) {
        for (uint32_t b = 0; b < s->count; b++) {
            if (a == b || place[a] < 0 || place[b] < 0 ||
                !hides(&s->triangles[a], &s->triangles[b], &eye)) {
                continue;
            }
            pairs++;
            if (place[a] < place[b]) {
                print_error("face %u hides a part of face %u but comes before it\n", a + 1, b + 1);
                fail();
            }
        }
    }
    return pairs;
}

static void check_scenes(bool parallel)
{
    uint64_t pairs = 0, placed = 0;
    static struct scene scene;
    for (uint32_t seed = 1; seed <= SCENES; seed++) {
        uint32_t size;
        uint8_t *blob = make_scene(&scene, seed, &size);
        struct ow_tree tree;
        assert_int_equal(ow_tree_open(&tree, blob, size), OW_OK);
        placed += scene.placed;
        for (int i = 0; i < EYES; i++) {
            pairs += check_view(&scene, &tree, parallel);
        }
        free(blob);
    }
    print_message("%llu faces placed, %llu hidden pairs\n", (unsigned long long)placed,
                  (unsigned long long)pairs);
    assert_true(placed > 1200);
    assert_true(pairs > 5000);
}

static void hidden_before_hiding_in_perspective(void **state)
{
    (void)state;
    check_scenes(false);
}

static void hidden_before_hiding_in_parallel_projection(void **state)
{
    (void)state;
    check_scenes(true);
}

/* A sequence the wrong way round must be noticed: the test can fail. */
static void a_wrong_order_would_be_noticed(void **state)
{
    (void)state;
    static const int low[3][3] = { { -500, -500, 0 }, { 500, -500, 0 }, { 0, 500, 0 } };
    static const int high[3][3] = { { -500, -500, 200 }, { 500, -500, 200 }, { 0, 500, 200 } };
    static struct scene s;
    memset(&s, 0, sizeof s);
    s.b = builder_new(0);
    for (; s.count < 2; s.count++) {
        struct triangle *t = &s.triangles[s.count];
        memcpy(t->v, s.count ? high : low, sizeof low);
        t->polygon = builder_triangle(s.b, (const int(*)[3])t->v, 0, 0);
        builder_plane(s.b, t->polygon, t->plane);
    }
    struct eye above = { false, { 10, 20, 900 } }, below = { false, { 10, 20, -900 } };
    struct eye aside = { true, { 0.99, 0.1, 0.1 } };
    assert_true(hides(&s.triangles[1], &s.triangles[0], &above));
    assert_false(hides(&s.triangles[0], &s.triangles[1], &above));
    assert_true(hides(&s.triangles[0], &s.triangles[1], &below));
    assert_false(hides(&s.triangles[1], &s.triangles[0], &aside));
    assert_true(can_obstruct(&s.triangles[1], &s.triangles[0]));
    assert_false(can_obstruct(&s.triangles[0], &s.triangles[1]));
    free(s.b);
}

/* Of faces in one plane the later wins, from either side and whichever way the walk goes. */
static void later_coplanar_faces_win(void **state)
{
    (void)state;
    static const int shape[3][3] = { { -500, -500, 0 }, { 500, -500, 0 }, { 0, 500, 0 } };
    struct builder *b = builder_new(OW_TREE_TWO_SIDED);
    (void)builder_colour(b, 0xFFFFFF);
    uint32_t root = builder_switch(b, (const int64_t[4]){ 0, 0, 1, 0 }), size;
    for (uint32_t kind = OW_ITEM_FACE; kind <= OW_ITEM_REVERSE; kind++) {
        for (uint32_t i = 0; i < 3; i++) {
            if (kind == OW_ITEM_FACE) {
                (void)builder_triangle(b, shape, 0, i + 1);
            }
            builder_add(b, root, kind, i);
        }
    }
    uint8_t *blob = builder_finish(b, root, &size);
    struct ow_tree tree;
    assert_int_equal(ow_tree_open(&tree, blob, size), OW_OK);
    for (int side = -1; side <= 1; side += 2) {
        struct ow_camera camera = { .eye = { 0, 0, side * 20000 * 256 },
                                    .up = { 0, 256, 0 },
                                    .fov = 1u << 29,
                                    .width_pixels = 64,
                                    .height_pixels = 48 };
        struct ow_view view;
        assert_int_equal(ow_view_make(&view, &camera), OW_OK);
        struct met far_first[6], near_first[6];
        assert_int_equal(walk_all(&tree, &view, OW_FARTHEST_FIRST, far_first, 6), 3);
        assert_int_equal(walk_all(&tree, &view, OW_NEAREST_FIRST, near_first, 6), 3);
        for (uint32_t i = 0; i < 3; i++) {
            assert_int_equal(far_first[i].reverse, side < 0);
            assert_int_equal(near_first[i].at, far_first[2 - i].at);
            assert_true(i == 0 || far_first[i].at > far_first[i - 1].at);
        }
    }
    free(blob);
    free(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hidden_before_hiding_in_perspective),
        cmocka_unit_test(hidden_before_hiding_in_parallel_projection),
        cmocka_unit_test(later_coplanar_faces_win),
        cmocka_unit_test(a_wrong_order_would_be_noticed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
