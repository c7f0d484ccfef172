/* SPDX-License-Identifier: 0BSD */
/*
 * One face on its way to the surface: its corners are looked up or clipped,
 * its outline is scanned, and it is shaded when its first spans come.
 */
#include "ow_clip.h"
#include "ow_frame.h"
#include "ow_project.h"

/* The face's outline by way of the clipper. Returns its count of points, 0 for none. */
static uint32_t clip_outline(struct ow_frame *frame, const struct ow_face *face, uint32_t corners)
{
    struct ow_workspace *workspace = frame->workspace;
    bool smooth = ow_shade_is_smooth(frame->shader.shade);
    bool marks = frame->faces != NULL && frame->faces->leaves_out != NULL;
    for (uint32_t i = 0; i < corners; i++) {
        uint32_t from = face->reverse ? corners - 1 - i : i;
        uint32_t vertex = ow_corner(frame->tree, face->at, from);
        workspace->clip[0][i] = ow_to_camera(frame->tree, frame->view, vertex);
        workspace->clip[0][i].marked = marks && frame->faces->leaves_out(frame, i);
        if (smooth) {
            ow_shade_corner(&frame->shader, frame->tree, vertex, face->reverse,
                            &workspace->clip[0][i].light);
        }
    }
    uint32_t which;
    bool overflow = false;
    uint32_t count =
        ow_clip(frame->view, workspace->clip, corners, workspace->capacity, &which, &overflow);
    frame->dropped += overflow;
    for (uint32_t i = 0; i < count; i++) {
        workspace->outline[i] = ow_to_screen(frame->view, workspace->clip[which][i]);
        workspace->corner_lights[i] = workspace->clip[which][i].light;
        if (marks) {
            workspace->corner_lights[i].part[0] = workspace->clip[which][i].marked;
        }
    }
    frame->clipped = true;
    return count < 3 ? 0 : count;
}

static inline uint32_t read_corner(const ow_byte *corners, uint32_t i, bool wide)
{
    return wide ? ow_read_u32(corners, 4 * i) : ow_read_u16(corners, 2 * i);
}

/* An entry that is right: where not all were projected at once, the tag tells. */
static inline struct ow_outline_point look_up(const struct ow_frame *frame, uint32_t vertex)
{
    struct ow_workspace *workspace = frame->workspace;
    uint32_t entry = vertex & workspace->cache_mask;
    if (workspace->tags[entry] != (frame->tag | vertex)) {
        workspace->tags[entry] = frame->tag | vertex;
        workspace->points[entry] = ow_project_vertex(frame->tree, frame->view, vertex);
    }
    return workspace->points[entry];
}

/* Looks up all corners, last first if reverse. False if one must be clipped first. */
static inline bool look_up_corners(const struct ow_frame *frame, const ow_byte *corner_bytes,
                                   uint32_t corners, bool wide, bool reverse)
{
    const struct ow_outline_point *points = frame->workspace->points;
    const bool all = frame->workspace->cache_mask == OW_CACHE_ALL;
    const int32_t step = reverse ? -1 : 1;
    struct ow_outline_point *out = frame->workspace->outline + (reverse ? corners - 1 : 0);
    for (uint32_t i = 0; i < corners; i++, out += step) {
        uint32_t vertex = read_corner(corner_bytes, i, wide);
        *out = all ? points[vertex] : look_up(frame, vertex);
        if (out->x == OW_CLIP_FIRST) {
            return false;
        }
    }
    return true;
}

/* The face's outline in workspace->outline. Returns its count of points, 0 for none. */
static uint32_t project_outline(struct ow_frame *frame, const struct ow_face *face)
{
    const struct ow_tree *tree = frame->tree;
    const ow_byte *corner_bytes = tree->bytes + face->at + tree->corners_in_record;
    uint32_t corners = ow_read_u8(tree->bytes, face->at);
    bool wide = (tree->flags & OW_TREE_INDEX32) != 0;
    return look_up_corners(frame, corner_bytes, corners, wide, face->reverse)
               ? corners
               : clip_outline(frame, face, corners);
}

static void begin_gradient(struct ow_frame *frame)
{
    struct ow_workspace *workspace = frame->workspace;
    const struct ow_face *face = &frame->face;
    if (!frame->clipped) {
        for (uint32_t i = 0; i < frame->points; i++) {
            uint32_t from = face->reverse ? frame->points - 1 - i : i;
            ow_shade_corner(&frame->shader, frame->tree, ow_corner(frame->tree, face->at, from),
                            face->reverse, &workspace->corner_lights[i]);
        }
    }
    ow_gradient_begin(&frame->gradient, workspace->outline, workspace->corner_lights, frame->points,
                      frame->shader.parts);
}

static inline bool project_face(struct ow_frame *frame)
{
    frame->clipped = false;
    frame->shaded = false;
    frame->points = project_outline(frame, &frame->face);
    return frame->points > 0;
}

bool ow_face_project(struct ow_frame *frame)
{
    return project_face(frame);
}

bool ow_face_outline(struct ow_frame *frame, struct ow_box *box)
{
    if (!ow_face_project(frame)) {
        return false;
    }
    return frame->faces != NULL && frame->faces->box != NULL
               ? frame->faces->box(frame, box)
               : ow_outline_box(frame->workspace->outline, frame->points, &frame->window, box);
}

/* A face is shaded when its first spans come: most small faces have none. */
void ow_paint_spans(struct ow_span_sink *sink)
{
    struct ow_frame *frame = (struct ow_frame *)(void *)sink;
    struct ow_surface *surface = &frame->surface;
    if (!frame->shaded) {
        if (surface->gradient != NULL) {
            surface->rgb = ow_face_colour(&frame->shader, frame->tree, &frame->face);
            begin_gradient(frame);
        } else {
            surface->rgb = ow_shade_face(&frame->shader, frame->tree, &frame->face);
            surface->colour = surface->target->format->pack(surface->rgb);
        }
        frame->shaded = true;
    }
    frame->kind->take(surface, sink->spans, sink->count);
    sink->count = 0;
}

bool ow_draw_face(struct ow_frame *frame)
{
    struct ow_workspace *workspace = frame->workspace;
    struct ow_surface *surface = &frame->surface;
    struct ow_box box;
    uint32_t before = surface->spans_written;
    if (frame->faces != NULL) {
        frame->faces->draw(frame);
        return surface->spans_written != before;
    }
    if (!project_face(frame) ||
        !ow_outline_box(workspace->outline, frame->points, &frame->window, &box) ||
        (frame->kind->hides != NULL && frame->kind->hides(surface, &box))) {
        return false;
    }
    ow_scan(workspace->outline, frame->points, frame->rule, &box, workspace->edges, &frame->sink);
    return surface->spans_written != before;
}
