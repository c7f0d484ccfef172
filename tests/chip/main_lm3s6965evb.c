/* SPDX-License-Identifier: 0BSD */
/*
 * The scenes on the Cortex-M3, and the faults that a board must survive. The
 * command line, by semihosting, says which: nothing for the scenes, or fault,
 * stack, flash, hang. The watchdog is the counter: in QEMU with -icount shift=3
 * an instruction takes 8 ns, a count at 50 MHz 20 ns.
 */
#include "hal/lm3s6965/chip.h"
#include "hal/lm3s6965/registers.h"
#include "tests/chip/scenes.h"

enum { MEMORY_BYTES = 48 << 10, LINE_BYTES = 128, NS_AN_INSTRUCTION = 8, NS_A_COUNT = 20 };

extern const uint8_t flat_tree[];
extern const uint8_t flat_tree_end[];
extern const uint8_t smooth_tree[];
extern const uint8_t smooth_tree_end[];

static uint8_t memory[MEMORY_BYTES] __attribute__((aligned(8)));

uint32_t scene_units(void)
{
    return ~WATCHDOG_VALUE;
}

static int semihosting(int operation, void *argument)
{
    register int r0 __asm__("r0") = operation;
    register void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

static _Noreturn void leave(uint32_t status)
{
    uint32_t block[2] = { 0x20026, status }; /* the application ends */
    pl011_flush(&chip_uart);
    semihosting(0x20, block);
    chip_reset();
}

static void draw_scenes(void)
{
    static struct ow_tree trees[2];
    uint32_t failed = 0;
    int status =
        ow_tree_open(&trees[0], flat_tree, (uint32_t)(flat_tree_end - flat_tree) / OW_STRIDE);
    if (status == OW_OK) {
        status = ow_tree_open(&trees[1], smooth_tree,
                              (uint32_t)(smooth_tree_end - smooth_tree) / OW_STRIDE);
    }
    if (status < 0) {
        pl011_puts(&chip_uart, ow_status_text(status));
        leave(1);
    }
    __asm__ volatile("cpsid i"); /* the counter counts the drawing alone */
    SYSCTL_RCGC0 |= RCGC0_WATCHDOG;
    (void)SYSCTL_RCGC0;
    WATCHDOG_LOCK = WATCHDOG_UNLOCK;
    WATCHDOG_LOAD = UINT32_MAX;
    WATCHDOG_CONTROL = WATCHDOG_COUNTS;
    for (uint32_t i = 0; i < scene_count; i++) {
        struct scene_result result;
        char line[LINE_BYTES];
        bool smooth = scenes[i].shade == OW_SHADE_GOURAUD || scenes[i].shade == OW_SHADE_PHONG;
        scene_draw(&scenes[i], &trees[smooth], memory, sizeof memory, &result);
        result.units = result.units * NS_A_COUNT / NS_AN_INSTRUCTION;
        scene_line(line, &scenes[i], &result);
        pl011_puts(&chip_uart, line);
        pl011_puts(&chip_uart, "\r\n");
        failed |= result.status < 0;
    }
    leave(failed);
}

/* Not inlined, not turned into a loop. */
__attribute__((noinline)) static uint32_t use_stack(uint32_t depth)
{
    volatile uint32_t some[32];
    some[depth % 32] = depth;
    return depth == 0 ? 0 : use_stack(depth - 1) + some[depth % 32];
}

static bool is(const char *word, const char *other)
{
    while (*word != '\0' && *word == *other) {
        word++;
        other++;
    }
    return *word == *other;
}

int main(void)
{
    char line[LINE_BYTES] = "";
    uint32_t block[2] = { (uint32_t)(uintptr_t)line, sizeof line };
    semihosting(0x15, block); /* get the command line */
    const char *word = line;
    for (const char *p = line; *p != '\0'; p++) {
        word = *p == ' ' ? p + 1 : word;
    }
    pl011_puts(&chip_uart, "Oldwell's scenes on lm3s6965evb\r\n");
    volatile uint32_t nowhere = 0x60000000; /* there is no memory */
    volatile uint32_t code = 0x100;         /* may not be written */
    if (is(word, "fault")) {
        (void)REG(nowhere);
    } else if (is(word, "stack")) {
        pl011_hex(&chip_uart, use_stack(1000));
    } else if (is(word, "flash")) {
        REG(code) = 0;
    } else if (is(word, "execute")) {
        ((void (*)(void))((uintptr_t)memory | 1))(); /* nor may data be run */
    } else if (is(word, "hang")) {
        (void)chip_board_ops.watchdog(NULL, 100000);
        for (;;) {
        }
    } else {
        draw_scenes();
    }
    pl011_puts(&chip_uart, "still here\r\n");
    leave(1);
}
