/* SPDX-License-Identifier: 0BSD */
/*
 * Drawing a band of a frame: open -> walk -> clip -> project -> scan -> shade
 * -> paint, in one call and in memory that the caller gives.
 */
#ifndef OW_DRAW_H
#define OW_DRAW_H

#include <stdbool.h>
#include <stdint.h>

#include "ow_changes.h"
#include "ow_fixed.h"
#include "ow_parts.h"
#include "ow_pixel.h"
#include "ow_status.h"
#include "ow_tree.h"
#include "ow_view.h"
#include "ow_walk.h"

enum ow_order {
    OW_BACK_TO_FRONT, /* painter's surface: overwrite [FKN80] */
    OW_FRONT_TO_BACK, /* dynamic screen: each pixel written once [GC91] */
    OW_SCAN_LINE      /* priority scan line: one line at a time, no frame buffer [FKN80] */
};

/* What becomes of a face's intensity. */
enum ow_map {
    OW_MAP_NONE,    /* it scales the material's colour */
    OW_MAP_HEAT,    /* black, red, orange, yellow, white, as a heated object [FAG83] */
    OW_MAP_COOL,    /* black, blue, cyan, white */
    OW_MAP_SPECTRUM /* blue, green, yellow, red: levels can be told apart */
};

enum { OW_LIGHTS_MAX = 8 }; /* of a look */

/*
 * A light: from a direction, or at a point. In model space or along right, up,
 * towards the viewer; then a point's place counts from the eye.
 */
struct ow_light {
    int16_t direction_q14[3]; /* unit vector towards the light, 14 fraction bits */
    uint16_t intensity_q8;    /* 256: a face square to the light shows its colour in full */
    bool in_model_space;      /* false: the light moves with the viewer */
    bool at_point;            /* not from a direction: as bright far away as near by */
    ow_q8 place[3];           /* of a point, lattice steps within OW_EYE_MAX */
};

/*
 * What fills the pixels that the model leaves unlit: a gradient, a picture, a
 * camera's frame. fill writes pixels first .. end-1 of the screen's line line;
 * row is the line's first pixel. Front to back asks for each pixel once.
 */
struct ow_backdrop {
    void (*fill)(void *context, const struct ow_pixel_format *format, uint8_t *row, uint32_t line,
                 uint32_t first, uint32_t end);
    void *context;
};

/* A backdrop that goes from one colour, 0x00RRGGBB, to another, from the top line down. */
struct ow_gradient_backdrop {
    uint32_t top;
    uint32_t bottom;
    uint16_t height; /* of the view */
    bool dither;
};

struct ow_backdrop ow_backdrop_of_gradient(struct ow_gradient_backdrop *gradient);

/*
 * Where an instance's object stands in the tree's lattice: its point v at
 * rotation v + place. rotation: a proper rotation, 30 fraction bits, row by row.
 */
struct ow_pose {
    ow_q30 rotation[3][3];
    ow_q8 place[3];
};

/* How a frame is to look. */
struct ow_look {
    enum ow_order order;
    enum ow_shade shade;
    enum ow_cull cull;
    uint32_t background; /* 0x00RRGGBB; OW_SHADE_ID: packed as it is */
    uint16_t ambient_q8; /* 256: all faces show their colour in full */
    struct ow_light lights[OW_LIGHTS_MAX];
    uint8_t light_count; /* 0: ambient light alone */
    /* OW_SHADE_PHONG: the highlight's strength, 256 adds full white in its middle; 0: none. */
    uint16_t specular_q8;
    uint8_t shininess; /* the highlight's exponent is 2^shininess; 0 .. 7 */
    bool dither;       /* ordered, in formats of few levels; not OW_SHADE_ID */
    enum ow_map map;   /* flat, Gouraud and Phong */
    /*
     * Depth cue: up to depth_near in front of the eye all shows its colour, from
     * depth_far on the background's, in between a mixture. Lattice steps along the
     * view vector, 0 <= near < far; both 0: none. Flat: by the face's nearest corner.
     */
    ow_q8 depth_near;
    ow_q8 depth_far;
    uint32_t foreground; /* OW_SHADE_LINES: 0x00RRGGBB */
    /*
     * 16 samples a pixel, nearest first, flat or smooth: needs a workspace with
     * coverage and OW_FRONT_TO_BACK. Not OW_SHADE_ID, not OW_SHADE_LINES.
     */
    bool coverage;
    /*
     * A deadline for OW_FRONT_TO_BACK: most work units a band may take, 0: no end. A face
     * that the walk comes by is one, 16 pixels written are one. When they are used up the
     * walk stops: what is near is right, the rest of the band is background.
     */
    uint32_t budget;
    /*
     * With ow_view_cut, where the tree says that the model is closed: what shows the
     * inside is drawn as a flat cap in the cutting plane, in this colour, 0x00RRGGBB.
     * Otherwise the inside is seen.
     */
    bool caps;
    uint32_t cap;
    /*
     * Of each of the tree's instances. One that leaves its region is drawn, but what it
     * hides and what hides it may be wrong; one that leaves the tree's cube, or whose
     * rotation is none, is left out; both are counted. NULL: no instance is drawn.
     */
    const struct ow_pose *poses;
    const struct ow_backdrop *backdrop; /* instead of background; NULL: none; not with coverage */
};

/* Where the band's pixels go. */
struct ow_target {
    uint8_t *pixels; /* of first_line's first pixel; aligned to 4 bytes */
    uint32_t stride; /* bytes from a line to the next, a multiple of 4 */
    uint16_t first_line;
    uint16_t line_count; /* first_line + line_count <= the view's height */
    const struct ow_pixel_format *format;
    /*
     * NULL: nobody asks. Otherwise begun for this frame and as large as the view: the pixels
     * that differ from what the target held are marked. Back to front and coverage, which
     * write pixels more than once, mark all.
     */
    struct ow_changes *changes;
};

/* Counted over a frame. */
struct ow_stats {
    uint32_t polygons_visited; /* faces that the walk came by */
    uint32_t polygons_painted; /* faces of which at least one pixel was written */
    uint32_t pixels_written;   /* by the model */
    uint32_t pixels_background;
    uint32_t spans;             /* runs of pixels written by the model */
    uint32_t nodes_skipped;     /* bounded nodes out of view, facing away or covered */
    uint32_t polygons_unlisted; /* scan line order: no room in the list; lines then walk anew */
    uint32_t lines_outgrown;    /* ow_surface_segments: lines whose list became bits */
    uint32_t instances_outside; /* objects that are outside their region */
    uint32_t polygons_dropped;  /* outlines that clipping made too long for the workspace */
};

struct ow_workspace_config {
    const struct ow_parts *parts; /* what can be drawn: ow_parts_all, or what there is room for */
    uint16_t width;               /* largest view to be drawn, pixels */
    uint16_t lines;               /* most lines of a band */
    /* Entries of the vertex cache, a power of two or 0: one for every vertex. 8 bytes each, 12 if they are fewer. */
    uint32_t cached_vertices;
    /*
     * Scan line order: most faces of a frame that can be listed, 16 bytes each and 4 a line of
     * height; ow_listed_faces_max() is always enough. 0: that order is not used.
     */
    uint32_t listed_faces;
    uint16_t height; /* scan line order: most lines of a view */
    bool coverage;   /* 8 bytes a pixel of a band and 4 spans a line, for the look's coverage */
};

#define OW_CACHE_ALL 0xFFFFFFFFu /* as cache_mask: an entry for every vertex */

/* Private to the core, here so that the caller can place it. */
struct ow_workspace {
    const struct ow_parts *parts;
    struct ow_frame *frame;
    struct ow_walk_run *stack;
    struct ow_outline_point *points; /* of vertices: the cache */
    uint32_t *tags;                  /* the frame's stamp in bits 24-31, the vertex number below */
    struct ow_outline_point *outline;
    struct ow_corner_light *corner_lights;
    struct ow_camera_point *clip[2];
    struct ow_scan_edge *edges;
    struct ow_span *spans;
    uint32_t *unlit;            /* front to back: a bit a pixel */
    uint16_t *open_pixels;      /* front to back: unlit pixels of each line */
    uint32_t *open_tiles;       /* front to back: a bit for each tile that may have unlit pixels */
    struct ow_samples *samples; /* coverage: of each pixel; NULL: there is no memory for it */
    uint32_t *sampled;          /* coverage: a bit for each pixel whose samples are in use */
    struct ow_instance_state *instances; /* NULL: there are none, or they are not drawn */
    uint32_t span_capacity;
    struct ow_listed_face *listed;
    uint32_t *line_heads;
    uint32_t listed_capacity;
    uint32_t listed_height;
    uint32_t cache_mask; /* entries - 1, or OW_CACHE_ALL */
    uint32_t cache_entries;
    uint32_t capacity; /* points of an outline after clipping */
    uint32_t width;
    uint32_t lines;
    uint32_t stamp; /* of the frame whose vertices are in the cache */
};

/* Bytes of memory that ow_workspace_place needs. 0: the configuration is out of range. */
uint32_t ow_workspace_bytes_needed(const struct ow_tree *tree,
                                   const struct ow_workspace_config *config);

/*
 * Places a workspace for this tree in memory (aligned to 8 bytes), which must
 * stay until the workspace is no longer used. Errors: OW_MEMORY, OW_ARGUMENT.
 */
enum ow_status ow_workspace_place(struct ow_workspace *workspace, const struct ow_tree *tree,
                                  const struct ow_workspace_config *config, void *memory,
                                  uint32_t bytes);

/*
 * Begins a frame; tree, view and look must stay until its last band. Errors:
 * OW_ARGUMENT (a workspace that is too small or lacks what the look needs; a
 * budget in another order than front to back), OW_SIDES, OW_NORMALS,
 * OW_UNSUPPORTED (the workspace's parts lack one that the look needs).
 */
enum ow_status ow_draw_begin(const struct ow_tree *tree, const struct ow_view *view,
                             const struct ow_look *look, struct ow_workspace *workspace);

/*
 * Draws one band of the frame whole, background included. The picture does not
 * depend on the order, the bands or the cache. In scan line order each band
 * must be below the last one. stats, unless NULL: counted since ow_draw_begin.
 * Errors: OW_ARGUMENT, OW_CAPACITY (the rest was drawn), OW_BUDGET (the near was
 * drawn; in this band or one before), OW_REGION (all was drawn).
 */
enum ow_status ow_draw_band(struct ow_workspace *workspace, const struct ow_target *target,
                            struct ow_stats *stats);

/* Both, for a frame that is one band. */
enum ow_status ow_draw(const struct ow_tree *tree, const struct ow_view *view,
                       const struct ow_look *look, const struct ow_target *target,
                       struct ow_workspace *workspace, struct ow_stats *stats);

/* A capacity for ow_workspace_config.listed_faces that never runs out. */
uint32_t ow_listed_faces_max(const struct ow_tree *tree);

#endif
