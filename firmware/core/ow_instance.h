/* SPDX-License-Identifier: 0BSD */
/*
 * Instances: objects that move as a whole [FAG83]. When the walk comes to one,
 * eye, view and lights are brought into its space; when it leaves, back.
 */
#ifndef OW_INSTANCE_H
#define OW_INSTANCE_H

#include "ow_frame.h"
#include "ow_read.h"

/* As stored, in lattice steps. */
struct ow_instance {
    uint32_t node_at; /* the object's root */
    uint32_t first_vertex;
    uint32_t end_vertex;
    uint32_t zero;
    int32_t region_min[3];
    int32_t region_max[3];
    int32_t centre[3];
    uint32_t radius;
};

struct ow_instance ow_read_instance(const struct ow_tree *tree, uint32_t number);

/* What drawing instances needs beside the frame; it lies in the workspace. */
struct ow_instance_state {
    struct ow_view view; /* as seen from the object */
    struct ow_shader shader;
    const struct ow_view *tree_view;
    struct ow_shader tree_shader;
};

#endif
