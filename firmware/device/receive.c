/* SPDX-License-Identifier: 0BSD */
/* Receiving a tree, a byte at a time until its length is known, then in pieces. */
#include "receive.h"

#include "ow_blob.h"

enum {
    LENGTH_AT = offsetof(struct ow_disk_header, blob_bytes),
    LENGTH_KNOWN = LENGTH_AT + 4,
    QUIET_US = 500000 /* after this long without a byte no more of a tree is to be expected */
};

static uint32_t piece(const struct receiver *receiver)
{
    if (receiver->got < LENGTH_KNOWN || receiver->refused != OW_OK) {
        return 1;
    }
    return receiver->needed - receiver->got;
}

/* The length has come: does the tree fit? */
static void judge_length(struct receiver *receiver)
{
    const uint8_t *p = receiver->arena + LENGTH_AT;
    receiver->needed =
        (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
    if (receiver->needed < sizeof(struct ow_disk_header)) {
        receiver->refused = OW_CORRUPT;
    } else if (receiver->needed > receiver->capacity) {
        receiver->refused = OW_MEMORY;
    }
}

/* One byte of the head, or one that is not of a tree. */
static enum receiver_result take_byte(struct receiver *receiver, uint8_t byte, char *command)
{
    if (receiver->refused != OW_OK) {
        return RECEIVER_BUSY;
    }
    if (receiver->got < 4 && byte != (uint8_t)(OW_BLOB_MAGIC >> 8 * receiver->got)) {
        bool alone = receiver->got == 0;
        receiver->got = 0;
        *command = (char)byte;
        return alone ? RECEIVER_COMMAND : RECEIVER_BUSY;
    }
    receiver->arena[receiver->got++] = byte;
    if (receiver->got == LENGTH_KNOWN) {
        judge_length(receiver);
    }
    return RECEIVER_BUSY;
}

/* No byte came: a tree that stopped coming is cut short, a refused one is over. */
static enum receiver_result take_silence(struct receiver *receiver, uint64_t now_us)
{
    if (receiver->got == 0 || now_us < receiver->last_us + QUIET_US) {
        return RECEIVER_NOTHING;
    }
    receiver->got = 0;
    if (receiver->refused == OW_OK) {
        receiver->refused = OW_TRUNCATED;
    }
    return RECEIVER_TREE;
}

enum receiver_result receiver_take(struct receiver *receiver, const struct ow_stream *stream,
                                   uint64_t now_us, char *command)
{
    uint8_t byte;
    bool in_place = receiver->got >= LENGTH_KNOWN && receiver->refused == OW_OK;
    if (receiver->got == 0) {
        receiver->refused = OW_OK;
    }
    int status = stream->ops->read(
        stream->device, in_place ? receiver->arena + receiver->got : &byte, piece(receiver));
    if (status == OW_AGAIN) {
        return take_silence(receiver, now_us);
    }
    receiver->last_us = now_us;
    if (status == OW_CAPACITY) {
        receiver->refused = receiver->got > 0 ? OW_BUS : OW_OK;
        return RECEIVER_BUSY;
    }
    if (status <= 0) {
        return RECEIVER_GONE;
    }
    if (!in_place) {
        return take_byte(receiver, byte, command);
    }
    receiver->got += (uint32_t)status;
    if (receiver->got < receiver->needed) {
        return RECEIVER_BUSY;
    }
    receiver->got = 0;
    return RECEIVER_TREE;
}
