/* SPDX-License-Identifier: 0BSD */
/* A model as the file has it: polygons of any number of corners in model coordinates. */
#ifndef OWC_MODEL_H
#define OWC_MODEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { MODEL_DEFAULT_COLOUR = 0xCCCCCC };

struct model_polygon {
    size_t first;    /* of its corners */
    uint32_t count;  /* corners, at least 3 */
    uint16_t colour; /* index into colours */
};

/* Polygons are in the file's order: polygon i is the file's polygon i + 1. */
struct model {
    double (*vertices)[3];
    float (*normals)[3]; /* one a vertex; all zero where the file has none */
    size_t vertex_count;
    size_t vertex_capacity;
    size_t normal_capacity;
    uint32_t *corners; /* vertex numbers, counter-clockwise seen from the front */
    size_t corner_count;
    size_t corner_capacity;
    struct model_polygon *polygons;
    size_t polygon_count;
    size_t polygon_capacity;
    uint32_t *colours; /* 0x00RRGGBB */
    size_t colour_count;
    size_t colour_capacity;
    uint64_t lines_dropped;   /* lines and points: they are no polygons */
    uint64_t colours_changed; /* materials that came too late for a colour of their own */
};

#endif
