/* SPDX-License-Identifier: 0BSD */
/* --panel fbdev. */
#include "hal/linux/fbdev.h"
#include "output.h"

static struct linux_fbdev the_fbdev;

static int open_fbdev(struct output *output, const struct oldwell_settings *settings,
                      const struct linux_system *system)
{
    const struct linux_fbdev_config config = {
        .system = system,
        .device = settings->device != NULL ? settings->device : output_fbdev.usual_device,
        .bits = (uint32_t)settings->depth,
        .one_page = settings->one_page,
    };
    output->fault = &the_fbdev.fault;
    output->panel = (struct ow_panel){ &linux_fbdev_ops, &the_fbdev };
    int status = linux_fbdev_open(&the_fbdev, &config);
    output->uses_changes = status == OW_OK && the_fbdev.pages == 1;
    return status;
}

static void close_fbdev(struct output *output)
{
    (void)output;
    linux_fbdev_close(&the_fbdev);
}

static void examine_fbdev(const struct output *output, struct report *report)
{
    (void)output;
    report_note(report, "fbdev", "%u bytes a line; %s; %s", the_fbdev.stride,
                the_fbdev.pages == 2 ? "panning works" : "no panning, or not asked for",
                the_fbdev.waits ? "it waits for the screen's start"
                                : "it does not wait for the screen's start");
}

const struct output_kind output_fbdev = {
    .examine = examine_fbdev,
    .usual_device = "/dev/fb0",
    .open = open_fbdev,
    .close = close_fbdev,
    .on_console = true,
};
