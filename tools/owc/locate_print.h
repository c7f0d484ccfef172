/* SPDX-License-Identifier: 0BSD */
/* The location problem as a command. */
#ifndef OWC_LOCATE_PRINT_H
#define OWC_LOCATE_PRINT_H

/*
 * Prints on standard output in which convex region of the tree in a file a
 * point lies, model units: the region's number, and its planes from the root down.
 */
void locate_print(const char *path, const double point[3]);

#endif
