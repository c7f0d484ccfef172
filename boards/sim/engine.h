/* SPDX-License-Identifier: 0BSD */
/*
 * The viewer and the core as owsim calls them. They are in the program three
 * times, compiled to read trees from memory and from bit planes 4 or 3 bytes
 * apart (OW_STRIDE); the build gives the names of the copies a prefix.
 */
#ifndef OLDWELL_BOARDS_SIM_ENGINE_H
#define OLDWELL_BOARDS_SIM_ENGINE_H

#include "firmware/viewer/viewer.h"

struct engine {
    enum ow_status (*tree_open)(struct ow_tree *tree, const void *bytes, uint32_t size);
    const struct ow_parts *parts;
    const struct ow_surface_kind *segments; /* may stand in parts.dynamic */
    uint32_t (*bytes_needed)(const struct ow_viewer_config *config);
    int (*start)(struct ow_viewer *viewer, const struct ow_viewer_config *config, void *memory,
                 uint32_t bytes);
    int (*step)(struct ow_viewer *viewer);
    void (*restart)(struct ow_viewer *viewer);
};

extern const struct engine ow_engine;
extern const struct engine planes4_ow_engine;
extern const struct engine planes3_ow_engine;

#endif
