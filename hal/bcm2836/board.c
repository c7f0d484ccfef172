/* SPDX-License-Identifier: 0BSD */
/* Serial port, time, and the cores as workers. */
#include "hal/bcm2836/chip.h"
#include "hal/bcm2836/registers.h"

struct pl011 chip_uart;

/* ---- time ---- */

static uint64_t now_us(void)
{
    for (;;) {
        uint32_t high = TIMER_HIGH;
        uint32_t low = TIMER_LOW;
        if (TIMER_HIGH == high) {
            return (uint64_t)high << 32 | low;
        }
    }
}

static int now(void *device, uint64_t *time_us)
{
    (void)device;
    *time_us = now_us();
    return OW_OK;
}

enum { NAP_US = 10000 }; /* the longest: an alarm that was set too late does not matter then */

static void nap_until(uint64_t until_us)
{
    uint64_t here_us = now_us();
    uint64_t left_us = until_us > here_us ? until_us - here_us : 0;
    TIMER_ALARM_1 = (uint32_t)here_us + (left_us < NAP_US ? (uint32_t)left_us : NAP_US);
    if (left_us > 50) {
        __asm__ volatile("dsb\n wfi" ::: "memory");
    }
}

static int sleep_until(void *device, uint64_t until_us)
{
    (void)device;
    while (now_us() < until_us) {
        nap_until(until_us);
    }
    return OW_OK;
}

static int wait(void *device, uint64_t until_us)
{
    (void)device;
    for (;;) {
        bool ready = pl011_has_bytes(&chip_uart);
        if (ready || now_us() >= until_us) {
            return ready;
        }
        nap_until(until_us);
    }
}

const struct ow_clock_ops chip_clock_ops = { .now = now, .sleep = sleep_until };
const struct ow_wait_ops chip_wait_ops = { .wait = wait };
const struct ow_board_ops chip_board_ops = { .log = pl011_log };

/* ---- workers ---- */

/* A job is given out by its number; a core that has done it says so with the same number. */
static struct {
    void (*job)(void *context, uint32_t worker);
    void *context;
    volatile uint32_t number;
    volatile uint32_t done[CHIP_CORES];
} work;

static void barrier(void)
{
    __asm__ volatile("dmb" ::: "memory");
}

void chip_work(uint32_t core)
{
    uint32_t number = 0;
    CORE_MAILBOX_IRQS(core) = 1u << BOX_WORK; /* wakes from WFI although interrupts are off */
    for (;;) {
        while (work.number == number) {
            __asm__ volatile("dsb\n wfi" ::: "memory");
            CORE_MAILBOX_CLEAR(core, BOX_WORK) = UINT32_MAX;
        }
        barrier();
        number = work.number;
        work.job(work.context, core);
        barrier();
        work.done[core] = number;
    }
}

static int run(void *device, void (*job)(void *context, uint32_t worker), void *context)
{
    (void)device;
    work.job = job;
    work.context = context;
    barrier();
    uint32_t number = ++work.number;
    __asm__ volatile("dsb" ::: "memory");
    for (uint32_t core = 1; core < CHIP_CORES; core++) {
        CORE_MAILBOX_SET(core, BOX_WORK) = 1;
    }
    job(context, 0);
    for (uint32_t core = 1; core < CHIP_CORES; core++) {
        while (work.done[core] != number) {
        }
    }
    barrier();
    return OW_OK;
}

const struct ow_workers_ops chip_workers_ops = { .run = run };
