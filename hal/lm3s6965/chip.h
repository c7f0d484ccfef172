/* SPDX-License-Identifier: 0BSD */
/*
 * The LM3S6965 behind the seams: clock and wait (SysTick, WFI), serial port
 * (bytes, log), SSI with a D/C line as command bus, buttons, watchdog, and what
 * the chip keeps an eye on: faults, the memory map, the stack. There is one of
 * each, so none but the serial port has a device struct: device is NULL.
 */
#ifndef OW_HAL_LM3S6965_CHIP_H
#define OW_HAL_LM3S6965_CHIP_H

#include "hal/bare/pl011.h"
#include "hal/board.h"
#include "hal/bus.h"
#include "hal/clock.h"
#include "hal/input.h"
#include "hal/stream.h"
#include "hal/wait.h"

enum { CHIP_HZ = 50000000, CHIP_FLASH_BYTES = 256 << 10, CHIP_RAM_BYTES = 64 << 10 };

/* Microseconds since chip_start; sleep and wait put the processor to sleep between interrupts. */
extern const struct ow_clock_ops chip_clock_ops;

/* Wakes for a received byte, a button, or the time, which it checks 100 times a second. */
extern const struct ow_wait_ops chip_wait_ops;

/* The serial port, 115200 8N1; a stream by pl011_stream_ops. */
extern struct pl011 chip_uart;

/* log: on the serial port, the device. watchdog: resets the chip. */
extern const struct ow_board_ops chip_board_ops;

/* SSI0 in mode 3 with D/C on PC7. Returns when the last bit is out; no read, no reset line. */
extern const struct ow_bus_ops chip_ssi_ops;

/* Five buttons to ground: PE0 up, PE1 down, PE2 left, PE3 right, PF1 select. */
extern const struct ow_input_ops chip_buttons_ops;

/* Clocks, ports, interrupts. Called once before the rest is used. */
void chip_start(void);

/* What the interrupts call. */
void chip_tick(void);
void chip_buttons_sample(uint64_t now_us);

bool chip_buttons_have_event(void);
uint64_t chip_now_us(void);

/* Bytes of the stack that were ever used, and how large it is. */
uint32_t chip_stack_used(void);
uint32_t chip_stack_bytes(void);

/* Where the processor starts and ends up when something is wrong. */
void chip_reset_entry(void);
_Noreturn void chip_reset(void);

#endif
