/* SPDX-License-Identifier: 0BSD */
/* --panel v4l2. */
#include "hal/linux/v4l2_out.h"
#include "output.h"

static struct linux_v4l2_out the_out = { .video = { .fd = -1 } };

static int open_v4l2(struct output *output, const struct oldwell_settings *settings,
                     const struct linux_system *system)
{
    const struct linux_v4l2_config config = {
        .system = system,
        .device = settings->device != NULL ? settings->device : output_v4l2.usual_device,
        .width = settings->has_size ? settings->size[0] : 0,
        .height = settings->size[1],
        .pixels = settings->pixels,
    };
    output->fault = &the_out.video.fault;
    output->panel = (struct ow_panel){ &linux_v4l2_out_ops, &the_out };
    return linux_v4l2_out_open(&the_out, &config);
}

static void close_v4l2(struct output *output)
{
    (void)output;
    linux_v4l2_out_close(&the_out);
}

static int finish_v4l2(struct output *output)
{
    (void)output;
    return linux_v4l2_out_finish(&the_out);
}

static void examine_v4l2(const struct output *output, struct report *report)
{
    (void)output;
    report_note(report, "v4l2", "frames go out as %.4s, %u bytes a line",
                (const char *)&the_out.video.pixels, the_out.video.stride);
}

const struct output_kind output_v4l2 = {
    .examine = examine_v4l2,
    .usual_device = "/dev/video0",
    .open = open_v4l2,
    .close = close_v4l2,
    .finish = finish_v4l2,
};
