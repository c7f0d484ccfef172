/* SPDX-License-Identifier: 0BSD */
/* Buttons and encoders from GPIO edges, event devices on a made-up kernel, and inputs merged. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <errno.h>
#include <fcntl.h>
#include <linux/input.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "hal/linux/input_evdev.h"
#include "hal/linux/input_gpio.h"
#include "hal/linux/inputs.h"
#include "tests/unit/child.h"

/* ---- lines whose edges are a text: `a` falls, `A` rises, `!` edges were lost, `x` an error ---- */

static struct {
    const char *edges;
    bool levels[26];
    uint64_t time_us;
    int get_status;
} wires;

static int wire_open(void *device, const struct ow_gpio_request *request)
{
    (void)device;
    (void)request;
    return OW_UNSUPPORTED;
}

static int wire_get(void *device, int line)
{
    (void)device;
    return wires.get_status < 0 ? wires.get_status : wires.levels[line];
}

static int wire_set(void *device, int line, bool level)
{
    (void)device;
    (void)line;
    (void)level;
    return OW_UNSUPPORTED;
}

static int wire_event(void *device, struct ow_gpio_event *event)
{
    (void)device;
    char edge = *wires.edges;
    if (edge == '\0') {
        return OW_AGAIN;
    }
    wires.edges++;
    if (edge == '!' || edge == '?') {
        return edge == '!' ? OW_CAPACITY : OW_GONE;
    }
    event->level = edge < 'a';
    event->line = event->level ? edge - 'A' : edge - 'a';
    event->time_us = wires.time_us += 10;
    wires.levels[event->line] = event->level;
    return OW_OK;
}

static int wire_close(void *device, int line)
{
    (void)device;
    (void)line;
    return OW_OK;
}

static const struct ow_gpio_ops wire_ops = { wire_open, wire_get, wire_set, wire_event,
                                             wire_close };
static const struct ow_gpio gpio = { &wire_ops, NULL };

/* All that an input has to say, as a text: control and + press, - release, > < turn, = axis, ! lost. */
static void listen(const struct ow_input_ops *ops, void *device, char *text, size_t bytes)
{
    struct ow_input_event event;
    size_t at = 0;
    int status;
    text[0] = '\0';
    while ((status = ops->next(device, &event)) == OW_OK || status == OW_CAPACITY) {
        if (status == OW_CAPACITY) {
            at += (size_t)snprintf(text + at, bytes - at, "! ");
        } else if (event.kind == OW_INPUT_TURN || event.kind == OW_INPUT_AXIS) {
            at += (size_t)snprintf(text + at, bytes - at, "%d%s%d ", event.control,
                                   event.kind == OW_INPUT_TURN ? "t" : "=", (int)event.value);
        } else {
            at += (size_t)snprintf(text + at, bytes - at, "%d%c ", event.control,
                                   event.kind == OW_INPUT_PRESS ? '+' : '-');
        }
    }
    snprintf(text + at, bytes - at, "%s",
             status == OW_AGAIN  ? ""
             : status == OW_GONE ? "gone"
                                 : "?");
}

/* Buttons on lines a and b (controls 1 and 2), an encoder on c and d (control 3). */
static const struct linux_button buttons[] = { { 1, 0 }, { 2, 1 } };

static void start(struct linux_input_gpio *input, uint8_t edges, bool rests_high)
{
    const struct linux_encoder encoder = { 3, 2, 3, edges };
    const struct linux_input_gpio_config config = { &gpio, buttons, 2, &encoder, 1 };
    memset(&wires, 0, sizeof wires);
    wires.edges = "";
    wires.levels[2] = wires.levels[3] = rests_high;
    assert_int_equal(linux_input_gpio_start(input, &config), OW_OK);
}

static const struct played {
    uint8_t edges; /* of the encoder from detent to detent */
    bool rests_high;
    const char *script;
    const char *heard;
} plays[] = {
    { 4, false, "AaABab", "1+ 1- 1+ 2+ 1- 2- " },
    { 4, false, "aAAa", "1+ 1- " }, /* what is known already counts for nothing */
    { 4, false, "CDcd", "3t1 " },   /* clockwise: c first */
    { 4, false, "DCdc", "3t-1 " },
    { 4, true, "cdCD", "3t1 " }, /* at rest both are high */
    { 4, true, "dcDC", "3t-1 " },
    { 4, false, "CcCcCDdDcd", "3t1 " }, /* contacts that bounce */
    { 4, false, "CcCc", "" },
    { 4, false, "CDdc", "" }, /* half way and back */
    { 4, false, "CDcdCDcdDCdc", "3t1 3t1 3t-1 " },
    { 2, false, "CDcd", "3t1 3t1 " },
    { 2, false, "DCdc", "3t-1 3t-1 " },
    { 1, false, "CDcd", "3t1 3t1 3t1 3t1 " },
    { 4, false, "CADacd", "1+ 1- 3t1 " },
    { 4, false, "A!aCDcd", "1+ ! 1- 3t1 " },
    { 4, false, "A?", "1+ gone" },
};

static void edges_become_events(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof plays / sizeof plays[0]; i++) {
        struct linux_input_gpio input;
        char text[200];
        start(&input, plays[i].edges, plays[i].rests_high);
        wires.edges = plays[i].script;
        listen(&linux_input_gpio_ops, &input, text, sizeof text);
        print_message("# %s: %s\n", plays[i].script, text);
        assert_string_equal(text, plays[i].heard);
    }
}

static void a_bad_gpio_configuration_is_refused(void **state)
{
    struct linux_input_gpio input;
    struct linux_encoder encoder = { 3, 2, 3, 3 };
    struct ow_gpio_ops silent = wire_ops;
    struct ow_gpio no_edges = { &silent, NULL };
    struct linux_input_gpio_config config = { &gpio, buttons, LINUX_INPUT_BUTTONS + 1, NULL, 0 };
    (void)state;
    start(&input, 4, false);
    assert_int_equal(linux_input_gpio_start(&input, &config), OW_ARGUMENT);
    config = (struct linux_input_gpio_config){ &gpio, NULL, 0, &encoder, 1 };
    assert_int_equal(linux_input_gpio_start(&input, &config), OW_ARGUMENT);
    silent.event = NULL;
    config = (struct linux_input_gpio_config){ &no_edges, NULL, 0, NULL, 0 };
    assert_int_equal(linux_input_gpio_start(&input, &config), OW_UNSUPPORTED);
    wires.get_status = OW_DENIED;
    config = (struct linux_input_gpio_config){ &gpio, buttons, 2, NULL, 0 };
    assert_int_equal(linux_input_gpio_start(&input, &config), OW_DENIED);
}

/* ---- event devices ---- */

enum { FD = 50, EVENTS = 64 };

static struct {
    struct input_event events[EVENTS];
    size_t head, tail;
    size_t at_once; /* bytes that a read gives at most */
    int read_errno;
    int open_fds;
    bool grabbed;
    bool unplugged;
    uint32_t calls;
    uint32_t fail_at;
    int fail_errno;
    const char *names[3];
} kernel;

static char folder[CHILD_PATH];

static bool fails(void)
{
    kernel.calls++;
    if (kernel.calls != kernel.fail_at) {
        return false;
    }
    errno = kernel.fail_errno;
    return true;
}

static int fake_open(const char *path, int flags)
{
    assert_true((flags & O_NONBLOCK) != 0);
    if (fails()) {
        return -1;
    }
    const char *number = strstr(path, "/event");
    if (number == NULL || number[6] < '0' || number[6] > '2' || kernel.unplugged) {
        errno = ENOENT;
        return -1;
    }
    kernel.open_fds++;
    return FD + number[6] - '0';
}

static int fake_close(int fd)
{
    (void)fd;
    kernel.open_fds--;
    return 0;
}

static int fake_ioctl(int fd, unsigned long request, void *argument)
{
    if (fails()) {
        return -1;
    }
    if (_IOC_NR(request) == _IOC_NR(EVIOCGNAME(0)) && _IOC_DIR(request) == _IOC_READ) {
        snprintf(argument, _IOC_SIZE(request), "%s", kernel.names[fd - FD]);
        return 1;
    }
    if (request == EVIOCSCLOCKID) {
        return 0;
    }
    if (request == EVIOCGRAB) {
        kernel.grabbed = true;
        return 0;
    }
    if (request == EVIOCGABS(ABS_X) || request == EVIOCGABS(ABS_HAT0X)) {
        *(struct input_absinfo *)argument =
            request == EVIOCGABS(ABS_X)
                ? (struct input_absinfo){ .minimum = 0, .maximum = 255, .flat = 10 }
                : (struct input_absinfo){ .minimum = -1, .maximum = 1 };
        return 0;
    }
    errno = EINVAL;
    return -1;
}

static ssize_t fake_read(int fd, void *bytes, size_t count)
{
    (void)fd;
    if (fails()) {
        return -1;
    }
    if (kernel.read_errno != 0 || kernel.head == kernel.tail) {
        errno = kernel.read_errno != 0 ? kernel.read_errno : EAGAIN;
        return -1;
    }
    size_t most = count / sizeof kernel.events[0];
    size_t there = kernel.tail - kernel.head;
    size_t taken = there < most ? there : most;
    taken = kernel.at_once != 0 && kernel.at_once < taken ? kernel.at_once : taken;
    memcpy(bytes, kernel.events + kernel.head, taken * sizeof kernel.events[0]);
    kernel.head += taken;
    return (ssize_t)(taken * sizeof kernel.events[0]);
}

static const struct linux_system fake_system = {
    .open = fake_open, .close = fake_close, .ioctl = fake_ioctl, .read = fake_read
};

static void happens(uint16_t type, uint16_t code, int32_t value)
{
    struct input_event *event = &kernel.events[kernel.tail];
    assert_true(kernel.tail < EVENTS);
    event->input_event_sec = 5;
    event->input_event_usec = (int)kernel.tail++;
    event->type = type;
    event->code = code;
    event->value = value;
}

static int plug_in(struct linux_evdev *evdev, const char *device, bool grab)
{
    const struct linux_evdev_config config = {
        .system = &fake_system, .device = device, .folder = folder, .grab = grab
    };
    memset(&kernel, 0, sizeof kernel);
    kernel.names[0] = "Power Button";
    kernel.names[1] = "gpio-keys";
    kernel.names[2] = "Some Pad";
    return linux_evdev_open(evdev, &config);
}

static void hear(struct linux_evdev *evdev, const char *wanted)
{
    char text[300];
    listen(&linux_evdev_ops, evdev, text, sizeof text);
    assert_string_equal(text, wanted);
}

static void keys_and_axes_become_events(void **state)
{
    struct linux_evdev evdev;
    struct ow_input_event event;
    (void)state;
    for (size_t at_once = 0; at_once < 3; at_once++) {
        assert_int_equal(plug_in(&evdev, "/dev/input/event0", false), OW_OK);
        kernel.at_once = at_once;
        hear(&evdev, "");
        happens(EV_KEY, KEY_LEFT, 1);
        happens(EV_KEY, KEY_LEFT, 2); /* the kernel's repeat */
        happens(EV_KEY, KEY_LEFT, 0);
        happens(EV_KEY, KEY_A, 1); /* no meaning */
        happens(EV_SYN, SYN_REPORT, 0);
        happens(EV_REL, REL_DIAL, -3);
        happens(EV_ABS, ABS_X, 0);
        happens(EV_ABS, ABS_X, 120); /* in the flat middle */
        happens(EV_ABS, ABS_X, 255);
        happens(EV_ABS, ABS_Y, 7); /* this device has none */
        happens(EV_ABS, ABS_HAT0X, -1);
        happens(EV_ABS, ABS_HAT0X, 1);
        happens(EV_ABS, ABS_HAT0X, 0);
        hear(&evdev, "0+ 0- 8t-3 11=-32767 11=0 11=32767 0+ 0- 1+ 1- ");
        happens(EV_KEY, KEY_ENTER, 1);
        assert_int_equal(linux_evdev_ops.next(&evdev, &event), OW_OK);
        assert_int_equal(event.time_us, 5000000 + kernel.tail - 1);
        linux_evdev_close(&evdev);
        assert_int_equal(kernel.open_fds, 0);
    }
}

static void dropped_events_are_told(void **state)
{
    struct linux_evdev evdev;
    (void)state;
    assert_int_equal(plug_in(&evdev, "/dev/input/event0", true), OW_OK);
    assert_true(kernel.grabbed);
    happens(EV_KEY, KEY_LEFT, 1);
    happens(EV_SYN, SYN_REPORT, 0);
    happens(EV_SYN, SYN_DROPPED, 0);
    happens(EV_KEY, KEY_UP, 1); /* until the next report nothing counts */
    happens(EV_SYN, SYN_REPORT, 0);
    happens(EV_KEY, KEY_DOWN, 1);
    hear(&evdev, "! 3+ ");
    linux_evdev_close(&evdev);
}

static void a_device_is_found_by_its_name(void **state)
{
    struct linux_evdev evdev;
    (void)state;
    assert_int_equal(plug_in(&evdev, "Some Pad", false), OW_OK);
    assert_int_equal(evdev.fd, FD + 2);
    assert_int_equal(kernel.open_fds, 1);
    linux_evdev_close(&evdev);
    assert_int_equal(plug_in(&evdev, "No Such Pad", false), OW_GONE);
    assert_int_equal(kernel.open_fds, 0);
    assert_non_null(strstr(evdev.fault.remedy, "/proc/bus/input/devices"));
}

static void a_device_comes_back(void **state)
{
    struct linux_evdev evdev;
    (void)state;
    assert_int_equal(plug_in(&evdev, "gpio-keys", false), OW_OK);
    happens(EV_KEY, KEY_LEFT, 1);
    hear(&evdev, "0+ ");
    kernel.read_errno = ENODEV;
    kernel.unplugged = true;
    hear(&evdev, "! "); /* the key that was held is released */
    assert_int_equal(evdev.fd, -1);
    assert_int_equal(kernel.open_fds, 0);
    assert_int_equal(evdev.fault.status, OW_GONE);
    assert_false(linux_evdev_retry(&evdev));
    hear(&evdev, "");
    kernel.unplugged = false;
    kernel.read_errno = 0;
    assert_true(linux_evdev_retry(&evdev));
    assert_false(linux_evdev_retry(&evdev)); /* it is there */
    happens(EV_KEY, KEY_UP, 1);
    hear(&evdev, "2+ ");
    linux_evdev_close(&evdev);
}

static void any_call_of_opening_may_fail(void **state)
{
    static const int errors[] = { ENOENT, EACCES, EBUSY, EIO, ENOTTY, ENODEV };
    static const int statuses[] = { OW_GONE, OW_DENIED, OW_BUSY, OW_BUS, OW_UNSUPPORTED, OW_GONE };
    struct linux_evdev evdev;
    char text[600];
    (void)state;
    for (uint32_t n = 1; n <= 3; n++) {
        for (size_t e = 0; e < sizeof errors / sizeof errors[0]; e++) {
            memset(&kernel, 0, sizeof kernel);
            const struct linux_evdev_config config = { .system = &fake_system,
                                                       .device = "/dev/input/event0",
                                                       .grab = true };
            kernel.fail_at = n;
            kernel.fail_errno = errors[e];
            int status = linux_evdev_open(&evdev, &config);
            int wanted = n == 2 && errors[e] == EIO ? OW_UNSUPPORTED : statuses[e];
            linux_fault_text(&evdev.fault, text, sizeof text);
            print_message("# %s\n", text);
            assert_int_equal(status, wanted);
            assert_int_equal(evdev.fault.status, wanted);
            assert_int_equal(kernel.open_fds, 0);
            linux_evdev_close(&evdev);
        }
    }
    assert_int_equal(plug_in(&evdev, "/dev/input/event1", false), OW_OK);
    kernel.fail_at = kernel.calls + 1;
    kernel.fail_errno = EINTR;
    happens(EV_KEY, KEY_UP, 1);
    hear(&evdev, ""); /* later */
    hear(&evdev, "2+ ");
    linux_evdev_close(&evdev);
}

/* ---- several as one ---- */

/* Events of a text: a digit a time, which is the control too; then `.` (AGAIN), `!` or `?`. */
static int next_of_text(void *device, struct ow_input_event *event)
{
    const char **text = device;
    char c = **text;
    if (c == '\0') {
        return OW_AGAIN;
    }
    ++*text;
    if (c < '0' || c > '9') {
        return c == '!' ? OW_CAPACITY : c == '?' ? OW_GONE : OW_AGAIN;
    }
    *event = (struct ow_input_event){ (uint64_t)(c - '0'), (uint16_t)(c - '0'), OW_INPUT_PRESS, 0 };
    return OW_OK;
}

static const struct ow_input_ops text_ops = { next_of_text };

static void inputs_are_merged_by_time(void **state)
{
    static const char *const scripts[][3] = {
        { "1458", "2367", "1+ 2+ 3+ 4+ 5+ 6+ 7+ 8+ " },
        { "", "12", "1+ 2+ " },
        { "1?", "23?", "1+ 2+ 3+ gone" },
        { "1!5", "34", "1+ ! 4+ 5+ " }, /* what was taken before the loss does not count */
    };
    (void)state;
    for (size_t i = 0; i < sizeof scripts / sizeof scripts[0]; i++) {
        const char *left = scripts[i][0];
        const char *right = scripts[i][1];
        const struct ow_input sources[] = { { &text_ops, &left }, { &text_ops, &right } };
        struct linux_inputs inputs = { .count = 0 };
        char text[100];
        assert_int_equal(linux_inputs_add(&inputs, &sources[0]), OW_OK);
        assert_int_equal(linux_inputs_add(&inputs, &sources[1]), OW_OK);
        listen(&linux_inputs_ops, &inputs, text, sizeof text);
        assert_string_equal(text, scripts[i][2]);
    }
    struct linux_inputs full = { .count = LINUX_INPUTS };
    const struct ow_input source = { &text_ops, NULL };
    const struct ow_input none = { NULL, NULL };
    assert_int_equal(linux_inputs_add(&full, &source), OW_CAPACITY);
    assert_int_equal(linux_inputs_add(&full, &none), OW_UNSUPPORTED);
}

static int make_folder(void **state)
{
    static const char *const names[] = { "event0", "event1", "event2" };
    (void)state;
    folder_make(folder);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char path[CHILD_PATH];
        folder_path(path, folder, names[i]);
        int fd = open(path, O_CREAT | O_WRONLY, 0600);
        if (fd < 0 || close(fd) != 0) {
            return -1;
        }
    }
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    folder_remove(folder);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_become_events),
        cmocka_unit_test(a_bad_gpio_configuration_is_refused),
        cmocka_unit_test(keys_and_axes_become_events),
        cmocka_unit_test(dropped_events_are_told),
        cmocka_unit_test(a_device_is_found_by_its_name),
        cmocka_unit_test(a_device_comes_back),
        cmocka_unit_test(any_call_of_opening_may_fail),
        cmocka_unit_test(inputs_are_merged_by_time),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
