/* SPDX-License-Identifier: 0BSD */
/* The RESET line. */
#include "hal/linux/reset_line.h"

#include <errno.h>

enum { SECOND_US = 1000000, US_NS = 1000 };

static int pause_us(const struct linux_system *system, uint32_t wait_us)
{
    struct timespec at;
    int error;
    if (system->now(&at) != 0) {
        return OW_BUS;
    }
    uint64_t until_us =
        (uint64_t)at.tv_sec * SECOND_US + (uint64_t)at.tv_nsec / US_NS + wait_us + 1;
    at.tv_sec = (time_t)(until_us / SECOND_US);
    at.tv_nsec = (long)(until_us % SECOND_US) * US_NS;
    do {
        error = system->sleep(&at);
    } while (error == EINTR);
    return error == 0 ? OW_OK : OW_BUS;
}

static int set(const struct linux_reset_line *reset, bool level)
{
    return reset->gpio->ops->set(reset->gpio->device, reset->line, level);
}

int linux_reset_pulse(const struct linux_reset_line *reset, uint32_t hold_us, uint32_t settle_us,
                      struct linux_fault *fault, const char *device)
{
    if (reset->gpio == NULL || reset->line < 0) {
        return OW_UNSUPPORTED;
    }
    int status = set(reset, true);
    status = status < 0 ? status : pause_us(reset->system, hold_us);
    status = status < 0 ? status : set(reset, false);
    status = status < 0 ? status : pause_us(reset->system, settle_us);
    return status < 0
               ? linux_fault_note(fault, status, device, "RESET line", "its level cannot be set",
                                  "see what the kernel says (dmesg)")
               : OW_OK;
}
