/* SPDX-License-Identifier: 0BSD */
/*
 * The oracle: an independent judge of owsim's pictures, in double precision.
 * It shares no code with the renderer or the compiler. main.c says how it judges.
 */
#ifndef OLDWELL_TESTS_ORACLE_H
#define OLDWELL_TESTS_ORACLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/*
 * Pixels by which rounding may move two outlines against each other: corners go
 * to the nearest 1/256 pixel, and arithmetic before that adds about as much.
 */
#define ROUNDING (1.0 / 64)

struct vec {
    double x, y, z;
};

/* What the oracle takes from a blob's header. */
struct lattice {
    double origin[3];
    double step;      /* model units in a lattice step */
    double tolerance; /* lattice steps */
    bool two_sided;
};

/* One flat piece of a source polygon: its corners lie in `corners` of the model. */
struct polygon {
    uint32_t first;
    uint32_t count;
    uint32_t id;  /* the source polygon's place in the file, from 1 */
    double slack; /* farthest corner from the polygon's plane, lattice steps */
};

/* An edge, from each polygon that has it: places in corners of where it begins. */
struct edge {
    int32_t ends[2][3]; /* lattice points, the lesser first */
    uint32_t corner;
    uint32_t polygon;
};

struct model {
    struct vec *points;    /* lattice points */
    struct vec *unsnapped; /* the same in lattice units before rounding */
    uint32_t *corners;     /* numbers of points */
    struct polygon *polygons;
    struct edge *edges; /* sorted by ends: those of neighbours lie together */
    uint32_t *edge_of;  /* a corner's place in edges */
    size_t point_count;
    size_t corner_count;
    size_t polygon_count;
    uint32_t source_count; /* polygons in the file */
};

/* A view as the core quantised it, in lattice units and pixels. */
struct camera {
    struct vec eye;
    struct vec axis[3]; /* right, up, forward */
    double near_z;
    double focal; /* pixels: times x/z in perspective, times x in parallel projection */
    uint32_t width;
    uint32_t height;
    bool parallel;
    bool cuts; /* what is drawn: cut.p + cut_offset >= 0, camera axes, lattice units */
    struct vec cut;
    double cut_offset;
};

/* What the pixels of a frame say. */
enum tells {
    TELLS_ID,  /* the polygon's number */
    TELLS_SIDE /* SIDE_FRONT or SIDE_BACK of some polygon: a cap shows where backs would */
};

enum { SIDE_FRONT = 1, SIDE_BACK = 2 };

/* A polygon as one view shows it. Outline: pixels, y down. */
struct shape {
    uint32_t first; /* of the scene's outline points */
    uint32_t count;
    uint32_t id; /* the source polygon's number, or its side: whatever the frame tells */
    double slack;
    struct vec normal; /* unit, camera axes, lattice units */
    double offset;     /* normal.p + offset = 0 */
    double z_min, z_max;
    double x_min, x_max, y_min, y_max;
    bool facing; /* shown: by its side, or because rounding to 1/256 pixel could turn it round */
    bool thin;   /* so thin that rounding could turn it round */
    uint32_t polygon;
};

/* A corner of an outline, and the edge from it to the next. */
struct spot {
    double x, y;
    uint32_t corner; /* of the model, where the edge comes from; CUT: a plane cut it */
    bool rim;        /* no other polygon that is drawn has this edge */
};

#define CUT UINT32_MAX

/* All polygons of one view, with bins of 4 x 4 pixels. */
struct scene {
    const struct camera *camera;
    const struct model *model;
    bool two_sided;
    enum tells tells;
    struct shape *shapes;
    size_t shape_count;
    struct spot *spots;
    size_t spot_count;
    uint32_t *bin_start; /* bins + 1 */
    uint32_t *bin_items; /* shape numbers */
    uint32_t bins_across;
    uint32_t bins_down;
    uint32_t *id_first; /* shapes of one source polygon: id_first[id] .. id_first[id + 1] - 1 */
    uint32_t *id_shapes;
    uint32_t id_count;
    uint32_t *seen; /* a pixel: number of the nearest shape at its centre + 1, or 0 */
    double *depth;
};

enum { EXAMPLES = 8 };

/* A wrong pixel or hole. */
struct example {
    uint32_t x, y;
    uint32_t shown; /* polygons, 0 background */
    uint32_t due;
};

struct verdict {
    uint64_t model; /* pixels where the oracle shows the model */
    uint64_t same;  /* the same polygon at the centre */
    uint64_t edge;  /* right by a neighbouring point within one pixel */
    uint64_t near;  /* right only by the projected lattice step */
    uint64_t tie;   /* right by depth within the bound, along the view */
    uint64_t slant; /* right by depth within the bound, along a polygon's normal alone */
    uint64_t rim;   /* right by the rounding of outlines that end there */
    uint64_t strip; /* right by lying on a plane with what is due, seen edge-on */
    uint64_t wrong;
    uint64_t holes;
    struct example examples[EXAMPLES]; /* the first ones, wrong + holes of them */
};

/* model.c */
void lattice_read(struct lattice *lattice, const char *tree);
void model_read(struct model *model, const char *path, const struct lattice *lattice);
/* Fills polygons from outlines already in points, unsnapped and corners; frees nothing. */
void model_add_polygon(struct model *model, const uint32_t *corners, uint32_t count, uint32_t id);
/* Finds out who shares edges with whom; after the last polygon. */
void model_join(struct model *model);
/* 0 if two edges have the same ends. */
int compare_ends(const struct edge *a, const struct edge *b);
void model_free(struct model *model);

/* view.c */
struct camera *cameras_read(const char *path, size_t *count);
int near_views_print(const struct model *model, const struct lattice *lattice, uint32_t count);

/* scene.c */
void scene_make(struct scene *scene, const struct model *model, const struct camera *camera,
                bool two_sided, enum tells tells);
void scene_free(struct scene *scene);
int shape_winding(const struct scene *scene, const struct shape *shape, double x, double y);
bool shape_covers(const struct scene *scene, const struct shape *shape, double x, double y);
/* The same, and no rim is within ROUNDING and a projected lattice step. */
bool shape_covers_surely(const struct scene *scene, const struct shape *shape, double x, double y);
/* The ray through a screen point: o + t * (0, 0, 1) in parallel projection, else t * (x, y, 1). */
struct vec scene_ray(const struct camera *camera, double x, double y);
/* Pixels that a lattice step covers at this depth. */
double scene_step(const struct camera *camera, double z);
/* Depth along forward at a screen point, kept within the shape's own depths. */
double shape_depth(const struct scene *scene, const struct shape *shape, double x, double y);
/* Cosine-like share of a depth difference that lies along the shape's normal, 0 .. about 1. */
double shape_slope(const struct scene *scene, const struct shape *shape, double x, double y);

const uint32_t *scene_candidates(const struct scene *scene, double x, double y, uint32_t *count);

/* judge.c */
void judge(const struct scene *scene, const uint32_t *frame, double tie, struct verdict *verdict,
           uint8_t *difference);

/* ppm.c */
uint32_t *ppm_read(const char *path, uint32_t *width, uint32_t *height);
void ppm_write(const char *path, const uint8_t *rgb, uint32_t width, uint32_t height);

/* selftest.c */
int self_test(void);

/* main.c */
_Noreturn void stop(const char *file, const char *what);
void *need(size_t count, size_t size);
void *more(void *block, size_t count, size_t size);

static inline struct vec vec_sub(struct vec a, struct vec b)
{
    return (struct vec){ a.x - b.x, a.y - b.y, a.z - b.z };
}

static inline double vec_dot(struct vec a, struct vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

#endif
