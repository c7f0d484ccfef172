/* SPDX-License-Identifier: 0BSD */
/* hal/gpio.h on Linux by libgpiod: lines by chip and name, label or number. */
#ifndef OW_HAL_LINUX_GPIO_H
#define OW_HAL_LINUX_GPIO_H

#include "hal/gpio.h"
#include "hal/linux/fault.h"
#include "hal/linux/gpio_lib.h"

enum { LINUX_GPIO_LINES = 32, LINUX_GPIO_NAME = 64 };

struct linux_gpio_config {
    const struct linux_gpio_lib *lib; /* NULL: this program was built without libgpiod */
    const char *folder;               /* with the chips' nodes; NULL: /dev */
    const char *user;                 /* whom others see on the lines; NULL: oldwell */
};

/* An open line. Private. */
struct linux_gpio_line {
    void *chip;
    void *line;
    char name[LINUX_GPIO_NAME + 32];
    uint8_t edges;
    bool waits; /* an edge that was read and not reported yet */
    struct linux_gpio_edge edge;
    uint32_t number;      /* of the edge read last */
    uint64_t debounce_ns; /* 0: the kernel does it, or nobody */
    uint64_t quiet_ns;    /* no edge before this is believed */
    bool level;           /* reported last */
    bool unsure;          /* an edge was dropped: the level is looked at when it is quiet */
};

/* Private but for fault. */
struct linux_gpio {
    struct linux_fault fault; /* of the call that failed last */
    struct linux_gpio_config config;
    struct linux_gpio_line lines[LINUX_GPIO_LINES];
    int timer; /* readable when an unsure line is quiet; -1: there is none */
    bool lost;
};

/* Device: struct linux_gpio. */
extern const struct ow_gpio_ops linux_gpio_ops;

void linux_gpio_init(struct linux_gpio *gpio, const struct linux_gpio_config *config);
/* Gives all lines back. */
void linux_gpio_close(struct linux_gpio *gpio);

/*
 * Descriptors to wait for: of the line that open returned; -1 where it reports
 * no edges. And of the timer of lines that are debounced here, -1: none.
 */
int linux_gpio_fd(const struct linux_gpio *gpio, int line);
int linux_gpio_timer_fd(const struct linux_gpio *gpio);

#endif
