/* SPDX-License-Identifier: 0BSD */
/*
 * Five buttons to ground, sampled at each tick: a level counts when two samples
 * agree. A button must have been seen released before its presses count, so
 * that one that is stuck, or held while the board starts, is none.
 */
#include "hal/lm3s6965/chip.h"
#include "hal/lm3s6965/registers.h"

enum { PINS_E = 0x0F, PIN_F = 1 << 1, BUTTONS = 5, EVENTS = 16 };

/* Bits of a sample: PE0 .. PE3, PF1. */
static const uint8_t controls[BUTTONS] = { OW_CONTROL_UP, OW_CONTROL_DOWN, OW_CONTROL_LEFT,
                                           OW_CONTROL_RIGHT, OW_CONTROL_SELECT };

static struct {
    uint64_t time_us[EVENTS];
    uint8_t control[EVENTS];
    uint8_t kind[EVENTS];
    volatile uint32_t come;  /* by the interrupt */
    volatile uint32_t taken; /* by next */
    volatile bool lost;
} events;

static uint32_t last_sample; /* 1: pressed */
static uint32_t pressed;
static uint32_t seen_released;

static void report(uint64_t now_us, uint8_t control, enum ow_input_kind kind)
{
    uint32_t come = events.come;
    if (come - events.taken == EVENTS) {
        events.lost = true;
        return;
    }
    events.time_us[come % EVENTS] = now_us;
    events.control[come % EVENTS] = control;
    events.kind[come % EVENTS] = (uint8_t)kind;
    events.come = come + 1;
}

void chip_buttons_sample(uint64_t now_us)
{
    uint32_t levels = PORT_DATA(PORT_E, PINS_E) | (PORT_DATA(PORT_F, PIN_F) & PIN_F) << 3;
    uint32_t sample = ~levels & ((1u << BUTTONS) - 1);
    uint32_t steady = ~(sample ^ last_sample);
    last_sample = sample;
    seen_released |= ~sample & steady;
    uint32_t now_pressed = ((sample & steady) | (pressed & ~steady)) & seen_released;
    uint32_t changed = now_pressed ^ pressed;
    pressed = now_pressed;
    for (uint32_t i = 0; changed != 0; i++, changed >>= 1) {
        if (changed & 1) {
            report(now_us, controls[i], now_pressed >> i & 1 ? OW_INPUT_PRESS : OW_INPUT_RELEASE);
        }
    }
}

bool chip_buttons_have_event(void)
{
    return events.lost || events.come != events.taken;
}

static int next(void *device, struct ow_input_event *event)
{
    (void)device;
    uint32_t taken = events.taken;
    if (taken == events.come) {
        if (events.lost) {
            events.lost = false;
            return OW_CAPACITY;
        }
        return OW_AGAIN;
    }
    *event = (struct ow_input_event){
        .time_us = events.time_us[taken % EVENTS],
        .control = events.control[taken % EVENTS],
        .kind = events.kind[taken % EVENTS],
    };
    events.taken = taken + 1;
    return OW_OK;
}

const struct ow_input_ops chip_buttons_ops = { .next = next };
