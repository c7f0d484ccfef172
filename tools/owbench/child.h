/* SPDX-License-Identifier: 0BSD */
/* Programs that are run for so many seconds at most. */
#ifndef OWBENCH_CHILD_H
#define OWBENCH_CHILD_H

#include <stdbool.h>

/* Sets the folder in which programs are looked for: that of this program, argv[0]. */
void child_set_folder(const char *self);

/*
 * Runs a program of that folder; arguments end with NULL, its own name excepted.
 * What it says on standard error is dropped. False: it failed, or was ended
 * because its time was up.
 */
bool child_run(const char *program, const char *const *arguments, double seconds);

#endif
