/* SPDX-License-Identifier: 0BSD */
/* hal/input.h from an event device: keys, joysticks, knobs with a kernel driver. */
#ifndef OW_HAL_LINUX_INPUT_EVDEV_H
#define OW_HAL_LINUX_INPUT_EVDEV_H

#include "hal/input.h"
#include "hal/linux/fault.h"
#include "hal/linux/system.h"

enum { LINUX_EVDEV_AXES = 8, LINUX_EVDEV_QUEUE = 32 };

/* What a code of the kernel means. Types: EV_KEY, EV_ABS, EV_REL of linux/input.h. */
struct linux_evdev_meaning {
    uint16_t type;
    uint16_t code;
    uint16_t control;
    /* EV_ABS: this control is pressed at the axis's high end and the other at its low end; */
    /* equal: the axis is reported as it is. */
    uint16_t low;
};

struct linux_evdev_config {
    const struct linux_system *system;
    const char *device; /* its path, or its name as the kernel says it; stays */
    const char *folder; /* with the nodes, for a name; NULL: /dev/input */
    bool grab;          /* nobody else gets its events (the console does not see the keys) */
    const struct linux_evdev_meaning *meanings; /* NULL: the usual ones */
    uint32_t meaning_count;
};

struct linux_evdev_axis {
    uint16_t code;
    int32_t minimum;
    int32_t maximum;
    int32_t flat;
    int8_t side; /* of one that stands for two buttons: -1 low, 1 high */
};

/* Private but for fault. */
struct linux_evdev {
    struct linux_fault fault;
    struct linux_evdev_config config;
    int fd; /* -1: the device is gone */
    struct linux_evdev_axis axes[LINUX_EVDEV_AXES];
    uint32_t axis_count;
    bool dropped; /* until the next report */
    struct ow_input_event queue[LINUX_EVDEV_QUEUE];
    uint32_t head;
    uint32_t tail;
    bool lost;
};

/*
 * Device: struct linux_evdev. A device that goes away is OW_CAPACITY once (all
 * controls are released), then OW_AGAIN until linux_evdev_retry finds it again.
 */
extern const struct ow_input_ops linux_evdev_ops;

/*
 * On failure nothing stays open and evdev->fault says why: OW_GONE, OW_DENIED,
 * OW_BUSY (somebody else grabbed it), OW_UNSUPPORTED (not an event device).
 */
int linux_evdev_open(struct linux_evdev *evdev, const struct linux_evdev_config *config);
void linux_evdev_close(struct linux_evdev *evdev);

/* To be called now and then: opens a device that is gone. True: it is back, with another fd. */
bool linux_evdev_retry(struct linux_evdev *evdev);

#endif
