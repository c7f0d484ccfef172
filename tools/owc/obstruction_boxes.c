/* SPDX-License-Identifier: 0BSD */
/* Boxes around faces: halved at the median along the longest side. */
#include "obstruction_boxes.h"

#include <math.h>
#include <stdlib.h>

#include "tools/common/xalloc.h"

static void enclose(const struct obstruction_boxes *boxes, struct obstruction_box *box)
{
    double low[3] = { INFINITY, INFINITY, INFINITY };
    double high[3] = { -INFINITY, -INFINITY, -INFINITY };
    const struct obstruction_set *set = boxes->set;
    for (uint32_t i = box->first; i < box->first + box->count; i++) {
        const struct obstruction_face *face = &set->faces[boxes->faces[i]];
        for (size_t p = face->first; p < face->first + face->count; p++) {
            for (int k = 0; k < 3; k++) {
                low[k] = smaller(low[k], set->points[p][k]);
                high[k] = larger(high[k], set->points[p][k]);
            }
        }
    }
    for (int k = 0; k < 3; k++) {
        box->middle[k] = (low[k] + high[k]) / 2;
        box->half[k] = (high[k] - low[k]) / 2 + OBSTRUCTION_DOUBT;
    }
}

/* Puts the smaller half of the faces first: Hoare's selection, on (centre, number). */
static void halve(const struct obstruction_boxes *boxes, uint32_t *faces, uint32_t count, int axis)
{
    const struct obstruction_face *all = boxes->set->faces;
    uint32_t low = 0;
    uint32_t high = count - 1;
    uint32_t middle = count / 2;
    while (low < high) {
        uint32_t pivot = faces[low + (high - low) / 2];
        double value = all[pivot].centre[axis];
        uint32_t i = low;
        uint32_t k = high;
        for (;;) {
            double at = all[faces[i]].centre[axis];
            while (at < value || (at == value && faces[i] < pivot)) {
                at = all[faces[++i]].centre[axis];
            }
            at = all[faces[k]].centre[axis];
            while (at > value || (at == value && faces[k] > pivot)) {
                at = all[faces[--k]].centre[axis];
            }
            if (i >= k) {
                break;
            }
            uint32_t swap = faces[i];
            faces[i++] = faces[k];
            faces[k--] = swap;
        }
        if (middle <= k) {
            high = k;
        } else {
            low = k + 1;
        }
    }
}

/* Depth is the logarithm of the number of faces: recursion is safe. */
static void grow(struct obstruction_boxes *boxes, uint32_t first, uint32_t count)
{
    struct obstruction_box *box = &boxes->all[boxes->count++];
    box->first = first;
    box->count = count;
    enclose(boxes, box);
    if (count > OBSTRUCTION_LEAF) {
        const double *half = box->half;
        int axis = half[0] >= half[1] && half[0] >= half[2] ? 0 : half[1] >= half[2] ? 1 : 2;
        halve(boxes, boxes->faces + first, count, axis);
        grow(boxes, first, count / 2);
        grow(boxes, first + count / 2, count - count / 2);
    }
    box->next = boxes->count;
}

void obstruction_boxes_begin(struct obstruction_boxes *boxes, const struct obstruction_set *set)
{
    *boxes = (struct obstruction_boxes){ .set = set };
    boxes->all = xalloc(set->count, sizeof *boxes->all); /* leaves hold half of the most, or more */
    boxes->faces = xalloc(set->count, sizeof *boxes->faces);
    for (uint32_t i = 0; i < set->count; i++) {
        boxes->faces[i] = i;
    }
    grow(boxes, 0, set->count);
}

void obstruction_boxes_free(struct obstruction_boxes *boxes)
{
    free(boxes->all);
    free(boxes->faces);
    *boxes = (struct obstruction_boxes){ 0 };
}
