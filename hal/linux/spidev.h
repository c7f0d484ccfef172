/* SPDX-License-Identifier: 0BSD */
/* hal/bus.h on Linux: 4-wire SPI by spidev, with D/C and RESET as GPIO lines. */
#ifndef OW_HAL_LINUX_SPIDEV_H
#define OW_HAL_LINUX_SPIDEV_H

#include "hal/bus.h"
#include "hal/gpio.h"
#include "hal/linux/fault.h"
#include "hal/linux/system.h"

struct linux_spidev_config {
    const struct linux_system *system;
    const char *device;   /* its path, /dev/spidev0.0; stays */
    uint32_t clock_hz;    /* to ask for */
    uint8_t mode;         /* 0 .. 3 */
    bool lsb_first;       /* the lowest bit goes first */
    bool no_select;       /* chip select is not driven */
    uint32_t transfer_us; /* what a transfer takes beside its bytes; 0: 25 */
    const char *bufsiz;   /* the file that says how long a transfer may be; NULL: spidev's own */
    const struct ow_gpio *gpio;
    int data;  /* D/C: output lines as gpio's open returned them, level 1 for data */
    int reset; /* level 1 resets (open it as active low); negative: there is none */
};

/* Private but for fault. */
struct linux_spidev {
    struct linux_fault fault;
    struct linux_spidev_config config;
    int fd;
    uint32_t max_bytes; /* of a transfer */
    uint32_t clock_hz;  /* what the driver says */
    int level;          /* of D/C; -1: unknown */
};

/* Device: struct linux_spidev. */
extern const struct ow_bus_ops linux_spidev_ops;

/*
 * Opens and sets up. On failure nothing stays open and spidev->fault says why:
 * OW_GONE, OW_DENIED, OW_BUSY, OW_UNSUPPORTED (mode or rate), OW_BUS.
 */
int linux_spidev_open(struct linux_spidev *spidev, const struct linux_spidev_config *config);

/* Safe on one that is not open. The lines are the board's. */
void linux_spidev_close(struct linux_spidev *spidev);

#endif
