/* SPDX-License-Identifier: 0BSD */
/*
 * What a program can draw: it names the parts that it has room for, and the
 * linker leaves out what nobody names. A look that needs a part which is NULL
 * is refused with OW_UNSUPPORTED; where a part only saves time, the picture is
 * the same without it.
 */
#ifndef OW_PARTS_H
#define OW_PARTS_H

struct ow_frame;
struct ow_surface_kind;
struct ow_face_kind;
struct ow_line_order;
struct ow_skipping;
struct ow_differences;
struct ow_dithering;
struct ow_shading;
struct ow_light_kind;
struct ow_effect;
struct ow_instancing;

enum ow_shade {
    OW_SHADE_ID,      /* the source polygon's number as a colour, no light */
    OW_SHADE_FLAT,    /* one colour a face, from its normal */
    OW_SHADE_GOURAUD, /* intensity interpolated between the corners; needs vertex normals */
    OW_SHADE_PHONG,   /* normals interpolated, with a highlight; needs vertex normals */
    OW_SHADE_LINES    /* outlines in the foreground's colour, faces in the background's */
};

struct ow_parts {
    const struct ow_surface_kind *painter; /* OW_BACK_TO_FRONT: ow_surface_painter */
    /* OW_FRONT_TO_BACK: ow_surface_dynamic; or ow_surface_segments, for wide screens, large faces */
    const struct ow_surface_kind *dynamic;
    const struct ow_line_order *scan_line; /* OW_SCAN_LINE: ow_line_order */
    /* By enum ow_shade: ow_shading_id, _flat, _gouraud, _phong, _lines */
    const struct ow_shading *shading[OW_SHADE_LINES + 1];
    const struct ow_light_kind *point;       /* lights at a point: ow_light_point */
    const struct ow_effect *effect;          /* look.map, depth cue: ow_effect_map_and_depth */
    const struct ow_face_kind *coverage;     /* look.coverage: ow_faces_covering */
    const struct ow_face_kind *lines;        /* OW_SHADE_LINES: ow_faces_in_lines */
    const struct ow_dithering *dither;       /* look.dither: ow_dithering */
    const struct ow_differences *difference; /* target.changes: ow_differences */
    const struct ow_instancing *instances;   /* look.poses: ow_instancing */
    const struct ow_skipping *skip;          /* saves time: ow_skipping */
    void (*draw_small)(struct ow_frame *);   /* saves time: ow_draw_small */
};

/* All there are. */
extern const struct ow_parts ow_parts_all;

#endif
