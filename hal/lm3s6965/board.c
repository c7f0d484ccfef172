/* SPDX-License-Identifier: 0BSD */
/* The board: the log on the serial port, and the watchdog. */
#include "hal/lm3s6965/chip.h"
#include "hal/lm3s6965/registers.h"

static int print_line(void *device, enum ow_log_level level, const char *text)
{
    static const char *const levels[] = { "error: ", "warning: ", "" };
    (void)device;
    chip_uart_puts(levels[level]);
    chip_uart_puts(text);
    chip_uart_puts("\r\n");
    return OW_OK;
}

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

const struct ow_board_ops chip_board_ops = { .log = print_line, .watchdog = feed_watchdog };
