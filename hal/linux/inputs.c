/* SPDX-License-Identifier: 0BSD */
/* Inputs merged by time. */
#include "hal/linux/inputs.h"

int linux_inputs_add(struct linux_inputs *inputs, const struct ow_input *source)
{
    int status = ow_input_check(source);
    if (status < 0) {
        return status;
    }
    if (inputs->count == LINUX_INPUTS) {
        return OW_CAPACITY;
    }
    inputs->sources[inputs->count++] = *source;
    return OW_OK;
}

/* Has every source that has an event show its oldest. A status other than AGAIN and GONE ends it. */
static int look(struct linux_inputs *inputs)
{
    for (uint32_t i = 0; i < inputs->count; i++) {
        if (inputs->waits[i] || inputs->gone[i]) {
            continue;
        }
        const struct ow_input *source = &inputs->sources[i];
        int status = source->ops->next(source->device, &inputs->ahead[i]);
        inputs->waits[i] = status >= 0;
        inputs->gone[i] = status == OW_GONE;
        if (status < 0 && status != OW_GONE && status != OW_AGAIN) {
            return status;
        }
    }
    return OW_OK;
}

static int inputs_next(void *device, struct ow_input_event *event)
{
    struct linux_inputs *inputs = device;
    int status = look(inputs);
    if (status == OW_CAPACITY) { /* all is released: what was taken before counts no more */
        for (uint32_t i = 0; i < inputs->count; i++) {
            inputs->waits[i] = false;
        }
    }
    if (status < 0) {
        return status;
    }
    uint32_t oldest = inputs->count;
    bool any_left = false;
    for (uint32_t i = 0; i < inputs->count; i++) {
        any_left = any_left || !inputs->gone[i];
        if (inputs->waits[i] &&
            (oldest == inputs->count || inputs->ahead[i].time_us < inputs->ahead[oldest].time_us)) {
            oldest = i;
        }
    }
    if (oldest == inputs->count) {
        return any_left ? OW_AGAIN : OW_GONE;
    }
    inputs->waits[oldest] = false;
    *event = inputs->ahead[oldest];
    return OW_OK;
}

const struct ow_input_ops linux_inputs_ops = { inputs_next };
