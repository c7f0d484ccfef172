/* SPDX-License-Identifier: 0BSD */
/*
 * The least that a viewer links, for `make size`: it opens a tree and draws it,
 * flat and Gouraud, front to back and back to front, in perspective, in 16
 * greys. Linked, not run.
 */
#include "ow_draw.h"
#include "ow_shade.h"
#include "ow_surface.h"

enum { WIDTH = 128, HEIGHT = 64, MEMORY_BYTES = 20 << 10 };

void chip_reset_entry(void);

extern const uint8_t board_tree[];
extern const uint32_t board_tree_bytes;

static uint8_t memory[MEMORY_BYTES] __attribute__((aligned(8)));
static uint8_t pixels[WIDTH * HEIGHT / 2] __attribute__((aligned(4)));

static const struct ow_parts parts = {
    .painter = &ow_surface_painter,
    .dynamic = &ow_surface_dynamic,
    .shading = { [OW_SHADE_FLAT] = &ow_shading_flat, [OW_SHADE_GOURAUD] = &ow_shading_gouraud },
};

static volatile uint32_t way; /* what the compiler may not foresee */

void chip_reset_entry(void)
{
    struct ow_workspace_config config = { .parts = &parts, .width = WIDTH, .lines = HEIGHT };
    struct ow_camera camera = { .fov = 1u << 29, .width_pixels = WIDTH, .height_pixels = HEIGHT };
    struct ow_look look = {
        .order = way & 1 ? OW_FRONT_TO_BACK : OW_BACK_TO_FRONT,
        .shade = way & 2 ? OW_SHADE_FLAT : OW_SHADE_GOURAUD,
        .lights = { { .direction_q14 = { -6521, 9782, 11412 }, .intensity_q8 = 179 } },
        .light_count = 1,
    };
    struct ow_target target = { pixels, WIDTH / 2, 0, HEIGHT, &ow_format_gray4, NULL };
    struct ow_tree tree;
    struct ow_view view;
    struct ow_workspace workspace;
    if (ow_tree_open(&tree, board_tree, board_tree_bytes) == OW_OK &&
        ow_workspace_place(&workspace, &tree, &config, memory, sizeof memory) == OW_OK) {
        for (;;) {
            ow_camera_orbit(&camera, &tree, way << 24, 1u << 28);
            if (ow_view_make(&view, &camera) == OW_OK) {
                (void)ow_draw(&tree, &view, &look, &target, &workspace, NULL);
            }
        }
    }
}
