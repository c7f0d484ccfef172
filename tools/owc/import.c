/* SPDX-License-Identifier: 0BSD */
/*
 * Reading models through assimp: files are read whole and handed over from
 * memory, and the scene's meshes become one list of polygons.
 */
#include "import.h"

#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "obj_text.h"
#include "ow_blob.h"
#include "tools/common/xalloc.h"

/* ---- files for assimp ---- */

struct source {
    const char *name; /* of the model */
    const char *text;
    size_t size;
    bool others; /* files that the model names may be read */
};

struct open_file {
    struct aiFile file;
    char *text;
    size_t size;
    size_t at;
    bool own;
};

/* The whole file with a zero byte after it, or NULL and errno. */
static char *read_whole(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return NULL;
    }
    char *text = NULL;
    size_t capacity = 0;
    size_t used = 0;
    size_t got;
    do {
        text = xgrow(text, &capacity, used + 65536, 1);
        got = fread(text + used, 1, capacity - used - 1, file);
        used += got;
    } while (got > 0);
    int error = ferror(file) ? errno : 0;
    fclose(file);
    if (error != 0) {
        free(text);
        errno = error;
        return NULL;
    }
    text[used] = '\0';
    *size = used;
    return text;
}

static size_t file_read(struct aiFile *file, char *to, size_t size, size_t count)
{
    struct open_file *open = (struct open_file *)file->UserData;
    size_t left = open->size - open->at;
    size_t whole = size > 0 ? left / size : 0;
    whole = whole < count ? whole : count;
    memcpy(to, open->text + open->at, whole * size);
    open->at += whole * size;
    return whole;
}

static size_t file_write(struct aiFile *file, const char *from, size_t size, size_t count)
{
    (void)file;
    (void)from;
    (void)size;
    (void)count;
    return 0;
}

static size_t file_tell(struct aiFile *file)
{
    return ((struct open_file *)file->UserData)->at;
}

static size_t file_size(struct aiFile *file)
{
    return ((struct open_file *)file->UserData)->size;
}

static aiReturn file_seek(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    struct open_file *open = (struct open_file *)file->UserData;
    size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? open->at : open->size;
    size_t at = base + offset; /* backwards: offset wraps around, as it does in assimp */
    if (at > open->size) {
        return aiReturn_FAILURE;
    }
    open->at = at;
    return aiReturn_SUCCESS;
}

static void file_flush(struct aiFile *file)
{
    (void)file;
}

static struct aiFile *file_open(struct aiFileIO *io, const char *name, const char *mode)
{
    const struct source *source = (const struct source *)io->UserData;
    bool own = strcmp(name, source->name) == 0;
    size_t size = source->size;
    char *text = (char *)(uintptr_t)source->text;
    if (strchr(mode, 'r') == NULL || (!own && !source->others)) {
        return NULL;
    }
    if (!own) {
        text = read_whole(name, &size);
        if (text == NULL) {
            return NULL;
        }
    }
    struct open_file *open = xalloc_zero(1, sizeof *open);
    open->file = (struct aiFile){ file_read, file_write, file_tell,   file_size,
                                  file_seek, file_flush, (char *)open };
    open->text = text;
    open->size = size;
    open->own = own;
    return &open->file;
}

static void file_close(struct aiFileIO *io, struct aiFile *file)
{
    (void)io;
    struct open_file *open = (struct open_file *)file->UserData;
    if (!open->own) {
        free(open->text);
    }
    free(open);
}

/* ---- the scene ---- */

/* A node's transform to model space; rows as assimp has them. */
struct transform {
    double m[3][4];
    bool identity;
    bool mirrors;
};

static struct transform transform_of(const struct aiNode *node)
{
    struct aiMatrix4x4 all = node->mTransformation;
    for (const struct aiNode *up = node->mParent; up != NULL; up = up->mParent) {
        struct aiMatrix4x4 product = up->mTransformation;
        aiMultiplyMatrix4(&product, &all);
        all = product;
    }
    struct transform t = {
        .m = { { all.a1, all.a2, all.a3, all.a4 },
               { all.b1, all.b2, all.b3, all.b4 },
               { all.c1, all.c2, all.c3, all.c4 } },
        .identity = true,
    };
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 4; k++) {
            t.identity = t.identity && t.m[i][k] == (i == k);
        }
    }
    double determinant = t.m[0][0] * (t.m[1][1] * t.m[2][2] - t.m[1][2] * t.m[2][1]) -
                         t.m[0][1] * (t.m[1][0] * t.m[2][2] - t.m[1][2] * t.m[2][0]) +
                         t.m[0][2] * (t.m[1][0] * t.m[2][1] - t.m[1][1] * t.m[2][0]);
    t.mirrors = determinant < 0;
    return t;
}

static void transform_point(const struct transform *t, const struct aiVector3D *v, double out[3])
{
    double in[3] = { v->x, v->y, v->z };
    for (int i = 0; i < 3; i++) {
        out[i] = t->identity
                     ? in[i]
                     : t->m[i][0] * in[0] + t->m[i][1] * in[1] + t->m[i][2] * in[2] + t->m[i][3];
    }
}

/* Normals go by the matrix of cofactors. */
static void transform_normal(const struct transform *t, const struct aiVector3D *v, float out[3])
{
    double in[3] = { v->x, v->y, v->z };
    double n[3];
    for (int i = 0; i < 3; i++) {
        const double *a = t->m[(i + 1) % 3];
        const double *b = t->m[(i + 2) % 3];
        n[i] = (a[1] * b[2] - a[2] * b[1]) * in[0] + (a[2] * b[0] - a[0] * b[2]) * in[1] +
               (a[0] * b[1] - a[1] * b[0]) * in[2];
    }
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int i = 0; i < 3; i++) {
        double unit = n[i] / length;
        out[i] = isfinite(unit) ? (float)unit : 0;
    }
}

static uint32_t byte_of(float share)
{
    return share >= 1 ? 255 : share > 0 ? (uint32_t)(share * 255 + 0.5f) : 0;
}

static uint32_t colour_of(const struct aiScene *scene, const struct aiMesh *mesh)
{
    struct aiColor4D colour;
    struct aiString name;
    if (mesh->mMaterialIndex >= scene->mNumMaterials) {
        return MODEL_DEFAULT_COLOUR;
    }
    const struct aiMaterial *material = scene->mMaterials[mesh->mMaterialIndex];
    if (aiGetMaterialString(material, AI_MATKEY_NAME, &name) == aiReturn_SUCCESS &&
        strcmp(name.data, AI_DEFAULT_MATERIAL_NAME) == 0) {
        return MODEL_DEFAULT_COLOUR;
    }
    if (aiGetMaterialColor(material, AI_MATKEY_COLOR_DIFFUSE, &colour) != aiReturn_SUCCESS) {
        return MODEL_DEFAULT_COLOUR;
    }
    return byte_of(colour.r) << 16 | byte_of(colour.g) << 8 | byte_of(colour.b);
}

static uint32_t distance_of(uint32_t a, uint32_t b)
{
    uint32_t sum = 0;
    for (int shift = 0; shift < 24; shift += 8) {
        int32_t d = (int32_t)(a >> shift & 255) - (int32_t)(b >> shift & 255);
        sum += (uint32_t)(d * d);
    }
    return sum;
}

/* The colour's number; when there are too many colours, the nearest one's. */
static uint16_t enter_colour(struct model *model, uint32_t rgb)
{
    size_t best = 0;
    for (size_t i = 0; i < model->colour_count; i++) {
        if (distance_of(model->colours[i], rgb) < distance_of(model->colours[best], rgb)) {
            best = i;
        }
    }
    if (model->colour_count > 0 && model->colours[best] == rgb) {
        return (uint16_t)best;
    }
    if (model->colour_count == OW_MAX_COLOURS) {
        model->colours_changed++;
        return (uint16_t)best;
    }
    model->colours = xgrow(model->colours, &model->colour_capacity, model->colour_count + 1,
                           sizeof *model->colours);
    model->colours[model->colour_count] = rgb;
    return (uint16_t)model->colour_count++;
}

static bool add_face(struct model *model, const struct aiFace *face, const struct aiMesh *mesh,
                     size_t base, bool mirrors, struct problem *problem)
{
    model->corners = xgrow(model->corners, &model->corner_capacity,
                           model->corner_count + face->mNumIndices, sizeof *model->corners);
    for (uint32_t i = 0; i < face->mNumIndices; i++) {
        uint32_t index = face->mIndices[mirrors ? face->mNumIndices - 1 - i : i];
        if (index >= mesh->mNumVertices) {
            return problem_set(problem, 0, "polygon %zu refers to vertex %u, but its mesh has %u",
                               model->polygon_count + 1, index, mesh->mNumVertices);
        }
        model->corners[model->corner_count + i] = (uint32_t)(base + index);
    }
    model->corner_count += face->mNumIndices;
    return true;
}

static bool add_vertices(struct model *model, const struct aiMesh *mesh, const struct transform *t,
                         struct problem *problem)
{
    size_t base = model->vertex_count;
    size_t all = base + mesh->mNumVertices;
    if (all >= UINT32_MAX) {
        return problem_set(problem, 0, "has more than %u vertices", UINT32_MAX - 1);
    }
    model->vertices = xgrow(model->vertices, &model->vertex_capacity, all, sizeof *model->vertices);
    model->normals = xgrow(model->normals, &model->normal_capacity, all, sizeof *model->normals);
    for (uint32_t i = 0; i < mesh->mNumVertices; i++) {
        transform_point(t, &mesh->mVertices[i], model->vertices[base + i]);
        memset(model->normals[base + i], 0, sizeof model->normals[base + i]);
        if (mesh->mNormals != NULL) {
            transform_normal(t, &mesh->mNormals[i], model->normals[base + i]);
        }
    }
    model->vertex_count = all;
    return true;
}

static bool add_mesh(struct model *model, const struct aiScene *scene, const struct aiMesh *mesh,
                     const struct transform *t, struct problem *problem)
{
    size_t base = model->vertex_count;
    uint16_t colour = 0;
    if (!add_vertices(model, mesh, t, problem)) {
        return false;
    }
    if (mesh->mNumFaces > 0) {
        colour = enter_colour(model, colour_of(scene, mesh));
    }
    for (uint32_t i = 0; i < mesh->mNumFaces; i++) {
        const struct aiFace *face = &mesh->mFaces[i];
        if (face->mNumIndices < 3) {
            model->lines_dropped++;
            continue;
        }
        size_t first = model->corner_count;
        if (!add_face(model, face, mesh, base, t->mirrors, problem)) {
            return false;
        }
        model->polygons = xgrow(model->polygons, &model->polygon_capacity, model->polygon_count + 1,
                                sizeof *model->polygons);
        model->polygons[model->polygon_count++] =
            (struct model_polygon){ first, face->mNumIndices, colour };
    }
    return true;
}

static bool add_node(struct model *model, const struct aiScene *scene, const struct aiNode *node,
                     struct problem *problem)
{
    struct transform t = transform_of(node);
    for (uint32_t i = 0; i < node->mNumMeshes; i++) {
        if (node->mMeshes[i] < scene->mNumMeshes &&
            !add_mesh(model, scene, scene->mMeshes[node->mMeshes[i]], &t, problem)) {
            return false;
        }
    }
    return true;
}

/* All nodes, parents before children, in the file's order. */
static bool add_scene(struct model *model, const struct aiScene *scene, struct problem *problem)
{
    const struct aiNode **stack = NULL;
    size_t capacity = 0;
    size_t count = 0;
    bool fine = true;
    if (scene->mRootNode != NULL) {
        stack = xgrow(stack, &capacity, 1, sizeof *stack);
        stack[count++] = scene->mRootNode;
    }
    while (fine && count > 0) {
        const struct aiNode *node = stack[--count];
        fine = add_node(model, scene, node, problem);
        stack = xgrow(stack, &capacity, count + node->mNumChildren, sizeof *stack);
        for (uint32_t i = node->mNumChildren; i > 0; i--) {
            stack[count++] = node->mChildren[i - 1];
        }
    }
    free(stack);
    return fine;
}

static bool check_model(const struct model *model, struct problem *problem)
{
    for (size_t i = 0; i < model->polygon_count; i++) {
        for (uint32_t k = 0; k < model->polygons[i].count; k++) {
            const double *v = model->vertices[model->corners[model->polygons[i].first + k]];
            if (!isfinite(v[0]) || !isfinite(v[1]) || !isfinite(v[2])) {
                return problem_set(problem, 0, "a coordinate of polygon %zu is not a finite number",
                                   i + 1);
            }
        }
    }
    return model->polygon_count > 0 || problem_set(problem, 0, "has no polygons");
}

/* assimp's own words on one line. */
static bool refused(struct problem *problem)
{
    char text[256];
    snprintf(text, sizeof text, "%s", aiGetErrorString());
    text[strcspn(text, "\r\n")] = '\0';
    if (strstr(text, "bad_alloc") != NULL) {
        return problem_set(problem, 0, "is too large: out of memory");
    }
    return problem_set(problem, 0, "cannot be read as a model: %s",
                       text[0] != '\0' ? text : "the format is not known");
}

static bool import_source(struct model *model, struct source *source, struct problem *problem)
{
    struct aiFileIO io = { file_open, file_close, (char *)source };
    const struct aiScene *scene = aiImportFileEx(source->name, 0, &io);
    if (scene == NULL) {
        return refused(problem);
    }
    bool fine = add_scene(model, scene, problem) && check_model(model, problem);
    aiReleaseImport(scene);
    return fine;
}

static bool is_obj(const char *name)
{
    const char *dot = strrchr(name, '.');
    return dot != NULL && strcasecmp(dot, ".obj") == 0;
}

/* text ends with a zero byte. */
static bool import_text(struct model *model, const char *name, char *text, size_t size, bool others,
                        struct problem *problem)
{
    struct source source = { name, text, size, others };
    if (size == 0) {
        return problem_set(problem, 0, "is empty");
    }
    if (is_obj(name)) {
        if (!obj_check(text, size, problem)) {
            return false;
        }
        obj_hide_groups(text, size);
    }
    return import_source(model, &source, problem);
}

bool import_file(struct model *model, const char *path, struct problem *problem)
{
    size_t size;
    memset(model, 0, sizeof *model);
    char *text = read_whole(path, &size);
    if (text == NULL) {
        return problem_set(problem, 0, "cannot be read: %s", strerror(errno));
    }
    bool fine = import_text(model, path, text, size, true, problem);
    free(text);
    return fine;
}

bool import_memory(struct model *model, const void *bytes, size_t size, const char *hint,
                   struct problem *problem)
{
    char name[32];
    memset(model, 0, sizeof *model);
    snprintf(name, sizeof name, "model.%s", hint);
    char *text = xalloc(size + 1, 1);
    memcpy(text, bytes, size);
    text[size] = '\0';
    bool fine = import_text(model, name, text, size, false, problem);
    free(text);
    return fine;
}

void import_free(struct model *model)
{
    free(model->vertices);
    free(model->normals);
    free(model->corners);
    free(model->polygons);
    free(model->colours);
    memset(model, 0, sizeof *model);
}
