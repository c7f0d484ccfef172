/* SPDX-License-Identifier: 0BSD */
/*
 * Memory of devices that may be unplugged. Touching it then raises SIGBUS; for
 * memory that is guarded here zeros take its place and the loss is noted, so
 * that a frame under way ends in order and the driver can say what happened.
 */
#ifndef OW_HAL_LINUX_MAPPING_H
#define OW_HAL_LINUX_MAPPING_H

#include <stdbool.h>
#include <stddef.h>

#include "hal/linux/system.h"

enum { LINUX_MAPPINGS = 16 };

/* Maps bytes of a device and guards them; NULL and errno for a failure. */
void *linux_map(const struct linux_system *system, size_t bytes, int fd, uint64_t offset);

/* Has the memory gone from under this mapping? */
bool linux_map_is_lost(const void *memory);

void linux_unmap(const struct linux_system *system, void *memory, size_t bytes);

#endif
