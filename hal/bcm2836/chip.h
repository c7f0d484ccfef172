/* SPDX-License-Identifier: 0BSD */
/*
 * The BCM2836 behind the seams, without an operating system: frame buffer by
 * the firmware's mailbox, system timer, serial port (UART0), four cores as
 * workers. There is one of each but the frame buffer's struct.
 */
#ifndef OW_HAL_BCM2836_CHIP_H
#define OW_HAL_BCM2836_CHIP_H

#include "hal/bare/pl011.h"
#include "hal/board.h"
#include "hal/clock.h"
#include "hal/panel.h"
#include "hal/wait.h"
#include "hal/workers.h"

enum { CHIP_CORES = 4, CHIP_UART_HZ = 48000000 };

/* Microseconds since power on, by the system timer. Nothing sleeps: the timer is asked. */
extern const struct ow_clock_ops chip_clock_ops;
extern const struct ow_wait_ops chip_wait_ops; /* wakes for a received byte or the time */

/* The serial port, 115200 8N1; a stream by pl011_stream_ops. */
extern struct pl011 chip_uart;

extern const struct ow_board_ops chip_board_ops; /* log: on the serial port, the device */

/* The job on all four cores. */
extern const struct ow_workers_ops chip_workers_ops;

/* Caches, interrupts, serial port; wakes the other cores, which wait for work. */
void chip_start(void);

_Noreturn void chip_reset(void);

uint32_t chip_stack_used(void);
uint32_t chip_stack_bytes(void);

/* ---- the frame buffer ---- */

struct chip_frame_buffer {
    uint16_t width; /* pixels; the board sets these before it opens it */
    uint16_t height;
    const struct ow_pixel_format *format; /* of 16 or 32 bits, red highest */
    uint16_t pages;                       /* 1, or 2: drawn and shown by turns */
    uint32_t keep;                        /* bits of a pixel that nobody may write */

    uint8_t *pixels; /* of the first page */
    uint32_t stride; /* bytes from a line to the next */
    uint32_t page;   /* the one to be drawn next */
    uint32_t shown;  /* frames so far */
};

/* Asks the firmware for it; alpha is to be ignored. OW_UNSUPPORTED: it gives another one. */
int chip_frame_buffer_open(struct chip_frame_buffer *device);

/* It lends its pages. */
extern const struct ow_panel_ops chip_frame_buffer_ops;

/* ---- between entry.S and the rest ---- */

_Noreturn void chip_main(void);
_Noreturn void chip_other_main(uint32_t core);
_Noreturn void chip_work(uint32_t core);
void chip_irq(void);
_Noreturn void chip_fault(uint32_t kind, uint32_t pc, uint32_t psr);

#endif
