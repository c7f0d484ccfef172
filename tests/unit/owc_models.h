/* SPDX-License-Identifier: 0BSD */
/* Small models for the compiler's tests, and checks of the trees made of them. */
#ifndef OLDWELL_TESTS_UNIT_OWC_MODELS_H
#define OLDWELL_TESTS_UNIT_OWC_MODELS_H

#include <stdbool.h>
#include <stdint.h>

#include "ow_tree.h"
#include "tools/owc/compile.h"
#include "tools/owc/model.h"

/* Models begin all zero; import_free frees them. */
uint32_t models_vertex(struct model *model, double x, double y, double z);
void models_polygon(struct model *model, const uint32_t *corners, uint32_t count);

/* A turn about z, then one about x, then a move. */
struct models_pose {
    double about_z;
    double about_x;
    double at[3];
};

/* A box of this size about its own middle, outwards; each side in cells x cells squares. */
void models_box(struct model *model, const double size[3], uint32_t cells,
                const struct models_pose *pose);
void models_tetrahedron(struct model *model, double size, const struct models_pose *pose);

/* A closed prism over a flat outline; outline: x, y of each corner, counter-clockwise. */
void models_prism(struct model *model, const double (*outline)[2], uint32_t count, double height);

/* kedem, k = 5, seed 1, sides auto, tolerance one step, numbers kept. */
struct compile_options models_options(void);

/* Compiles; a model that is refused ends the test. */
void models_compile(struct blob *blob, struct compile_stats *stats, const struct model *model,
                    const struct compile_options *options);

/* A polygon record, read. */
struct models_record {
    uint32_t count;
    uint32_t source; /* 0 without OW_TREE_IDS */
    uint32_t look;
    int8_t normal[3];
    uint32_t corners[OW_MAX_CORNERS];
    bool marks[OW_MAX_CORNERS];
};

/* Reads the record at a byte offset of the blob; returns the offset after it. */
uint32_t models_read_record(const struct ow_tree *tree, uint32_t at, struct models_record *record);

/* A vertex's lattice coordinates. */
void models_read_vertex(const struct ow_tree *tree, uint32_t vertex, int32_t at[3]);

/* Edges of the tree's polygons that run more often one way than the other. */
uint32_t models_open_edges(const struct ow_tree *tree);

#endif
