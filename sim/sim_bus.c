/* SPDX-License-Identifier: 0BSD */
/* The simulated command bus. */
#include "sim_bus.h"

#include <string.h>

enum { I2C_BYTES = 2 };

/* Counts a call; a status if it is one that is to fail. */
static int count_call(struct sim_bus *bus)
{
    const struct sim_bus_config *config = &bus->config;
    bus->calls++;
    if ((config->fail_every != 0 && bus->calls % config->fail_every == 0) ||
        bus->calls == config->fail_at) {
        bus->failed++;
        return config->fail_status;
    }
    return OW_OK;
}

static void put(struct sim_bus *bus, bool data, const uint8_t *bytes, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        sim_controller_byte(&bus->controller, data, bytes[i]);
    }
}

static int bus_command(void *device, uint8_t code, const uint8_t *parameters, uint32_t count,
                       bool as_commands)
{
    struct sim_bus *bus = device;
    int status = count_call(bus);
    if (bus->pending > 0) {
        sim_complain(&bus->controller, "code %02X while pixels are under way", code);
    }
    if (status < 0) { /* the code gets through, and half of the rest */
        count /= 2;
    }
    bus->command_bytes += 1 + count + (bus->config.i2c ? (uint32_t)I2C_BYTES : 0);
    put(bus, false, &code, 1);
    put(bus, !as_commands, parameters, count);
    if (status < 0) {
        sim_controller_tear(&bus->controller);
    }
    return status;
}

static void leave(struct sim_bus *bus, const uint8_t *bytes, uint32_t count)
{
    bus->pixel_bytes += count + (bus->config.i2c ? (uint32_t)I2C_BYTES : 0);
    put(bus, true, bytes, count);
    sim_controller_release(&bus->controller);
}

/* The oldest leaves; its bytes are read only now. */
static void leave_first(struct sim_bus *bus)
{
    leave(bus, bus->queue[0].bytes, bus->queue[0].count);
    bus->pending--;
    memmove(bus->queue, bus->queue + 1, bus->pending * sizeof bus->queue[0]);
}

static int bus_pixels(void *device, const uint8_t *bytes, uint32_t count)
{
    struct sim_bus *bus = device;
    uint32_t most = bus->config.limits.max_bytes;
    int status = count_call(bus);
    if (count == 0 || (most != 0 && count > most)) {
        sim_complain(&bus->controller, "%u pixel bytes in one transfer of 1 .. %u", (unsigned)count,
                     (unsigned)most);
    }
    if (status < 0) {
        sim_controller_tear(&bus->controller);
        bus->pending = 0;
        put(bus, true, bytes, count / 2);
        return status;
    }
    bus->longest = count > bus->longest ? count : bus->longest;
    if (bus->config.delay == 0) {
        leave(bus, bytes, count);
    } else {
        if (bus->pending == SIM_BUS_QUEUE) { /* it waits for room */
            leave_first(bus);
        }
        bus->queue[bus->pending].bytes = bytes;
        bus->queue[bus->pending++].count = count;
    }
    return OW_OK;
}

static int bus_done(void *device, uint32_t pending)
{
    struct sim_bus *bus = device;
    int status = count_call(bus);
    if (status < 0) {
        sim_controller_tear(&bus->controller);
        bus->pending = 0;
        return status;
    }
    while (bus->pending > pending) {
        if (++bus->asked < bus->config.delay) {
            return OW_AGAIN;
        }
        bus->asked = 0;
        leave_first(bus);
    }
    return OW_OK;
}

static int bus_read(void *device, uint8_t code, uint8_t *answer, uint32_t count)
{
    struct sim_bus *bus = device;
    int status = count_call(bus);
    if (status < 0) {
        sim_controller_tear(&bus->controller);
        return status;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (bus->config.mute || !sim_controller_answer(&bus->controller, code, &answer[i])) {
            answer[i] = 0xFF;
        }
    }
    return OW_OK;
}

static int bus_reset(void *device, uint32_t hold_us, uint32_t settle_us)
{
    struct sim_bus *bus = device;
    int status = count_call(bus);
    if (status < 0) {
        sim_controller_tear(&bus->controller);
        return status;
    }
    bus->time.now_us += hold_us;
    sim_controller_reset(&bus->controller, hold_us);
    bus->time.now_us += settle_us;
    return OW_OK;
}

static int bus_limits(void *device, struct ow_bus_limits *limits)
{
    const struct sim_bus *bus = device;
    *limits = bus->config.limits;
    return OW_OK;
}

/* By whether there are a RESET line and a `done`. */
#define ALWAYS .command = bus_command, .pixels = bus_pixels, .limits = bus_limits, .read = bus_read
static const struct ow_bus_ops bus_ops[2][2] = {
    { { ALWAYS }, { ALWAYS, .done = bus_done } },
    { { ALWAYS, .reset = bus_reset }, { ALWAYS, .reset = bus_reset, .done = bus_done } },
};

bool sim_bus_open(struct sim_bus *bus, const struct sim_bus_config *config)
{
    *bus = (struct sim_bus){ .config = *config };
    bus->bus.ops = &bus_ops[!config->no_reset][config->delay > 0];
    bus->bus.device = bus;
    bus->clock = (struct ow_clock){ &sim_virtual_clock_ops, &bus->time };
    return sim_controller_open(&bus->controller, config->module, &bus->clock);
}

void sim_bus_close(struct sim_bus *bus)
{
    sim_controller_close(&bus->controller);
}
