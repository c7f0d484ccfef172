/* SPDX-License-Identifier: 0BSD */
/*
 * The stages put together: the walk gives a face, its corners are projected
 * (or clipped first), the outline is scanned, the surface takes the spans.
 */
#include "ow_draw.h"

#include "ow_clip.h"
#include "ow_frame.h"
#include "ow_memory.h"
#include "ow_project.h"

static inline uint32_t corner(const struct ow_tree *tree, uint32_t at, uint32_t i)
{
    uint32_t first = at + tree->corners_in_record;
    return (tree->flags & OW_TREE_INDEX32) ? ow_read_u32(tree->bytes, first + 4 * i)
                                           : ow_read_u16(tree->bytes, first + 2 * i);
}

/* Computes a vertex's place on the screen into its entry of the cache. */
static void project_vertex(const struct ow_frame *frame, uint32_t vertex,
                           struct ow_cached_vertex *cached)
{
    struct ow_camera_point p = ow_to_camera(frame->tree, frame->view, vertex);
    cached->tag = frame->tag | vertex;
    if (ow_is_inside(frame->view, p)) {
        cached->point = ow_to_screen(frame->view, p);
    } else {
        cached->point.x = OW_CLIP_FIRST;
    }
}

/* The face's outline by way of the clipper. Returns its count of points, 0 for none. */
static uint32_t clip_outline(struct ow_frame *frame, const struct ow_face *face, uint32_t corners)
{
    struct ow_workspace *workspace = frame->workspace;
    bool smooth = ow_shade_is_smooth(frame->shader.shade);
    for (uint32_t i = 0; i < corners; i++) {
        uint32_t from = face->reverse ? corners - 1 - i : i;
        uint32_t vertex = corner(frame->tree, face->at, from);
        workspace->clip[0][i] = ow_to_camera(frame->tree, frame->view, vertex);
        if (smooth) {
            workspace->clip[0][i].light =
                ow_shade_corner(&frame->shader, frame->tree, vertex, face->reverse);
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
    }
    frame->clipped = true;
    return count < 3 ? 0 : count;
}

/* Looks up all corners, last first if reverse. False if one must be clipped first. */
static inline bool look_up_corners(const struct ow_frame *frame, const uint8_t *corner_bytes,
                                   uint32_t corners, bool wide, bool reverse)
{
    struct ow_cached_vertex *cache = frame->workspace->cache;
    const uint32_t mask = frame->workspace->cache_mask;
    const uint32_t tag = frame->tag;
    const int32_t step = reverse ? -1 : 1;
    struct ow_outline_point *out = frame->workspace->outline + (reverse ? corners - 1 : 0);
    for (uint32_t i = 0; i < corners; i++, out += step) {
        uint32_t vertex =
            wide ? ow_read_u32(corner_bytes, 4 * i) : ow_read_u16(corner_bytes, 2 * i);
        struct ow_cached_vertex *cached = &cache[vertex & mask];
        if (cached->tag != (tag | vertex)) {
            project_vertex(frame, vertex, cached);
        }
        struct ow_outline_point point = cached->point;
        if (point.x == OW_CLIP_FIRST) {
            return false;
        }
        *out = point;
    }
    return true;
}

/* The face's outline in workspace->outline. Returns its count of points, 0 for none. */
static uint32_t project_outline(struct ow_frame *frame, const struct ow_face *face)
{
    const struct ow_tree *tree = frame->tree;
    const uint8_t *corner_bytes = tree->bytes + face->at + tree->corners_in_record;
    uint32_t corners = ow_read_u8(tree->bytes, face->at);
    bool ready = (tree->flags & OW_TREE_INDEX32)
                     ? look_up_corners(frame, corner_bytes, corners, true, face->reverse)
                     : look_up_corners(frame, corner_bytes, corners, false, face->reverse);
    return ready ? corners : clip_outline(frame, face, corners);
}

static void begin_gradient(struct ow_frame *frame)
{
    struct ow_workspace *workspace = frame->workspace;
    const struct ow_face *face = &frame->face;
    if (!frame->clipped) {
        for (uint32_t i = 0; i < frame->points; i++) {
            uint32_t from = face->reverse ? frame->points - 1 - i : i;
            workspace->corner_lights[i] = ow_shade_corner(
                &frame->shader, frame->tree, corner(frame->tree, face->at, from), face->reverse);
        }
    }
    ow_gradient_begin(&frame->gradient, workspace->outline, workspace->corner_lights, frame->points,
                      frame->shader.shade == OW_SHADE_PHONG ? OW_LIGHT_PARTS : 1);
}

/* A face is shaded when its first spans come: most small faces have none. */
static void paint(struct ow_span_sink *sink)
{
    struct ow_frame *frame = (struct ow_frame *)(void *)sink;
    struct ow_surface *surface = &frame->surface;
    if (!frame->shaded) {
        if (surface->gradient != NULL) {
            surface->colour = ow_face_colour(&frame->shader, frame->tree, &frame->face);
            begin_gradient(frame);
        } else {
            uint32_t colour = ow_shade_face(&frame->shader, frame->tree, &frame->face);
            surface->colour = surface->target->format->pack(colour);
        }
        frame->shaded = true;
    }
    frame->kind->take(surface, sink->spans, sink->count);
    sink->count = 0;
}

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

/* Draws what the walk gives. Returns how many faces had a pixel written. */
static uint32_t draw_faces(struct ow_frame *frame)
{
    uint32_t painted = 0;
    struct ow_workspace *workspace = frame->workspace;
    struct ow_surface *surface = &frame->surface;
    while (surface->lines_open > 0 && ow_walk_next(&frame->walk, &frame->face)) {
        frame->clipped = false;
        uint32_t count = project_outline(frame, &frame->face);
        struct ow_box box;
        if (count == 0 || !ow_outline_box(workspace->outline, count, &frame->window, &box) ||
            (frame->kind->hides != NULL && frame->kind->hides(surface, &box))) {
            continue;
        }
        uint32_t before = surface->pixels_written;
        frame->shaded = false;
        frame->points = count;
        ow_scan(workspace->outline, count, frame->rule, &box, workspace->edges, &frame->sink);
        painted += surface->pixels_written != before;
    }
    return painted;
}

static enum ow_status check(const struct ow_tree *tree, const struct ow_view *view,
                            const struct ow_target *target, const struct ow_workspace *workspace)
{
    uint32_t end_line = (uint32_t)target->first_line + target->line_count;
    bool fits =
        view->width <= workspace->width && target->line_count <= workspace->lines &&
        target->line_count > 0 && end_line <= view->height && target->stride % 4 == 0 &&
        target->stride >= ow_row_bytes(target->format, view->width) &&
        (uintptr_t)target->pixels % 4 == 0 && workspace->capacity >= 2 * tree->max_corners &&
        (workspace->cache_mask != 0xFFFFFFFFu || workspace->cache_entries >= tree->vertex_count);
    return fits ? OW_OK : OW_ARGUMENT;
}

/* A stamp that no entry of the cache has yet: what is cached is one call's. */
static uint32_t next_stamp(struct ow_workspace *workspace)
{
    if (++workspace->stamp > 255) {
        memset(workspace->cache, 0, (size_t)workspace->cache_entries * sizeof *workspace->cache);
        workspace->stamp = 1;
    }
    return workspace->stamp << 24;
}

static void begin_surface(struct ow_surface *surface, const struct ow_workspace *workspace,
                          const struct ow_view *view, const struct ow_target *target)
{
    memset(surface, 0, sizeof *surface);
    surface->target = target;
    surface->width = view->width;
    surface->unlit = workspace->unlit;
    surface->open_pixels = workspace->open_pixels;
    surface->open_tiles = workspace->open_tiles;
    surface->words_in_line = (view->width + 31u) / 32;
}

static void begin_frame(struct ow_frame *frame, const struct ow_tree *tree,
                        const struct ow_view *view, const struct ow_look *look,
                        const struct ow_target *target, struct ow_workspace *workspace)
{
    frame->sink = (struct ow_span_sink){ workspace->spans, 0, workspace->lines, paint };
    frame->tree = tree;
    frame->view = view;
    frame->workspace = workspace;
    frame->window = (struct ow_window){ target->first_line, target->first_line + target->line_count,
                                        view->width };
    frame->rule = frame->walk.reject_backs ? OW_WINDING_POSITIVE : OW_WINDING_ANY;
    frame->tag = next_stamp(workspace);
    frame->dropped = 0;
    ow_frustum_make(&frame->frustum, view);
    ow_shader_make(&frame->shader, look, view);
    begin_surface(&frame->surface, workspace, view, target);
    frame->surface.shader = &frame->shader;
    frame->surface.gradient = ow_shade_is_smooth(look->shade) ? &frame->gradient : NULL;
    frame->walk.skip = (struct ow_walk_skip){ hides_node, frame };
}

static void report(const struct ow_frame *frame, uint32_t painted, struct ow_stats *stats)
{
    *stats = (struct ow_stats){
        .polygons_visited = frame->walk.faces_met,
        .polygons_painted = painted,
        .pixels_written = frame->surface.pixels_written,
        .pixels_background = frame->surface.pixels_background,
        .spans = frame->surface.spans_written,
        .nodes_skipped = frame->walk.nodes_skipped,
        .polygons_dropped = frame->dropped,
    };
}

enum ow_status ow_draw(const struct ow_tree *tree, const struct ow_view *view,
                       const struct ow_look *look, const struct ow_target *target,
                       struct ow_workspace *workspace, struct ow_stats *stats)
{
    struct ow_frame *frame = workspace->frame;
    enum ow_status status = check(tree, view, target, workspace);
    if (status != OW_OK) {
        return status;
    }
    if (ow_shade_is_smooth(look->shade) && !(tree->flags & OW_TREE_NORMALS)) {
        return OW_NORMALS;
    }
    frame->kind = look->order == OW_FRONT_TO_BACK ? &ow_surface_dynamic : &ow_surface_painter;
    status = ow_walk_begin(&frame->walk, tree, view, frame->kind->direction, look->cull,
                           workspace->stack);
    if (status != OW_OK) {
        return status;
    }
    begin_frame(frame, tree, view, look, target, workspace);
    uint32_t background = target->format->pack(look->background);
    frame->kind->begin(&frame->surface, background);
    uint32_t painted = draw_faces(frame);
    frame->kind->end(&frame->surface, background);
    if (stats != NULL) {
        report(frame, painted, stats);
    }
    return frame->dropped > 0 ? OW_CAPACITY : OW_OK;
}
