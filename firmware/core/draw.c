/* SPDX-License-Identifier: 0BSD */
/*
 * The stages put together: the walk gives a face, face.c brings it to the
 * surface. A frame is begun once; a target is one of its bands.
 */
#include "ow_draw.h"

#include "ow_frame.h"
#include "ow_memory.h"

/* The walk asks: can nothing of what is below this node be seen? */
static bool hides_node(void *context, const struct ow_tree *tree, uint32_t bounds_at)
{
    const struct ow_frame *frame = context;
    struct ow_bounds bounds = ow_read_bounds(tree, bounds_at);
    struct ow_box box;
    return (frame->rule == OW_WINDING_POSITIVE && ow_cone_looks_away(frame->view, &bounds)) ||
           !ow_sphere_box(&frame->frustum, &bounds, &frame->window, &box) ||
           (frame->kind->hides != NULL && frame->kind->hides(&frame->surface, &box));
}

/* A stamp that no entry of the cache has yet: what is cached is one frame's. */
static uint32_t next_stamp(struct ow_workspace *workspace)
{
    if (++workspace->stamp > 255) {
        memset(workspace->cache, 0, (size_t)workspace->cache_entries * sizeof *workspace->cache);
        workspace->stamp = 1;
    }
    return workspace->stamp << 24;
}

static bool workspace_fits(const struct ow_workspace *workspace, const struct ow_tree *tree,
                           const struct ow_view *view)
{
    return view->width <= workspace->width && workspace->capacity >= 2 * tree->max_corners &&
           (workspace->cache_mask != 0xFFFFFFFFu || workspace->cache_entries >= tree->vertex_count);
}

enum ow_status ow_frame_begin(struct ow_workspace *workspace, const struct ow_tree *tree,
                              const struct ow_view *view, const struct ow_look *look,
                              enum ow_direction direction)
{
    struct ow_frame *frame = workspace->frame;
    if (!workspace_fits(workspace, tree, view)) {
        return OW_ARGUMENT;
    }
    if (ow_shade_is_smooth(look->shade) && !(tree->flags & OW_TREE_NORMALS)) {
        return OW_NORMALS;
    }
    memset(frame, 0, sizeof *frame);
    enum ow_status status =
        ow_walk_begin(&frame->walk, tree, view, direction, look->cull, workspace->stack);
    if (status != OW_OK) {
        return status;
    }
    frame->walk.skip = (struct ow_walk_skip){ hides_node, frame };
    frame->sink = (struct ow_span_sink){ workspace->spans, 0, workspace->lines, ow_paint_spans };
    frame->tree = tree;
    frame->view = view;
    frame->look = look;
    frame->workspace = workspace;
    frame->window = (struct ow_window){ 0, view->height, view->width };
    frame->rule = frame->walk.reject_backs ? OW_WINDING_POSITIVE : OW_WINDING_ANY;
    frame->tag = next_stamp(workspace);
    ow_frustum_make(&frame->frustum, view);
    ow_shader_make(&frame->shader, look, view);
    return OW_OK;
}

enum ow_status ow_frame_check(const struct ow_frame *frame, const struct ow_target *target)
{
    uint32_t end_line = (uint32_t)target->first_line + target->line_count;
    bool fits = target->line_count > 0 && target->line_count <= frame->workspace->lines &&
                end_line <= frame->view->height && target->stride % 4 == 0 &&
                target->stride >= ow_row_bytes(target->format, frame->view->width) &&
                (uintptr_t)target->pixels % 4 == 0;
    return fits ? OW_OK : OW_ARGUMENT;
}

void ow_frame_target(struct ow_frame *frame, const struct ow_surface_kind *kind,
                     const struct ow_target *target)
{
    struct ow_surface *surface = &frame->surface;
    const struct ow_workspace *workspace = frame->workspace;
    frame->kind = kind;
    frame->window.first_line = target->first_line;
    frame->window.end_line = target->first_line + target->line_count;
    frame->background = target->format->pack(frame->look->background);
    surface->target = target;
    surface->width = frame->view->width;
    surface->unlit = workspace->unlit;
    surface->open_pixels = workspace->open_pixels;
    surface->open_tiles = workspace->open_tiles;
    surface->words_in_line = (surface->width + 31) / 32;
    surface->shader = &frame->shader;
    surface->gradient = ow_shade_is_smooth(frame->shader.shade) ? &frame->gradient : NULL;
}

enum ow_status ow_frame_report(const struct ow_frame *frame, struct ow_stats *stats)
{
    if (stats != NULL) {
        *stats = (struct ow_stats){
            .polygons_visited = frame->walk.faces_met,
            .polygons_painted = frame->painted,
            .pixels_written = frame->surface.pixels_written,
            .pixels_background = frame->surface.pixels_background,
            .spans = frame->surface.spans_written,
            .nodes_skipped = frame->walk.nodes_skipped,
            .polygons_unlisted = frame->unlisted,
            .polygons_dropped = frame->dropped,
        };
    }
    return frame->dropped > 0 ? OW_CAPACITY : OW_OK;
}

static enum ow_status draw_scan_lines(const struct ow_tree *tree, const struct ow_view *view,
                                      const struct ow_look *look, const struct ow_target *target,
                                      struct ow_workspace *workspace, struct ow_stats *stats)
{
    enum ow_status status = ow_scan_lines_begin(tree, view, look, workspace);
    return status == OW_OK ? ow_scan_lines_draw(workspace, target, stats) : status;
}

enum ow_status ow_draw(const struct ow_tree *tree, const struct ow_view *view,
                       const struct ow_look *look, const struct ow_target *target,
                       struct ow_workspace *workspace, struct ow_stats *stats)
{
    if (look->order == OW_SCAN_LINE) {
        return draw_scan_lines(tree, view, look, target, workspace, stats);
    }
    struct ow_frame *frame = workspace->frame;
    const struct ow_surface_kind *kind =
        look->order == OW_FRONT_TO_BACK ? &ow_surface_dynamic : &ow_surface_painter;
    enum ow_status status = ow_frame_begin(workspace, tree, view, look, kind->direction);
    if (status == OW_OK) {
        status = ow_frame_check(frame, target);
    }
    if (status != OW_OK) {
        return status;
    }
    ow_frame_target(frame, kind, target);
    kind->begin(&frame->surface, frame->background);
    while (frame->surface.lines_open > 0 && ow_walk_next(&frame->walk, &frame->face)) {
        frame->painted += ow_draw_face(frame);
    }
    kind->end(&frame->surface, frame->background);
    return ow_frame_report(frame, stats);
}
