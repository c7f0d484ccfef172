/* SPDX-License-Identifier: 0BSD */
/* I2C by i2c-dev. Each transfer begins with a control byte: commands follow, or pixels. */
#include "hal/linux/i2cdev.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/i2c-dev.h>
#include <string.h>

#include "hal/linux/reset_line.h"

enum {
    COMMANDS = 0x00, /* control bytes */
    PIXELS = 0x40,
    SMALLEST = 16, /* below this a transfer that is too long is an error */
    OVERHEAD = 3   /* start, address, control byte, stop: about so many bytes */
};

static int failed(struct linux_i2cdev *i2cdev, const char *call, int number)
{
    return linux_fault_errno(&i2cdev->fault, i2cdev->config.device, call, number);
}

int linux_i2cdev_open(struct linux_i2cdev *i2cdev, const struct linux_i2cdev_config *config)
{
    *i2cdev = (struct linux_i2cdev){ .config = *config, .fd = -1 };
    uint32_t most = config->max_bytes;
    i2cdev->max_bytes = most > 0 && most < LINUX_I2CDEV_BYTES ? most : LINUX_I2CDEV_BYTES;
    if (config->address < 0x08 || config->address > 0x77) {
        return linux_fault_note(&i2cdev->fault, OW_ARGUMENT, config->device, NULL,
                                "the address is not in 0x08 .. 0x77", "most panels have 0x3c");
    }
    i2cdev->fd = config->system->open(config->device, O_RDWR);
    if (i2cdev->fd < 0) {
        int status = failed(i2cdev, "open", errno);
        if (status == OW_GONE) {
            linux_fault_remedy(&i2cdev->fault, "load i2c-dev and enable the bus (Raspberry Pi: "
                                               "dtparam=i2c_arm=on), then name its node");
        }
        return status;
    }
    if (linux_ioctl(config->system, i2cdev->fd, I2C_SLAVE, (void *)(uintptr_t)config->address) <
        0) {
        int status = failed(i2cdev, "I2C_SLAVE", errno);
        if (status == OW_BUSY) {
            linux_fault_remedy(&i2cdev->fault, "a kernel driver has address 0x%02x: unbind it",
                               config->address);
        }
        linux_i2cdev_close(i2cdev);
        return status;
    }
    return OW_OK;
}

void linux_i2cdev_close(struct linux_i2cdev *i2cdev)
{
    if (i2cdev->fd >= 0 && i2cdev->config.system != NULL) {
        (void)i2cdev->config.system->close(i2cdev->fd);
    }
    i2cdev->fd = -1;
}

/* 0, or the error number. Nothing is sent by halves: a short count is an error. */
static int try_send(struct linux_i2cdev *i2cdev, uint32_t count)
{
    ssize_t sent;
    do {
        sent = i2cdev->config.system->write(i2cdev->fd, i2cdev->bytes, count);
    } while (sent < 0 && errno == EINTR);
    return sent < 0 ? errno : (size_t)sent == count ? 0 : EIO;
}

static int send_failed(struct linux_i2cdev *i2cdev, int number)
{
    int status = failed(i2cdev, "write", number);
    if (number == ENXIO || number == EREMOTEIO) { /* nobody acknowledged */
        i2cdev->fault.status = status = OW_GONE;
        linux_fault_remedy(&i2cdev->fault,
                           "nobody answers at 0x%02x: check wiring and supply, try 0x%02x",
                           i2cdev->config.address, i2cdev->config.address ^ 1u);
    }
    return status;
}

static int i2c_command(void *device, uint8_t code, const uint8_t *parameters, uint32_t count,
                       bool as_commands)
{
    struct linux_i2cdev *i2cdev = device;
    if (!as_commands && count > 0) {
        return OW_UNSUPPORTED;
    }
    i2cdev->bytes[0] = COMMANDS;
    i2cdev->bytes[1] = code;
    if (count > 0) {
        memcpy(i2cdev->bytes + 2, parameters, count);
    }
    int error = try_send(i2cdev, 2 + count);
    return error == 0 ? OW_OK : send_failed(i2cdev, error);
}

/* Adapters that take less than this at a time say so in different ways. */
static bool is_too_long(int number)
{
    return number == EMSGSIZE || number == EOPNOTSUPP || number == EINVAL;
}

static int i2c_pixels(void *device, const uint8_t *bytes, uint32_t count)
{
    struct linux_i2cdev *i2cdev = device;
    while (count > 0) {
        uint32_t part = count < i2cdev->max_bytes ? count : i2cdev->max_bytes;
        i2cdev->bytes[0] = PIXELS;
        memcpy(i2cdev->bytes + 1, bytes, part);
        int error = try_send(i2cdev, 1 + part);
        if (is_too_long(error) && part / 2 >= SMALLEST) {
            i2cdev->max_bytes = part / 2;
            continue;
        }
        if (error != 0) {
            return send_failed(i2cdev, error);
        }
        bytes += part;
        count -= part;
    }
    return OW_OK;
}

static int i2c_reset(void *device, uint32_t hold_us, uint32_t settle_us)
{
    struct linux_i2cdev *i2cdev = device;
    const struct linux_i2cdev_config *config = &i2cdev->config;
    const struct linux_reset_line line = { config->system, config->gpio, config->reset };
    return linux_reset_pulse(&line, hold_us, settle_us, &i2cdev->fault, config->device);
}

static int i2c_limits(void *device, struct ow_bus_limits *limits)
{
    const struct linux_i2cdev *i2cdev = device;
    limits->max_bytes = i2cdev->max_bytes;
    limits->clock_hz = i2cdev->config.clock_hz;
    limits->transfer_bytes = OVERHEAD;
    return OW_OK;
}

const struct ow_bus_ops linux_i2cdev_ops = {
    .command = i2c_command,
    .pixels = i2c_pixels,
    .reset = i2c_reset,
    .limits = i2c_limits,
};
