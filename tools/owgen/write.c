/* SPDX-License-Identifier: 0BSD */
/* Writes a mesh as an OBJ file and its materials as an MTL file beside it. */
#define _XOPEN_SOURCE 700 /* PATH_MAX */
#include "tools/owgen/write.h"

#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "tools/common/fail.h"
#include "tools/common/outfile.h"

/* Six decimals by integer arithmetic: no printf of doubles, no "-0". */
static void write_coordinate(FILE *stream, int64_t value)
{
    uint64_t size = value < 0 ? (uint64_t)-value : (uint64_t)value;
    fprintf(stream, " %s%" PRIu64 ".%06" PRIu64, value < 0 ? "-" : "", size / MESH_SCALE,
            size % MESH_SCALE);
}

static void write_polygon(const struct mesh *mesh, const struct mesh_polygon *polygon, FILE *stream)
{
    fputc('f', stream);
    for (size_t i = 0; i < polygon->count; i++) {
        fprintf(stream, " %zu", mesh->corners[polygon->first + i] + 1);
    }
    fputc('\n', stream);
}

static void write_obj(const struct mesh *mesh, const char *title, const char *mtl_name,
                      FILE *stream)
{
    fprintf(stream, "# %s: %zu vertices, %zu polygons\n", title, mesh->vertex_count,
            mesh->polygon_count);
    if (mtl_name != NULL) {
        fprintf(stream, "mtllib %s\n", mtl_name);
    }
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        fputc('v', stream);
        for (int k = 0; k < 3; k++) {
            write_coordinate(stream, mesh->vertices[i].at[k]);
        }
        fputc('\n', stream);
    }
    int part = -1;
    int material = -1;
    for (size_t i = 0; i < mesh->polygon_count; i++) {
        const struct mesh_polygon *polygon = &mesh->polygons[i];
        /* A comment, not an object: readers may put objects of one name together. */
        if (polygon->part != part) {
            part = polygon->part;
            fprintf(stream, "# part %s\n", mesh->parts[part].name);
        }
        if (polygon->material != material && mtl_name != NULL) {
            material = polygon->material;
            fprintf(stream, "usemtl %s\n", mesh->materials[material].name);
        }
        write_polygon(mesh, polygon, stream);
    }
}

static void write_mtl(const struct mesh *mesh, const char *title, FILE *stream)
{
    fprintf(stream, "# %s: %zu materials\n", title, mesh->material_count);
    for (size_t i = 0; i < mesh->material_count; i++) {
        fprintf(stream, "newmtl %s\nKd", mesh->materials[i].name);
        for (int shift = 16; shift >= 0; shift -= 8) {
            uint32_t byte = mesh->materials[i].colour >> shift & 255;
            write_coordinate(stream, ((int64_t)byte * MESH_SCALE + 127) / 255);
        }
        fputc('\n', stream);
    }
}

/* The OBJ's name with .mtl for .obj; what has another ending gets .mtl added. */
static void name_mtl(const char *path, char *mtl, size_t bytes)
{
    size_t length = strlen(path);
    if (length > 4 && strcmp(path + length - 4, ".obj") == 0) {
        length -= 4;
    }
    if (length + 5 > bytes) {
        fail(FAIL_INPUT, NULL, 0, "the output file's name is too long");
    }
    memcpy(mtl, path, length);
    strcpy(mtl + length, ".mtl");
}

void write_model(const struct mesh *mesh, const char *title, const char *path)
{
    char mtl[PATH_MAX];
    struct outfile *outs[2] = { outfile_open(path), NULL };
    if (outfile_is_direct(outs[0])) {
        write_obj(mesh, title, NULL, outfile_stream(outs[0]));
        outfile_commit(outs[0]);
        return;
    }
    name_mtl(path, mtl, sizeof mtl);
    outs[1] = outfile_open(mtl);
    const char *slash = strrchr(mtl, '/');
    write_obj(mesh, title, slash == NULL ? mtl : slash + 1, outfile_stream(outs[0]));
    write_mtl(mesh, title, outfile_stream(outs[1]));
    outfile_commit_all(outs, 2);
}
