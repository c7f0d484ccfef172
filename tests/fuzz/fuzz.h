/* SPDX-License-Identifier: 0BSD */
/* What every fuzz target defines and replay.c and libFuzzer call. */
#ifndef OLDWELL_TESTS_FUZZ_H
#define OLDWELL_TESTS_FUZZ_H

#include <stddef.h>
#include <stdint.h>

/* Handles one input; 0. Anything wrong aborts. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#endif
