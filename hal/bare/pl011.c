/* SPDX-License-Identifier: 0BSD */
/* The PL011's registers, its ring and its log. */
#include "hal/bare/pl011.h"

enum {
    DATA = 0x00,
    FLAGS = 0x18,
    DIVISOR = 0x24,
    FRACTION = 0x28,
    LINE = 0x2C,
    CONTROL = 0x30,
    INTERRUPTS = 0x38,
    CLEAR = 0x44
};
enum {
    FLAG_BUSY = 1 << 3,
    FLAG_RECEIVED_NONE = 1 << 4,
    FLAG_SEND_FULL = 1 << 5,
    LINE_8N1_FIFO = 0x70,
    CONTROL_ON = 0x301,
    RECEIVED = 1 << 4 | 1 << 6, /* the FIFO is half full, or bytes wait in it */
    DATA_ERRORS = 0xF00         /* framing, parity, break, overrun */
};
enum {
    RATE = 115200,
    STOP_AT = PL011_RING_BYTES * 3 / 4,
    GO_AT = PL011_RING_BYTES / 4,
    XON = 0x11,
    XOFF = 0x13
};

static volatile uint32_t *reg(const struct pl011 *port, uint32_t at)
{
    return (volatile uint32_t *)(port->base + at);
}

void pl011_start(struct pl011 *port, uint32_t clock_hz)
{
    *reg(port, CONTROL) = 0;
    *reg(port, DIVISOR) = clock_hz / (16 * RATE);
    *reg(port, FRACTION) = (clock_hz % (16 * RATE) * 64 + 8 * RATE) / (16 * RATE);
    *reg(port, LINE) = LINE_8N1_FIFO;
    *reg(port, INTERRUPTS) = RECEIVED;
    *reg(port, CONTROL) = CONTROL_ON;
}

static void put(const struct pl011 *port, uint8_t byte)
{
    while (*reg(port, FLAGS) & FLAG_SEND_FULL) {
    }
    *reg(port, DATA) = byte;
}

static void stop(struct pl011 *port)
{
    if (!port->stopped) {
        port->stopped = true;
        put(port, XOFF);
    }
}

void pl011_interrupt(struct pl011 *port)
{
    while (!(*reg(port, FLAGS) & FLAG_RECEIVED_NONE)) {
        uint32_t received = port->received;
        if (received - port->taken == PL011_RING_BYTES) {
            stop(port);
            *reg(port, INTERRUPTS) = 0; /* until read has made room */
            return;
        }
        uint32_t data = *reg(port, DATA);
        port->lost = port->lost || (data & DATA_ERRORS) != 0;
        port->bytes[received % PL011_RING_BYTES] = (uint8_t)data;
        port->received = received + 1;
    }
    *reg(port, CLEAR) = RECEIVED;
    if (port->received - port->taken > STOP_AT) {
        stop(port);
    }
}

bool pl011_has_bytes(const struct pl011 *port)
{
    return port->lost || port->received != port->taken;
}

static int read(void *device, void *bytes, uint32_t count)
{
    struct pl011 *port = device;
    uint8_t *to = bytes;
    uint32_t taken = port->taken;
    uint32_t waiting = port->received - taken;
    if (waiting == 0 && port->lost) { /* what came before the gap has been read */
        port->lost = false;
        return OW_CAPACITY;
    }
    count = count < waiting ? count : waiting;
    for (uint32_t i = 0; i < count; i++) {
        to[i] = port->bytes[(taken + i) % PL011_RING_BYTES];
    }
    port->taken = taken + count;
    if (port->stopped && port->received - port->taken < GO_AT) {
        port->stopped = false;
        *reg(port, INTERRUPTS) = RECEIVED;
        put(port, XON);
    }
    return count > 0 ? (int)count : OW_AGAIN;
}

static int write(void *device, const void *bytes, uint32_t count)
{
    const struct pl011 *port = device;
    const uint8_t *from = bytes;
    uint32_t sent = 0;
    while (sent < count && !(*reg(port, FLAGS) & FLAG_SEND_FULL)) {
        *reg(port, DATA) = from[sent++];
    }
    return sent > 0 ? (int)sent : OW_AGAIN;
}

void pl011_puts(const struct pl011 *port, const char *text)
{
    for (; *text != '\0'; text++) {
        put(port, (uint8_t)*text);
    }
}

void pl011_hex(const struct pl011 *port, uint32_t value)
{
    for (uint32_t i = 0; i < 8; i++) {
        put(port, (uint8_t) "0123456789abcdef"[value >> (28 - 4 * i) & 15]);
    }
}

void pl011_flush(const struct pl011 *port)
{
    while (*reg(port, FLAGS) & FLAG_BUSY) {
    }
}

int pl011_log(void *device, enum ow_log_level level, const char *text)
{
    static const char *const levels[] = { "error: ", "warning: ", "" };
    const struct pl011 *port = device;
    pl011_puts(port, levels[level]);
    pl011_puts(port, text);
    pl011_puts(port, "\r\n");
    return OW_OK;
}

const struct ow_stream_ops pl011_stream_ops = { .read = read, .write = write };
