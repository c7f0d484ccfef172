/* SPDX-License-Identifier: 0BSD */
/* In the place of libgpiod where it was not installed. */
#include "hal/linux/gpio_lib.h"

const struct linux_gpio_lib *const linux_gpio_installed = NULL;
