/* SPDX-License-Identifier: 0BSD */
/* A polygon mesh as the generator builds it: growing arrays, joined vertices, placings. */
#include "tools/owgen/mesh.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/common/fail.h"
#include "tools/owgen/circle.h"

/* Makes room for `more` items after `count`; returns the array, moved if need be. */
static void *grow(void *array, size_t count, size_t more, size_t *room, size_t item_bytes)
{
    if (more <= *room - count) {
        return array;
    }
    size_t wanted = count + more > 2 * *room ? count + more : 2 * *room;
    wanted = wanted < 64 ? 64 : wanted;
    void *moved = wanted > SIZE_MAX / item_bytes ? NULL : realloc(array, wanted * item_bytes);
    if (moved == NULL) {
        fail(FAIL_INPUT, NULL, 0, "out of memory, make a smaller model");
    }
    *room = wanted;
    return moved;
}

void mesh_init(struct mesh *mesh)
{
    memset(mesh, 0, sizeof *mesh);
    place_reset(mesh);
}

void mesh_free(struct mesh *mesh)
{
    free(mesh->vertices);
    free(mesh->corners);
    free(mesh->polygons);
    free(mesh->parts);
    free(mesh->materials);
    memset(mesh, 0, sizeof *mesh);
}

int mesh_material(struct mesh *mesh, const char *name, uint32_t colour)
{
    mesh->materials = grow(mesh->materials, mesh->material_count, 1, &mesh->material_room,
                           sizeof *mesh->materials);
    struct mesh_material *material = &mesh->materials[mesh->material_count];
    snprintf(material->name, sizeof material->name, "%s", name);
    material->colour = colour;
    return (int)mesh->material_count++;
}

void mesh_part(struct mesh *mesh, const char *name, bool closed)
{
    mesh->parts = grow(mesh->parts, mesh->part_count, 1, &mesh->part_room, sizeof *mesh->parts);
    struct mesh_part *part = &mesh->parts[mesh->part_count++];
    snprintf(part->name, sizeof part->name, "%s", name);
    part->closed = closed;
    part->first_vertex = mesh->vertex_count;
    part->first_polygon = mesh->polygon_count;
}

static struct mesh_vertex placed(const struct mesh *mesh, double x, double y, double z)
{
    struct mesh_vertex vertex;
    for (int i = 0; i < 3; i++) {
        const double *row = mesh->place.turn[i];
        double value = row[0] * x + row[1] * y + row[2] * z + mesh->place.move[i];
        vertex.at[i] = llround(value * MESH_SCALE);
    }
    return vertex;
}

static size_t add_vertex(struct mesh *mesh, struct mesh_vertex vertex)
{
    mesh->vertices =
        grow(mesh->vertices, mesh->vertex_count, 1, &mesh->vertex_room, sizeof *mesh->vertices);
    mesh->vertices[mesh->vertex_count] = vertex;
    return mesh->vertex_count++;
}

size_t mesh_vertex_new(struct mesh *mesh, double x, double y, double z)
{
    return add_vertex(mesh, placed(mesh, x, y, z));
}

size_t mesh_vertex(struct mesh *mesh, double x, double y, double z)
{
    struct mesh_vertex vertex = placed(mesh, x, y, z);
    for (size_t i = mesh->parts[mesh->part_count - 1].first_vertex; i < mesh->vertex_count; i++) {
        if (memcmp(&mesh->vertices[i], &vertex, sizeof vertex) == 0) {
            return i;
        }
    }
    return add_vertex(mesh, vertex);
}

void mesh_polygon(struct mesh *mesh, int material, size_t count, const size_t *corners)
{
    mesh->corners =
        grow(mesh->corners, mesh->corner_count, count, &mesh->corner_room, sizeof *mesh->corners);
    memcpy(mesh->corners + mesh->corner_count, corners, count * sizeof *corners);
    mesh->polygons =
        grow(mesh->polygons, mesh->polygon_count, 1, &mesh->polygon_room, sizeof *mesh->polygons);
    mesh->polygons[mesh->polygon_count++] = (struct mesh_polygon){
        .first = mesh->corner_count,
        .count = count,
        .material = material,
        .part = (int)mesh->part_count - 1,
    };
    mesh->corner_count += count;
}

void mesh_quad(struct mesh *mesh, int material, const size_t corners[4])
{
    size_t kept[4];
    size_t count = 0;
    for (size_t i = 0; i < 4; i++) {
        if (corners[i] != corners[(i + 1) % 4]) {
            kept[count++] = corners[i];
        }
    }
    mesh_polygon(mesh, material, count, kept);
}

void mesh_position(const struct mesh *mesh, size_t vertex, double position[3])
{
    for (int i = 0; i < 3; i++) {
        position[i] = (double)mesh->vertices[vertex].at[i] / MESH_SCALE;
    }
}

void place_reset(struct mesh *mesh)
{
    mesh->place = (struct placing){ .turn = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
}

void place_move(struct mesh *mesh, double x, double y, double z)
{
    struct placing *place = &mesh->place;
    for (int i = 0; i < 3; i++) {
        place->move[i] += place->turn[i][0] * x + place->turn[i][1] * y + place->turn[i][2] * z;
    }
}

void place_turn(struct mesh *mesh, int axis, double degrees)
{
    double c = circle_cos(degrees);
    double s = circle_sin(degrees);
    int u = (axis + 1) % 3;
    int v = (axis + 2) % 3;
    for (int i = 0; i < 3; i++) {
        double *row = mesh->place.turn[i];
        double at_u = row[u];
        double at_v = row[v];
        row[u] = at_u * c + at_v * s;
        row[v] = at_v * c - at_u * s;
    }
}
