/* SPDX-License-Identifier: 0BSD */
/* A cube in front of a viewer. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "tests/property/blob_builder.h"
#include "tests/unit/sim_scene.h"

enum { CANARY = 0x5C };

uint8_t *scene_cube(uint32_t *size)
{
    static const uint32_t sides[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
                                          { 2, 6, 7, 3 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
    static const uint32_t colours[6] = {
        0xE04040, 0x40E040, 0x4040E0, 0xE0E040, 0xE040E0, 0x40E0E0
    };
    struct builder *b = builder_new(OW_TREE_IDS | OW_TREE_CLOSED);
    uint32_t root = builder_sequence(b);
    for (int i = 0; i < 8; i++) {
        (void)builder_vertex(b, i & 1 ? 20000 : -20000, i & 2 ? 20000 : -20000,
                             i & 4 ? 20000 : -20000);
    }
    for (uint32_t i = 0; i < 6; i++) {
        uint32_t colour = builder_colour(b, colours[i]);
        builder_add(b, root, OW_ITEM_FACE, builder_polygon(b, sides[i], 4, colour, i + 1));
    }
    b->step = 0.001;
    uint8_t *blob = builder_finish(b, root, size);
    free(b);
    return blob;
}

void scene_open(struct scene *scene, const struct sim_panel_config *panel)
{
    struct sim_panel_config whole = *panel;
    memset(scene, 0, sizeof *scene);
    whole.width = whole.width == 0 ? SCENE_WIDTH : whole.width;
    whole.height = whole.height == 0 ? SCENE_HEIGHT : whole.height;
    whole.format = whole.format == NULL ? &ow_format_xrgb8888 : whole.format;
    scene->blob = scene_cube(&scene->blob_bytes);
    assert_int_equal(ow_tree_open(&scene->tree, scene->blob, scene->blob_bytes), OW_OK);
    assert_true(sim_panel_open(&scene->panel, &whole));
    scene->clock = (struct ow_clock){ &sim_virtual_clock_ops, &scene->time };
    scene->config = (struct ow_viewer_config){
        .parts = &ow_parts_all,
        .tree = &scene->tree,
        .look = { .order = OW_FRONT_TO_BACK,
                  .shade = OW_SHADE_FLAT,
                  .ambient_q8 = 100,
                  .background = 0x203040,
                  .lights = { { .direction_q14 = { -6000, 9000, 12288 }, .intensity_q8 = 156 } },
                  .light_count = 1 },
        .camera = { .projection = OW_PERSPECTIVE, .fov = UINT32_C(1) << 29 },
        .views = 1,
        .elevation = UINT32_C(1) << 28,
        .panel = &scene->panel.panel,
        .clock = &scene->clock,
    };
}

int scene_start(struct scene *scene)
{
    scene->memory_bytes = ow_viewer_bytes_needed(&scene->config);
    assert_int_not_equal(scene->memory_bytes, 0);
    scene->memory = malloc(scene->memory_bytes + SCENE_CANARY);
    assert_non_null(scene->memory);
    memset(scene->memory, CANARY, scene->memory_bytes + SCENE_CANARY);
    return ow_viewer_start(&scene->viewer, &scene->config, scene->memory, scene->memory_bytes);
}

int scene_step(struct scene *scene)
{
    int status = ow_viewer_step(&scene->viewer);
    if (status == 1) {
        assert_true(scene->frames < SCENE_FRAMES);
        scene->crc[scene->frames++] = sim_panel_crc(&scene->panel, 0);
    }
    return status;
}

void scene_run(struct scene *scene)
{
    for (int i = 0; i < 10000 && !scene->viewer.finished; i++) {
        assert_true(scene_step(scene) >= 0);
    }
    assert_true(scene->viewer.finished);
    assert_null(scene->panel.wrong);
}

void scene_close(struct scene *scene)
{
    for (uint32_t i = 0; scene->memory != NULL && i < SCENE_CANARY; i++) {
        assert_int_equal(scene->memory[scene->memory_bytes + i], CANARY);
    }
    sim_panel_close(&scene->panel);
    free(scene->memory);
    free(scene->blob);
    memset(scene, 0, sizeof *scene);
}
