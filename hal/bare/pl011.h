/* SPDX-License-Identifier: 0BSD */
/*
 * The serial port PL011, which many chips have: received bytes through an
 * interrupt and a ring, sent ones by hand. When the ring fills up the other
 * side is told to wait (XOFF, XON); if it does not, bytes stay in the
 * hardware's FIFO, and those beyond it are lost.
 */
#ifndef OW_HAL_BARE_PL011_H
#define OW_HAL_BARE_PL011_H

#include "hal/board.h"
#include "hal/stream.h"

enum { PL011_RING_BYTES = 512 }; /* a power of two: 44 ms of bytes at 115200 */

struct pl011 {
    uintptr_t base; /* address of its registers */
    uint8_t bytes[PL011_RING_BYTES];
    volatile uint32_t received; /* by the interrupt */
    volatile uint32_t taken;    /* by read */
    volatile bool lost;
    volatile bool stopped; /* the other side was told to wait */
};

/* device: a struct pl011. read: from the ring; write: what fits the FIFO. */
extern const struct ow_stream_ops pl011_stream_ops;

/* A log: each line goes to the port, which is waited for. device likewise. */
int pl011_log(void *device, enum ow_log_level level, const char *text);

/* 115200 8N1 from this clock, with the interrupt for received bytes. base must be set. */
void pl011_start(struct pl011 *port, uint32_t clock_hz);

/* What the interrupt calls. */
void pl011_interrupt(struct pl011 *port);

bool pl011_has_bytes(const struct pl011 *port);

/* These wait for the port. */
void pl011_puts(const struct pl011 *port, const char *text);
void pl011_hex(const struct pl011 *port, uint32_t value);
void pl011_flush(const struct pl011 *port);

#endif
