/* SPDX-License-Identifier: 0BSD */
/* Small models for the compiler's tests, and checks of the trees made of them. */
#include "tests/unit/owc_models.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ow_read.h"
#include "tools/common/xalloc.h"
#include "tools/owc/map64.h"

uint32_t models_vertex(struct model *model, double x, double y, double z)
{
    size_t i = model->vertex_count++;
    model->vertices =
        xgrow(model->vertices, &model->vertex_capacity, i + 1, sizeof *model->vertices);
    model->normals = xgrow(model->normals, &model->normal_capacity, i + 1, sizeof *model->normals);
    memcpy(model->vertices[i], (double[]){ x, y, z }, sizeof model->vertices[i]);
    memset(model->normals[i], 0, sizeof model->normals[i]);
    return (uint32_t)i;
}

void models_polygon(struct model *model, const uint32_t *corners, uint32_t count)
{
    if (model->colour_count == 0) {
        model->colours = xgrow(model->colours, &model->colour_capacity, 1, sizeof(uint32_t));
        model->colours[model->colour_count++] = MODEL_DEFAULT_COLOUR;
    }
    size_t first = model->corner_count;
    model->corners =
        xgrow(model->corners, &model->corner_capacity, first + count, sizeof *model->corners);
    memcpy(model->corners + first, corners, count * sizeof *corners);
    model->corner_count += count;
    model->polygons = xgrow(model->polygons, &model->polygon_capacity, model->polygon_count + 1,
                            sizeof *model->polygons);
    model->polygons[model->polygon_count++] = (struct model_polygon){ first, count, 0 };
}

static uint32_t posed_vertex(struct model *model, const double p[3], const struct models_pose *pose)
{
    double x = cos(pose->about_z) * p[0] - sin(pose->about_z) * p[1];
    double y = sin(pose->about_z) * p[0] + cos(pose->about_z) * p[1];
    double v = cos(pose->about_x) * y - sin(pose->about_x) * p[2];
    double w = sin(pose->about_x) * y + cos(pose->about_x) * p[2];
    return models_vertex(model, x + pose->at[0], v + pose->at[1], w + pose->at[2]);
}

void models_box(struct model *model, const double size[3], uint32_t cells,
                const struct models_pose *pose)
{
    for (int side = 0; side < 6; side++) {
        int axis = side / 2;
        double sign = side % 2 ? 1 : -1;
        for (uint32_t i = 0; i < cells * cells; i++) {
            uint32_t corners[4];
            for (uint32_t k = 0; k < 4; k++) {
                uint32_t u = i % cells + (k == 1 || k == 2);
                uint32_t v = i / cells + (k >= 2);
                double p[3];
                p[axis] = sign * size[axis] / 2;
                p[(axis + 1) % 3] = size[(axis + 1) % 3] * ((double)u / cells - 0.5);
                p[(axis + 2) % 3] = size[(axis + 2) % 3] * ((double)v / cells - 0.5);
                corners[sign > 0 ? k : 3 - k] = posed_vertex(model, p, pose);
            }
            models_polygon(model, corners, 4);
        }
    }
}

void models_tetrahedron(struct model *model, double size, const struct models_pose *pose)
{
    static const double at[4][3] = { { 1, 1, 1 }, { -1, -1, 1 }, { -1, 1, -1 }, { 1, -1, -1 } };
    static const uint32_t faces[4][3] = { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } };
    uint32_t v[4];
    for (int i = 0; i < 4; i++) {
        v[i] = posed_vertex(model, (double[]){ at[i][0] * size, at[i][1] * size, at[i][2] * size },
                            pose);
    }
    for (int i = 0; i < 4; i++) {
        models_polygon(model, (uint32_t[]){ v[faces[i][0]], v[faces[i][1]], v[faces[i][2]] }, 3);
    }
}

void models_prism(struct model *model, const double (*outline)[2], uint32_t count, double height)
{
    uint32_t *low = xalloc(count, sizeof *low);
    uint32_t *high = xalloc(count, sizeof *high);
    for (uint32_t i = 0; i < count; i++) {
        low[count - 1 - i] = models_vertex(model, outline[i][0], outline[i][1], 0);
        high[i] = models_vertex(model, outline[i][0], outline[i][1], height);
    }
    models_polygon(model, low, count);
    models_polygon(model, high, count);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t j = (i + 1) % count;
        models_polygon(model,
                       (uint32_t[]){ low[count - 1 - i], low[count - 1 - j], high[j], high[i] }, 4);
    }
    free(low);
    free(high);
}

struct compile_options models_options(void)
{
    return (struct compile_options){ .select = BSP_KEDEM,
                                     .candidates = 5,
                                     .seed = 1,
                                     .sides = SIDES_AUTO,
                                     .tolerance_q8 = 256,
                                     .keep_ids = true };
}

void models_compile(struct blob *blob, struct compile_stats *stats, const struct model *model,
                    const struct compile_options *options)
{
    struct problem problem = { 0, "" };
    if (!compile_model(blob, stats, model, options, &problem)) {
        print_error("refused: %s\n", problem.text);
        assert_true(false);
    }
}

uint32_t models_read_record(const struct ow_tree *tree, uint32_t at, struct models_record *record)
{
    uint32_t step = tree->flags & OW_TREE_INDEX32 ? 4 : 2;
    memset(record, 0, sizeof *record);
    record->count = ow_read_u8(tree->bytes, at);
    record->look = ow_read_u16(tree->bytes, at + 4);
    for (uint32_t k = 0; k < 3; k++) {
        record->normal[k] = (int8_t)ow_read_i8(tree->bytes, at + 1 + k);
    }
    if (tree->flags & OW_TREE_IDS) {
        record->source = ow_read_u32(tree->bytes, at + OW_POLYGON_HEAD_BYTES);
    }
    uint32_t marks_at = at + tree->corners_in_record + record->count * step;
    for (uint32_t i = 0; i < record->count; i++) {
        uint32_t corner_at = at + tree->corners_in_record + i * step;
        record->corners[i] =
            step == 4 ? ow_read_u32(tree->bytes, corner_at) : ow_read_u16(tree->bytes, corner_at);
        if (record->look & OW_POLYGON_MARKED) {
            record->marks[i] = ow_read_u16(tree->bytes, marks_at + i / 16 * 2) >> i % 16 & 1;
        }
    }
    return at + ow_polygon_bytes(tree, at);
}

void models_read_vertex(const struct ow_tree *tree, uint32_t vertex, int32_t at[3])
{
    for (uint32_t k = 0; k < 3; k++) {
        at[k] = ow_read_i16(tree->bytes, tree->vertices_at + vertex * OW_VERTEX_BYTES + 2 * k);
    }
}

uint32_t models_open_edges(const struct ow_tree *tree)
{
    struct map64 edges = { 0 };
    int32_t *sums = xalloc_zero(tree->polygon_count * (size_t)tree->max_corners, sizeof *sums);
    struct models_record record;
    uint32_t at = tree->polygons_at;
    for (uint32_t i = 0; i < tree->polygon_count; i++) {
        at = models_read_record(tree, at, &record);
        for (uint32_t k = 0; k < record.count; k++) {
            uint32_t a = record.corners[k];
            uint32_t b = record.corners[(k + 1) % record.count];
            uint64_t key = a < b ? map64_key(a, b) : map64_key(b, a);
            sums[map64_put(&edges, key, (uint32_t)edges.count)] += a < b ? 1 : -1;
        }
    }
    uint32_t open = 0;
    for (uint64_t i = 0; i < edges.count; i++) {
        open += sums[i] != 0;
    }
    free(sums);
    map64_free(&edges);
    return open;
}
