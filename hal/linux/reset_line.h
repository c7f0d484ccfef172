/* SPDX-License-Identifier: 0BSD */
/* A RESET line that buses without one of their own have beside them. */
#ifndef OW_HAL_LINUX_RESET_LINE_H
#define OW_HAL_LINUX_RESET_LINE_H

#include "hal/gpio.h"
#include "hal/linux/fault.h"
#include "hal/linux/system.h"

struct linux_reset_line {
    const struct linux_system *system;
    const struct ow_gpio *gpio; /* NULL: there is no line */
    int line;                   /* level 1 resets (open it as active low); negative: none */
};

/* Holds it for hold_us, then waits settle_us. OW_UNSUPPORTED: there is no line. */
int linux_reset_pulse(const struct linux_reset_line *reset, uint32_t hold_us, uint32_t settle_us,
                      struct linux_fault *fault, const char *device);

#endif
