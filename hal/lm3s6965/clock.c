/* SPDX-License-Identifier: 0BSD */
/* Time by SysTick, 100 interrupts a second, with the counter's value in between; and sleep. */
#include "hal/lm3s6965/chip.h"
#include "hal/lm3s6965/registers.h"

enum { TICK_US = 10000, CLOCKS_A_US = CHIP_HZ / 1000000 };

static volatile uint64_t ticks_us;

void chip_tick(void)
{
    ticks_us += TICK_US;
    chip_buttons_sample(ticks_us);
}

/* With interrupts off, so that the two parts belong together; a tick that waits is counted. */
uint64_t chip_now_us(void)
{
    uint32_t masked;
    __asm__ volatile("mrs %0, primask\n cpsid i" : "=r"(masked)::"memory");
    uint32_t left = SYSTICK_VALUE;
    uint64_t now_us = ticks_us;
    if (SCB_ICSR & ICSR_SYSTICK_PENDING) {
        left = SYSTICK_VALUE;
        now_us += TICK_US;
    }
    __asm__ volatile("msr primask, %0" ::"r"(masked) : "memory");
    return now_us + TICK_US - 1 - left / CLOCKS_A_US;
}

static int now(void *device, uint64_t *time_us)
{
    (void)device;
    *time_us = chip_now_us();
    return OW_OK;
}

static int sleep_until(void *device, uint64_t until_us)
{
    (void)device;
    while (chip_now_us() < until_us) {
        __asm__ volatile("wfi");
    }
    return OW_OK;
}

/* A byte that comes between the question and WFI is seen a tick later. */
static int wait(void *device, uint64_t until_us)
{
    (void)device;
    for (;;) {
        int ready = pl011_has_bytes(&chip_uart) + chip_buttons_have_event();
        if (ready > 0 || chip_now_us() >= until_us) {
            return ready;
        }
        __asm__ volatile("wfi");
    }
}

const struct ow_clock_ops chip_clock_ops = { .now = now, .sleep = sleep_until };
const struct ow_wait_ops chip_wait_ops = { .wait = wait };
