/* SPDX-License-Identifier: 0BSD */
/*
 * What one turn of the Old Well costs on the wire: 64 frames, 320x240, 16 bits,
 * an ILI9341 on its side, all windows' commands counted. Beside sending every
 * frame whole, and beside a rival that compares each pixel with the last frame,
 * joins what lies up to 8 bytes apart on a line, and speaks through the same
 * driver. Ours may not be more than the rival's; the glass must show the same.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "firmware/viewer/viewer.h"
#include "hal/panel/command_panel.h"
#include "ow_tree.h"
#include "sim/sim_bus.h"
#include "tests/unit/child.h"

enum {
    WIDTH = 320,
    HEIGHT = 240,
    FRAME_BYTES = WIDTH * HEIGHT * 2,
    FRAMES = 64,
    GAP_BYTES = 8,
    RECTS_MAX = HEIGHT * WIDTH / 2,
    WINDOW_BYTES = 11 /* columns, rows, write */
};

/* A panel that lends a frame, on a bus of its own. */
struct station {
    struct sim_bus bus;
    struct ow_command_panel device;
    _Alignas(4) uint16_t frame[HEIGHT][WIDTH];
    uint64_t started; /* bytes before the first frame */
};

static struct station ours;
static struct station rivals;

static uint64_t bytes_of(const struct station *station)
{
    return station->bus.command_bytes + station->bus.pixel_bytes - station->started;
}

static void open_station(struct station *station)
{
    const struct sim_bus_config bus = { .module = sim_module_by_name("ili9341") };
    struct ow_command_panel_config config;
    assert_true(sim_bus_open(&station->bus, &bus));
    ow_command_panel_defaults(&config, &ow_controller_ili9341);
    config.bus = &station->bus.bus;
    config.clock = &station->bus.clock;
    config.rotation = 1;
    config.frame = (uint8_t *)station->frame;
    config.frame_bytes = sizeof station->frame;
    assert_int_equal(ow_command_panel_open(&station->device, &config), OW_OK);
    assert_int_equal(ow_command_panel_start(&station->device), OW_OK);
    station->started = station->bus.command_bytes + station->bus.pixel_bytes;
}

/* ---- the rival ---- */

static struct ow_panel_rect rects[RECTS_MAX];

/* Runs of pixels that differ on one line, joined where the gap is small; how many. */
static uint32_t compare_line(const uint16_t *now, const uint16_t *before, uint32_t y,
                             struct ow_panel_rect *runs)
{
    uint32_t count = 0;
    for (uint32_t x = 0; x < WIDTH; x++) {
        if (now[x] == before[x]) {
            continue;
        }
        struct ow_panel_rect *last = count > 0 ? &runs[count - 1] : NULL;
        uint32_t end = last != NULL ? (uint32_t)last->x + last->width : 0;
        if (last != NULL && (x - end) * 2 <= GAP_BYTES) {
            last->width = (uint16_t)(x + 1 - last->x);
        } else {
            runs[count++] = (struct ow_panel_rect){ (uint16_t)x, (uint16_t)y, 1, 1 };
        }
    }
    return count;
}

static void rival_shows(void)
{
    static uint16_t before[HEIGHT][WIDTH];
    const struct ow_panel *panel = &rivals.device.panel;
    struct ow_panel_buffer buffer;
    uint32_t count = 0;
    assert_int_equal(panel->ops->lend(panel->device, &buffer), OW_OK);
    for (uint32_t y = 0; y < HEIGHT && buffer.age == 1; y++) {
        count += compare_line(ours.frame[y], before[y], y, rects + count);
    }
    if (buffer.age != 1) {
        rects[count++] = (struct ow_panel_rect){ 0, 0, WIDTH, HEIGHT };
    }
    memcpy(before, ours.frame, FRAME_BYTES);
    memcpy(buffer.pixels, ours.frame, FRAME_BYTES);
    assert_int_equal(panel->ops->show(panel->device, rects, count), OW_OK);
}

/* ---- the turn ---- */

/* The tree, made by the programs that this configuration built; freed by the caller. */
static uint8_t *make_tree(uint32_t *size)
{
    const char *folder = getenv("O");
    char path[CHILD_PATH];
    char model[CHILD_PATH];
    char blob[CHILD_PATH];
    char command[4 * CHILD_PATH];
    folder_make(path);
    folder_path(model, path, "well.obj");
    folder_path(blob, path, "well.owt");
    snprintf(command, sizeof command, "'%s/owgen' oldwell -o '%s' && '%s/owc' '%s' -o '%s'",
             folder != NULL ? folder : "build", model, folder != NULL ? folder : "build", model,
             blob);
    assert_int_equal(system(command), 0);
    FILE *file = fopen(blob, "rb");
    assert_non_null(file);
    enum { MOST = 1 << 22 };
    uint8_t *bytes = malloc(MOST);
    assert_non_null(bytes);
    *size = (uint32_t)fread(bytes, 1, MOST, file);
    assert_true(*size > 0 && *size < MOST && fclose(file) == 0);
    folder_remove(path);
    return bytes;
}

static void same_picture_on_both(void)
{
    for (uint32_t y = 0; y < 320; y++) {
        for (uint32_t x = 0; x < 240; x++) {
            assert_int_equal(sim_controller_glass(&ours.bus.controller, x, y),
                             sim_controller_glass(&rivals.bus.controller, x, y));
        }
    }
    assert_int_equal(ours.bus.controller.complaints, 0);
    assert_int_equal(rivals.bus.controller.complaints, 0);
}

static void run_turn(const struct ow_tree *tree, const struct ow_look *look)
{
    struct ow_viewer viewer;
    open_station(&ours);
    open_station(&rivals);
    const struct ow_viewer_config config = {
        .parts = &ow_parts_all,
        .tree = tree,
        .look = *look,
        .camera = { .projection = OW_PERSPECTIVE, .fov = UINT32_C(1) << 29 },
        .views = FRAMES,
        .end = OW_VIEWER_STOP,
        .elevation = 178956971u, /* 15 degrees */
        .find_changes = true,
        .panel = &ours.device.panel,
        .clock = &ours.bus.clock,
    };
    uint32_t bytes = ow_viewer_bytes_needed(&config);
    void *memory = malloc(bytes);
    assert_true(bytes > 0 && memory != NULL);
    assert_int_equal(ow_viewer_start(&viewer, &config, memory, bytes), OW_OK);
    while (!viewer.finished) {
        assert_true(ow_viewer_step(&viewer) >= 0);
        if (viewer.frames > 0) {
            rival_shows();
            same_picture_on_both();
        }
    }
    assert_int_equal(viewer.frames, FRAMES);
    free(memory);
}

static void close_stations(void)
{
    sim_bus_close(&ours.bus);
    sim_bus_close(&rivals.bus);
}

static void a_turn_of_the_old_well_costs_no_more_than_the_rivals(void **state)
{
    static const struct {
        const char *name;
        enum ow_shade shade;
        bool dither;
    } looks[] = { { "flat", OW_SHADE_FLAT, false }, { "flat, dithered", OW_SHADE_FLAT, true } };
    const uint64_t whole = (uint64_t)FRAMES * (WINDOW_BYTES + FRAME_BYTES);
    struct ow_tree tree;
    uint32_t size;
    (void)state;
    uint8_t *blob = make_tree(&size);
    assert_int_equal(ow_tree_open(&tree, blob, size), OW_OK);
    print_message("# bytes on the bus for %d frames of %dx%d, the first one whole\n", FRAMES, WIDTH,
                  HEIGHT);
    for (size_t i = 0; i < sizeof looks / sizeof looks[0]; i++) {
        const struct ow_look look = {
            .order = OW_FRONT_TO_BACK,
            .shade = looks[i].shade,
            .dither = looks[i].dither,
            .background = 0x20242C,
            .ambient_q8 = 77,
            .lights = { { .direction_q14 = { -6521, 9781, 11412 }, .intensity_q8 = 179 } },
            .light_count = 1,
        };
        run_turn(&tree, &look);
        print_message(
            "# %s: every frame whole %llu; the rival %llu in %u windows; ours %llu in %u\n",
            looks[i].name, (unsigned long long)whole, (unsigned long long)bytes_of(&rivals),
            rivals.device.counts.windows, (unsigned long long)bytes_of(&ours),
            ours.device.counts.windows);
        assert_true(bytes_of(&ours) <= bytes_of(&rivals));
        assert_true(bytes_of(&rivals) < whole);
        close_stations();
    }
    free(blob);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_turn_of_the_old_well_costs_no_more_than_the_rivals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
