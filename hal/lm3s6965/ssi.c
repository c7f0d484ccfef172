/* SPDX-License-Identifier: 0BSD */
/*
 * The command bus: SSI0, 8 bits, mode 3, with D/C on PC7 (low: command). Bytes
 * go through the FIFO; every one that comes back is taken out at once, since a
 * full receive FIFO loses bytes. PD0 high keeps the card that shares the bus
 * off it; PC6 switches the display's supply on.
 */
#include "hal/lm3s6965/chip.h"
#include "hal/lm3s6965/registers.h"

enum {
    PIN_DATA = 1 << 7,   /* port C */
    PIN_SUPPLY = 1 << 6, /* port C */
    PIN_NO_CARD = 1 << 0 /* port D */
};

enum { PRESCALE = 2, RATE = 6, BUS_HZ = CHIP_HZ / (PRESCALE * (1 + RATE)) };
_Static_assert((int)BUS_HZ <= 4000000, "the fastest that the controller takes");

static void start(void)
{
    PORT_DATA(PORT_C, PIN_DATA | PIN_SUPPLY) = PIN_DATA | PIN_SUPPLY;
    PORT_OUTPUT(PORT_C) |= PIN_DATA | PIN_SUPPLY;
    PORT_DIGITAL(PORT_C) |= PIN_DATA | PIN_SUPPLY;
    PORT_DATA(PORT_D, PIN_NO_CARD) = PIN_NO_CARD;
    PORT_OUTPUT(PORT_D) |= PIN_NO_CARD;
    PORT_DIGITAL(PORT_D) |= PIN_NO_CARD;
    SSI_CR1 = 0;
    SSI_PRESCALE = PRESCALE;
    SSI_CR0 = SSI_CR0_8_BITS | SSI_CR0_MODE_3 | RATE << SSI_CR0_RATE_SHIFT;
    SSI_CR1 = SSI_CR1_ON;
}

static void send(const uint8_t *bytes, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        while (!(SSI_STATUS & SSI_STATUS_SEND_ROOM)) {
        }
        SSI_DATA = bytes[i];
        while (SSI_STATUS & SSI_STATUS_RECEIVED) {
            (void)SSI_DATA;
        }
    }
    while (SSI_STATUS & SSI_STATUS_BUSY) { /* D/C may change after the last bit only */
    }
    while (SSI_STATUS & SSI_STATUS_RECEIVED) {
        (void)SSI_DATA;
    }
}

static void select(bool data)
{
    if (!(SSI_CR1 & SSI_CR1_ON)) {
        start();
    }
    PORT_DATA(PORT_C, PIN_DATA) = data ? PIN_DATA : 0;
}

static int command(void *device, uint8_t code, const uint8_t *parameters, uint32_t count,
                   bool as_commands)
{
    (void)device;
    select(false);
    send(&code, 1);
    if (!as_commands) {
        select(true);
    }
    send(parameters, count);
    return OW_OK;
}

static int pixels(void *device, const uint8_t *bytes, uint32_t count)
{
    (void)device;
    select(true);
    send(bytes, count);
    return OW_OK;
}

static int limits(void *device, struct ow_bus_limits *limits)
{
    (void)device;
    *limits = (struct ow_bus_limits){ .max_bytes = 0, .clock_hz = BUS_HZ, .transfer_bytes = 1 };
    return OW_OK;
}

const struct ow_bus_ops chip_ssi_ops = { .command = command, .pixels = pixels, .limits = limits };
