/* SPDX-License-Identifier: 0BSD */
/* Statuses: what every function of the core and of the HAL can answer. */
#ifndef OW_STATUS_H
#define OW_STATUS_H

/*
 * Zero is success, failures are negative; a function that counts returns the
 * count as a positive number. Values are stable: they cross wires and logs.
 */
enum ow_status {
    OW_OK = 0,
    /* The caller's side. */
    OW_ARGUMENT = -1, /* a parameter is out of its stated range */
    OW_MEMORY = -2,   /* the memory handed in is smaller than ..._bytes_needed */
    OW_CAPACITY = -3, /* a capacity ran out: less was drawn, nothing was written past */
    OW_SIDES = -4,    /* a one-sided tree with sequences cannot show back faces */
    OW_NORMALS = -5,  /* smooth shading of a tree without vertex normals */
    OW_BUDGET = -6,   /* the work budget ran out: what is near is right, the rest is background */
    OW_REGION = -7,   /* an object is outside its region: what hides what may be wrong there */
    /* The blob's side. */
    OW_MAGIC = -16,     /* these bytes are not an Oldwell tree */
    OW_VERSION = -17,   /* a tree of another format version */
    OW_TRUNCATED = -18, /* fewer bytes than the header promises */
    OW_CHECKSUM = -19,  /* a byte differs from what the compiler wrote */
    OW_CORRUPT = -20,   /* an index, count, order or depth contradicts another */
    /* The devices' side. */
    OW_AGAIN = -32,       /* nothing now; ask again */
    OW_TIMEOUT = -33,     /* the device did not answer in time */
    OW_UNSUPPORTED = -34, /* this device cannot do that; go on without */
    OW_GONE = -35,        /* the device is not there (any more) */
    OW_DENIED = -36,      /* no permission */
    OW_BUSY = -37,        /* somebody else holds the device */
    OW_BUS = -38,         /* a transfer failed */
    OW_FULL = -39         /* the store or the disk is full */
};

/* A sentence for people about a status; never NULL, "unknown status" for any other value. */
const char *ow_status_text(int status);

#endif
