/* SPDX-License-Identifier: 0BSD */
/* --panel file. */
#include "hal/linux/raw_file.h"
#include "output.h"

static struct linux_raw_file the_file;

static int open_file(struct output *output, const struct oldwell_settings *settings,
                     const struct linux_system *system)
{
    const struct linux_raw_file_config config = {
        .system = system,
        .device = settings->device,
        .width = (uint16_t)settings->size[0],
        .height = (uint16_t)settings->size[1],
        .format = settings->format,
    };
    output->fault = &the_file.fault;
    output->panel = (struct ow_panel){ &linux_raw_file_ops, &the_file };
    return linux_raw_file_open(&the_file, &config);
}

static void close_file(struct output *output)
{
    (void)output;
    linux_raw_file_close(&the_file);
}

const struct output_kind output_file = { .open = open_file, .close = close_file };
