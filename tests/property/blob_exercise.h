/* SPDX-License-Identifier: 0BSD */
/* Takes some bytes for a blob and uses them in every way the core offers. */
#ifndef OLDWELL_TESTS_BLOB_EXERCISE_H
#define OLDWELL_TESTS_BLOB_EXERCISE_H

#include <stdint.h>

#include "ow_status.h"

/*
 * Opens the blob and, if that succeeds, walks and draws it in several views,
 * orders, shades and bands, all memory being heap blocks of exactly the size
 * asked for: a sanitizer sees any access beyond. Aborts if a walk does not meet
 * face_count faces, or if a status or a count contradicts another. Returns
 * what ow_tree_open said.
 */
enum ow_status blob_exercise(const uint8_t *bytes, uint32_t size);

#endif
