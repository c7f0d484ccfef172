/* SPDX-License-Identifier: 0BSD */
/* The doctor's round. */
#include "doctor.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>

#include "access.h"
#include "controls.h"
#include "events.h"
#include "hal/linux/clock.h"
#include "hal/linux/console.h"
#include "hal/linux/v4l2_camera.h"
#include "output.h"
#include "pattern.h"
#include "run.h"
#include "tree.h"

enum { TEXT_BYTES = 256, SECOND_US = 1000000 };

static void check_tree(struct report *report, const struct oldwell_settings *settings)
{
    struct loaded_tree tree;
    char why[TEXT_BYTES];
    if (settings->tree == NULL) {
        return;
    }
    if (!loaded_tree_read(&tree, settings->tree, why, sizeof why)) {
        report_bad(report, OW_CORRUPT, "tree", "%s: %s", settings->tree, why);
        return;
    }
    report_good(report, "tree", "%s: %" PRIu32 " polygons, %" PRIu32 " bytes", settings->tree,
                tree.tree.polygon_count, tree.tree.blob_bytes);
    loaded_tree_free(&tree);
}

/* A node that can be looked at without opening it. False: there is no use in opening it. */
static bool check_node(struct report *report, const char *item, const char *path)
{
    struct stat node;
    char text[TEXT_BYTES];
    if (stat(path, &node) != 0) {
        report_bad(report, errno == EACCES ? OW_DENIED : OW_GONE, item,
                   "%s: %s; connect the device and load its driver, or name another one", path,
                   strerror(errno));
        return false;
    }
    bool may = access_of_path(path, text, sizeof text);
    if (may) {
        report_good(report, item, "%s is there; %s", path, text);
    } else {
        report_bad(report, OW_DENIED, item, "%s: %s", path, text);
    }
    return may;
}

static void check_camera(struct report *report, const struct oldwell_settings *settings,
                         const struct linux_system *system)
{
    static struct linux_v4l2_camera camera;
    const struct linux_v4l2_config config = {
        .system = system,
        .device = settings->camera,
        .width = settings->has_camera_size ? settings->camera_size[0] : 0,
        .height = settings->camera_size[1],
    };
    if (settings->camera == NULL || !check_node(report, "camera", settings->camera)) {
        return;
    }
    if (linux_v4l2_camera_open(&camera, &config) < 0) {
        report_fault(report, "camera", &camera.video.fault);
        return;
    }
    report_good(report, "camera", "%" PRIu32 "x%" PRIu32 ", %.4s", camera.video.width,
                camera.video.height, (const char *)&camera.video.pixels);
    linux_v4l2_camera_close(&camera);
}

static void check_controls(struct report *report, const struct oldwell_settings *settings,
                           const struct linux_system *system)
{
    static struct controls controls;
    struct linux_wait wait;
    linux_wait_init(&wait, system);
    if (controls_open(&controls, settings, system, linux_gpio_installed, &wait) < 0) {
        report_fault(report, "input", &controls.fault);
        return;
    }
    if (controls.inputs.count > 0) {
        report_good(report, "input", "%s%s%s", settings->buttons != NULL ? "buttons " : "",
                    settings->knobs != NULL ? "knobs " : "",
                    settings->input != NULL ? settings->input : "");
    } else {
        report_note(report, "input", "no buttons: the model turns for ever");
    }
    controls_close(&controls);
}

/* Only that it can be had: it is taken later, by who gives it back. */
static void check_console(struct report *report, const struct oldwell_settings *settings,
                          const struct linux_system *system)
{
    struct linux_console console;
    if (linux_console_open(&console, system, settings->console) < 0) {
        report_fault(report, "console", &console.fault);
    } else if (console.fd < 0) {
        report_note(report, "console", "none shares the screen");
    } else {
        report_good(report, "console", "its text gives way to the picture");
        (void)system->close(console.fd);
    }
}

/* Where permission is missing, the node says whose. */
static void report_failed_open(struct report *report, const char *item,
                               const struct linux_fault *fault)
{
    char text[TEXT_BYTES];
    if (fault->status == OW_DENIED && fault->device[0] == '/' &&
        !access_of_path(fault->device, text, sizeof text)) {
        report_bad(report, OW_DENIED, item, "%s: %s", fault->device, text);
    } else {
        report_fault(report, item, fault);
    }
}

static void describe_panel(struct report *report, const struct output *output)
{
    struct ow_panel_info info;
    int status = ow_panel_check(&output->panel, &info);
    if (status < 0) {
        report_bad(report, status, "panel", "%s", ow_status_text(status));
        return;
    }
    report_good(report, "panel", "%ux%u pixels, %s, %s", info.width, info.height, info.format->name,
                info.buffers > 1    ? "pages change whole"
                : info.buffers == 1 ? "what changed is copied"
                                    : "pixels are sent");
    if (output->kind->examine != NULL) {
        output->kind->examine(output, report);
    }
}

static void show_pattern(struct report *report, struct output *output,
                         const struct oldwell_settings *settings, const struct linux_system *system)
{
    struct linux_wait wait;
    struct events events;
    struct ow_clock clock = { &linux_clock_ops, (void *)(uintptr_t)system };
    uint64_t now_us = 0;
    int status = pattern_show(&output->panel, &clock, (uint32_t)(settings->rotate / 90));
    if (status == OW_OK) {
        status = output_finish(output);
    }
    if (status < 0 && output->fault->status == status) {
        report_fault(report, "pattern", output->fault);
        return;
    }
    if (status < 0) {
        report_bad(report, status, "pattern", "%s", ow_status_text(status));
        return;
    }
    report_good(report, "pattern", "shown for %" PRIu64 " s", settings->seconds);
    report_note(report, "look",
                "a white line all round the edge; corners red, green / blue, white; the arrow "
                "points up; bars white, yellow, cyan, green, magenta, red, blue, black");
    report_note(report, "if not",
                "a line missing: the size or offset; red and blue exchanged: the channel order; "
                "arrow elsewhere: --rotate");
    linux_wait_init(&wait, system);
    if (events_open(&events, &wait)) {
        (void)clock.ops->now(clock.device, &now_us);
        (void)linux_wait_ops.wait(&wait, now_us + settings->seconds * SECOND_US);
    }
    events_close(&events);
}

int doctor_main(struct report *report, const struct oldwell_settings *settings,
                const struct linux_system *system)
{
    static struct output output;
    const struct output_kind *kind = output_kind_of(settings);
    const char *device = settings->device;
    if (settings->board != NULL) {
        report_good(report, "board", "%s", settings->board);
    }
    check_tree(report, settings);
    check_camera(report, settings, system);
    check_controls(report, settings, system);
    if (kind != NULL && kind->on_console) {
        check_console(report, settings, system);
    }
    if (device == NULL && kind != NULL) {
        device = kind->usual_device;
    }
    bool may = settings->panel == PANEL_FILE || device == NULL ||
               check_node(report, panel_kind_name(settings->panel), device);
    if (may && output_open(&output, settings, system) < 0) {
        report_failed_open(report, panel_kind_name(settings->panel), output.fault);
    } else if (may) {
        describe_panel(report, &output);
        if (settings->seconds > 0) {
            show_pattern(report, &output, settings, system);
        }
        output_close(&output);
    }
    fprintf(report->stream, "%u right, %u wrong\n", report->good, report->bad);
    return report->bad == 0 ? 0 : report->worst == OW_CORRUPT ? 1 : run_exit_status(report->worst);
}
