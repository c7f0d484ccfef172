/* SPDX-License-Identifier: 0BSD */
/* Flatness of polygons, and polygons cut into triangles through their own corners. */
#ifndef OWC_TRIANGULATE_H
#define OWC_TRIANGULATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The area vector times 2 of an outline (Newell's sum). */
void outline_area(const double (*points)[3], uint32_t count, double area[3]);

/* True if no corner is farther than limit from the plane of Newell's normal through the middle. */
bool outline_is_flat(const double (*points)[3], uint32_t count, double limit);

/*
 * Cuts an outline into count - 2 triangles: corner numbers, three a triangle,
 * the outline's way round. Ears where it is concave as seen along the area
 * vector, a fan where it is convex.
 */
void outline_triangulate(const double (*points)[3], uint32_t count, uint32_t (*triangles)[3]);

#endif
