/* SPDX-License-Identifier: 0BSD */
/*
 * From reset to main: the vector table, memory, the MPU and the PLL; and what
 * happens on a fault: registers on the serial port, then a restart.
 */
#include "hal/lm3s6965/chip.h"
#include "hal/lm3s6965/registers.h"

/* The linker script's. */
extern uint32_t ld_stack_begin[], ld_stack_end[], ld_data_begin[], ld_data_end[], ld_data_load[];
extern uint32_t ld_bss_begin[], ld_bss_end[];

int main(void);

#define STACK_PATTERN 0xA5A5A5A5u

enum {
    PATIENCE = 100000, /* rounds to wait for the PLL */
    LOCAL_BYTES = 32   /* of the stack in use while chip_reset_entry paints it */
};

/* ---- memory protection ---- */

/* Everything that is not listed faults; the stack lies lowest in RAM, nothing is below it. */
static const struct region {
    uint32_t base;
    uint32_t attributes;
} regions[] = {
    { 0x00000000, 0x06020000 | 17 << 1 | 1 }, /* flash, 256 KB: read, execute */
    { 0x20000000, 0x13060000 | 15 << 1 | 1 }, /* RAM, 64 KB: read, write */
    { 0x40000000, 0x13050000 | 19 << 1 | 1 }, /* peripherals, 1 MB: read, write */
};

static void protect_memory(void)
{
    for (uint32_t i = 0; i < sizeof regions / sizeof regions[0]; i++) {
        MPU_REGION = i;
        MPU_BASE = regions[i].base;
        MPU_ATTRIBUTES = regions[i].attributes;
    }
    SCB_HANDLERS |= SCB_FAULTS_APART; /* so that a fault while one is being taken finds a handler */
    MPU_CONTROL = 1;
    __asm__ volatile("dsb\n isb" ::: "memory");
}

/* ---- start ---- */

/* The crystal's 8 MHz, by the PLL's 200 MHz, to 50 MHz. Without a lock the crystal alone serves. */
static void start_clock(void)
{
    uint32_t rcc = SYSCTL_RCC;
    rcc = (rcc | RCC_BYPASS) & ~RCC_USE_DIVISOR;
    SYSCTL_RCC = rcc;
    rcc = (rcc & ~(RCC_CRYSTAL_MASK | RCC_OSCILLATOR_MASK | RCC_PLL_OFF)) | RCC_CRYSTAL_8_MHZ;
    SYSCTL_RCC = rcc;
    rcc = (rcc & ~(0xFu << RCC_DIVISOR_SHIFT)) | 3u << RCC_DIVISOR_SHIFT | RCC_USE_DIVISOR;
    SYSCTL_RCC = rcc;
    for (int i = 0; i < PATIENCE; i++) {
        if (SYSCTL_RIS & RIS_PLL_LOCKED) {
            SYSCTL_RCC = rcc & ~RCC_BYPASS;
            return;
        }
    }
}

void chip_start(void)
{
    start_clock();
    SYSCTL_RCGC1 |= RCGC1_UART0 | RCGC1_SSI0;
    SYSCTL_RCGC2 |= RCGC2_PORT_A | RCGC2_PORT_C | RCGC2_PORT_D | RCGC2_PORT_E | RCGC2_PORT_F;
    (void)SYSCTL_RCGC2; /* a port answers three clocks later */

    PORT_FUNCTION(PORT_A) |= 0x3F; /* PA0, PA1: UART; PA2 .. PA5: SSI */
    PORT_DIGITAL(PORT_A) |= 0x3F;
    chip_uart.base = UART_0;
    pl011_start(&chip_uart, CHIP_HZ);

    PORT_PULL_UP(PORT_E) |= 0x0F;
    PORT_DIGITAL(PORT_E) |= 0x0F;
    PORT_PULL_UP(PORT_F) |= 0x02;
    PORT_DIGITAL(PORT_F) |= 0x02;

    SYSTICK_RELOAD = CHIP_HZ / 100 - 1;
    SYSTICK_VALUE = 0;
    SYSTICK_CONTROL = SYSTICK_ON;
    NVIC_ENABLE = 1u << IRQ_UART0;
}

/* Between two addresses of the linker script. */
static uint32_t words(const uint32_t *begin, const uint32_t *end)
{
    return (uint32_t)((uintptr_t)end - (uintptr_t)begin) / 4;
}

void chip_reset_entry(void)
{
    uint32_t free_words =
        words(ld_stack_begin, __builtin_frame_address(0)) - LOCAL_BYTES / 4; /* below this call */
    for (uint32_t i = 0; i < free_words; i++) {
        ld_stack_begin[i] = STACK_PATTERN;
    }
    for (uint32_t i = 0; i < words(ld_data_begin, ld_data_end); i++) {
        ld_data_begin[i] = ld_data_load[i];
    }
    for (uint32_t i = 0; i < words(ld_bss_begin, ld_bss_end); i++) {
        ld_bss_begin[i] = 0;
    }
    protect_memory();
    chip_start();
    (void)main();
    chip_reset();
}

uint32_t chip_stack_used(void)
{
    uint32_t all = words(ld_stack_begin, ld_stack_end);
    uint32_t unused = 0;
    while (unused < all && ld_stack_begin[unused] == STACK_PATTERN) {
        unused++;
    }
    return (all - unused) * 4;
}

uint32_t chip_stack_bytes(void)
{
    return words(ld_stack_begin, ld_stack_end) * 4;
}

void chip_reset(void)
{
    pl011_flush(&chip_uart);
    SCB_RESET = SCB_RESET_NOW;
    for (;;) {
    }
}

/* ---- faults ---- */

/* What the processor pushes. */
struct fault_frame {
    uint32_t r0_r3[4];
    uint32_t r12;
    uint32_t lr;
    uint32_t pc;
    uint32_t psr;
};

static void print(const char *name, uint32_t value)
{
    pl011_puts(&chip_uart, name);
    pl011_hex(&chip_uart, value);
}

static bool is_readable(uint32_t sp)
{
    return sp >= (uint32_t)(uintptr_t)ld_stack_begin &&
           sp <= (uint32_t)(uintptr_t)ld_stack_end - sizeof(struct fault_frame) && sp % 4 == 0;
}

_Noreturn void chip_report_fault(uint32_t sp, const uint32_t r4_r11[8]);

_Noreturn void chip_report_fault(uint32_t sp, const uint32_t r4_r11[8])
{
    static const char *const names[] = { "\r\n r0 ", " r1 ", " r2 ", " r3 " };
    pl011_puts(&chip_uart, "\r\nFAULT");
    print(" cfsr ", SCB_FAULT_STATUS);
    print(" hfsr ", SCB_HARD_FAULT_STATUS);
    print(" mmfar ", SCB_FAULT_ADDRESS);
    print(" bfar ", SCB_BUS_FAULT_ADDRESS);
    print(" sp ", sp);
    if (is_readable(sp)) {
        const struct fault_frame *frame = (const struct fault_frame *)(uintptr_t)sp;
        for (uint32_t i = 0; i < 4; i++) {
            print(names[i], frame->r0_r3[i]);
        }
        print(" r12 ", frame->r12);
        print(" lr ", frame->lr);
        print(" pc ", frame->pc);
        print(" psr ", frame->psr);
    } else {
        pl011_puts(&chip_uart, "\r\n the stack has overflowed");
    }
    pl011_puts(&chip_uart, "\r\n r4-r11");
    for (uint32_t i = 0; i < 8; i++) {
        print(" ", r4_r11[i]);
    }
    pl011_puts(&chip_uart, "\r\nrestart\r\n");
    chip_reset();
}

/* The stack may be what is wrong: without 256 bytes left of it, begins it anew. Never returns. */
__attribute__((naked)) static void fault_entry(void)
{
    __asm__ volatile("mov r0, sp\n"
                     "ldr r1, =ld_stack_begin + 256\n"
                     "cmp r0, r1\n"
                     "itt lo\n"
                     "ldrlo r1, =ld_stack_end\n"
                     "movlo sp, r1\n"
                     "push {r4-r11}\n"
                     "mov r1, sp\n"
                     "b chip_report_fault\n");
}

static void uart_entry(void)
{
    pl011_interrupt(&chip_uart);
}

static void surprise(void)
{
    pl011_puts(&chip_uart, "\r\nan interrupt that nobody expects\r\n");
    chip_reset();
}

/* The watchdog's first end of time; the chip resets at the second. */
static void watchdog_entry(void)
{
    pl011_puts(&chip_uart, "\r\nthe watchdog was not fed\r\nrestart\r\n");
    chip_reset();
}

union vector {
    void (*handler)(void);
    uint32_t *stack;
};

#define NOBODY              \
    {                       \
        .handler = surprise \
    }
#define FIVE_NOBODIES NOBODY, NOBODY, NOBODY, NOBODY, NOBODY
#define FAULT                  \
    {                          \
        .handler = fault_entry \
    }

__attribute__((section(".vectors"), used)) static const union vector vectors[16 + IRQ_COUNT] = {
    { .stack = ld_stack_end },
    { .handler = chip_reset_entry },
    NOBODY /* NMI */,
    FAULT,
    FAULT,
    FAULT,
    FAULT,
    NOBODY,
    NOBODY,
    NOBODY,
    NOBODY,
    NOBODY,
    NOBODY,
    NOBODY,
    NOBODY,
    { .handler = chip_tick },
    FIVE_NOBODIES,
    [16 + IRQ_UART0] = { .handler = uart_entry },
    FIVE_NOBODIES,
    FIVE_NOBODIES,
    NOBODY,
    NOBODY,
    [16 + IRQ_WATCHDOG] = { .handler = watchdog_entry },
    FIVE_NOBODIES,
    FIVE_NOBODIES,
    FIVE_NOBODIES,
    FIVE_NOBODIES,
    FIVE_NOBODIES,
};
