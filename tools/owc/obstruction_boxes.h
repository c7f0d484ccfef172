/* SPDX-License-Identifier: 0BSD */
/*
 * Boxes around faces that lie together: where a plane puts faces is counted
 * without looking at those that are far from it.
 */
#ifndef OWC_OBSTRUCTION_BOXES_H
#define OWC_OBSTRUCTION_BOXES_H

#include <stdint.h>

#include "obstruction_faces.h"

struct obstruction_box {
    double middle[3];
    double half[3];
    uint32_t first; /* faces: places first .. first + count - 1 */
    uint32_t count;
    uint32_t next; /* the box after this one and all within it */
};

struct obstruction_boxes {
    const struct obstruction_set *set;
    struct obstruction_box *all; /* each before those within it */
    uint32_t count;
    uint32_t *faces; /* of the set, by place */
};

enum { OBSTRUCTION_LEAF = 6 }; /* most faces in a box that is not divided */

void obstruction_boxes_begin(struct obstruction_boxes *boxes, const struct obstruction_set *set);
void obstruction_boxes_free(struct obstruction_boxes *boxes);

/* The height of the box's middle above normal.x + offset = 0, and how far corners lie from that. */
static inline double obstruction_box_height(const struct obstruction_box *box,
                                            const double normal[3], double offset, double *reach)
{
    double height = offset;
    *reach = 0;
    for (int k = 0; k < 3; k++) {
        height += normal[k] * box->middle[k];
        *reach += (normal[k] < 0 ? -normal[k] : normal[k]) * box->half[k];
    }
    return height;
}

#endif
