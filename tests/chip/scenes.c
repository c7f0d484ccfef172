/* SPDX-License-Identifier: 0BSD */
/* The scenes, and the viewer that draws them. */
#include "tests/chip/scenes.h"

#include "firmware/device/text.h"
#include "ow_coverage.h"
#include "ow_dither.h"
#include "ow_frame.h"
#include "ow_lines.h"

#define TURN_OF(degrees) ((ow_turn)((((uint64_t)(degrees) << 32) + 180) / 360))

const struct scene scenes[] = {
    { "oled", 128, 64, &ow_format_gray4, OW_FRONT_TO_BACK, OW_SHADE_FLAT, false, 0, 0, 8 },
    { "oled-painter", 128, 64, &ow_format_gray4, OW_BACK_TO_FRONT, OW_SHADE_FLAT, false, 0, 0, 8 },
    { "oled-bands", 128, 64, &ow_format_gray4, OW_FRONT_TO_BACK, OW_SHADE_FLAT, false, 8, 256, 8 },
    { "tft", 320, 240, &ow_format_rgb565, OW_FRONT_TO_BACK, OW_SHADE_FLAT, false, 24, 0, 8 },
    { "tft-painter", 320, 240, &ow_format_rgb565, OW_BACK_TO_FRONT, OW_SHADE_FLAT, false, 24, 0,
      8 },
    { "tft-gouraud", 320, 240, &ow_format_rgb565, OW_FRONT_TO_BACK, OW_SHADE_GOURAUD, false, 24, 0,
      4 },
    { "tft-phong", 320, 240, &ow_format_rgb565, OW_FRONT_TO_BACK, OW_SHADE_PHONG, false, 24, 0, 4 },
    { "xrgb", 160, 120, &ow_format_xrgb8888, OW_FRONT_TO_BACK, OW_SHADE_FLAT, false, 24, 0, 8 },
    { "xrgb-4x4", 96, 64, &ow_format_xrgb8888, OW_FRONT_TO_BACK, OW_SHADE_FLAT, true, 8, 0, 4 },
    { "lines", 320, 240, &ow_format_mono, OW_FRONT_TO_BACK, OW_SHADE_LINES, false, 48, 0, 4 },
};
const uint32_t scene_count = sizeof scenes / sizeof scenes[0];

/* All but the fast way for small faces, which costs time where a picture has many bands. */
static const struct ow_parts parts = {
    .painter = &ow_surface_painter,
    .dynamic = &ow_surface_dynamic,
    .scan_line = &ow_line_order,
    .shading = { &ow_shading_id, &ow_shading_flat, &ow_shading_gouraud, &ow_shading_phong,
                 &ow_shading_lines },
    .coverage = &ow_faces_covering,
    .lines = &ow_faces_in_lines,
    .dither = &ow_dithering,
    .difference = &ow_differences,
    .skip = &ow_skipping,
};

/* ---- a panel that takes a checksum ---- */

struct sum_panel {
    const struct scene *scene;
    uint32_t crc;
};

static int info(void *device, struct ow_panel_info *info)
{
    const struct sum_panel *panel = device;
    *info = (struct ow_panel_info){
        .width = panel->scene->width,
        .height = panel->scene->height,
        .format = panel->scene->format,
        .align_x = 1,
        .align_y = 1,
    };
    return OW_OK;
}

static int write(void *device, const struct ow_panel_rect *rect, const void *pixels,
                 uint32_t stride, bool last)
{
    struct sum_panel *panel = device;
    const uint8_t *row = pixels;
    uint32_t bytes = ow_row_bytes(panel->scene->format, rect->width);
    (void)last;
    for (uint32_t y = 0; y < rect->height; y++) {
        panel->crc = ow_crc32(panel->crc, row, bytes);
        row += stride;
    }
    return OW_OK;
}

static const struct ow_panel_ops sum_panel_ops = { .info = info, .write = write };

/* ---- time, of which none passes ---- */

static int now(void *device, uint64_t *time_us)
{
    (void)device;
    *time_us = 0;
    return OW_OK;
}

static int sleep_until(void *device, uint64_t until_us)
{
    (void)device;
    (void)until_us;
    return OW_OK;
}

static const struct ow_clock_ops no_time_ops = { .now = now, .sleep = sleep_until };

/* ---- counting ---- */

struct counter {
    uint32_t begun;
    uint64_t units;
};

static void probe(void *context, enum ow_probe point)
{
    struct counter *counter = context;
    uint32_t units = scene_units();
    if (point == OW_PROBE_DRAW_BEGIN) {
        counter->begun = units;
    } else {
        counter->units += units - counter->begun;
    }
}

void scene_draw(const struct scene *scene, const struct ow_tree *tree, void *memory,
                uint32_t memory_bytes, struct scene_result *result)
{
    static struct ow_viewer viewer;
    struct sum_panel sum = { scene, 0 };
    struct ow_panel panel = { &sum_panel_ops, &sum };
    struct ow_clock clock = { &no_time_ops, NULL };
    struct counter counter = { 0, 0 };
    struct ow_viewer_config config = {
        .parts = &parts,
        .tree = tree,
        .look = {
            .order = scene->order,
            .shade = scene->shade,
            .coverage = scene->coverage,
            .background = 0x20242C,
            .foreground = 0xF0F0F0,
            .ambient_q8 = 77,
            .lights = { { .direction_q14 = { -6521, 9782, 11412 }, .intensity_q8 = 179 } },
        .light_count = 1,
            .specular_q8 = 102,
            .shininess = 4,
        },
        .camera = { .projection = OW_PERSPECTIVE, .fov = TURN_OF(45) },
        .views = scene->views,
        .elevation = TURN_OF(15),
        .band_lines = scene->band_lines,
        .cached_vertices = scene->cached_vertices,
        .panel = &panel,
        .clock = &clock,
        .probe = probe,
        .probe_context = &counter,
    };
    *result = (struct scene_result){ .memory_bytes = ow_viewer_bytes_needed(&config) };
    result->status = ow_viewer_start(&viewer, &config, memory, memory_bytes);
    while (result->status >= 0 && !viewer.finished) {
        result->status = ow_viewer_step(&viewer);
    }
    result->crc = sum.crc;
    result->units = counter.units;
}

void scene_line(char *line, const struct scene *scene, const struct scene_result *result)
{
    struct text text = { 0 };
    text_add(&text, "scene ");
    text_add(&text, scene->name);
    if (result->status < 0) {
        text_add(&text, " failed: ");
        text_add(&text, ow_status_text(result->status));
    }
    text_pair(&text, "frames", (int32_t)scene->views);
    text_add(&text, " crc32 ");
    text_number(&text, result->crc);
    if (result->units > 0) {
        text_add(&text, " units ");
        text_number(&text, (uint32_t)(result->units / scene->views));
    }
    for (uint32_t i = 0; i <= text.length; i++) {
        line[i] = text.bytes[i];
    }
}
