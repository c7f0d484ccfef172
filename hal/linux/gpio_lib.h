/* SPDX-License-Identifier: 0BSD */
/*
 * What hal/linux/gpio.c needs of libgpiod. Its major versions have other names
 * and types: each is one file that fills this table, and the build takes the one
 * that fits. A test fills it with its own. Failures are -1 or NULL with errno.
 */
#ifndef OW_HAL_LINUX_GPIO_LIB_H
#define OW_HAL_LINUX_GPIO_LIB_H

#include <stddef.h>

#include "hal/gpio.h"

struct linux_gpio_edge {
    uint64_t time_ns; /* CLOCK_MONOTONIC */
    uint32_t number;  /* of the line's edges, from 1, lost ones counted; 0: not known */
    bool level;       /* logical, after the edge */
};

struct linux_gpio_lib {
    const char *(*version)(void);
    bool debounces; /* in the kernel */

    void *(*chip_open)(const char *path);
    void (*chip_close)(void *chip);
    /* Of an open chip; text ends with a zero byte, cut at bytes. */
    void (*chip_name)(void *chip, char *text, size_t bytes);
    void (*chip_label)(void *chip, char *text, size_t bytes);
    unsigned (*chip_lines)(void *chip);
    /* The offset of the line of this name; -1 with ENOENT: there is none. */
    int (*find_line)(void *chip, const char *name);
    /* Who has the line; empty: nobody. */
    void (*line_user)(void *chip, unsigned offset, char *text, size_t bytes);

    /* chip stays open as long as the line is in use. */
    void *(*line_request)(void *chip, unsigned offset, const struct ow_gpio_request *request,
                          const char *user);
    void (*line_release)(void *line);
    int (*line_get)(void *line);
    int (*line_set)(void *line, bool level);
    /* Readable when edges are there; -1: the line reports none. */
    int (*line_fd)(void *line);
    /* 1: *edge is the oldest; 0: there is none; -1. Never waits. */
    int (*line_edge)(void *line, struct linux_gpio_edge *edge);
};

/* The installed libgpiod; NULL where this program was built without. */
extern const struct linux_gpio_lib *const linux_gpio_installed;

#endif
