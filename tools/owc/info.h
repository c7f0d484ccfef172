/* SPDX-License-Identifier: 0BSD */
/* Checking and describing a blob. */
#ifndef OWC_INFO_H
#define OWC_INFO_H

/* Describes the blob on standard output; fails with the core's words if it is not a valid one. */
void info_print(const char *path);

#endif
