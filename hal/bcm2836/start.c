/* SPDX-License-Identifier: 0BSD */
/*
 * Start-up in C: the memory map, caches, interrupts, the other cores; and
 * faults: registers on the serial port, then a restart.
 */
#include "hal/bcm2836/cache.h"
#include "hal/bcm2836/chip.h"
#include "hal/bcm2836/registers.h"

extern uint32_t ld_stacks_begin[], ld_stacks_end[];

void chip_entry(void);
int main(void);

#define GO 0x600D600Du
#define STACK_PATTERN 0xA5A5A5A5u

enum {
    SECTIONS = 4096, /* of 1 MB */
    SECTION_SHIFT = 20,
    PERIPHERAL_SECTION = 0x3F0,
    CORE_SECTION = 0x400,
    MODE_STACK_BYTES = 1024 /* of each core's stack, for interrupts and faults */
};

/* Section entries: all may read and write; normal memory written back, or past the caches, or
 * devices, whose memory nobody runs. */
enum { NORMAL = 0x11C0E, UNCACHED = 0x11C12, DEVICE = 0x10C16 };

volatile uint32_t chip_others_go; /* entry.S waits for it */
static uint32_t sections[SECTIONS] __attribute__((aligned(16384)));

static void make_map(void)
{
    for (uint32_t i = 0; i < SECTIONS; i++) {
        uint32_t kind = i < PERIPHERAL_SECTION ? NORMAL : i <= CORE_SECTION ? DEVICE : 0;
        sections[i] = kind == 0 ? 0 : i << SECTION_SHIFT | kind;
    }
}

void cache_leave_out(uintptr_t first, uint32_t bytes)
{
    for (uint32_t i = first >> SECTION_SHIFT; i <= (first + bytes - 1) >> SECTION_SHIFT; i++) {
        sections[i] = i << SECTION_SHIFT | UNCACHED;
    }
    cache_clean(sections, sizeof sections);
    __asm__ volatile("mcr p15, 0, %0, c8, c3, 0\n dsb\n isb" ::"r"(0) : "memory"); /* all TLBs */
}

/* Throws away what the data cache holds from before the start: sets and ways of level 1. */
static void forget_cache(void)
{
    uint32_t size;
    __asm__ volatile("mcr p15, 2, %1, c0, c0, 0\n isb\n mrc p15, 1, %0, c0, c0, 0"
                     : "=r"(size)
                     : "r"(0));
    uint32_t line_shift = (size & 7) + 4;
    uint32_t ways = (size >> 3 & 0x3FF) + 1;
    uint32_t sets = (size >> 13 & 0x7FFF) + 1;
    uint32_t way_shift = ways > 1 ? (uint32_t)__builtin_clz(ways - 1) : 0;
    for (uint32_t way = 0; way < ways; way++) {
        for (uint32_t set = 0; set < sets; set++) {
            uint32_t entry = (ways > 1 ? way << way_shift : 0) | set << line_shift;
            __asm__ volatile("mcr p15, 0, %0, c7, c6, 2" ::"r"(entry) : "memory");
        }
    }
    __asm__ volatile("dsb" ::: "memory");
}

/* This core's caches, and its part in the others'. */
static void start_caches(void)
{
    uint32_t value;
    forget_cache();
    __asm__ volatile("mrc p15, 0, %0, c1, c0, 1" : "=r"(value));
    value |= 1u << 6; /* coherent with the other cores */
    __asm__ volatile("mcr p15, 0, %0, c1, c0, 1\n isb" ::"r"(value));
    __asm__ volatile("mcr p15, 0, %0, c8, c7, 0\n"             /* TLB */
                     "mcr p15, 0, %0, c7, c5, 0\n"             /* instruction cache */
                     "mcr p15, 0, %0, c7, c5, 6\n dsb\n isb\n" /* branch predictor */
                     ::"r"(0)
                     : "memory");
    __asm__ volatile("mcr p15, 0, %0, c2, c0, 2\n" ::"r"(0));                          /* TTBCR */
    __asm__ volatile("mcr p15, 0, %0, c2, c0, 0\n" ::"r"((uintptr_t)sections | 0x4A)); /* TTBR0 */
    __asm__ volatile("mcr p15, 0, %0, c3, c0, 0\n" ::"r"(1)); /* domain 0 */
    __asm__ volatile("dsb\n isb" ::: "memory");
    __asm__ volatile("mrc p15, 0, %0, c1, c0, 0" : "=r"(value));
    value = (value & ~(1u << 1)) | 1u << 0 | 1u << 2 | 1u << 11 | 1u << 12; /* unaligned is right */
    __asm__ volatile("mcr p15, 0, %0, c1, c0, 0\n dsb\n isb" ::"r"(value) : "memory");
}

static void call_others(void)
{
    chip_others_go = GO;
    __asm__ volatile("dsb\n sev" ::: "memory");
    for (uint32_t core = 1; core < CHIP_CORES; core++) {
        CORE_MAILBOX_SET(core, BOX_START) = (uint32_t)(uintptr_t)chip_entry;
    }
    __asm__ volatile("dsb\n sev" ::: "memory");
}

void chip_start(void)
{
    PINS_10_19 = (PINS_10_19 & ~PINS_UART_MASK) | PINS_UART;
    chip_uart.base = UART_0;
    pl011_start(&chip_uart, CHIP_UART_HZ);
    IRQ_ENABLE_1 = IRQ_1_TIMER_1;
    IRQ_ENABLE_2 = IRQ_2_UART;
    __asm__ volatile("cpsie i" ::: "memory");
}

void chip_main(void)
{
    make_map();
    call_others(); /* while memory is not cached yet: they do not cache either */
    start_caches();
    chip_start();
    (void)main();
    chip_reset();
}

void chip_other_main(uint32_t core)
{
    start_caches();
    chip_work(core);
}

void chip_irq(void)
{
    if (TIMER_STATUS & TIMER_BIT_1) {
        TIMER_STATUS = TIMER_BIT_1;
    }
    pl011_interrupt(&chip_uart);
}

void chip_reset(void)
{
    pl011_flush(&chip_uart);
    POWER_TIME = POWER_PASSWORD | 10;
    POWER_RESET = POWER_PASSWORD | (POWER_RESET & ~POWER_RESET_MASK) | POWER_RESET_FULL;
    for (;;) {
    }
}

static void print(const char *name, uint32_t value)
{
    pl011_puts(&chip_uart, name);
    pl011_hex(&chip_uart, value);
}

void chip_fault(uint32_t kind, uint32_t pc, uint32_t psr)
{
    static const char *const kinds[] = { "undefined instruction", "call", "fetch", "data" };
    uint32_t status;
    uint32_t address;
    uint32_t core;
    __asm__ volatile("mrc p15, 0, %0, c5, c0, 0" : "=r"(status));
    __asm__ volatile("mrc p15, 0, %0, c6, c0, 0" : "=r"(address));
    __asm__ volatile("mrc p15, 0, %0, c0, c0, 5" : "=r"(core));
    pl011_puts(&chip_uart, "\r\nFAULT ");
    pl011_puts(&chip_uart, kinds[kind & 3]);
    print(" core ", core & 3);
    print(" pc ", pc);
    print(" psr ", psr);
    print(" dfsr ", status);
    print(" dfar ", address);
    pl011_puts(&chip_uart, "\r\nrestart\r\n");
    chip_reset();
}

/* Between two addresses of the linker script. */
static uint32_t words(const uint32_t *begin, const uint32_t *end)
{
    return (uint32_t)((uintptr_t)end - (uintptr_t)begin) / 4;
}

/* Of the first core: its stack lies highest. */
uint32_t chip_stack_used(void)
{
    uint32_t all = words(ld_stacks_begin, ld_stacks_end);
    uint32_t end = all - MODE_STACK_BYTES / 4;
    uint32_t at = all - chip_stack_bytes() / 4;
    while (at < end && ld_stacks_begin[at] == STACK_PATTERN) {
        at++;
    }
    return (end - at) * 4;
}

uint32_t chip_stack_bytes(void)
{
    return words(ld_stacks_begin, ld_stacks_end) / CHIP_CORES * 4;
}
