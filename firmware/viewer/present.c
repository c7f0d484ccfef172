/* SPDX-License-Identifier: 0BSD */
/* Present: draws the view into memory that the panel lends, or band by band into the caller's. */
#include "stages.h"

enum {
    SLICES = 2 /* for each worker */
};

static void probe(const struct ow_viewer *viewer, enum ow_probe point)
{
    if (viewer->config.probe != NULL) {
        viewer->config.probe(viewer->config.probe_context, point);
    }
}

/* Lines that the workers draw, in slices that they take in turn. */
struct slices {
    struct ow_viewer *viewer;
    uint8_t *pixels; /* NULL: the frame is only begun */
    uint32_t stride;
    uint16_t first;
    uint16_t count;
    uint16_t lines; /* of a slice */
    struct ow_changes *changes;
};

static int draw_slices(const struct slices *slices, uint32_t number)
{
    const struct ow_viewer *viewer = slices->viewer;
    struct ow_viewer_worker *worker = &viewer->worker[number];
    if (slices->pixels == NULL) {
        worker->stats = (struct ow_stats){ 0 };
        return ow_draw_begin(viewer->config.tree, &viewer->view, &viewer->look, &worker->workspace);
    }
    int result = OW_OK;
    uint32_t step = viewer->workers * slices->lines;
    for (uint32_t at = number * slices->lines; at < slices->count; at += step) {
        uint32_t left = slices->count - at;
        struct ow_target target = {
            .pixels = slices->pixels + at * slices->stride,
            .stride = slices->stride,
            .first_line = (uint16_t)(slices->first + at),
            .line_count = (uint16_t)(left < slices->lines ? left : slices->lines),
            .format = viewer->panel.format,
            .changes = slices->changes,
        };
        int status = ow_draw_band(&worker->workspace, &target, &worker->stats);
        result = status < 0 ? status : result;
    }
    return result;
}

static void slices_job(void *context, uint32_t number)
{
    const struct slices *slices = context;
    slices->viewer->worker[number].status = draw_slices(slices, number);
}

static void add_stats(struct ow_stats *sum, const struct ow_stats *part)
{
    sum->polygons_visited += part->polygons_visited;
    sum->polygons_painted += part->polygons_painted;
    sum->pixels_written += part->pixels_written;
    sum->pixels_background += part->pixels_background;
    sum->spans += part->spans;
    sum->nodes_skipped += part->nodes_skipped;
    sum->polygons_unlisted += part->polygons_unlisted;
    sum->lines_outgrown += part->lines_outgrown;
    sum->polygons_dropped += part->polygons_dropped;
}

/* Has all workers do their part. A capacity or budget that ran out is noted, not a failure. */
static int draw_together(struct slices *slices)
{
    struct ow_viewer *viewer = slices->viewer;
    const struct ow_workers *workers = viewer->config.workers;
    int status = OW_OK;
    probe(viewer, OW_PROBE_DRAW_BEGIN);
    if (viewer->workers > 1) {
        status = workers->ops->run(workers->device, slices_job, slices);
    } else {
        slices_job(slices, 0);
    }
    probe(viewer, OW_PROBE_DRAW_END);
    viewer->stats = (struct ow_stats){ 0 };
    for (uint32_t i = 0; i < viewer->workers; i++) {
        const struct ow_viewer_worker *worker = &viewer->worker[i];
        add_stats(&viewer->stats, &worker->stats);
        if (worker->status == OW_CAPACITY || worker->status == OW_BUDGET ||
            worker->status == OW_REGION) {
            viewer->drawn = (enum ow_status)worker->status;
        } else if (worker->status < 0) {
            status = worker->status;
        }
    }
    return status;
}

static int begin_frame(struct ow_viewer *viewer)
{
    struct slices slices = { .viewer = viewer };
    return draw_together(&slices);
}

/* Draws lines first .. first+count-1 to pixels: several slices for each worker even out the work. */
static int draw_lines(struct ow_viewer *viewer, uint8_t *pixels, uint32_t stride, uint16_t first,
                      uint16_t count, struct ow_changes *changes)
{
    uint32_t parts = viewer->workers > 1 ? viewer->workers * SLICES : 1;
    struct slices slices = {
        .viewer = viewer,
        .pixels = pixels,
        .stride = stride,
        .first = first,
        .count = count,
        .lines = (uint16_t)((count + parts - 1) / parts),
        .changes = changes,
    };
    return draw_together(&slices);
}

static uint16_t lines_from(const struct ow_viewer *viewer, uint16_t first)
{
    uint16_t left = (uint16_t)(viewer->panel.height - first);
    return left < viewer->band_lines ? left : viewer->band_lines;
}

/* Waits until at most `pending` writes still use their pixels. */
static int wait_done(struct ow_viewer *viewer, uint32_t pending)
{
    const struct ow_clock *clock = viewer->config.clock;
    uint64_t now_us;
    uint64_t end_us = 0;
    for (;;) {
        int status = ow_panel_done(viewer->config.panel, pending);
        if (status != OW_AGAIN) {
            return status;
        }
        status = clock->ops->now(clock->device, &now_us);
        if (status < 0) {
            return status;
        }
        if (end_us == 0) {
            uint32_t limit_us = viewer->config.timeout_us;
            end_us = now_us + (limit_us != 0 ? limit_us : TIMEOUT_US);
        }
        if (now_us >= end_us) {
            return OW_TIMEOUT;
        }
        status = viewer_sleep_until(viewer, now_us + NAP_US);
        if (status < 0) {
            return status;
        }
    }
}

/* After a failed write: the bands are to be ours before anything else happens to them. */
static void drain(struct ow_viewer *viewer)
{
    (void)wait_done(viewer, 0);
}

static int draw_to_bands(struct ow_viewer *viewer)
{
    const struct ow_panel *panel = viewer->config.panel;
    uint32_t bands = viewer->config.bands;
    uint32_t turn = 0;
    uint16_t count;
    int status = wait_done(viewer, 0); /* a frame that timed out may still be under way */
    for (uint16_t first = 0; first < viewer->panel.height && status >= 0;
         first = (uint16_t)(first + count)) {
        count = lines_from(viewer, first);
        status = wait_done(viewer, bands - 1);
        if (status < 0) {
            break;
        }
        uint8_t *pixels = viewer->band[turn];
        turn = (turn + 1) % bands;
        status = draw_lines(viewer, pixels, viewer->band_stride, first, count, NULL);
        if (status < 0) {
            break;
        }
        struct ow_panel_rect rect = { 0, first, viewer->panel.width, count };
        status = panel->ops->write(panel->device, &rect, pixels, viewer->band_stride,
                                   first + count == viewer->panel.height);
    }
    if (status < 0) {
        drain(viewer);
        return status;
    }
    return wait_done(viewer, 0);
}

/* What changed as the panel wants it, in the memory of the list; *count: how many. */
static const struct ow_panel_rect *list_changes(struct ow_viewer *viewer, uint32_t *count)
{
    const struct ow_panel_info *panel = &viewer->panel;
    const struct ow_change_costs costs = {
        .rect_bits = panel->rect_bytes * 8,
        .pixel_bits = panel->format->bits,
        .align_x = panel->align_x,
        .align_y = panel->align_y,
    };
    struct ow_change *list = viewer->changes.list;
    struct ow_panel_rect *rects = (struct ow_panel_rect *)(void *)list;
    _Static_assert(sizeof *rects == sizeof *list, "one takes the place of the other");
    *count = ow_changes_list(&viewer->changes, &costs);
    for (uint32_t i = 0; i < *count; i++) {
        struct ow_change change = list[i];
        rects[i] =
            (struct ow_panel_rect){ change.left, change.top, (uint16_t)(change.right - change.left),
                                    (uint16_t)(change.bottom - change.top) };
    }
    if (*count == 0) { /* a frame was asked for: show that nothing changed by its first corner */
        rects[0] = (struct ow_panel_rect){ 0, 0, panel->align_x, panel->align_y };
        *count = 1;
    }
    return rects;
}

static int draw_to_lent(struct ow_viewer *viewer)
{
    const struct ow_panel *panel = viewer->config.panel;
    struct ow_panel_buffer buffer;
    int status = panel->ops->lend(panel->device, &buffer);
    if (status < 0) {
        return status;
    }
    struct ow_changes *changes = viewer->changes.bits != NULL ? &viewer->changes : NULL;
    if (changes != NULL) { /* only the frame shown last is what show's rectangles refer to */
        ow_changes_begin(changes, buffer.age == 1);
    }
    uint16_t count;
    for (uint16_t first = 0; first < viewer->panel.height && status >= 0;
         first = (uint16_t)(first + count)) {
        count = lines_from(viewer, first);
        uint8_t *pixels = buffer.pixels + (uint32_t)first * buffer.stride;
        status = draw_lines(viewer, pixels, buffer.stride, first, count, changes);
    }
    const struct ow_panel_rect whole = { 0, 0, viewer->panel.width, viewer->panel.height };
    uint32_t count_changed = 1;
    const struct ow_panel_rect *changed =
        changes != NULL ? list_changes(viewer, &count_changed) : &whole;
    int shown = panel->ops->show(panel->device, changed, status < 0 ? 0 : count_changed);
    return status < 0 ? status : shown;
}

int viewer_present(struct ow_viewer *viewer)
{
    viewer->stats = (struct ow_stats){ 0 };
    viewer->drawn = OW_OK;
    int status = begin_frame(viewer);
    if (status == OW_OK) {
        status =
            ow_panel_lends(viewer->config.panel) ? draw_to_lent(viewer) : draw_to_bands(viewer);
    }
    return status < 0 ? status : OW_OK;
}
