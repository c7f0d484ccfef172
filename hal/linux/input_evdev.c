/* SPDX-License-Identifier: 0BSD */
/* Event devices. */
#define _GNU_SOURCE /* versionsort */
#include "hal/linux/input_evdev.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/input.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { READ_MAX = 16, NAME_BYTES = 80, PATH_BYTES = 300, AXIS_MAX = 32767, SECOND_US = 1000000 };

static const struct linux_evdev_meaning usual[] = {
    { EV_KEY, KEY_LEFT, OW_CONTROL_LEFT, 0 },
    { EV_KEY, KEY_RIGHT, OW_CONTROL_RIGHT, 0 },
    { EV_KEY, KEY_UP, OW_CONTROL_UP, 0 },
    { EV_KEY, KEY_DOWN, OW_CONTROL_DOWN, 0 },
    { EV_KEY, KEY_KPPLUS, OW_CONTROL_IN, 0 },
    { EV_KEY, KEY_PAGEUP, OW_CONTROL_IN, 0 },
    { EV_KEY, KEY_KPMINUS, OW_CONTROL_OUT, 0 },
    { EV_KEY, KEY_PAGEDOWN, OW_CONTROL_OUT, 0 },
    { EV_KEY, KEY_ENTER, OW_CONTROL_SELECT, 0 },
    { EV_KEY, KEY_SPACE, OW_CONTROL_SELECT, 0 },
    { EV_KEY, KEY_ESC, OW_CONTROL_BACK, 0 },
    { EV_KEY, BTN_SOUTH, OW_CONTROL_SELECT, 0 },
    { EV_KEY, BTN_EAST, OW_CONTROL_BACK, 0 },
    { EV_KEY, BTN_TRIGGER, OW_CONTROL_SELECT, 0 },
    { EV_KEY, BTN_TL, OW_CONTROL_OUT, 0 },
    { EV_KEY, BTN_TR, OW_CONTROL_IN, 0 },
    { EV_KEY, BTN_DPAD_LEFT, OW_CONTROL_LEFT, 0 },
    { EV_KEY, BTN_DPAD_RIGHT, OW_CONTROL_RIGHT, 0 },
    { EV_KEY, BTN_DPAD_UP, OW_CONTROL_UP, 0 },
    { EV_KEY, BTN_DPAD_DOWN, OW_CONTROL_DOWN, 0 },
    { EV_REL, REL_DIAL, OW_CONTROL_KNOB_1, 0 },
    { EV_REL, REL_WHEEL, OW_CONTROL_KNOB_1, 0 },
    { EV_REL, REL_HWHEEL, OW_CONTROL_KNOB_2, 0 },
    { EV_ABS, ABS_X, OW_CONTROL_AXIS_X, OW_CONTROL_AXIS_X },
    { EV_ABS, ABS_Y, OW_CONTROL_AXIS_Y, OW_CONTROL_AXIS_Y },
    { EV_ABS, ABS_Z, OW_CONTROL_AXIS_Z, OW_CONTROL_AXIS_Z },
    { EV_ABS, ABS_HAT0X, OW_CONTROL_RIGHT, OW_CONTROL_LEFT },
    { EV_ABS, ABS_HAT0Y, OW_CONTROL_DOWN, OW_CONTROL_UP },
};

static int control(const struct linux_evdev *evdev, unsigned long request, void *argument)
{
    return linux_ioctl(evdev->config.system, evdev->fd, request, argument);
}

/* ---- opening ---- */

static int is_event(const struct dirent *entry)
{
    return strncmp(entry->d_name, "event", 5) == 0;
}

static int open_path(const struct linux_evdev *evdev, const char *path)
{
    return evdev->config.system->open(path, O_RDONLY | O_NONBLOCK);
}

/* The device of a name: its fd, or -1 and errno, of the first that could not be opened. */
static int open_named(struct linux_evdev *evdev)
{
    const struct linux_evdev_config *config = &evdev->config;
    const char *folder = config->folder != NULL ? config->folder : "/dev/input";
    struct dirent **entries = NULL;
    int count = scandir(folder, &entries, is_event, versionsort);
    int found = -1;
    int error = 0;
    for (int i = 0; i < count; i++) {
        char path[PATH_BYTES];
        char name[NAME_BYTES] = "";
        snprintf(path, sizeof path, "%s/%s", folder, entries[i]->d_name);
        free(entries[i]);
        if (found >= 0) {
            continue;
        }
        int fd = open_path(evdev, path);
        if (fd < 0) {
            error = error == 0 ? errno : error;
            continue;
        }
        if (linux_ioctl(config->system, fd, EVIOCGNAME(sizeof name - 1), name) >= 0 &&
            strcmp(name, config->device) == 0) {
            found = fd;
        } else {
            (void)config->system->close(fd);
        }
    }
    free(entries);
    errno = error != 0 ? error : ENOENT;
    return found;
}

static void learn_axes(struct linux_evdev *evdev)
{
    evdev->axis_count = 0;
    for (uint32_t i = 0; i < evdev->config.meaning_count; i++) {
        const struct linux_evdev_meaning *meaning = &evdev->config.meanings[i];
        struct input_absinfo info = { 0 };
        if (meaning->type == EV_ABS && evdev->axis_count < LINUX_EVDEV_AXES &&
            control(evdev, EVIOCGABS((unsigned)meaning->code), &info) >= 0 &&
            info.maximum > info.minimum) {
            evdev->axes[evdev->axis_count++] =
                (struct linux_evdev_axis){ meaning->code, info.minimum, info.maximum, info.flat,
                                           0 };
        }
    }
}

static int failed(struct linux_evdev *evdev, const char *call)
{
    int status = linux_fault_errno(&evdev->fault, evdev->config.device, call, errno);
    if (evdev->fd >= 0) {
        (void)evdev->config.system->close(evdev->fd);
        evdev->fd = -1;
    }
    return status;
}

static int set_up(struct linux_evdev *evdev)
{
    int clock = CLOCK_MONOTONIC;
    if (control(evdev, EVIOCSCLOCKID, &clock) < 0) {
        int status = failed(evdev, "EVIOCSCLOCKID");
        if (status == OW_UNSUPPORTED || status == OW_BUS) {
            status = linux_fault_note(&evdev->fault, OW_UNSUPPORTED, evdev->config.device,
                                      "EVIOCSCLOCKID", "it is not an event device",
                                      "name one of /dev/input/event*");
        }
        return status;
    }
    if (evdev->config.grab && control(evdev, EVIOCGRAB, (void *)(uintptr_t)1) < 0) {
        return failed(evdev, "EVIOCGRAB");
    }
    learn_axes(evdev);
    return OW_OK;
}

static int open_device(struct linux_evdev *evdev)
{
    const char *device = evdev->config.device;
    evdev->fd = device[0] == '/' ? open_path(evdev, device) : open_named(evdev);
    if (evdev->fd < 0) {
        int status = failed(evdev, "open");
        if (status == OW_GONE) {
            linux_fault_remedy(&evdev->fault, "plug it in, or name one of /dev/input/event* or of "
                                              "the names in /proc/bus/input/devices");
        }
        return status;
    }
    return set_up(evdev);
}

int linux_evdev_open(struct linux_evdev *evdev, const struct linux_evdev_config *config)
{
    *evdev = (struct linux_evdev){ .config = *config, .fd = -1 };
    if (config->meanings == NULL) {
        evdev->config.meanings = usual;
        evdev->config.meaning_count = sizeof usual / sizeof usual[0];
    }
    return open_device(evdev);
}

void linux_evdev_close(struct linux_evdev *evdev)
{
    if (evdev->fd >= 0 && evdev->config.system != NULL) {
        (void)evdev->config.system->close(evdev->fd);
    }
    evdev->fd = -1;
}

bool linux_evdev_retry(struct linux_evdev *evdev)
{
    return evdev->fd < 0 && open_device(evdev) == OW_OK;
}

/* ---- events ---- */

/* Puts an event into the queue; there is room for all that one read can mean. */
static void put(struct linux_evdev *evdev, uint64_t time_us, uint16_t number, uint16_t kind,
                int32_t value)
{
    if (evdev->tail == LINUX_EVDEV_QUEUE) {
        evdev->lost = true;
        return;
    }
    evdev->queue[evdev->tail++] = (struct ow_input_event){ time_us, number, kind, value };
}

static struct linux_evdev_axis *axis_of(struct linux_evdev *evdev, uint16_t code)
{
    for (uint32_t i = 0; i < evdev->axis_count; i++) {
        if (evdev->axes[i].code == code) {
            return &evdev->axes[i];
        }
    }
    return NULL;
}

/* -32767 .. 32767, 0 in the flat middle. */
static int32_t scaled(const struct linux_evdev_axis *axis, int32_t value)
{
    int64_t doubled = 2 * (int64_t)value - axis->minimum - axis->maximum;
    int64_t span = (int64_t)axis->maximum - axis->minimum;
    if (doubled <= 2 * (int64_t)axis->flat && doubled >= -2 * (int64_t)axis->flat) {
        return 0;
    }
    int64_t position = doubled * AXIS_MAX / span;
    return (int32_t)(position > AXIS_MAX ? AXIS_MAX : position < -AXIS_MAX ? -AXIS_MAX : position);
}

static void take_axis(struct linux_evdev *evdev, const struct linux_evdev_meaning *meaning,
                      uint64_t time_us, int32_t value)
{
    struct linux_evdev_axis *axis = axis_of(evdev, meaning->code);
    if (axis == NULL) {
        return;
    }
    int32_t position = scaled(axis, value);
    if (meaning->low == meaning->control) {
        put(evdev, time_us, meaning->control, OW_INPUT_AXIS, position);
        return;
    }
    int8_t side = position > AXIS_MAX / 2 ? 1 : position < -AXIS_MAX / 2 ? -1 : 0;
    if (side == axis->side) {
        return;
    }
    if (axis->side != 0) {
        put(evdev, time_us, axis->side > 0 ? meaning->control : meaning->low, OW_INPUT_RELEASE, 0);
    }
    if (side != 0) {
        put(evdev, time_us, side > 0 ? meaning->control : meaning->low, OW_INPUT_PRESS, 0);
    }
    axis->side = side;
}

static void take_meaning(struct linux_evdev *evdev, const struct linux_evdev_meaning *meaning,
                         uint64_t time_us, int32_t value)
{
    switch (meaning->type) {
    case EV_KEY: /* 2: the kernel repeats it; the viewer does that itself */
        if (value != 2) {
            put(evdev, time_us, meaning->control, value != 0 ? OW_INPUT_PRESS : OW_INPUT_RELEASE,
                0);
        }
        break;
    case EV_REL:
        put(evdev, time_us, meaning->control, OW_INPUT_TURN, value);
        break;
    default:
        take_axis(evdev, meaning, time_us, value);
        break;
    }
}

static void lose(struct linux_evdev *evdev)
{
    evdev->lost = true;
    evdev->head = evdev->tail = 0;
    for (uint32_t i = 0; i < evdev->axis_count; i++) {
        evdev->axes[i].side = 0;
    }
}

static void take(struct linux_evdev *evdev, const struct input_event *event)
{
    if (event->type == EV_SYN) {
        evdev->dropped = event->code == SYN_DROPPED;
        if (evdev->dropped) {
            lose(evdev);
        }
        return;
    }
    uint64_t time_us =
        (uint64_t)event->input_event_sec * SECOND_US + (uint64_t)event->input_event_usec;
    for (uint32_t i = 0; i < evdev->config.meaning_count && !evdev->dropped; i++) {
        const struct linux_evdev_meaning *meaning = &evdev->config.meanings[i];
        if (meaning->type == event->type && meaning->code == event->code) {
            take_meaning(evdev, meaning, time_us, event->value);
            return;
        }
    }
}

/* Reads once. OW_AGAIN: nothing was there. */
static int read_events(struct linux_evdev *evdev)
{
    struct input_event events[READ_MAX];
    ssize_t count = evdev->config.system->read(evdev->fd, events, sizeof events);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
        return OW_AGAIN;
    }
    if (count < (ssize_t)sizeof events[0]) {
        errno = count < 0 ? errno : ENODEV;
        (void)failed(evdev, "read");
        lose(evdev);
        return OW_OK;
    }
    evdev->head = evdev->tail = 0;
    for (size_t i = 0; i < (size_t)count / sizeof events[0]; i++) {
        take(evdev, &events[i]);
    }
    return OW_OK;
}

static int evdev_next(void *device, struct ow_input_event *event)
{
    struct linux_evdev *evdev = device;
    while (evdev->head == evdev->tail && !evdev->lost) {
        if (evdev->fd < 0 || read_events(evdev) == OW_AGAIN) {
            return OW_AGAIN;
        }
    }
    if (evdev->lost) {
        evdev->lost = false;
        return OW_CAPACITY;
    }
    *event = evdev->queue[evdev->head++];
    return OW_OK;
}

const struct ow_input_ops linux_evdev_ops = { evdev_next };
