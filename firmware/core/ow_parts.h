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

struct ow_parts {
    const struct ow_surface_kind *painter;   /* OW_BACK_TO_FRONT: ow_surface_painter */
    const struct ow_surface_kind *dynamic;   /* OW_FRONT_TO_BACK: ow_surface_dynamic */
    const struct ow_line_order *scan_line;   /* OW_SCAN_LINE: ow_line_order */
    const struct ow_face_kind *coverage;     /* look.coverage: ow_faces_covering */
    const struct ow_face_kind *lines;        /* OW_SHADE_LINES: ow_faces_in_lines */
    const struct ow_dithering *dither;       /* look.dither: ow_dithering */
    const struct ow_differences *difference; /* target.changes: ow_differences */
    const struct ow_skipping *skip;          /* saves time: ow_skipping */
    void (*draw_small)(struct ow_frame *);   /* saves time: ow_draw_small */
};

/* All there are. */
extern const struct ow_parts ow_parts_all;

#endif
