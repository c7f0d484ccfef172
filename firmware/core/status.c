/* SPDX-License-Identifier: 0BSD */
/* Statuses: a sentence for each. */
#include "ow_status.h"

/* Kept apart from the drawing code: a board without a log does not link it. */
const char *ow_status_text(int status)
{
    switch (status) {
    case OW_OK:
        return "success";
    case OW_ARGUMENT:
        return "an argument is out of range";
    case OW_MEMORY:
        return "the memory given is too small";
    case OW_CAPACITY:
        return "a capacity ran out; less was drawn";
    case OW_SIDES:
        return "back faces have no order in this tree; compile with --sides two";
    case OW_NORMALS:
        return "the tree has no vertex normals; compile with --normals";
    case OW_BUDGET:
        return "the work budget ran out; only what is near was drawn";
    case OW_REGION:
        return "an object is outside its region; what hides what may be wrong there";
    case OW_MAGIC:
        return "not an Oldwell tree";
    case OW_VERSION:
        return "a tree of another format version; compile the model again";
    case OW_TRUNCATED:
        return "the tree is cut short";
    case OW_CHECKSUM:
        return "the tree's checksum is wrong; a byte was changed";
    case OW_CORRUPT:
        return "the tree contradicts itself";
    case OW_AGAIN:
        return "nothing now; ask again";
    case OW_TIMEOUT:
        return "the device did not answer in time";
    case OW_UNSUPPORTED:
        return "the device cannot do that";
    case OW_GONE:
        return "the device is not there";
    case OW_DENIED:
        return "permission denied";
    case OW_BUSY:
        return "the device is in use";
    case OW_BUS:
        return "a bus transfer failed";
    case OW_FULL:
        return "no space left";
    default:
        return "unknown status";
    }
}
