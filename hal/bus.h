/* SPDX-License-Identifier: 0BSD */
/*
 * The command bus below panels that are driven by commands: 4-wire SPI with a
 * D/C line, I2C with a control byte, 8080. A panel driver speaks to it and
 * knows nothing of chips and pins.
 *
 * Every function returns OW_OK, or OW_BUS (a transfer failed), OW_TIMEOUT,
 * OW_GONE, OW_DENIED or OW_BUSY. A transfer that fails leaves the controller in
 * an unknown state: reset it or send the window anew.
 */
#ifndef OW_HAL_BUS_H
#define OW_HAL_BUS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "ow_status.h"

struct ow_bus_limits {
    uint32_t max_bytes;      /* of one pixels call; the driver above cuts. 0: no limit */
    uint32_t clock_hz;       /* the rate really set; 0: unknown */
    uint32_t transfer_bytes; /* what a transfer costs beside its bytes, as bytes on the wire */
};

struct ow_bus_ops {
    /*
     * Sends a command code and count parameters (0 .. 255; parameters may be
     * NULL with 0), in one transaction. as_commands: the parameters go with D/C
     * as the code's, as SSD1306-like controllers want. Called when no pixels are
     * under way; returns when all is sent. Mandatory.
     */
    int (*command)(void *device, uint8_t code, const uint8_t *parameters, uint32_t count,
                   bool as_commands);

    /*
     * Sends count bytes of pixel data (1 .. max_bytes), continuing the command
     * sent last. They belong to the bus until done. Mandatory.
     */
    int (*pixels)(void *device, const uint8_t *bytes, uint32_t count);

    /*
     * OW_OK: at most `pending` pixels calls still use their bytes; OW_AGAIN: not
     * yet. Optional: without it pixels returns when its bytes are free.
     */
    int (*done)(void *device, uint32_t pending);

    /* Sends a code and reads count bytes, dummy bits taken off. Optional. */
    int (*read)(void *device, uint8_t code, uint8_t *answer, uint32_t count);

    /* Pulses RESET for hold_us, then waits settle_us, microseconds. Optional. */
    int (*reset)(void *device, uint32_t hold_us, uint32_t settle_us);

    /* Fills *limits, which stay. Mandatory. */
    int (*limits)(void *device, struct ow_bus_limits *limits);
};

struct ow_bus {
    const struct ow_bus_ops *ops;
    void *device;
};

/* OW_UNSUPPORTED where a mandatory function is missing. */
static inline int ow_bus_check(const struct ow_bus *bus)
{
    bool complete = bus != NULL && bus->ops != NULL && bus->ops->command != NULL &&
                    bus->ops->pixels != NULL && bus->ops->limits != NULL;
    return complete ? OW_OK : OW_UNSUPPORTED;
}

static inline int ow_bus_done(const struct ow_bus *bus, uint32_t pending)
{
    return bus->ops->done == NULL ? OW_OK : bus->ops->done(bus->device, pending);
}

static inline int ow_bus_read(const struct ow_bus *bus, uint8_t code, uint8_t *answer,
                              uint32_t count)
{
    return bus->ops->read == NULL ? OW_UNSUPPORTED
                                  : bus->ops->read(bus->device, code, answer, count);
}

static inline int ow_bus_reset(const struct ow_bus *bus, uint32_t hold_us, uint32_t settle_us)
{
    return bus->ops->reset == NULL ? OW_UNSUPPORTED
                                   : bus->ops->reset(bus->device, hold_us, settle_us);
}

#endif
