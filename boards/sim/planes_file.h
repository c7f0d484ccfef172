/* SPDX-License-Identifier: 0BSD */
/* A plane image: a tree's bytes as the grey pixels of a PGM, and zeros behind them. */
#ifndef OLDWELL_BOARDS_SIM_PLANES_FILE_H
#define OLDWELL_BOARDS_SIM_PLANES_FILE_H

#include <stddef.h>
#include <stdint.h>

/*
 * Reads the head of a binary PGM (P5, 255) of width x height pixels, each up to
 * OW_SCREEN_MAX. Returns where in the file its pixels begin, or 0 if this is no
 * such file or its pixels are not all there.
 */
size_t planes_file_head(const uint8_t *file, size_t bytes, uint32_t size[2]);

#endif
