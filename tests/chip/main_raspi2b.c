/* SPDX-License-Identifier: 0BSD */
/* The scenes on the Cortex-A7, on one core. */
#include "hal/bcm2836/chip.h"
#include "tests/chip/scenes.h"

enum { MEMORY_BYTES = 4 << 20, LINE_BYTES = 128 };

extern const uint8_t flat_tree[];
extern const uint8_t flat_tree_end[];
extern const uint8_t smooth_tree[];
extern const uint8_t smooth_tree_end[];

static uint8_t memory[MEMORY_BYTES] __attribute__((aligned(8)));

uint32_t scene_units(void)
{
    return 0;
}

int main(void)
{
    static struct ow_tree trees[2];
    (void)ow_tree_open(&trees[0], flat_tree, (uint32_t)(flat_tree_end - flat_tree));
    (void)ow_tree_open(&trees[1], smooth_tree, (uint32_t)(smooth_tree_end - smooth_tree));
    for (uint32_t i = 0; i < scene_count; i++) {
        struct scene_result result = { .status = OW_TRUNCATED };
        char line[LINE_BYTES];
        bool smooth = scenes[i].shade == OW_SHADE_GOURAUD || scenes[i].shade == OW_SHADE_PHONG;
        if (trees[smooth].blob_bytes > 0) {
            scene_draw(&scenes[i], &trees[smooth], memory, sizeof memory, &result);
        }
        scene_line(line, &scenes[i], &result);
        pl011_puts(&chip_uart, line);
        pl011_puts(&chip_uart, "\r\n");
    }
    pl011_puts(&chip_uart, "end\r\n");
    for (;;) {
        __asm__ volatile("wfi");
    }
}
