/* SPDX-License-Identifier: 0BSD */
/*
 * A file in the place of a panel: it holds the pixels of the frame shown last,
 * packed rows, top down, each padded to 4 bytes. For trying out without a
 * device, and for tests.
 */
#ifndef OW_HAL_LINUX_RAW_FILE_H
#define OW_HAL_LINUX_RAW_FILE_H

#include "hal/linux/fault.h"
#include "hal/linux/system.h"
#include "hal/panel.h"

struct linux_raw_file_config {
    const struct linux_system *system;
    const char *device; /* its path; stays; made if it is not there */
    uint16_t width;     /* pixels */
    uint16_t height;
    const struct ow_pixel_format *format;
};

/* Private but for fault. */
struct linux_raw_file {
    struct linux_fault fault;
    struct linux_raw_file_config config;
    int fd;
    uint8_t *frame;
    uint32_t stride;
    uint32_t frames;
    bool known; /* frame holds what was shown last */
};

extern const struct ow_panel_ops linux_raw_file_ops;

/* OW_GONE (no such folder), OW_DENIED, OW_MEMORY; file->fault says more. */
int linux_raw_file_open(struct linux_raw_file *file, const struct linux_raw_file_config *config);
void linux_raw_file_close(struct linux_raw_file *file);

#endif
