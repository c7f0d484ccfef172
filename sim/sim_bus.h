/* SPDX-License-Identifier: 0BSD */
/* A command bus that ends in a model of a controller, cuts, counts, delays and fails. */
#ifndef OLDWELL_SIM_BUS_H
#define OLDWELL_SIM_BUS_H

#include "hal/bus.h"
#include "sim_clock.h"
#include "sim_controller.h"

struct sim_bus_config {
    const struct sim_module *module;
    struct ow_bus_limits limits;
    bool no_reset;  /* there is no RESET line */
    bool mute;      /* the controller's answers do not come through */
    uint32_t delay; /* pixels leave when `done` has been asked so often; 0: at once, no `done` */
    bool i2c;       /* each transfer begins with an address and a control byte */
    /* Faults: every n-th call, and the n-th call, fail in the middle; 0: none does. */
    uint32_t fail_every;
    uint32_t fail_at;
    int fail_status;
};

enum { SIM_BUS_QUEUE = 64 };

/* To be read by tests; faults may be changed. */
struct sim_bus {
    struct ow_bus bus; /* what a driver is given */
    struct sim_bus_config config;
    struct sim_controller controller;
    struct sim_clock time; /* what the driver's clock should be, so that waits are seen */
    struct ow_clock clock;
    uint32_t calls;
    uint32_t failed;
    uint64_t command_bytes; /* codes and parameters on the wire */
    uint64_t pixel_bytes;
    uint32_t longest; /* pixels call, bytes */
    struct {
        const uint8_t *bytes;
        uint32_t count;
    } queue[SIM_BUS_QUEUE];
    uint32_t pending;
    uint32_t asked;
};

/* False: out of memory. */
bool sim_bus_open(struct sim_bus *bus, const struct sim_bus_config *config);
void sim_bus_close(struct sim_bus *bus);

#endif
