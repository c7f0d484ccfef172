/* SPDX-License-Identifier: 0BSD */
/* The plane image: a blob's bytes as grey pixels, one for each pixel of a frame buffer. */
#ifndef OWC_PLANES_H
#define OWC_PLANES_H

#include <stdio.h>

#include "blob_write.h"

/* Ends the program, naming the model, if size[0] x size[1] pixels do not hold the blob. */
void planes_check(const struct blob *blob, const uint32_t size[2], const char *model);

/*
 * Writes a binary PGM: byte i of the blob is pixel i, line by line; the pixels
 * behind the blob are 0. In the frame buffer each is the spare byte of a pixel.
 */
void planes_write(FILE *stream, const struct blob *blob, const uint32_t size[2]);

#endif
