/* SPDX-License-Identifier: 0BSD */
/* The board: what belongs to no device of its own. Both functions are optional. */
#ifndef OW_HAL_BOARD_H
#define OW_HAL_BOARD_H

#include <stddef.h>
#include <stdint.h>

#include "ow_status.h"

enum ow_log_level { OW_LOG_ERROR, OW_LOG_WARNING, OW_LOG_INFO };

struct ow_board_ops {
    /* Prints one line; text: no line end in it, used during the call only. May drop lines. */
    int (*log)(void *device, enum ow_log_level level, const char *text);

    /*
     * Starts or feeds the watchdog: the board restarts unless this is called
     * again within limit_us microseconds (the next longer time that the hardware
     * has). 0 stops it; OW_UNSUPPORTED where it cannot be stopped.
     */
    int (*watchdog)(void *device, uint32_t limit_us);
};

struct ow_board {
    const struct ow_board_ops *ops;
    void *device;
};

/* board may be NULL: then nobody listens. */
static inline int ow_board_log(const struct ow_board *board, enum ow_log_level level,
                               const char *text)
{
    return board == NULL || board->ops->log == NULL ? OW_UNSUPPORTED
                                                    : board->ops->log(board->device, level, text);
}

static inline int ow_board_watchdog(const struct ow_board *board, uint32_t limit_us)
{
    return board == NULL || board->ops->watchdog == NULL
               ? OW_UNSUPPORTED
               : board->ops->watchdog(board->device, limit_us);
}

#endif
