/* SPDX-License-Identifier: 0BSD */
/*
 * owsim: the viewer on the simulator's panel, clock and input. This file
 * composes them; what happens to the frames is in output.c.
 */
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "engine.h"
#include "output.h"
#include "settings.h"
#include "sim/sim_clock.h"
#include "sim/sim_panel.h"
#include "sim/sim_script.h"
#include "sim/sim_workers.h"
#include "tools/common/fail.h"
#include "tools/common/outfile.h"
#include "tree_file.h"
#include "views.h"

enum { SCRIPT_BYTES_MAX = 1 << 26, REPEAT_US = 50000, MS_US = 1000 };

/* Everything that one run is made of. */
struct run {
    struct settings settings;
    struct tree_file tree;
    const struct engine *engine;
    struct ow_parts parts; /* the engine's, as the options choose */
    struct views views;
    struct output output;
    struct sim_panel panel;
    struct sim_clock time;
    struct ow_clock clock;
    struct sim_script script;
    struct ow_input input;
    struct ow_wait wait;
    struct sim_workers *pool; /* NULL: one thread */
    struct ow_workers workers;
    struct ow_viewer_config config;
    struct ow_viewer viewer;
    void *memory;
    struct bench bench;
    struct ow_stats sum; /* of all frames */
    uint32_t dropped;    /* frames of which a part was left out */
    uint32_t cut_short;  /* frames whose work budget ran out */
    struct outfile *dump;
};

static void open_script(struct run *run)
{
    struct sim_script_error error;
    const char *file = run->settings.script;
    size_t bytes;
    char *text = read_whole_file(file, file, SCRIPT_BYTES_MAX, &bytes);
    bool good = sim_script_parse(&run->script, text, bytes, &error);
    free(text);
    if (!good) {
        fail(FAIL_INPUT, file, error.line, "%s", error.text);
    }
    run->script.clock = &run->clock;
    run->input = (struct ow_input){ &sim_script_input_ops, &run->script };
    run->wait = (struct ow_wait){ &sim_script_wait_ops, &run->script };
    run->config.input = &run->input;
    run->config.wait = &run->wait;
    run->config.end = OW_VIEWER_HOLD;
    run->config.interval_us = run->settings.interval_ms * MS_US;
    run->config.repeat_us = REPEAT_US;
}

/* The format that leaves the tree's byte of each pixel alone. */
static const struct ow_pixel_format *kept_format(const struct ow_pixel_format *format)
{
    return format == &ow_format_rgb565 ? &ow_format_x8rgb565_kept : &ow_format_xrgb8888_kept;
}

/* The tree goes where it stays, into the panel's memory, and is opened there. */
static void open_planes(struct run *run)
{
    uint32_t stride;
    const uint8_t *first = sim_panel_kept(&run->panel, &stride);
    run->engine = stride == 4 ? &planes4_ow_engine : &planes3_ow_engine;
    enum ow_status status = run->engine->tree_open(
        &run->tree.tree, first, run->tree.planes_size[0] * run->tree.planes_size[1]);
    if (status != OW_OK) {
        fail(FAIL_INPUT, run->tree.name, 0, "in planes: %s", ow_status_text(status));
    }
}

static void open_panel(struct run *run)
{
    const struct settings *settings = &run->settings;
    struct sim_panel_config config = {
        .width = (uint16_t)settings->size[0],
        .height = (uint16_t)settings->size[1],
        .format = settings->planes ? kept_format(settings->format) : settings->format,
        .kind = settings->panel,
        .kept = run->tree.planes,
        .frame = output_frame,
        .context = &run->output,
    };
    if (!sim_panel_open(&run->panel, &config)) {
        fail(FAIL_INPUT, NULL, 0,
             settings->planes ? "planes need lines of whole 32-bit words"
                              : "not enough memory for the panel");
    }
    run->engine = &ow_engine;
    if (settings->planes) {
        open_planes(run);
    }
}

/* Only trees with numbers can be drawn by number: 0 would mean two things. */
static void check_tree(const struct run *run)
{
    if (run->settings.look.shade == OW_SHADE_ID && !(run->tree.tree.flags & OW_TREE_IDS)) {
        fail(FAIL_INPUT, run->tree.name, 0,
             "the tree has no polygon numbers, compile it with owc --keep-ids");
    }
}

static void open_tree(struct run *run)
{
    struct settings *settings = &run->settings;
    if (!settings->planes) {
        tree_file_open(&run->tree, settings->tree);
        return;
    }
    tree_file_open_planes(&run->tree, settings->tree);
    const uint32_t *size = run->tree.planes_size;
    if (settings->has_size && (settings->size[0] != size[0] || settings->size[1] != size[1])) {
        settings_wrong("the planes are %" PRIu32 "x%" PRIu32 ", so is the picture: leave out "
                       "--size",
                       size[0], size[1]);
    }
    settings->size[0] = size[0];
    settings->size[1] = size[1];
}

/* The cutting plane in lattice units; its direction is the same. */
static void set_cut(struct run *run)
{
    const double *cut = run->settings.cut;
    const struct tree_file *tree = &run->tree;
    double length = sqrt(cut[0] * cut[0] + cut[1] * cut[1] + cut[2] * cut[2]);
    double distance = cut[3];
    for (int i = 0; i < 3; i++) {
        distance -= cut[i] * tree->origin[i];
        run->config.cut_normal[i] = (int32_t)lround(cut[i] / length * (1 << 30));
    }
    distance = distance / length / tree->step * 256;
    double most = OW_EYE_MAX; /* all of the model lies on one side by then */
    run->config.cut_distance = (ow_q8)lround(distance > most    ? most
                                             : distance < -most ? -most
                                                                : distance);
    run->config.cuts = true;
}

/* Distances of the look, which only the tree can bring into lattice units. */
static void scale_look(struct ow_look *look, const struct run *run)
{
    const double *depth_cue = run->settings.depth_cue;
    lights_scale(look, &run->settings.light_places, &run->tree);
    if (depth_cue[1] > 0) {
        look->depth_near = length_q8(depth_cue[0], &run->tree);
        look->depth_far = length_q8(depth_cue[1], &run->tree);
        if (look->depth_far <= look->depth_near) {
            settings_wrong("--depth-cue %g,%g does not suit the model's size", depth_cue[0],
                           depth_cue[1]);
        }
    }
}

static void start_viewer(struct run *run)
{
    const struct settings *settings = &run->settings;
    struct ow_viewer_config *config = &run->config;
    run->clock = (struct ow_clock){ &sim_virtual_clock_ops, &run->time };
    run->parts = *run->engine->parts;
    if (settings->segments) {
        run->parts.dynamic = run->engine->segments;
    }
    config->parts = &run->parts;
    config->tree = &run->tree.tree;
    config->look = settings->look;
    if (settings->cuts) {
        set_cut(run);
    }
    scale_look(&config->look, run);
    config->camera = run->views.lens;
    config->views = run->views.count;
    config->elevation = (ow_turn)lround(settings->elevation / 360 * 4294967296.0);
    config->band_lines = (uint16_t)settings->band_lines;
    config->listed_faces =
        settings->look.order == OW_SCAN_LINE ? ow_listed_faces_max(config->tree) : 0;
    if (settings->threads > 1) {
        run->pool = sim_workers_start(settings->threads);
        if (run->pool == NULL) {
            fail(1, NULL, 0, "the system refuses %u threads, ask for fewer", settings->threads);
        }
        run->workers = sim_workers_seam(run->pool);
        config->workers = &run->workers;
    }
    config->panel = &run->panel.panel;
    config->clock = &run->clock;
    if (run->views.list != NULL) {
        config->view = views_give;
        config->view_context = &run->views;
    }
    run->bench.yard_bytes =
        (size_t)ow_row_bytes(settings->format, settings->size[0]) * settings->size[1];
    if (settings->bench || settings->stats) {
        config->probe = bench_probe;
        config->probe_context = &run->bench;
    }
    uint32_t bytes = run->engine->bytes_needed(config);
    run->memory = bytes == 0 ? NULL : malloc(bytes);
    if (run->memory == NULL) {
        fail(FAIL_INPUT, run->tree.name, 0, "not enough memory to draw this tree");
    }
    int status = run->engine->start(&run->viewer, config, run->memory, bytes);
    if (status < 0) {
        fail(FAIL_INPUT, run->tree.name, 0, "cannot start the viewer: %s", ow_status_text(status));
    }
}

/* ---- after each frame ---- */

static void print_stats(const struct run *run, double ms)
{
    const struct ow_stats *stats = &run->viewer.stats;
    fprintf(stderr,
            "{\"frame\":%" PRIu32 ",\"ms\":%.6f,\"polygons_visited\":%" PRIu32
            ",\"polygons_painted\":%" PRIu32 ",\"polygons_dropped\":%" PRIu32
            ",\"pixels_written\":%" PRIu32 ",\"pixels_background\":%" PRIu32 ",\"spans\":%" PRIu32
            ",\"lines_outgrown\":%" PRIu32 "}\n",
            run->viewer.frames - 1, ms, stats->polygons_visited, stats->polygons_painted,
            stats->polygons_dropped, stats->pixels_written, stats->pixels_background, stats->spans,
            stats->lines_outgrown);
}

static void add_stats(struct run *run)
{
    const struct ow_stats *stats = &run->viewer.stats;
    run->sum.polygons_visited += stats->polygons_visited;
    run->sum.polygons_painted += stats->polygons_painted;
    run->sum.pixels_written += stats->pixels_written;
    run->sum.pixels_background += stats->pixels_background;
    run->sum.spans += stats->spans;
    run->sum.polygons_dropped += stats->polygons_dropped;
    run->dropped += run->viewer.drawn == OW_CAPACITY;
    run->cut_short += run->viewer.drawn == OW_BUDGET;
}

static void after_frame(struct run *run, uint64_t drawn_ns)
{
    add_stats(run);
    if (run->settings.stats) {
        print_stats(run, (double)drawn_ns / 1e6);
    }
    if (run->dump != NULL) {
        FILE *stream = outfile_stream(run->dump);
        fputs(run->viewer.frames == 1 ? "[\n" : ",\n", stream);
        views_dump(stream, run->viewer.frames - 1, &run->viewer.view);
    }
}

/* One pass: every view, or the script to its end. */
static void draw_all(struct run *run, bool first)
{
    while (!run->viewer.finished) {
        uint64_t before_ns = run->bench.pass_ns;
        int status = run->engine->step(&run->viewer);
        if (status < 0) {
            fail(FAIL_INPUT, run->tree.name, 0, "frame %" PRIu32 ": %s", run->viewer.frames,
                 ow_status_text(status));
        }
        if (status > 0 && first) {
            after_frame(run, run->bench.pass_ns - before_ns);
        }
    }
}

static void measure(struct run *run)
{
    uint32_t frames = run->viewer.frames;
    run->output.off = true;
    while (bench_end_pass(&run->bench, frames, run->settings.passes)) {
        run->engine->restart(&run->viewer);
        draw_all(run, false);
    }
    bench_print(&run->bench, &run->settings, frames, &run->sum, run->output.crc);
}

static void finish(struct run *run)
{
    output_end(&run->output);
    if (run->dump != NULL) {
        fputs("\n]\n", outfile_stream(run->dump));
        outfile_commit(run->dump);
    }
    if (run->cut_short > 0) {
        warn_line(NULL, 0, "the budget ran out in %" PRIu32 " frames: only what is near was drawn",
                  run->cut_short);
    }
    if (run->dropped > 0) {
        warn_line(run->tree.name, 0,
                  "%" PRIu32 " polygons were left out in %" PRIu32
                  " frames: clipping gave them too many corners",
                  run->sum.polygons_dropped, run->dropped);
    }
    if (run->panel.wrong != NULL) {
        fail(FAIL_INPUT, NULL, 0, "the viewer broke the panel's contract: %s", run->panel.wrong);
    }
}

static void close_all(struct run *run)
{
    sim_workers_stop(run->pool);
    free(run->memory);
    sim_panel_close(&run->panel);
    sim_script_free(&run->script);
    views_free(&run->views);
    tree_file_close(&run->tree);
}

int main(int argc, char **argv)
{
    static struct run run; /* large: names and times */
    fail_set_program("owsim");
    settings_read(&run.settings, argc, argv);
    open_tree(&run);
    check_tree(&run);
    views_make(&run.views, &run.settings, &run.tree);
    if (run.settings.script != NULL) {
        open_script(&run);
    }
    output_begin(&run.output, &run.settings, run.settings.script != NULL ? 0 : run.views.count);
    if (run.settings.dump_views != NULL) {
        run.dump = outfile_open(run.settings.dump_views);
    }
    open_panel(&run);
    start_viewer(&run);
    draw_all(&run, true);
    finish(&run);
    if (run.settings.bench) {
        measure(&run);
    }
    bool equal = run.output.differ == 0;
    if (run.settings.bench || run.settings.compare != NULL) {
        outfile_commit(outfile_open("-")); /* a full disk behind standard output */
    }
    if (!equal) {
        warn_line(run.settings.compare, 0, "%" PRIu32 " of %" PRIu32 " frames differ",
                  run.output.differ, run.output.count);
    }
    close_all(&run);
    return equal ? 0 : FAIL_INPUT;
}
