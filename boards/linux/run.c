/* SPDX-License-Identifier: 0BSD */
/* The loop around the viewer. */
#include "run.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hal/linux/clock.h"
#include "tools/common/fail.h"

enum {
    SECOND_US = 1000000,
    FIRST_PAUSE_US = 50000, /* between two attempts to open; doubles */
    LAST_PAUSE_US = 5000000,
    REPEAT_US = 50000, /* of a button that is held */
    TEXT_BYTES = 600
};

int run_exit_status(int status)
{
    switch (status) {
    case OW_GONE:
    case OW_BUSY:
        return FAIL_ABSENT;
    case OW_DENIED:
        return FAIL_DENIED;
    case OW_ARGUMENT:
        return FAIL_USAGE;
    case OW_TIMEOUT:
        return FAIL_TIMEOUT;
    default:
        return FAIL_DEVICE;
    }
}

static uint64_t now_us(const struct run *run)
{
    uint64_t now = 0;
    (void)run->clock.ops->now(run->clock.device, &now);
    return now;
}

/* Sleeps, but not through a signal. Input and the camera wait. */
static void pause_until(struct run *run, uint64_t until_us)
{
    while (!run->events.stop && now_us(run) < until_us) {
        if (linux_wait_ops.wait(&run->quiet, until_us) < 0) {
            return;
        }
    }
}

static void say_fault(const struct linux_fault *fault, const char *more)
{
    char text[TEXT_BYTES];
    linux_fault_text(fault, text, sizeof text);
    warn_line(NULL, 0, "%s%s", text, more);
}

/* ---- the display ---- */

/*
 * Opens the display, again and again for at most for_s seconds, slower and
 * slower. The status of the last attempt, or OW_OK; OW_AGAIN: stopped by a signal.
 */
static int open_display(struct run *run, uint64_t for_s)
{
    uint64_t end_us = now_us(run) + for_s * SECOND_US;
    uint64_t pause_us = FIRST_PAUSE_US;
    for (;;) {
        int status = output_open(&run->output, run->settings, run->system);
        if (status == OW_OK) {
            return linux_wait_add(&run->waiting, run->output.fd, run->output.ready, &run->output);
        }
        uint64_t now = now_us(run);
        if (status == OW_UNSUPPORTED || status == OW_ARGUMENT || status == OW_MEMORY ||
            now >= end_us) {
            return status;
        }
        pause_until(run, now + pause_us < end_us ? now + pause_us : end_us);
        if (run->events.stop) {
            return OW_AGAIN;
        }
        pause_us = 2 * pause_us < LAST_PAUSE_US ? 2 * pause_us : LAST_PAUSE_US;
    }
}

static void close_display(struct run *run)
{
    if (run->output.is_open) {
        linux_wait_remove(&run->waiting, run->output.fd);
        output_close(&run->output);
    }
}

/* ---- the viewer ---- */

static struct ow_viewer_config viewer_config(struct run *run, const struct ow_tree *tree)
{
    const struct oldwell_settings *s = run->settings;
    struct ow_viewer_config config = {
        .tree = tree,
        .parts = &ow_parts_all,
        .look = s->look,
        .camera = { .projection = OW_PERSPECTIVE,
                    .fov = (ow_turn)llround(s->fov / 360 * 4294967296.0) },
        .views = (uint32_t)s->orbit,
        .interval_us = run->frame_us,
        .end = OW_VIEWER_REPEAT,
        .elevation = (ow_turn)(int64_t)llround(s->elevation / 360 * 4294967296.0),
        .repeat_us = REPEAT_US,
        .find_changes = run->output.uses_changes,
        .panel = &run->output.panel,
        .clock = &run->clock,
        .input = &run->controls.input,
        .wait = &run->wait,
        .quarter_turns = (uint8_t)(s->rotate / 90),
        .probe = s->stats ? stats_probe : NULL,
        .probe_context = &run->stats,
    };
    if (run->camera.is_wanted) {
        config.look.backdrop = &run->camera.backdrop;
    }
    return config;
}

/* Makes a viewer of this tree for the open display and puts it in the old one's place. */
static int make_viewer(struct run *run, const struct ow_tree *tree,
                       const struct ow_viewer_place *place)
{
    struct ow_viewer viewer;
    struct ow_viewer_config config = viewer_config(run, tree);
    uint32_t bytes = ow_viewer_bytes_needed(&config);
    void *memory = bytes == 0 ? NULL : malloc(bytes);
    if (memory == NULL) {
        return bytes == 0 ? OW_ARGUMENT : OW_MEMORY;
    }
    int status = ow_viewer_start(&viewer, &config, memory, bytes);
    if (status < 0) {
        free(memory);
        return status;
    }
    ow_viewer_set_place(&viewer, place);
    camera_fit(&run->camera, viewer.panel.width, viewer.panel.height, viewer.turned);
    free(run->memory);
    run->memory = memory;
    run->viewer = viewer;
    return OW_OK;
}

bool run_reload(struct run *run)
{
    const char *file = run->settings->tree;
    struct loaded_tree tree;
    char why[256];
    if (!loaded_tree_read(&tree, file, why, sizeof why)) {
        warn_line(file, 0, "%s; going on with the tree of before", why);
        return false;
    }
    struct ow_viewer_place place;
    ow_viewer_get_place(&run->viewer, &place);
    struct loaded_tree old = run->tree;
    run->tree = tree;
    int status = make_viewer(run, &run->tree.tree, &place);
    if (status < 0) {
        run->tree = old;
        loaded_tree_free(&tree);
        warn_line(file, 0, "%s; going on with the tree of before", ow_status_text(status));
        return false;
    }
    loaded_tree_free(&old);
    return true;
}

/* ---- failures ---- */

static bool is_device_failure(int status)
{
    return status == OW_GONE || status == OW_BUS || status == OW_TIMEOUT || status == OW_BUSY ||
           status == OW_DENIED || status == OW_FULL;
}

/* What the drivers do not note comes from the viewer: a status alone. */
static void note_status(struct run *run, int status)
{
    if (run->output.fault->status != status) {
        const char *device = run->output.fault->device[0] != '\0'
                                 ? run->output.fault->device
                                 : panel_kind_name(run->settings->panel);
        char copy[sizeof run->output.fault->device];
        snprintf(copy, sizeof copy, "%s", device);
        linux_fault_note(run->output.fault, status, copy, NULL, ow_status_text(status), "");
    }
}

/* Opens the display anew and goes on where the eye was. 0, or the program's exit status. */
static int recover(struct run *run, int failure)
{
    char more[64];
    struct ow_viewer_place place;
    note_status(run, failure);
    snprintf(more, sizeof more, "; trying again for %" PRIu64 " s", run->settings->retry_s);
    say_fault(run->output.fault, run->settings->retry_s > 0 ? more : "");
    if (run->settings->retry_s == 0) {
        return run_exit_status(failure);
    }
    ow_viewer_get_place(&run->viewer, &place);
    close_display(run);
    int status = open_display(run, run->settings->retry_s);
    if (status == OW_AGAIN) {
        return 0;
    }
    if (status < 0) {
        say_fault(run->output.fault, "; giving up");
        return run_exit_status(status);
    }
    status = make_viewer(run, &run->tree.tree, &place);
    if (status < 0) {
        note_status(run, status);
        say_fault(run->output.fault, "; giving up");
        return run_exit_status(status);
    }
    warn_line(NULL, 0, "the display is back");
    return 0;
}

/* ---- the loop ---- */

/* A status: one of drawing, of a device, or how many frames were shown. */
static int step(struct run *run)
{
    uint64_t began_us = now_us(run);
    int status = ow_viewer_step(&run->viewer);
    if (status > 0) {
        stats_frame(&run->stats, &run->viewer, now_us(run) - began_us);
        run->next_us = began_us + run->frame_us;
        if (run->settings->once) {
            status = output_finish(&run->output);
            run->events.stop = status >= 0;
        }
    }
    return status;
}

/* OW_OK, or what the display says of itself. */
static int serve_events(struct run *run)
{
    int status = OW_OK;
    events_look(&run->events);
    if (run->events.reload) {
        run->events.reload = false;
        (void)run_reload(run);
    }
    if (run->events.second) {
        run->events.second = false;
        camera_second(&run->camera);
        controls_second(&run->controls);
        status = output_look(&run->output);
        if (run->settings->stats) {
            stats_print(&run->stats);
        }
    }
    if (camera_look(&run->camera)) {
        ow_viewer_refresh(&run->viewer);
    }
    return status;
}

/* Failures in a row, each recovered from at once, must not keep it busy for ever. */
enum { FAILURES_MOST = 20 };

static int loop(struct run *run)
{
    uint32_t failures = 0;
    while (!run->events.stop) {
        int status = serve_events(run);
        pause_until(run, run->next_us);
        if (run->events.stop) {
            break;
        }
        status = status < 0 ? status : step(run);
        if (status >= 0) {
            failures = status > 0 ? 0 : failures;
            continue;
        }
        if (!is_device_failure(status)) {
            warn_line(run->settings->tree, 0, "cannot draw this: %s", ow_status_text(status));
            return FAIL_INPUT;
        }
        run->next_us = now_us(run) + (uint64_t)FIRST_PAUSE_US * failures;
        if (++failures > FAILURES_MOST) {
            say_fault(run->output.fault, "; it fails each time, giving up");
            return run_exit_status(status);
        }
        int end = recover(run, status);
        if (end != 0) {
            return end;
        }
    }
    return 0;
}

static int open_all(struct run *run)
{
    const struct oldwell_settings *s = run->settings;
    char why[256];
    if (!loaded_tree_read(&run->tree, s->tree, why, sizeof why)) {
        warn_line(s->tree, 0, "%s", why);
        return FAIL_INPUT;
    }
    if (s->look.shade == OW_SHADE_ID && !(run->tree.tree.flags & OW_TREE_IDS)) {
        warn_line(s->tree, 0, "the tree has no polygon numbers, compile it with owc --keep-ids");
        return FAIL_INPUT;
    }
    bool ticks = s->stats || s->camera != NULL || s->input != NULL ||
                 (output_kind_of(s) != NULL && output_kind_of(s)->look != NULL);
    if (!events_open(&run->events, &run->waiting) || (ticks && !events_tick(&run->events))) {
        warn_line(NULL, 0, "signals cannot be waited for: %s", strerror(errno));
        return FAIL_DEVICE;
    }
    events_add_signals(&run->events, &run->quiet);
    if (!s->no_watch && !s->once && !events_watch(&run->events, s->tree)) {
        warn_line(s->tree, 0, "cannot be watched for changes (%s), SIGHUP loads it anew",
                  strerror(errno));
    }
    int status = camera_start(&run->camera, s, run->system, &run->waiting);
    if (status < 0) {
        say_fault(&run->camera.device.video.fault, "");
        return run_exit_status(status);
    }
    status = controls_open(&run->controls, s, run->system, linux_gpio_installed, &run->waiting);
    if (status < 0) {
        say_fault(&run->controls.fault, "");
        return run_exit_status(status);
    }
    camera_wait(&run->camera);
    status = open_display(run, s->wait_s);
    if (status == OW_AGAIN) {
        return 0;
    }
    if (status < 0) {
        say_fault(run->output.fault, "");
        return run_exit_status(status);
    }
    const struct ow_viewer_place place = { .number = (uint32_t)s->first, .manual = s->still };
    status = make_viewer(run, &run->tree.tree, &place);
    if (status < 0) {
        warn_line(s->tree, 0, "cannot start the viewer: %s", ow_status_text(status));
        return is_device_failure(status) ? run_exit_status(status) : FAIL_INPUT;
    }
    return 0;
}

int run_main(struct run *run, const struct oldwell_settings *settings,
             const struct linux_system *system)
{
    *run = (struct run){ .settings = settings, .system = system };
    linux_wait_init(&run->waiting, system);
    linux_wait_init(&run->quiet, system);
    run->controls.wait = &run->waiting; /* may be closed before it was opened */
    linux_gpio_init(&run->controls.gpio, &(struct linux_gpio_config){ .lib = NULL });
    run->wait = (struct ow_wait){ &linux_wait_ops, &run->waiting };
    run->clock = (struct ow_clock){ &linux_clock_ops, (void *)(uintptr_t)system };
    run->frame_us = SECOND_US / settings->fps;
    run->events = (struct events){ .wait = &run->waiting, .signals = -1, .watch = -1, .timer = -1 };
    stats_begin(&run->stats, system);
    int status = open_all(run);
    if (status == 0 && run->output.is_open) {
        status = loop(run);
    }
    camera_stop(&run->camera);
    controls_close(&run->controls);
    close_display(run);
    events_close(&run->events);
    free(run->memory);
    run->memory = NULL;
    loaded_tree_free(&run->tree);
    return status;
}
