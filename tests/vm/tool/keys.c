/* SPDX-License-Identifier: 0BSD */
/* A keyboard and joystick that is not there, by uinput. */
#include <fcntl.h>
#include <linux/uinput.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "tests/vm/tool/tool.h"

static int make_device(void)
{
    static const int axes[] = { ABS_X, ABS_Y, ABS_Z };
    int fd = open("/dev/uinput", O_WRONLY);
    struct uinput_setup setup = { .id = { .bustype = BUS_USB, .vendor = 1, .product = 1 } };
    strcpy(setup.name, "vmtool");
    if (fd < 0 || ioctl(fd, UI_SET_EVBIT, EV_KEY) != 0 || ioctl(fd, UI_SET_EVBIT, EV_ABS) != 0) {
        return -1;
    }
    for (int key = 1; key < KEY_MICMUTE; key++) {
        ioctl(fd, UI_SET_KEYBIT, key);
    }
    ioctl(fd, UI_SET_KEYBIT, BTN_JOYSTICK);
    for (size_t i = 0; i < sizeof axes / sizeof axes[0]; i++) {
        struct uinput_abs_setup abs = { .code = (uint16_t)axes[i],
                                        .absinfo = { .minimum = -1000, .maximum = 1000 } };
        ioctl(fd, UI_SET_ABSBIT, axes[i]);
        ioctl(fd, UI_ABS_SETUP, &abs);
    }
    return ioctl(fd, UI_DEV_SETUP, &setup) == 0 && ioctl(fd, UI_DEV_CREATE) == 0 ? fd : -1;
}

static int send(int fd, unsigned type, unsigned code, int value)
{
    struct input_event event = { .type = (uint16_t)type, .code = (uint16_t)code, .value = value };
    return write(fd, &event, sizeof event) == (ssize_t)sizeof event ? 0 : -1;
}

int tool_keys(int argc, char **argv)
{
    char line[80];
    unsigned type;
    unsigned code;
    int value;
    int fd = make_device();
    FILE *orders = fopen(argv[0], "r+"); /* of a FIFO: the end never comes */
    (void)argc;
    if (fd < 0 || orders == NULL) {
        return failed("uinput");
    }
    puts("keys");
    fflush(stdout);
    while (fgets(line, sizeof line, orders) != NULL) {
        if (sscanf(line, "%u %u %d", &type, &code, &value) != 3 ||
            send(fd, type, code, value) != 0 || send(fd, EV_SYN, SYN_REPORT, 0) != 0) {
            return failed(line);
        }
    }
    return 0;
}
