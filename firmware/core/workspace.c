/* SPDX-License-Identifier: 0BSD */
/* The memory of drawing: one block from the caller, cut into the stages' arrays. */
#include "ow_frame.h"
#include "ow_memory.h"

enum { ALIGNMENT = 8 };

/* Hands out parts of a block, or only counts while the block is NULL. */
struct cutter {
    uint8_t *block;
    uint64_t used;
};

static void *cut(struct cutter *cutter, uint64_t count, uint64_t each)
{
    void *part = cutter->block ? cutter->block + cutter->used : NULL;
    cutter->used += (count * each + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    return part;
}

/*
 * Points of an outline after clipping. A convex outline gains at most one
 * point a plane; a winding one as many as it crosses the plane, half its
 * corners at most. Twice the corners and a few holds all but outlines that
 * zigzag over several planes: those are dropped and counted.
 */
static uint32_t outline_capacity(const struct ow_tree *tree)
{
    return 2 * tree->max_corners + 8;
}

static uint32_t cache_entries(const struct ow_tree *tree, const struct ow_workspace_config *config)
{
    uint32_t entries = config->cached_vertices;
    return entries == 0 || entries >= tree->vertex_count ? tree->vertex_count : entries;
}

static uint64_t place(struct ow_workspace *workspace, const struct ow_tree *tree,
                      const struct ow_workspace_config *config, void *memory)
{
    struct cutter cutter = { memory, 0 };
    uint32_t capacity = outline_capacity(tree);
    uint32_t entries = cache_entries(tree, config);
    uint32_t words = (config->width + 31u) / 32;
    workspace->parts = config->parts;
    workspace->frame = cut(&cutter, 1, sizeof *workspace->frame);
    const struct ow_instancing *instances = config->parts->instances;
    workspace->instances = NULL;
    if (instances != NULL && tree->instance_count > 0) {
        workspace->instances = cut(&cutter, 1, instances->state_bytes);
    }
    workspace->stack = cut(&cutter, ow_walk_stack_bytes(tree), 1);
    workspace->points = cut(&cutter, entries, sizeof *workspace->points);
    workspace->tags =
        cut(&cutter, entries < tree->vertex_count ? entries : 0, sizeof *workspace->tags);
    workspace->outline = cut(&cutter, capacity, sizeof *workspace->outline);
    workspace->corner_lights = cut(&cutter, capacity, sizeof *workspace->corner_lights);
    for (int i = 0; i < 2; i++) {
        workspace->clip[i] = cut(&cutter, capacity, sizeof *workspace->clip[i]);
    }
    workspace->edges = cut(&cutter, capacity, sizeof *workspace->edges);
    workspace->span_capacity = config->lines * (config->coverage ? 4u : 1u);
    workspace->spans = cut(&cutter, workspace->span_capacity, sizeof *workspace->spans);
    workspace->open_pixels = cut(&cutter, config->lines, sizeof *workspace->open_pixels);
    workspace->unlit = cut(&cutter, (uint64_t)words * config->lines, sizeof *workspace->unlit);
    uint32_t tile_rows = ow_tiles(config->lines);
    workspace->open_tiles = cut(&cutter, (uint64_t)ow_tile_words(config->width) * tile_rows,
                                sizeof *workspace->open_tiles);
    workspace->samples = NULL;
    workspace->sampled = NULL;
    if (config->coverage) {
        workspace->samples =
            cut(&cutter, (uint64_t)config->width * config->lines, sizeof *workspace->samples);
        workspace->sampled =
            cut(&cutter, (uint64_t)words * config->lines, sizeof *workspace->sampled);
    }
    workspace->listed = cut(&cutter, config->listed_faces, sizeof *workspace->listed);
    workspace->line_heads =
        cut(&cutter, config->listed_faces > 0 ? config->height : 0, sizeof *workspace->line_heads);
    workspace->listed_capacity = config->listed_faces;
    workspace->listed_height = config->height;
    workspace->cache_entries = entries;
    workspace->cache_mask = entries < tree->vertex_count ? entries - 1 : OW_CACHE_ALL;
    workspace->capacity = capacity;
    workspace->width = config->width;
    workspace->lines = config->lines;
    return cutter.used;
}

static bool config_is_valid(const struct ow_workspace_config *config)
{
    return config->parts != NULL && config->width >= 1 && config->width <= OW_SCREEN_MAX &&
           config->lines >= 1 && config->lines <= OW_SCREEN_MAX &&
           config->height <= OW_SCREEN_MAX &&
           (config->cached_vertices & (config->cached_vertices - 1)) == 0;
}

uint32_t ow_workspace_bytes_needed(const struct ow_tree *tree,
                                   const struct ow_workspace_config *config)
{
    struct ow_workspace counted;
    if (!config_is_valid(config)) {
        return 0;
    }
    uint64_t bytes = place(&counted, tree, config, NULL);
    return bytes > 0xFFFFFFFFu ? 0 : (uint32_t)bytes;
}

enum ow_status ow_workspace_place(struct ow_workspace *workspace, const struct ow_tree *tree,
                                  const struct ow_workspace_config *config, void *memory,
                                  uint32_t bytes)
{
    uint32_t needed = ow_workspace_bytes_needed(tree, config);
    if (needed == 0 || (uintptr_t)memory % ALIGNMENT != 0) {
        return OW_ARGUMENT;
    }
    if (memory == NULL || bytes < needed) {
        return OW_MEMORY;
    }
    (void)place(workspace, tree, config, memory);
    workspace->stamp = 255; /* the first frame clears the tags */
    return OW_OK;
}
