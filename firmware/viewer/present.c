/* SPDX-License-Identifier: 0BSD */
/* Present: draws the view into memory that the panel lends, or band by band into the caller's. */
#include "stages.h"

static void probe(const struct ow_viewer *viewer, enum ow_probe point)
{
    if (viewer->config.probe != NULL) {
        viewer->config.probe(viewer->config.probe_context, point);
    }
}

/* Draws lines first .. first+count-1 to pixels. A capacity that ran out is noted, not a failure. */
static int draw_band(struct ow_viewer *viewer, uint8_t *pixels, uint32_t stride, uint16_t first,
                     uint16_t count)
{
    struct ow_target target = {
        .pixels = pixels,
        .stride = stride,
        .first_line = first,
        .line_count = count,
        .format = viewer->panel.format,
    };
    probe(viewer, OW_PROBE_DRAW_BEGIN);
    enum ow_status status = ow_draw_band(&viewer->workspace, &target, &viewer->stats);
    probe(viewer, OW_PROBE_DRAW_END);
    if (status == OW_CAPACITY) {
        viewer->drawn = OW_CAPACITY;
        return OW_OK;
    }
    return status;
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
        status = draw_band(viewer, pixels, viewer->band_stride, first, count);
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

static int draw_to_lent(struct ow_viewer *viewer)
{
    const struct ow_panel *panel = viewer->config.panel;
    struct ow_panel_buffer buffer;
    int status = panel->ops->lend(panel->device, &buffer);
    if (status < 0) {
        return status;
    }
    uint16_t count;
    for (uint16_t first = 0; first < viewer->panel.height && status >= 0;
         first = (uint16_t)(first + count)) {
        count = lines_from(viewer, first);
        uint8_t *pixels = buffer.pixels + (uint32_t)first * buffer.stride;
        status = draw_band(viewer, pixels, buffer.stride, first, count);
    }
    struct ow_panel_rect whole = { 0, 0, viewer->panel.width, viewer->panel.height };
    int shown = panel->ops->show(panel->device, &whole, status < 0 ? 0 : 1);
    return status < 0 ? status : shown;
}

int viewer_present(struct ow_viewer *viewer)
{
    viewer->stats = (struct ow_stats){ 0 };
    viewer->drawn = OW_OK;
    probe(viewer, OW_PROBE_DRAW_BEGIN);
    int status =
        ow_draw_begin(viewer->config.tree, &viewer->view, &viewer->look, &viewer->workspace);
    probe(viewer, OW_PROBE_DRAW_END);
    if (status == OW_OK) {
        status =
            ow_panel_lends(viewer->config.panel) ? draw_to_lent(viewer) : draw_to_bands(viewer);
    }
    return status < 0 ? status : OW_OK;
}
