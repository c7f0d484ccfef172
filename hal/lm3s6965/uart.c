/* SPDX-License-Identifier: 0BSD */
/*
 * The serial port: received bytes through an interrupt and a ring, sent ones by
 * hand. When the ring fills up the other side is told to wait (XOFF, XON); if
 * it does not, bytes stay in the hardware's FIFO, and those beyond it are lost.
 */
#include "hal/lm3s6965/chip.h"
#include "hal/lm3s6965/registers.h"

enum {
    RING_BYTES = 512, /* a power of two: 44 ms of bytes */
    STOP_AT = RING_BYTES * 3 / 4,
    GO_AT = RING_BYTES / 4,
    XON = 0x11,
    XOFF = 0x13
};

static struct {
    uint8_t bytes[RING_BYTES];
    volatile uint32_t received; /* by the interrupt */
    volatile uint32_t taken;    /* by read */
    volatile bool lost;
    volatile bool stopped; /* the other side was told to wait */
} ring;

static void put(uint8_t byte)
{
    while (UART_FLAGS & UART_FLAG_SEND_FULL) {
    }
    UART_DATA = byte;
}

void chip_uart_receive(void)
{
    while (!(UART_FLAGS & UART_FLAG_RECEIVED_NONE)) {
        uint32_t received = ring.received;
        if (received - ring.taken == RING_BYTES) {
            UART_INTERRUPTS = 0; /* until read has made room */
            return;
        }
        uint32_t data = UART_DATA;
        ring.lost = ring.lost || (data & UART_DATA_ERRORS) != 0;
        ring.bytes[received % RING_BYTES] = (uint8_t)data;
        ring.received = received + 1;
    }
    UART_CLEAR = UART_RECEIVED;
    if (!ring.stopped && ring.received - ring.taken > STOP_AT) {
        ring.stopped = true;
        put(XOFF);
    }
}

bool chip_uart_has_bytes(void)
{
    return ring.lost || ring.received != ring.taken;
}

static int read(void *device, void *bytes, uint32_t count)
{
    (void)device;
    uint8_t *to = bytes;
    uint32_t taken = ring.taken;
    uint32_t waiting = ring.received - taken;
    if (waiting == 0 && ring.lost) { /* what came before the gap has been read */
        ring.lost = false;
        return OW_CAPACITY;
    }
    count = count < waiting ? count : waiting;
    for (uint32_t i = 0; i < count; i++) {
        to[i] = ring.bytes[(taken + i) % RING_BYTES];
    }
    ring.taken = taken + count;
    if (ring.stopped && ring.received - ring.taken < GO_AT) {
        ring.stopped = false;
        UART_INTERRUPTS = UART_RECEIVED;
        put(XON);
    }
    return count > 0 ? (int)count : OW_AGAIN;
}

static int write(void *device, const void *bytes, uint32_t count)
{
    (void)device;
    const uint8_t *from = bytes;
    uint32_t sent = 0;
    while (sent < count && !(UART_FLAGS & UART_FLAG_SEND_FULL)) {
        UART_DATA = from[sent++];
    }
    return sent > 0 ? (int)sent : OW_AGAIN;
}

void chip_uart_puts(const char *text)
{
    for (; *text != '\0'; text++) {
        put((uint8_t)*text);
    }
}

void chip_uart_hex(uint32_t value)
{
    char digits[9];
    for (uint32_t i = 0; i < 8; i++) {
        digits[i] = "0123456789abcdef"[value >> (28 - 4 * i) & 15];
    }
    digits[8] = '\0';
    chip_uart_puts(digits);
}

void chip_uart_flush(void)
{
    while (UART_FLAGS & UART_FLAG_BUSY) {
    }
}

const struct ow_stream_ops chip_uart_ops = { .read = read, .write = write };
