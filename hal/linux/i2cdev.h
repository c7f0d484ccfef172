/* SPDX-License-Identifier: 0BSD */
/* hal/bus.h on Linux: I2C by i2c-dev, where a control byte stands for D/C (SSD1306 and kin). */
#ifndef OW_HAL_LINUX_I2CDEV_H
#define OW_HAL_LINUX_I2CDEV_H

#include "hal/bus.h"
#include "hal/gpio.h"
#include "hal/linux/fault.h"
#include "hal/linux/system.h"

enum { LINUX_I2CDEV_BYTES = 1024 }; /* of pixels in a transfer, at most */

struct linux_i2cdev_config {
    const struct linux_system *system;
    const char *device;         /* its path, /dev/i2c-1; stays */
    uint8_t address;            /* 7 bits; 0x3C or 0x3D */
    uint32_t clock_hz;          /* of the bus, which is set elsewhere; 0: unknown */
    uint32_t max_bytes;         /* of pixels in a transfer; 0: LINUX_I2CDEV_BYTES */
    const struct ow_gpio *gpio; /* of RESET; NULL: there is none */
    int reset;                  /* an output line as gpio's open returned it, level 1 resets */
};

/* Private but for fault. */
struct linux_i2cdev {
    struct linux_fault fault;
    struct linux_i2cdev_config config;
    int fd;
    uint32_t max_bytes;
    uint8_t bytes[1 + LINUX_I2CDEV_BYTES]; /* the control byte and what follows */
};

/* Device: struct linux_i2cdev. */
extern const struct ow_bus_ops linux_i2cdev_ops;

/* As linux_spidev_open. Whether the panel answers is seen with the first command. */
int linux_i2cdev_open(struct linux_i2cdev *i2cdev, const struct linux_i2cdev_config *config);
void linux_i2cdev_close(struct linux_i2cdev *i2cdev);

#endif
