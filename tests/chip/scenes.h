/* SPDX-License-Identifier: 0BSD */
/*
 * Scenes that every machine draws alike: the viewer on a panel that only takes
 * a checksum of what it is sent. The same source runs on a host and on each
 * board, so that their figures can be compared.
 */
#ifndef OLDWELL_TESTS_CHIP_SCENES_H
#define OLDWELL_TESTS_CHIP_SCENES_H

#include <stdint.h>

#include "firmware/viewer/viewer.h"

struct scene {
    const char *name;
    uint16_t width;
    uint16_t height;
    const struct ow_pixel_format *format;
    enum ow_order order;
    enum ow_shade shade;
    bool coverage;
    uint16_t band_lines;      /* 0: all */
    uint32_t cached_vertices; /* 0: all */
    uint32_t views;           /* of one turn */
};

extern const struct scene scenes[];
extern const uint32_t scene_count;

struct scene_result {
    int status;
    uint32_t crc;          /* zlib's, over the packed rows of all frames */
    uint64_t units;        /* that drawing took, by scene_units */
    uint32_t memory_bytes; /* that the viewer wanted */
};

/* Draws a scene. The tree must have normals if the scene is smooth. */
void scene_draw(const struct scene *scene, const struct ow_tree *tree, void *memory,
                uint32_t memory_bytes, struct scene_result *result);

/* The platform's: a counter that grows by one for each unit of work, and may wrap. */
uint32_t scene_units(void);

/* "scene NAME frames N crc32 N" and, if they were counted, " units N", of a frame; at most 120 bytes. */
void scene_line(char *line, const struct scene *scene, const struct scene_result *result);

#endif
