/* SPDX-License-Identifier: 0BSD */
/* Bytes in and out: a UART, a pipe, a connection. Reading and writing are both partial. */
#ifndef OW_HAL_STREAM_H
#define OW_HAL_STREAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "ow_status.h"

struct ow_stream_ops {
    /*
     * Reads 1 .. count bytes and returns how many; 0: the other side has closed,
     * no byte will come. OW_AGAIN: none now; OW_GONE: the connection broke;
     * OW_CAPACITY, once: bytes were lost before the next ones. count is
     * 1 .. INT32_MAX. Never waits. Mandatory.
     */
    int (*read)(void *device, void *bytes, uint32_t count);

    /*
     * Writes 1 .. count bytes and returns how many; the bytes are the caller's
     * again at once. OW_AGAIN: there is no room now; OW_GONE. Never waits. Optional.
     */
    int (*write)(void *device, const void *bytes, uint32_t count);
};

struct ow_stream {
    const struct ow_stream_ops *ops;
    void *device;
};

/* OW_UNSUPPORTED where a mandatory function is missing. */
static inline int ow_stream_check(const struct ow_stream *stream)
{
    bool complete = stream != NULL && stream->ops != NULL && stream->ops->read != NULL;
    return complete ? OW_OK : OW_UNSUPPORTED;
}

static inline int ow_stream_write(const struct ow_stream *stream, const void *bytes, uint32_t count)
{
    return stream->ops->write == NULL ? OW_UNSUPPORTED
                                      : stream->ops->write(stream->device, bytes, count);
}

#endif
