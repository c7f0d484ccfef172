/* SPDX-License-Identifier: 0BSD */
/*
 * spidev and i2c-dev on a made-up kernel, whose bytes end in a controller's
 * model: the picture arrives in transfers that the kernel takes, and any call
 * may fail with any error, which is then told with the device, the call and a
 * remedy.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <errno.h>
#include <linux/i2c-dev.h>
#include <linux/spi/spidev.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hal/linux/i2cdev.h"
#include "hal/linux/spidev.h"
#include "hal/panel/command_panel.h"
#include "sim/sim_controller.h"

enum { SPI_FD = 7, BUFSIZ_FD = 8, I2C_FD = 9, DATA_LINE = 3, RESET_LINE = 4 };

/* The kernel, and two lines. */
static struct {
    struct sim_controller controller;
    uint64_t now_us;
    uint32_t bufsiz; /* what the parameter says; 0: it cannot be read */
    uint32_t really; /* what a transfer may have */
    int too_long;    /* what is said of more */
    uint32_t longest;
    uint32_t transfers;
    uint32_t mode;
    uint32_t clock_hz;
    bool data;
    uint64_t reset_at_us;
    bool read_done;
    int open_fds;
    uint32_t calls;
    uint32_t fail_at;
    int fail_errno;
} kernel;

/* Counts a call; true: it is the one that fails. */
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
    (void)flags;
    if (fails()) {
        return -1;
    }
    int fd = strcmp(path, "/dev/spidev0.0") == 0 ? SPI_FD
             : strcmp(path, "/dev/i2c-1") == 0   ? I2C_FD
             : strstr(path, "bufsiz") != NULL    ? BUFSIZ_FD
                                                 : -1;
    if (fd < 0 || (fd == BUFSIZ_FD && kernel.bufsiz == 0)) {
        errno = ENOENT;
        return -1;
    }
    kernel.open_fds++;
    kernel.read_done = false;
    return fd;
}

static int fake_close(int fd)
{
    assert_true(fd == SPI_FD || fd == BUFSIZ_FD || fd == I2C_FD);
    kernel.open_fds--;
    return 0;
}

static ssize_t fake_read(int fd, void *bytes, size_t count)
{
    char text[16];
    assert_int_equal(fd, BUFSIZ_FD);
    if (fails()) {
        return -1;
    }
    int length = snprintf(text, sizeof text, "%u\n", (unsigned)kernel.bufsiz);
    assert_true((size_t)length <= count);
    memcpy(bytes, text, (size_t)length);
    return length;
}

static bool too_long(uint32_t count)
{
    if (kernel.really == 0 || count <= kernel.really) {
        return false;
    }
    errno = kernel.too_long;
    return true;
}

static int transfer(const struct spi_ioc_transfer *message)
{
    const uint8_t *bytes = (const uint8_t *)(uintptr_t)message->tx_buf;
    bool broken = fails();
    if (too_long(message->len)) {
        return -1;
    }
    uint32_t count = !broken                               ? message->len
                     : errno == EINTR || errno == EMSGSIZE ? 0
                                                           : message->len / 2;
    for (uint32_t i = 0; i < count; i++) {
        sim_controller_byte(&kernel.controller, kernel.data, bytes[i]);
    }
    if (broken && errno != EINTR && errno != EMSGSIZE) {
        sim_controller_tear(&kernel.controller);
    }
    sim_controller_release(&kernel.controller);
    kernel.transfers++;
    kernel.longest = count > kernel.longest ? count : kernel.longest;
    return broken ? -1 : (int)message->len;
}

/* A code goes out, the answer comes in the same message. */
static int exchange(const struct spi_ioc_transfer messages[2])
{
    static const uint8_t id[] = { 0x3E, 0x44, 0xF8, 0x00 }; /* 7C 89 F0, a bit late */
    const uint8_t *code = (const uint8_t *)(uintptr_t)messages[0].tx_buf;
    uint8_t *answer = (uint8_t *)(uintptr_t)messages[1].rx_buf;
    if (fails()) {
        return -1;
    }
    assert_true(!kernel.data && messages[0].len == 1 && messages[0].cs_change == 0);
    assert_true(messages[0].speed_hz <= 4000000 && messages[1].tx_buf == 0);
    if (*code == 0x04) {
        assert_int_equal(messages[1].len, sizeof id);
        memcpy(answer, id, sizeof id);
    } else {
        assert_int_equal(messages[1].len, 1);
        assert_true(sim_controller_answer(&kernel.controller, *code, answer));
    }
    return (int)(messages[0].len + messages[1].len);
}

static int fake_ioctl(int fd, unsigned long request, void *argument)
{
    assert_true(fd == SPI_FD || fd == I2C_FD);
    if (request == SPI_IOC_MESSAGE(1)) {
        return transfer(argument);
    }
    if (request == SPI_IOC_MESSAGE(2)) {
        return exchange(argument);
    }
    if (fails()) {
        return -1;
    }
    switch (request) {
    case SPI_IOC_WR_MODE32:
        kernel.mode = *(uint32_t *)argument;
        return 0;
    case SPI_IOC_WR_BITS_PER_WORD:
        assert_int_equal(*(uint8_t *)argument, 8);
        return 0;
    case SPI_IOC_WR_MAX_SPEED_HZ:
        kernel.clock_hz = *(uint32_t *)argument;
        return 0;
    case SPI_IOC_RD_MAX_SPEED_HZ:
        *(uint32_t *)argument = kernel.clock_hz;
        return 0;
    case I2C_SLAVE:
        assert_int_equal((uintptr_t)argument, 0x3C);
        return 0;
    default:
        fail();
        return -1;
    }
}

/* I2C: the control byte stands for D/C. */
static ssize_t fake_write(int fd, const void *bytes, size_t count)
{
    const uint8_t *byte = bytes;
    assert_int_equal(fd, I2C_FD);
    assert_true(count >= 2 && (byte[0] == 0x00 || byte[0] == 0x40));
    bool broken = fails();
    if (too_long((uint32_t)count)) {
        return -1;
    }
    if (broken) {
        int error = errno;
        sim_controller_tear(&kernel.controller);
        errno = error;
        return -1;
    }
    for (size_t i = 1; i < count; i++) {
        sim_controller_byte(&kernel.controller, byte[0] == 0x40, byte[i]);
    }
    kernel.transfers++;
    return (ssize_t)count;
}

static int fake_now(struct timespec *now)
{
    now->tv_sec = (time_t)(kernel.now_us / 1000000);
    now->tv_nsec = (long)(kernel.now_us % 1000000 * 1000);
    return 0;
}

static int fake_sleep(const struct timespec *until)
{
    uint64_t until_us = (uint64_t)until->tv_sec * 1000000 + (uint64_t)until->tv_nsec / 1000;
    kernel.now_us = until_us > kernel.now_us ? until_us : kernel.now_us;
    return 0;
}

static const struct linux_system fake_system = {
    .open = fake_open,
    .close = fake_close,
    .ioctl = fake_ioctl,
    .read = fake_read,
    .write = fake_write,
    .now = fake_now,
    .sleep = fake_sleep,
};

static int line_open(void *device, const struct ow_gpio_request *request)
{
    (void)device;
    (void)request;
    return OW_UNSUPPORTED;
}

static int line_get(void *device, int line)
{
    (void)device;
    (void)line;
    return 0;
}

static int line_set(void *device, int line, bool level)
{
    (void)device;
    if (fails()) {
        return OW_BUS;
    }
    if (line == DATA_LINE) {
        kernel.data = level;
    } else if (level) {
        kernel.reset_at_us = kernel.now_us;
    } else {
        sim_controller_reset(&kernel.controller, (uint32_t)(kernel.now_us - kernel.reset_at_us));
    }
    return OW_OK;
}

static int line_close(void *device, int line)
{
    (void)device;
    (void)line;
    return OW_OK;
}

static const struct ow_gpio_ops line_ops = { line_open, line_get, line_set, NULL, line_close };
static const struct ow_gpio lines = { &line_ops, NULL };

static int clock_now(void *device, uint64_t *time_us)
{
    (void)device;
    *time_us = kernel.now_us;
    return OW_OK;
}

static int clock_sleep(void *device, uint64_t until_us)
{
    (void)device;
    kernel.now_us = until_us > kernel.now_us ? until_us : kernel.now_us;
    return OW_OK;
}

static const struct ow_clock_ops clock_ops = { clock_now, clock_sleep };
static const struct ow_clock virtual_clock = { &clock_ops, NULL };

/* ---- a panel on a bus ---- */

struct rig {
    struct linux_spidev spidev;
    struct linux_i2cdev i2cdev;
    struct ow_bus bus;
    struct ow_command_panel device;
    uint8_t frame[128 * 160 * 2];
    uint32_t width, height, stride;
    bool i2c;
};

static struct rig rig;

static void power_on(bool i2c)
{
    memset(&kernel, 0, sizeof kernel);
    memset(&rig, 0, sizeof rig);
    kernel.now_us = 1000000;
    kernel.bufsiz = 4096;
    kernel.too_long = EMSGSIZE;
    rig.i2c = i2c;
    rig.width = 128;
    rig.height = i2c ? 64 : 160;
    rig.stride = i2c ? 16 : 256;
    assert_true(sim_controller_open(
        &kernel.controller, sim_module_by_name(i2c ? "ssd1306" : "st7735"), &virtual_clock));
    for (size_t i = 0; i < sizeof rig.frame; i++) {
        rig.frame[i] = (uint8_t)(i * 2654435761u >> 24);
    }
}

static void power_off(void)
{
    linux_spidev_close(&rig.spidev);
    linux_i2cdev_close(&rig.i2cdev);
    assert_int_equal(kernel.open_fds, 0);
    sim_controller_close(&kernel.controller);
}

static int open_bus(void)
{
    const struct linux_spidev_config spi = {
        .system = &fake_system,
        .device = "/dev/spidev0.0",
        .clock_hz = 16000000,
        .gpio = &lines,
        .data = DATA_LINE,
        .reset = RESET_LINE,
    };
    const struct linux_i2cdev_config i2c = {
        .system = &fake_system,
        .device = "/dev/i2c-1",
        .address = 0x3C,
        .gpio = &lines,
        .reset = RESET_LINE,
    };
    rig.bus = rig.i2c ? (struct ow_bus){ &linux_i2cdev_ops, &rig.i2cdev }
                      : (struct ow_bus){ &linux_spidev_ops, &rig.spidev };
    rig.spidev.fd = -1;
    rig.i2cdev.fd = -1;
    return rig.i2c ? linux_i2cdev_open(&rig.i2cdev, &i2c) : linux_spidev_open(&rig.spidev, &spi);
}

static int open_panel(void)
{
    struct ow_command_panel_config config;
    ow_command_panel_defaults(&config, rig.i2c ? &ow_controller_ssd1306 : &ow_controller_st7735);
    config.bus = &rig.bus;
    config.clock = &virtual_clock;
    return ow_command_panel_open(&rig.device, &config);
}

static int show(void)
{
    const struct ow_panel_rect whole = { 0, 0, (uint16_t)rig.width, (uint16_t)rig.height };
    const struct ow_panel *panel = &rig.device.panel;
    return panel->ops->write(panel->device, &whole, rig.frame, rig.stride, true);
}

static void check_picture(void)
{
    if (kernel.controller.complaints != 0) {
        print_message("# the controller says: %s\n", kernel.controller.complaint);
    }
    assert_int_equal(kernel.controller.complaints, 0);
    const struct ow_pixel_format *format = rig.i2c ? &ow_format_mono : &ow_format_rgb565_be;
    for (uint32_t y = 0; y < rig.height; y++) {
        for (uint32_t x = 0; x < rig.width; x++) {
            assert_int_equal(sim_controller_glass(&kernel.controller, x, y),
                             format->get(rig.frame + y * rig.stride, x));
        }
    }
}

static const struct linux_fault *fault(void)
{
    return rig.i2c ? &rig.i2cdev.fault : &rig.spidev.fault;
}

/* ---- tests ---- */

static void the_picture_arrives_in_transfers_that_fit(void **state)
{
    static const uint32_t sizes[][2] = { { 4096, 0 },     { 65536, 0 },   { 0, 4096 },
                                         { 65536, 4096 }, { 4096, 1000 }, { 32, 17 } };
    (void)state;
    for (int i2c = 0; i2c <= 1; i2c++) {
        for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
            power_on(i2c);
            kernel.bufsiz = sizes[i][0];
            kernel.really = sizes[i][1];
            kernel.too_long = i2c && i % 2 == 1 ? EOPNOTSUPP : EMSGSIZE;
            assert_int_equal(open_bus(), OW_OK);
            assert_int_equal(open_panel(), OW_OK);
            assert_int_equal(show(), OW_OK);
            check_picture();
            uint32_t limit = kernel.really != 0 ? kernel.really : kernel.bufsiz;
            assert_true(limit == 0 || kernel.longest <= limit);
            if (!i2c) {
                assert_int_equal(kernel.mode, 0);
                assert_int_equal(kernel.clock_hz, 16000000);
                assert_int_equal(rig.device.limits.clock_hz, 16000000);
                assert_int_equal(rig.device.limits.transfer_bytes, 50); /* 25 us */
                assert_int_equal(rig.device.limits.max_bytes,
                                 kernel.bufsiz != 0 ? kernel.bufsiz : 4096);
            }
            assert_int_equal(kernel.controller.resets, 1);
            power_off();
        }
    }
}

static bool recovers(int error)
{
    return error == EINTR || error == EMSGSIZE;
}

/* Every call in turn with every error: it is told or overcome, and the next try succeeds. */
static void any_call_may_fail(void **state)
{
    static const int errors[] = { EINTR, EIO, EMSGSIZE, EBUSY, EACCES, ENOENT, ENODEV, ETIMEDOUT };
    (void)state;
    for (int i2c = 0; i2c <= 1; i2c++) {
        power_on(i2c);
        assert_true(open_bus() >= 0 && open_panel() >= 0 && show() >= 0);
        uint32_t calls = kernel.calls;
        power_off();
        for (uint32_t n = 1; n <= calls; n++) {
            for (size_t e = 0; e < sizeof errors / sizeof errors[0]; e++) {
                char text[600];
                power_on(i2c);
                kernel.fail_at = n;
                kernel.fail_errno = errors[e];
                int status = open_bus();
                status = status < 0 ? status : open_panel();
                status = status < 0 ? status : show();
                if (status < 0) {
                    assert_int_equal(fault()->status, status);
                    linux_fault_text(fault(), text, sizeof text);
                    assert_non_null(strstr(text, i2c ? "/dev/i2c-1: " : "/dev/spidev0.0: "));
                    assert_true(fault()->call[0] != '\0' && fault()->why[0] != '\0');
                    assert_true(fault()->remedy[0] != '\0' || recovers(errors[e]));
                    if (rig.bus.ops != NULL && rig.spidev.fd < 0 && rig.i2cdev.fd < 0) {
                        assert_int_equal(kernel.open_fds, 0);
                        assert_int_equal(open_bus(), OW_OK);
                        assert_int_equal(open_panel(), OW_OK);
                    }
                    assert_int_equal(show(), OW_OK);
                }
                check_picture();
                power_off();
            }
        }
    }
}

static const struct told {
    bool i2c;
    uint32_t call;
    int error;
    int status;
    const char *words;
} tolds[] = {
    { false, 1, ENOENT, OW_GONE, "enable the bus" },
    { false, 1, EACCES, OW_DENIED, "oldwell doctor" },
    { false, 1, EBUSY, OW_BUSY, "end the program" },
    { false, 2, EINVAL, OW_UNSUPPORTED, "SPI_IOC_WR_MODE32: the controller refuses it" },
    { false, 4, EINVAL, OW_UNSUPPORTED, "lower --spi-hz" },
    { false, 5, EIO, OW_OK, NULL },    /* then the rate is unknown */
    { false, 6, EACCES, OW_OK, NULL }, /* and the parameter its usual value */
    { false, 7, EIO, OW_OK, NULL },
    { true, 1, ENOENT, OW_GONE, "i2c-dev" },
    { true, 2, EBUSY, OW_BUSY, "unbind" },
};

static void failures_of_opening_are_told(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof tolds / sizeof tolds[0]; i++) {
        char text[600];
        power_on(tolds[i].i2c);
        kernel.fail_at = tolds[i].call;
        kernel.fail_errno = tolds[i].error;
        assert_int_equal(open_bus(), tolds[i].status);
        if (tolds[i].words != NULL) {
            linux_fault_text(fault(), text, sizeof text);
            print_message("# %s\n", text);
            assert_non_null(strstr(text, tolds[i].words));
            assert_int_equal(kernel.open_fds, 0);
        }
        power_off();
    }
}

static void a_controller_is_read(void **state)
{
    uint8_t answer[3] = { 0 };
    (void)state;
    power_on(false);
    assert_int_equal(open_bus(), OW_OK);
    assert_int_equal(open_panel(), OW_OK);
    assert_int_equal(show(), OW_OK);
    assert_int_equal(ow_command_panel_ask(&rig.device, answer), 1);
    assert_int_equal(answer[0], 0x9C);
    assert_int_equal(ow_bus_read(&rig.bus, 0x04, answer, 3), OW_OK);
    assert_true(answer[0] == 0x7C && answer[1] == 0x89 && answer[2] == 0xF0);
    assert_int_equal(ow_bus_read(&rig.bus, 0x04, answer, 0), OW_ARGUMENT);
    assert_int_equal(ow_bus_read(&rig.bus, 0x04, answer, 17), OW_ARGUMENT);
    kernel.fail_at = kernel.calls + 2; /* after the D/C line */
    kernel.fail_errno = EIO;
    assert_int_equal(show(), OW_BUS);
    assert_int_equal(show(), OW_OK);
    check_picture();
    power_off();
    power_on(true);
    assert_int_equal(open_bus(), OW_OK);
    assert_int_equal(ow_bus_read(&rig.bus, 0x0A, answer, 1), OW_UNSUPPORTED);
    power_off();
}

static void nobody_at_an_address_is_told(void **state)
{
    (void)state;
    power_on(true);
    assert_int_equal(open_bus(), OW_OK);
    assert_int_equal(open_panel(), OW_OK);
    kernel.fail_at = kernel.calls + 3; /* after RESET's two */
    kernel.fail_errno = EREMOTEIO;
    assert_int_equal(show(), OW_GONE);
    assert_non_null(strstr(fault()->remedy, "try 0x3d"));
    power_off();
}

static void a_configuration_without_lines_is_refused(void **state)
{
    (void)state;
    struct linux_spidev spidev;
    struct linux_spidev_config config = { .system = &fake_system, .device = "/dev/spidev0.0" };
    power_on(false);
    assert_int_equal(linux_spidev_open(&spidev, &config), OW_ARGUMENT);
    config.gpio = &lines;
    assert_int_equal(linux_spidev_open(&spidev, &config), OW_ARGUMENT); /* no clock */
    config.clock_hz = 1000000;
    config.mode = 4;
    assert_int_equal(linux_spidev_open(&spidev, &config), OW_ARGUMENT);
    linux_spidev_close(&spidev);
    power_off();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_picture_arrives_in_transfers_that_fit),
        cmocka_unit_test(any_call_may_fail),
        cmocka_unit_test(failures_of_opening_are_told),
        cmocka_unit_test(a_controller_is_read),
        cmocka_unit_test(nobody_at_an_address_is_told),
        cmocka_unit_test(a_configuration_without_lines_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
