/* SPDX-License-Identifier: 0BSD */
/* The models that the generator can make: one build function each, and the table of them. */
#ifndef OLDWELL_TOOLS_OWGEN_MODELS_H
#define OLDWELL_TOOLS_OWGEN_MODELS_H

#include "tools/owgen/mesh.h"

enum model_detail { DETAIL_LOW, DETAIL_HIGH };

/* What the command line may say about a model. */
struct model_options {
    enum model_detail detail;
    uint64_t count; /* triangles of random and parallel */
    double size;    /* side of the cube or square that holds a triangle */
    uint64_t seed;
};

/* What a model promises; the tests hold it to that. */
enum model_traits {
    MODEL_FLAT = 1,    /* every polygon is planar */
    MODEL_CONVEX = 2,  /* every polygon is convex */
    MODEL_CLOSED = 4,  /* every part is a closed solid */
    MODEL_APART = 8,   /* parts touch, but none reaches into another */
    MODEL_DETAIL = 16, /* takes --detail */
    MODEL_RANDOM = 32  /* takes --count, --size and --seed */
};

struct model_kind {
    const char *name;
    void (*build)(struct mesh *mesh, const struct model_options *options);
    size_t polygons[2]; /* at low and high detail; 0: as many as --count says */
    unsigned traits;
    const char *about;
};

extern const struct model_kind model_kinds[];
extern const size_t model_kind_count;

/* NULL if there is no such kind. */
const struct model_kind *model_find(const char *name);

void model_oldwell(struct mesh *mesh, const struct model_options *options);
void model_cubes(struct mesh *mesh, const struct model_options *options);
void model_klein(struct mesh *mesh, const struct model_options *options);
void model_ribbon(struct mesh *mesh, const struct model_options *options);
void model_atoms(struct mesh *mesh, const struct model_options *options);
void model_robot(struct mesh *mesh, const struct model_options *options);
void model_vise(struct mesh *mesh, const struct model_options *options);
void model_house(struct mesh *mesh, const struct model_options *options);
void model_random(struct mesh *mesh, const struct model_options *options);
void model_parallel(struct mesh *mesh, const struct model_options *options);

#endif
