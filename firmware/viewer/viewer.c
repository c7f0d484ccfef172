/* SPDX-License-Identifier: 0BSD */
/* The loop: memory, the order of the stages, and when to draw or to sleep. */
#include "viewer.h"
#include "stages.h"

/* How the memory is cut up. */
struct layout {
    struct ow_workspace_config workspace;
    uint32_t workspace_bytes; /* of each worker, a multiple of 8 */
    uint32_t workers;
    uint32_t worker_bytes;
    uint32_t stride;
    uint32_t band_bytes; /* of one band, a multiple of 8; 0: the panel lends */
    uint32_t bands;
    uint32_t changes_bytes; /* a multiple of 8 */
};

static uint32_t round_up(uint32_t value, uint32_t step)
{
    return (value + step - 1) / step * step;
}

static int check_config(const struct ow_viewer_config *config)
{
    if (config->workers != NULL) {
        int status = ow_workers_check(config->workers);
        if (status < 0) {
            return status;
        }
    }
    if (config->tree == NULL || config->views == 0 || config->parts == NULL || config->bands > 2 ||
        config->binding_count > OW_BINDINGS_MAX || config->quarter_turns > 3) {
        return OW_ARGUMENT;
    }
    return OW_OK;
}

/* Total bytes; 0 where they do not fit 32 bits or the core refuses the sizes. */
static uint32_t make_layout(struct layout *layout, const struct ow_viewer_config *config,
                            const struct ow_panel_info *info)
{
    uint32_t wanted = config->band_lines == 0 ? info->height : config->band_lines;
    uint32_t lines = round_up(wanted, info->align_y);
    if (lines > info->height) {
        lines = info->height;
    }
    layout->workspace = (struct ow_workspace_config){
        .parts = config->parts,
        .width = info->width,
        .lines = (uint16_t)lines,
        .cached_vertices = config->cached_vertices,
        .coverage = config->look.coverage,
        .listed_faces = config->listed_faces,
        .height = info->height,
    };
    uint32_t workspace = ow_workspace_bytes_needed(config->tree, &layout->workspace);
    bool lends = ow_panel_lends(config->panel);
    layout->stride = round_up(ow_row_bytes(info->format, info->width), 4);
    layout->bands = config->bands == 2 ? 2 : 1;
    layout->band_bytes = lends ? 0 : round_up(layout->stride * lines, 8);
    if (workspace == 0 || workspace > UINT32_MAX - 7) {
        return 0;
    }
    layout->workspace_bytes = round_up(workspace, 8);
    layout->workers = config->workers != NULL ? config->workers->count : 1;
    layout->worker_bytes = round_up(layout->workers * (uint32_t)sizeof(struct ow_viewer_worker), 8);
    layout->changes_bytes = config->find_changes && lends
                                ? round_up(ow_changes_bytes_needed(info->width, info->height), 8)
                                : 0;
    uint64_t total = layout->changes_bytes + layout->worker_bytes +
                     (uint64_t)layout->workspace_bytes * layout->workers +
                     (uint64_t)layout->band_bytes * layout->bands;
    return total > UINT32_MAX ? 0 : (uint32_t)total;
}

uint32_t ow_viewer_bytes_needed(const struct ow_viewer_config *config)
{
    struct ow_panel_info info;
    struct layout layout;
    if (check_config(config) < 0 || ow_panel_check(config->panel, &info) < 0) {
        return 0;
    }
    uint32_t bytes = make_layout(&layout, config, &info);
    if ((config->quarter_turns & 1) != 0 && bytes != 0) { /* the panel may turn width and height */
        uint16_t width = info.width;
        info.width = info.height;
        info.height = width;
        uint32_t turned = make_layout(&layout, config, &info);
        bytes = turned == 0 ? 0 : turned > bytes ? turned : bytes;
    }
    return bytes;
}

/* Lets the panel turn the picture if it can; otherwise the projection will. */
static int start_rotation(struct ow_viewer *viewer)
{
    uint8_t turns = viewer->config.quarter_turns;
    viewer->turned = 0;
    if (turns == 0) {
        return OW_OK;
    }
    const struct ow_panel *panel = viewer->config.panel;
    int status = ow_panel_set(panel, OW_PANEL_ROTATION, turns);
    if (status == OW_UNSUPPORTED) {
        viewer->turned = turns;
        return OW_OK;
    }
    return status < 0 ? status : ow_panel_check(panel, &viewer->panel);
}

static int check_devices(const struct ow_viewer_config *config)
{
    int status = ow_clock_check(config->clock);
    if (status == OW_OK && config->input != NULL) {
        status = ow_input_check(config->input);
    }
    if (status == OW_OK && config->wait != NULL) {
        status = ow_wait_check(config->wait);
    }
    return status;
}

static int place(struct ow_viewer *viewer, void *memory, uint32_t bytes)
{
    struct layout layout;
    uint32_t needed = make_layout(&layout, &viewer->config, &viewer->panel);
    if (needed == 0) {
        return OW_ARGUMENT;
    }
    if (memory == NULL || bytes < needed) {
        return OW_MEMORY;
    }
    uint8_t *free_memory = (uint8_t *)memory + layout.worker_bytes;
    viewer->worker = memory;
    for (uint32_t i = 0; i < layout.workers; i++) {
        int status = ow_workspace_place(&viewer->worker[i].workspace, viewer->config.tree,
                                        &layout.workspace, free_memory, layout.workspace_bytes);
        if (status < 0) {
            return status;
        }
        free_memory += layout.workspace_bytes;
    }
    viewer->workers = layout.workers;
    if (layout.changes_bytes > 0) {
        ow_changes_place(&viewer->changes, viewer->panel.width, viewer->panel.height, free_memory);
        free_memory += layout.changes_bytes;
    }
    viewer->band[0] = free_memory;
    viewer->band[1] = free_memory + (layout.bands - 1) * layout.band_bytes;
    viewer->band_stride = layout.stride;
    viewer->band_lines = layout.workspace.lines;
    viewer->config.bands = (uint8_t)layout.bands;
    return OW_OK;
}

int ow_viewer_start(struct ow_viewer *viewer, const struct ow_viewer_config *config, void *memory,
                    uint32_t bytes)
{
    *viewer = (struct ow_viewer){ .config = *config };
    int status = check_config(config);
    if (status == OW_OK) {
        status = check_devices(config);
    }
    if (status == OW_OK) {
        status = ow_panel_check(config->panel, &viewer->panel);
    }
    if (status == OW_OK) {
        status = start_rotation(viewer);
    }
    if (status == OW_OK) {
        status = place(viewer, memory, bytes);
    }
    if (status != OW_OK) {
        viewer->finished = true;
        return status;
    }
    if (viewer->config.bindings == NULL) {
        viewer->config.bindings = ow_default_bindings;
        viewer->config.binding_count = ow_default_binding_count;
    }
    ow_viewer_restart(viewer);
    return OW_OK;
}

void ow_viewer_restart(struct ow_viewer *viewer)
{
    viewer->finished = false;
    viewer->number = 0;
    viewer->turn = 0;
    viewer->tilt = 0;
    viewer->zoom = 0;
    viewer->manual = false;
    viewer->held = 0;
    viewer->due_us = 0;
    viewer->changed = true;
}

void ow_viewer_get_place(const struct ow_viewer *viewer, struct ow_viewer_place *place)
{
    place->number = viewer->number;
    place->turn = viewer->turn;
    place->tilt = viewer->tilt;
    place->zoom = viewer->zoom;
    place->manual = viewer->manual;
}

void ow_viewer_set_place(struct ow_viewer *viewer, const struct ow_viewer_place *place)
{
    viewer->number = place->number < viewer->config.views ? place->number : 0;
    viewer->turn = place->turn;
    viewer->tilt = place->tilt;
    viewer->zoom = place->zoom;
    viewer->manual = place->manual;
    viewer->changed = true;
}

void ow_viewer_refresh(struct ow_viewer *viewer)
{
    viewer->changed = true;
}

int viewer_sleep_until(struct ow_viewer *viewer, uint64_t until_us)
{
    const struct ow_wait *wait = viewer->config.wait;
    const struct ow_clock *clock = viewer->config.clock;
    if (wait != NULL) {
        int status = wait->ops->wait(wait->device, until_us);
        return status < 0 ? status : OW_OK;
    }
    return clock->ops->sleep(clock->device, until_us);
}

/* Whether another view comes by itself. */
static bool goes_on(const struct ow_viewer *viewer)
{
    if (viewer->manual || viewer->config.views == 1) {
        return false;
    }
    return viewer->number + 1 < viewer->config.views || viewer->config.end == OW_VIEWER_REPEAT;
}

/* The next view of the list or the orbit, if its time has come. */
static void advance(struct ow_viewer *viewer, uint64_t now_us)
{
    if (viewer->changed || !goes_on(viewer) || now_us < viewer->due_us) {
        return;
    }
    viewer->number = viewer->number + 1 < viewer->config.views ? viewer->number + 1 : 0;
    viewer->changed = true;
}

/* Nothing to draw: sleep until something may change, or see that nothing can. */
static int rest(struct ow_viewer *viewer, uint64_t now_us)
{
    bool has_input = viewer->config.input != NULL && !viewer->input_gone;
    uint64_t until_us = goes_on(viewer) ? viewer->due_us : OW_TIME_NEVER;
    if (viewer->held != 0 && viewer->config.repeat_us != 0 && viewer->repeat_us < until_us) {
        until_us = viewer->repeat_us;
    }
    if (until_us == OW_TIME_NEVER && !has_input) {
        viewer->finished = true;
        return OW_OK;
    }
    if (viewer->config.wait == NULL && has_input && until_us > now_us + IDLE_US) {
        until_us = now_us + IDLE_US;
    }
    int status = viewer_sleep_until(viewer, until_us);
    if (status == OW_GONE && until_us == OW_TIME_NEVER) { /* no source can wake us any more */
        viewer->finished = true;
        return OW_OK;
    }
    return status;
}

static int show_frame(struct ow_viewer *viewer, uint64_t now_us)
{
    int status = viewer_make_view(viewer);
    if (status >= 0) {
        status = viewer_present(viewer);
    }
    if (status == OW_AGAIN) { /* all the panel's frames are on their way: later */
        return viewer_sleep_until(viewer, now_us + NAP_US);
    }
    if (status < 0) {
        return status;
    }
    viewer->changed = false;
    viewer->frames++;
    uint64_t next_us = viewer->due_us + viewer->config.interval_us;
    viewer->due_us = next_us > now_us ? next_us : now_us + viewer->config.interval_us;
    if (!goes_on(viewer) && !viewer->manual && viewer->config.end == OW_VIEWER_STOP) {
        viewer->finished = true;
    }
    return 1;
}

int ow_viewer_step(struct ow_viewer *viewer)
{
    const struct ow_clock *clock = viewer->config.clock;
    uint64_t now_us;
    if (viewer->finished) {
        return 0;
    }
    int status = clock->ops->now(clock->device, &now_us);
    if (status >= 0) {
        status = viewer_take_input(viewer, now_us);
    }
    if (status < 0) {
        return status;
    }
    advance(viewer, now_us);
    return viewer->changed ? show_frame(viewer, now_us) : rest(viewer, now_us);
}
