/* SPDX-License-Identifier: 0BSD */
/* The board's own: the serial port, which takes the log, and the watchdog. */
#include "hal/lm3s6965/chip.h"
#include "hal/lm3s6965/registers.h"

struct pl011 chip_uart;

/* Counts down twice: the first end interrupts, the second resets. */
static int feed_watchdog(void *device, uint32_t limit_us)
{
    (void)device;
    if (limit_us == 0) {
        return OW_UNSUPPORTED;
    }
    uint64_t clocks = (uint64_t)limit_us * (CHIP_HZ / 1000000);
    SYSCTL_RCGC0 |= RCGC0_WATCHDOG;
    (void)SYSCTL_RCGC0;
    WATCHDOG_LOCK = WATCHDOG_UNLOCK;
    WATCHDOG_LOAD = clocks > UINT32_MAX ? UINT32_MAX : (uint32_t)clocks;
    WATCHDOG_CONTROL = WATCHDOG_COUNTS | WATCHDOG_RESETS;
    WATCHDOG_LOCK = 0;
    NVIC_ENABLE = 1u << IRQ_WATCHDOG;
    return OW_OK;
}

const struct ow_board_ops chip_board_ops = { .log = pl011_log, .watchdog = feed_watchdog };
