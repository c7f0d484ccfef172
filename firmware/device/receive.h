/* SPDX-License-Identifier: 0BSD */
/*
 * A tree that comes over a stream: its header says how long it is and its
 * checksum whether it is whole, so the bytes of the file are the protocol.
 * Bytes between trees are commands of one letter.
 */
#ifndef OW_DEVICE_RECEIVE_H
#define OW_DEVICE_RECEIVE_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/stream.h"

struct receiver {
    uint8_t *arena; /* where the tree goes */
    uint32_t capacity;
    uint32_t got;     /* bytes of the tree so far; 0: none is coming */
    uint32_t needed;  /* all its bytes, known from the 12th on */
    int refused;      /* why the rest is thrown away, OW_OK: it is not */
    uint64_t last_us; /* when the last byte came */
};

enum receiver_result {
    RECEIVER_NOTHING, /* no byte came */
    RECEIVER_BUSY,    /* some did */
    RECEIVER_COMMAND, /* *command is one */
    RECEIVER_TREE,    /* a tree is in the arena, or `refused` says why not */
    RECEIVER_GONE     /* the stream has ended */
};

/* Takes what the stream has, as far as one result goes. Never waits. */
enum receiver_result receiver_take(struct receiver *receiver, const struct ow_stream *stream,
                                   uint64_t now_us, char *command);

#endif
