/* SPDX-License-Identifier: 0BSD */
/* hal/clock.h by the kernel's monotonic clock. */
#ifndef OW_HAL_LINUX_CLOCK_H
#define OW_HAL_LINUX_CLOCK_H

#include "hal/clock.h"
#include "hal/linux/system.h"

/* Device: const struct linux_system. A signal does not shorten a sleep. */
extern const struct ow_clock_ops linux_clock_ops;

#endif
