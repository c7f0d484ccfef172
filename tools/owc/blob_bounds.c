/* SPDX-License-Identifier: 0BSD */
/* Bounds of nodes. */
#include "blob_bounds.h"

#include <math.h>
#include <stddef.h>

#include "mesh.h"
#include "ow_blob.h"

enum { LEAST_ITEMS = 16, LOOK_EVERYWHERE = -128 };

bool blob_is_bounded(const struct tree *tree, const struct tree_node *node)
{
    if (node->plane != MESH_NONE || node->count < LEAST_ITEMS) {
        return false;
    }
    for (uint32_t i = 0; i < node->count; i++) {
        if (tree_item_tag(tree->items[node->first + i]) == OW_ITEM_NODE) {
            return false;
        }
    }
    return true;
}

/* The outlines of a face item: first .. *end - 1. */
static uint32_t outlines(const struct repaired *repaired, tree_item item, uint32_t *end)
{
    *end = repaired->first[tree_item_value(item) + 1];
    return repaired->first[tree_item_value(item)];
}

static void find_box(const struct repaired *repaired, const struct tree *tree,
                     const struct tree_node *node, int low[3], int high[3])
{
    for (int k = 0; k < 3; k++) {
        low[k] = OW_LATTICE_MAX;
        high[k] = -OW_LATTICE_MAX;
    }
    for (uint32_t i = 0; i < node->count; i++) {
        uint32_t end;
        for (uint32_t o = outlines(repaired, tree->items[node->first + i], &end); o < end; o++) {
            const struct outline_final *outline = &repaired->outlines[o];
            for (size_t c = outline->first; c < outline->first + outline->count; c++) {
                for (int k = 0; k < 3; k++) {
                    int at = repaired->corners[c][k];
                    low[k] = at < low[k] ? at : low[k];
                    high[k] = at > high[k] ? at : high[k];
                }
            }
        }
    }
}

static void find_sphere(struct blob_bounds *bounds, const struct repaired *repaired,
                        const struct tree *tree, const struct tree_node *node)
{
    int low[3];
    int high[3];
    int64_t most = 0;
    find_box(repaired, tree, node, low, high);
    for (int k = 0; k < 3; k++) {
        bounds->centre[k] = (int16_t)((low[k] + high[k]) / 2);
    }
    for (uint32_t i = 0; i < node->count; i++) {
        uint32_t end;
        for (uint32_t o = outlines(repaired, tree->items[node->first + i], &end); o < end; o++) {
            const struct outline_final *outline = &repaired->outlines[o];
            for (size_t c = outline->first; c < outline->first + outline->count; c++) {
                int64_t square = 0;
                for (int k = 0; k < 3; k++) {
                    int64_t way = repaired->corners[c][k] - bounds->centre[k];
                    square += way * way;
                }
                most = square > most ? square : most;
            }
        }
    }
    bounds->radius = (uint16_t)ceil(sqrt((double)most)); /* at most 56756 */
}

/* The axis, and the least cosine that the faces' normals have with it. */
static void find_cone(struct blob_bounds *bounds, const struct repaired *repaired,
                      const struct tree *tree, const struct tree_node *node)
{
    double sum[3] = { 0, 0, 0 };
    double least = 1;
    for (int pass = 0; pass < 2; pass++) {
        for (uint32_t i = 0; i < node->count; i++) {
            tree_item item = tree->items[node->first + i];
            int sign = tree_item_tag(item) == OW_ITEM_REVERSE ? -1 : 1;
            uint32_t end;
            for (uint32_t o = outlines(repaired, item, &end); o < end; o++) {
                const int8_t *n = repaired->outlines[o].normal;
                double along = 0;
                double square = 0;
                if (repaired->outlines[o].uneven) {
                    bounds->cosine = LOOK_EVERYWHERE;
                    return;
                }
                for (int k = 0; k < 3; k++) {
                    sum[k] += pass == 0 ? sign * n[k] : 0;
                    along += sign * n[k] * bounds->axis[k];
                    square += n[k] * n[k];
                }
                least = pass == 1 ? fmin(least, along / sqrt(square)) : least;
            }
        }
        double length = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
        double axis = 0;
        for (int k = 0; k < 3 && pass == 0; k++) {
            bounds->axis[k] = length > 0 ? (int8_t)floor(127 * sum[k] / length + 0.5) : 0;
        }
        for (int k = 0; k < 3; k++) {
            axis += bounds->axis[k] * bounds->axis[k];
        }
        if (!(axis > 0)) {
            bounds->cosine = LOOK_EVERYWHERE;
            return;
        }
        least = pass == 1 ? least / sqrt(axis) : 127;
    }
    bounds->cosine = (int8_t)fmax(-127, floor(127 * least - 1e-6));
}

void blob_bounds_find(struct blob_bounds *bounds, const struct repaired *repaired,
                      const struct tree *tree, const struct tree_node *node)
{
    *bounds = (struct blob_bounds){ .cosine = LOOK_EVERYWHERE };
    find_sphere(bounds, repaired, tree, node);
    find_cone(bounds, repaired, tree, node);
}
