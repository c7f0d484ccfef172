/* SPDX-License-Identifier: 0BSD */
/* Several inputs as one, their events in the order of time. */
#ifndef OW_HAL_LINUX_INPUTS_H
#define OW_HAL_LINUX_INPUTS_H

#include "hal/input.h"

enum { LINUX_INPUTS = 8 };

/* Private. All zero: no input yet. */
struct linux_inputs {
    struct ow_input sources[LINUX_INPUTS];
    struct ow_input_event ahead[LINUX_INPUTS]; /* taken and not handed on yet */
    bool waits[LINUX_INPUTS];
    bool gone[LINUX_INPUTS];
    uint32_t count;
};

/* Device: struct linux_inputs. OW_GONE when all are. */
extern const struct ow_input_ops linux_inputs_ops;

/* OW_CAPACITY: there are LINUX_INPUTS already; OW_UNSUPPORTED: it has no functions. */
int linux_inputs_add(struct linux_inputs *inputs, const struct ow_input *source);

#endif
