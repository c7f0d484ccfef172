/* SPDX-License-Identifier: 0BSD */
/*
 * The stages put together: the walk gives a face, face.c brings it to the
 * surface. A frame is begun once; a target is one of its bands.
 */
#include "ow_draw.h"

#include "ow_frame.h"
#include "ow_memory.h"

enum { PIXELS_A_UNIT = 16 }; /* of the work budget */

/* A stamp that no entry of the cache has yet: what is cached is one frame's. */
static uint32_t next_stamp(struct ow_workspace *workspace)
{
    if (++workspace->stamp > 255) {
        if (workspace->cache_mask != OW_CACHE_ALL) {
            memset(workspace->tags, 0, (size_t)workspace->cache_entries * sizeof *workspace->tags);
        }
        workspace->stamp = 1;
    }
    return workspace->stamp << 24;
}

static bool workspace_fits(const struct ow_workspace *workspace, const struct ow_tree *tree,
                           const struct ow_view *view)
{
    return view->width <= workspace->width && workspace->capacity >= 2 * tree->max_corners &&
           (workspace->cache_mask != OW_CACHE_ALL ||
            workspace->cache_entries >= tree->vertex_count);
}

static bool parts_are_there(const struct ow_parts *parts, const struct ow_look *look)
{
    bool order = look->order == OW_BACK_TO_FRONT   ? parts->painter != NULL
                 : look->order == OW_FRONT_TO_BACK ? parts->dynamic != NULL
                                                   : parts->scan_line != NULL;
    bool lights = parts->point != NULL;
    for (uint32_t i = 0; i < look->light_count && !lights; i++) {
        if (look->lights[i].at_point) {
            return false;
        }
    }
    return order && parts->shading[look->shade] != NULL &&
           (!ow_look_has_effect(look) || parts->effect != NULL) &&
           (!look->coverage || parts->coverage != NULL) &&
           (look->poses == NULL || parts->instances != NULL) &&
           (look->shade != OW_SHADE_LINES || parts->lines != NULL) &&
           (!look->dither || parts->dither != NULL);
}

static bool draws_instances(const struct ow_frame *frame)
{
    return frame->look->poses != NULL && frame->workspace->instances != NULL;
}

/* Begins the walk; what the last one counted is added up. */
static enum ow_status begin_walk(struct ow_frame *frame, enum ow_direction direction)
{
    enum ow_status status = ow_walk_begin(&frame->walk, frame->tree, frame->view, direction,
                                          frame->look->cull, frame->workspace->stack);
    const struct ow_skipping *skip = frame->workspace->parts->skip;
    if (skip != NULL) {
        frame->walk.skip = (struct ow_walk_skip){ skip->hides, frame };
    }
    if (draws_instances(frame)) {
        const struct ow_instancing *instances = frame->workspace->parts->instances;
        instances->leave(frame); /* the last walk may have ended in one */
        frame->walk.instances =
            (struct ow_walk_instances){ instances->enter, instances->leave, frame };
    }
    return status;
}

static void end_walk(struct ow_frame *frame)
{
    frame->visited += frame->walk.faces_met;
    frame->skipped += frame->walk.nodes_skipped;
}

enum ow_status ow_draw_begin(const struct ow_tree *tree, const struct ow_view *view,
                             const struct ow_look *look, struct ow_workspace *workspace)
{
    struct ow_frame *frame = workspace->frame;
    const struct ow_parts *parts = workspace->parts;
    if (!workspace_fits(workspace, tree, view) || !ow_look_fits(look, workspace)) {
        return OW_ARGUMENT;
    }
    if (!parts_are_there(parts, look)) {
        return OW_UNSUPPORTED;
    }
    if (ow_shade_is_smooth(look->shade) && !(tree->flags & OW_TREE_NORMALS)) {
        return OW_NORMALS;
    }
    if (view->cuts && !(tree->flags & OW_TREE_TWO_SIDED)) {
        return OW_SIDES;
    }
    memset(frame, 0, sizeof *frame);
    frame->sink =
        (struct ow_span_sink){ workspace->spans, 0, workspace->span_capacity, ow_paint_spans };
    frame->tree = tree;
    frame->view = view;
    frame->look = look;
    frame->workspace = workspace;
    frame->window = (struct ow_window){ 0, view->height, view->width };
    frame->tag = next_stamp(workspace);
    frame->gradient.beside = look->coverage;
    frame->faces = look->shade == OW_SHADE_LINES ? parts->lines
                   : look->coverage              ? parts->coverage
                                                 : NULL;
    if (parts->skip != NULL) {
        parts->skip->begin(frame);
    }
    ow_shader_make(&frame->shader, parts, look, view);
    frame->shader.caps = frame->shader.caps && (tree->flags & OW_TREE_CLOSED);
    enum ow_status status = begin_walk(frame, OW_FARTHEST_FIRST);
    frame->rule = frame->walk.reject_backs ? OW_WINDING_POSITIVE : OW_WINDING_ANY;
    if (status == OW_OK && workspace->cache_mask == OW_CACHE_ALL) {
        frame->clips = ow_project_vertices(tree, view, 0, tree->vertex_count, workspace->points);
    }
    if (status == OW_OK && draws_instances(frame)) {
        parts->instances->begin(frame);
    }
    if (status == OW_OK && look->order == OW_SCAN_LINE) {
        status = parts->scan_line->begin(frame);
        end_walk(frame);
    }
    return status;
}

void ow_frame_aim(struct ow_frame *frame, const struct ow_surface_kind *kind,
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
    surface->samples = workspace->samples;
    surface->sampled = workspace->sampled;
    surface->words_in_line = (surface->width + 31) / 32;
    surface->shader = &frame->shader;
    surface->gradient = ow_shade_is_smooth(frame->shader.shade) ? &frame->gradient : NULL;
    surface->changes = NULL;
    surface->difference = workspace->parts->difference;
    if (target->changes != NULL && target->changes->known) {
        if (kind->writes_once) {
            surface->changes = target->changes;
        } else {
            surface->difference->mark_all(target->changes, target, surface->width);
        }
    }
    ow_surface_choose_write(surface, frame->look, workspace->parts->dither);
}

/* Small triangles: all vertices are projected, and only fronts are seen. */
static bool goes_the_fast_way(const struct ow_frame *frame)
{
    return frame->workspace->parts->draw_small != NULL &&
           frame->workspace->cache_mask == OW_CACHE_ALL && frame->rule == OW_WINDING_POSITIVE &&
           frame->faces == NULL && frame->look->budget == 0 &&
           frame->workspace->span_capacity >= OW_SMALL_SPANS;
}

void ow_frame_walk(struct ow_frame *frame)
{
    (void)begin_walk(frame, frame->kind->direction); /* ow_draw_begin has seen that it can */
    const struct ow_surface *surface = &frame->surface;
    const uint32_t before = surface->pixels_written;
    const uint32_t budget = frame->look->budget > 0 ? frame->look->budget : UINT32_MAX;
    if (goes_the_fast_way(frame)) {
        frame->workspace->parts->draw_small(frame);
    }
    while (surface->lines_open > 0 && ow_walk_next(&frame->walk, &frame->face)) {
        if (frame->walk.faces_met + (surface->pixels_written - before) / PIXELS_A_UNIT > budget) {
            frame->out_of_budget = true;
            break;
        }
        frame->painted += ow_draw_face(frame);
    }
    end_walk(frame);
}

static void draw_band(struct ow_frame *frame, const struct ow_target *target)
{
    const struct ow_parts *parts = frame->workspace->parts;
    const struct ow_surface_kind *kind =
        frame->look->order == OW_FRONT_TO_BACK ? parts->dynamic : parts->painter;
    if (frame->faces != NULL && frame->faces->surface != NULL) {
        kind = frame->faces->surface;
    }
    ow_frame_aim(frame, kind, target);
    kind->begin(&frame->surface, frame->background);
    ow_frame_walk(frame);
    kind->end(&frame->surface, frame->background);
}

static bool target_fits(const struct ow_frame *frame, const struct ow_target *target)
{
    uint32_t end_line = (uint32_t)target->first_line + target->line_count;
    return target->line_count > 0 && target->line_count <= frame->workspace->lines &&
           end_line <= frame->view->height && target->stride % 4 == 0 &&
           target->stride >= ow_row_bytes(target->format, frame->view->width) &&
           (uintptr_t)target->pixels % 4 == 0 &&
           (target->changes == NULL || frame->workspace->parts->difference != NULL) &&
           (target->changes == NULL || (target->changes->width == frame->view->width &&
                                        target->changes->height == frame->view->height));
}

enum ow_status ow_draw_band(struct ow_workspace *workspace, const struct ow_target *target,
                            struct ow_stats *stats)
{
    struct ow_frame *frame = workspace->frame;
    if (!target_fits(frame, target)) {
        return OW_ARGUMENT;
    }
    if (frame->look->order != OW_SCAN_LINE) {
        draw_band(frame, target);
    } else if (frame->workspace->parts->scan_line->draw(frame, target) != OW_OK) {
        return OW_ARGUMENT;
    }
    if (stats != NULL) {
        *stats = (struct ow_stats){
            .polygons_visited = frame->visited,
            .polygons_painted = frame->painted,
            .pixels_written = frame->surface.pixels_written,
            .pixels_background = frame->surface.pixels_background,
            .spans = frame->surface.spans_written,
            .nodes_skipped = frame->skipped,
            .polygons_unlisted = frame->unlisted,
            .instances_outside = frame->instances_outside,
            .lines_outgrown = frame->surface.lines_outgrown,
            .polygons_dropped = frame->dropped,
        };
    }
    if (frame->out_of_budget) {
        return OW_BUDGET;
    }
    if (frame->dropped > 0) {
        return OW_CAPACITY;
    }
    return frame->instances_outside > 0 ? OW_REGION : OW_OK;
}

enum ow_status ow_draw(const struct ow_tree *tree, const struct ow_view *view,
                       const struct ow_look *look, const struct ow_target *target,
                       struct ow_workspace *workspace, struct ow_stats *stats)
{
    enum ow_status status = ow_draw_begin(tree, view, look, workspace);
    return status == OW_OK ? ow_draw_band(workspace, target, stats) : status;
}
