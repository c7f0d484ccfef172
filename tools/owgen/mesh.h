/* SPDX-License-Identifier: 0BSD */
/*
 * A polygon mesh as the generator builds it.
 *
 * Axes: right-handed, y up; a polygon is counter-clockwise seen from the side it faces.
 * Coordinates are kept in whole millionths, so that a file is the same on every machine.
 * A mesh is a list of parts; vertices are joined inside a part and never between parts.
 * A polygon with a hole is one outline that goes in to the hole and back along the same two
 * vertices. Memory that runs out ends the program with one line.
 */
#ifndef OLDWELL_TOOLS_OWGEN_MESH_H
#define OLDWELL_TOOLS_OWGEN_MESH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Units of struct mesh_vertex in one unit of the model. */
#define MESH_SCALE 1000000

enum { MESH_NAME_BYTES = 32 };

struct mesh_vertex {
    int64_t at[3]; /* x, y, z in 1 / MESH_SCALE */
};

struct mesh_polygon {
    size_t first; /* into mesh.corners */
    size_t count;
    int material;
    int part;
};

struct mesh_part {
    char name[MESH_NAME_BYTES];
    bool closed; /* promises that every directed edge meets its reverse exactly once */
    size_t first_vertex;
    size_t first_polygon;
};

struct mesh_material {
    char name[MESH_NAME_BYTES];
    uint32_t colour; /* 0xRRGGBB */
};

/* Where the next vertices go: p' = turn * p + move. */
struct placing {
    double turn[3][3];
    double move[3];
};

struct mesh {
    struct mesh_vertex *vertices;
    size_t vertex_count, vertex_room;
    size_t *corners; /* vertex numbers from 0 */
    size_t corner_count, corner_room;
    struct mesh_polygon *polygons;
    size_t polygon_count, polygon_room;
    struct mesh_part *parts;
    size_t part_count, part_room;
    struct mesh_material *materials;
    size_t material_count, material_room;
    struct placing place;
};

void mesh_init(struct mesh *mesh);
void mesh_free(struct mesh *mesh);

/* Adds a material and returns its number. Names are unique by the caller's care. */
int mesh_material(struct mesh *mesh, const char *name, uint32_t colour);

/* Begins a part; the vertices and polygons that follow belong to it. */
void mesh_part(struct mesh *mesh, const char *name, bool closed);

/* Returns the number of the part's vertex at this place; adds it if it is new. */
size_t mesh_vertex(struct mesh *mesh, double x, double y, double z);

/* Adds a vertex without looking for an equal one. */
size_t mesh_vertex_new(struct mesh *mesh, double x, double y, double z);

void mesh_polygon(struct mesh *mesh, int material, size_t count, const size_t *corners);

/*
 * A polygon of four vertices; equal neighbours are left out, so it may become a triangle.
 * Takes an array so that nobody calls mesh_vertex in an argument list: the order in which
 * arguments are evaluated, and with it the vertices' numbers, is the compiler's choice.
 */
void mesh_quad(struct mesh *mesh, int material, const size_t corners[4]);

/* A vertex's place in the model's units. */
void mesh_position(const struct mesh *mesh, size_t vertex, double position[3]);

/* Placings: each of these is done to the point before what mesh->place already does. */
void place_reset(struct mesh *mesh);
void place_move(struct mesh *mesh, double x, double y, double z);
/* Turns by `degrees` about axis 0 (x), 1 (y) or 2 (z), counter-clockwise seen from its tip. */
void place_turn(struct mesh *mesh, int axis, double degrees);

#endif
