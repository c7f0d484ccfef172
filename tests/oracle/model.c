/* SPDX-License-Identifier: 0BSD */
/*
 * The source model on the lattice: positions by assimp, polygons in the file's
 * own order. Assimp sorts polygons by material, so the `f` lines of an OBJ are
 * read here too, and each must be met again among assimp's faces.
 */
#include "tests/oracle/oracle.h"

#include <assimp/cimport.h>
#include <assimp/scene.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- the blob's header: by the offsets of docs/FORMAT.md ------------------------------------ */
static uint64_t little_endian(const uint8_t *bytes, size_t count)
{
    uint64_t value = 0;
    for (size_t i = count; i-- > 0;) {
        value = value << 8 | bytes[i];
    }
    return value;
}

static double binary64(const uint8_t *bytes)
{
    uint64_t bits = little_endian(bytes, 8);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

void lattice_read(struct lattice *lattice, const char *tree)
{
    uint8_t header[128];
    FILE *file = fopen(tree, "rb");
    if (!file || fread(header, sizeof header, 1, file) != 1) {
        stop(tree, "no tree can be read here");
    }
    fclose(file);
    if (memcmp(header, "\177OWT\1\0", 6) != 0) {
        stop(tree, "not a tree of version 1");
    }
    lattice->two_sided = little_endian(header + 16, 4) & 1;
    lattice->tolerance = (double)little_endian(header + 92, 4) / 256;
    for (int i = 0; i < 3; i++) {
        lattice->origin[i] = binary64(header + 96 + 8 * i);
    }
    lattice->step = binary64(header + 120);
    if (!(lattice->step > 0)) {
        stop(tree, "the lattice step is not positive");
    }
}

/* ---- planes and triangles ------------------------------------------------------------------- */
static struct vec newell(const struct vec *points, const uint32_t *corners, uint32_t count)
{
    struct vec n = { 0, 0, 0 };
    for (uint32_t i = 0; i < count; i++) {
        struct vec a = points[corners[i]], b = points[corners[(i + 1) % count]];
        n.x += (a.y - b.y) * (a.z + b.z);
        n.y += (a.z - b.z) * (a.x + b.x);
        n.z += (a.x - b.x) * (a.y + b.y);
    }
    double length = sqrt(vec_dot(n, n));
    if (length > 0) {
        n = (struct vec){ n.x / length, n.y / length, n.z / length };
    }
    return n;
}

/* The farthest corner from the plane with Newell's normal midway between the extremes. */
static double unevenness(const struct vec *points, const uint32_t *corners, uint32_t count)
{
    struct vec n = newell(points, corners, count);
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        double height = vec_dot(n, vec_sub(points[corners[i]], points[corners[0]]));
        low = fmin(low, height);
        high = fmax(high, height);
    }
    return (high - low) / 2;
}

static void add_piece(struct model *m, const uint32_t *corners, uint32_t count, uint32_t id,
                      double slack)
{
    m->corners = more(m->corners, m->corner_count + count, sizeof *m->corners);
    memcpy(m->corners + m->corner_count, corners, count * sizeof *corners);
    m->polygons = more(m->polygons, m->polygon_count + 1, sizeof *m->polygons);
    m->polygons[m->polygon_count++] =
        (struct polygon){ (uint32_t)m->corner_count, count, id, slack };
    m->corner_count += count;
}

/* Twice the area of a triangle, seen against n. */
static double turn(const struct vec *points, struct vec n, uint32_t a, uint32_t b, uint32_t c)
{
    struct vec u = vec_sub(points[b], points[a]), v = vec_sub(points[c], points[a]);
    return n.x * (u.y * v.z - u.z * v.y) + n.y * (u.z * v.x - u.x * v.z) +
           n.z * (u.x * v.y - u.y * v.x);
}

static bool is_ear(const struct vec *points, struct vec n, const uint32_t *ring, uint32_t count,
                   uint32_t at)
{
    uint32_t a = ring[(at + count - 1) % count], b = ring[at], c = ring[(at + 1) % count];
    if (turn(points, n, a, b, c) <= 0) {
        return false;
    }
    for (uint32_t i = 0; i < count; i++) {
        uint32_t p = ring[i];
        if (p != a && p != b && p != c && turn(points, n, a, b, p) >= 0 &&
            turn(points, n, b, c, p) >= 0 && turn(points, n, c, a, p) >= 0) {
            return false;
        }
    }
    return true;
}

static bool is_convex(const struct vec *points, struct vec n, const uint32_t *ring, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (turn(points, n, ring[i], ring[(i + 1) % count], ring[(i + 2) % count]) < 0) {
            return false;
        }
    }
    return true;
}

/*
 * What the surface of a polygon that is not flat shall be, the file does not say.
 * It is the compiler's: a fan from the first corner where the outline is convex,
 * otherwise ears, from the second corner on. Where that leaves a choice (concave
 * with more than four corners) the oracle's slack is the polygon's unevenness.
 */
static void add_triangles(struct model *m, const uint32_t *corners, uint32_t count, uint32_t id,
                          double slack)
{
    uint32_t *ring = need(count, sizeof *ring);
    memcpy(ring, corners, count * sizeof *ring);
    struct vec n = newell(m->unsnapped, corners, count);
    bool convex = is_convex(m->unsnapped, n, ring, count);
    slack = convex || count == 4 ? 0 : slack;
    while (count > 3) {
        uint32_t at = 1;
        for (uint32_t tries = 0; !convex && tries < count; tries++) {
            if (is_ear(m->unsnapped, n, ring, count, (1 + tries) % count)) {
                at = (1 + tries) % count;
                break;
            }
        }
        uint32_t ear[3] = { ring[(at + count - 1) % count], ring[at], ring[(at + 1) % count] };
        add_piece(m, ear, 3, id, slack);
        memmove(ring + at, ring + at + 1, (count - at - 1) * sizeof *ring);
        count--;
    }
    add_piece(m, ring, 3, id, slack);
    free(ring);
}

void model_add_polygon(struct model *m, const uint32_t *corners, uint32_t count, uint32_t id)
{
    if (count < 3) {
        return;
    }
    double before = unevenness(m->unsnapped, corners, count);
    double after = unevenness(m->points, corners, count);
    if (count > 3 && before > 1) {
        add_triangles(m, corners, count, id, 2 * fmax(before, after));
    } else {
        add_piece(m, corners, count, id, after);
    }
}

/* ---- neighbours ----------------------------------------------------------------------------- */
int compare_ends(const struct edge *a, const struct edge *b)
{
    for (int i = 0; i < 6; i++) {
        int32_t u = a->ends[i / 3][i % 3], v = b->ends[i / 3][i % 3];
        if (u != v) {
            return u < v ? -1 : 1;
        }
    }
    return 0;
}

static int by_ends(const void *a, const void *b)
{
    return compare_ends(a, b);
}

static struct edge edge_from(const struct model *m, uint32_t polygon, uint32_t i)
{
    const struct polygon *p = &m->polygons[polygon];
    struct edge e = { .corner = p->first + i, .polygon = polygon };
    for (uint32_t end = 0; end < 2; end++) {
        struct vec v = m->points[m->corners[p->first + (i + end) % p->count]];
        e.ends[end][0] = (int32_t)v.x;
        e.ends[end][1] = (int32_t)v.y;
        e.ends[end][2] = (int32_t)v.z;
    }
    struct edge swapped = e;
    memcpy(swapped.ends[0], e.ends[1], sizeof e.ends[0]);
    memcpy(swapped.ends[1], e.ends[0], sizeof e.ends[0]);
    return compare_ends(&e, &swapped) <= 0 ? e : swapped;
}

void model_join(struct model *m)
{
    m->edges = need(m->corner_count, sizeof *m->edges);
    m->edge_of = need(m->corner_count, sizeof *m->edge_of);
    for (uint32_t i = 0; i < m->polygon_count; i++) {
        for (uint32_t k = 0; k < m->polygons[i].count; k++) {
            m->edges[m->polygons[i].first + k] = edge_from(m, i, k);
        }
    }
    qsort(m->edges, m->corner_count, sizeof *m->edges, by_ends);
    for (uint32_t i = 0; i < m->corner_count; i++) {
        m->edge_of[m->edges[i].corner] = i;
    }
}

void model_free(struct model *m)
{
    free(m->points);
    free(m->unsnapped);
    free(m->corners);
    free(m->polygons);
    free(m->edges);
    free(m->edge_of);
}

/* ---- files ---------------------------------------------------------------------------------- */
static void add_point(struct model *m, const struct lattice *lattice, const double v[3])
{
    double l[3];
    for (int i = 0; i < 3; i++) {
        l[i] = (v[i] - lattice->origin[i]) / lattice->step;
    }
    m->points = more(m->points, m->point_count + 1, sizeof *m->points);
    m->unsnapped = more(m->unsnapped, m->point_count + 1, sizeof *m->unsnapped);
    m->unsnapped[m->point_count] = (struct vec){ l[0], l[1], l[2] };
    /* To the nearest lattice point, halves up. */
    m->points[m->point_count++] =
        (struct vec){ floor(l[0] + 0.5), floor(l[1] + 0.5), floor(l[2] + 0.5) };
}

static const struct aiVector3D *corner_of(const struct aiMesh *mesh, uint32_t face, uint32_t i)
{
    return &mesh->mVertices[mesh->mFaces[face].mIndices[i]];
}

/* One polygon whose corners are new points; equal points need no joining here. */
static void add_face(struct model *m, const struct lattice *lattice, const struct aiMesh *mesh,
                     uint32_t face, uint32_t id)
{
    uint32_t count = mesh->mFaces[face].mNumIndices;
    uint32_t *corners = need(count, sizeof *corners);
    for (uint32_t i = 0; i < count; i++) {
        const struct aiVector3D *v = corner_of(mesh, face, i);
        corners[i] = (uint32_t)m->point_count;
        add_point(m, lattice, (double[3]){ v->x, v->y, v->z });
    }
    model_add_polygon(m, corners, count, id);
    free(corners);
}

struct obj {
    double (*v)[3];
    size_t v_count;
    double size; /* largest magnitude of a coordinate */
};

static bool same_face(const struct obj *obj, const struct aiMesh *mesh, uint32_t face,
                      const size_t *corners, uint32_t count)
{
    if (mesh->mFaces[face].mNumIndices != count) {
        return false;
    }
    for (uint32_t i = 0; i < count; i++) {
        const struct aiVector3D *a = corner_of(mesh, face, i);
        const double *b = obj->v[corners[i]];
        double bound = 1e-5 * obj->size;
        if (fabs(a->x - b[0]) > bound || fabs(a->y - b[1]) > bound || fabs(a->z - b[2]) > bound) {
            return false;
        }
    }
    return true;
}

/* The corners of an `f` line as numbers of `v` lines from 0. */
static uint32_t parse_face(const char *path, const struct obj *obj, char *text, size_t *corners,
                           uint32_t room)
{
    uint32_t count = 0;
    char *rest = NULL;
    for (char *t = strtok_r(text, " \t\r\n", &rest); t; t = strtok_r(NULL, " \t\r\n", &rest)) {
        long number = strtol(t, NULL, 10);
        size_t index = number > 0 ? (size_t)number - 1 : obj->v_count - (size_t)-number;
        if (number == 0 || index >= obj->v_count || count == room) {
            stop(path, "an f line that the oracle cannot read");
        }
        corners[count++] = index;
    }
    return count;
}

/* Finds the face among the next unread faces of assimp's meshes, and adds it. */
static void match_face(struct model *m, const struct lattice *lattice, const struct aiScene *scene,
                       uint32_t *cursor, const struct obj *obj, const size_t *corners,
                       uint32_t count)
{
    for (uint32_t k = 0; k < scene->mNumMeshes; k++) {
        const struct aiMesh *mesh = scene->mMeshes[k];
        while (cursor[k] < mesh->mNumFaces && mesh->mFaces[cursor[k]].mNumIndices < 3) {
            cursor[k]++;
        }
        if (cursor[k] < mesh->mNumFaces && same_face(obj, mesh, cursor[k], corners, count)) {
            add_face(m, lattice, mesh, cursor[k]++, m->source_count);
            return;
        }
    }
    stop("model", "an f line is not among assimp's faces");
}

static void read_obj(struct model *m, const char *path, const struct lattice *lattice,
                     const struct aiScene *scene)
{
    FILE *file = fopen(path, "r");
    struct obj obj = { NULL, 0, 0 };
    uint32_t *cursor = need(scene->mNumMeshes + 1, sizeof *cursor);
    char *line = NULL;
    size_t room = 0;
    enum { MOST_CORNERS = 4096 };
    size_t *corners = need(MOST_CORNERS, sizeof *corners);
    while (file && getline(&line, &room, file) > 0) {
        if (line[0] == 'v' && (line[1] == ' ' || line[1] == '\t')) {
            obj.v = more(obj.v, obj.v_count + 1, sizeof *obj.v);
            double *v = obj.v[obj.v_count++];
            if (sscanf(line + 1, "%lf %lf %lf", &v[0], &v[1], &v[2]) != 3) {
                stop(path, "a v line that the oracle cannot read");
            }
            obj.size = fmax(obj.size, fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2]))));
        } else if (line[0] == 'f' && (line[1] == ' ' || line[1] == '\t')) {
            uint32_t count = parse_face(path, &obj, line + 1, corners, MOST_CORNERS);
            m->source_count++;
            if (count >= 3) {
                match_face(m, lattice, scene, cursor, &obj, corners, count);
            }
        }
    }
    if (!file) {
        stop(path, "cannot be opened");
    }
    fclose(file);
    free(line);
    free(corners);
    free(cursor);
    free(obj.v);
}

void model_read(struct model *m, const char *path, const struct lattice *lattice)
{
    memset(m, 0, sizeof *m);
    const struct aiScene *scene = aiImportFile(path, 0);
    if (!scene) {
        stop(path, aiGetErrorString());
    }
    const char *dot = strrchr(path, '.');
    if (dot && strcasecmp(dot, ".obj") == 0) {
        read_obj(m, path, lattice, scene);
    } else {
        for (uint32_t k = 0; k < scene->mNumMeshes; k++) {
            for (uint32_t i = 0; i < scene->mMeshes[k]->mNumFaces; i++) {
                if (scene->mMeshes[k]->mFaces[i].mNumIndices >= 3) {
                    add_face(m, lattice, scene->mMeshes[k], i, ++m->source_count);
                }
            }
        }
    }
    aiReleaseImport(scene);
    if (m->polygon_count == 0) {
        stop(path, "no polygons");
    }
    model_join(m);
}
