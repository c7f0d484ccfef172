/* SPDX-License-Identifier: 0BSD */
/* The text of OBJ files: what assimp does not tell or would lose. */
#ifndef OWC_OBJ_TEXT_H
#define OWC_OBJ_TEXT_H

#include <stdbool.h>
#include <stddef.h>

#include "problem.h"

/*
 * Turns the lines that begin groups and objects into comments: assimp gathers
 * polygons by these names, without them it keeps the file's order.
 */
void obj_hide_groups(char *text, size_t size);

/*
 * Checks coordinates and vertex numbers, with the line of the first that is
 * wrong. text ends with a zero byte at text[size].
 */
bool obj_check(const char *text, size_t size, struct problem *problem);

#endif
