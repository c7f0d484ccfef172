/* SPDX-License-Identifier: 0BSD */
/* Checking and describing a blob. */
#include "info.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#include "blob_file.h"
#include "ow_read.h"
#include "ow_tree.h"
#include "tools/common/outfile.h"
#include "tools/common/xalloc.h"

#define AT(name) ((uint32_t)offsetof(struct ow_disk_header, name))

/* What the nodes and records hold. */
struct census {
    uint32_t fronts;
    uint32_t reverses;
    uint32_t empty_children;
    uint32_t most_items;
    uint32_t bounded;
    uint32_t marked;
    uint32_t uneven;
    uint64_t corners;
    uint32_t by_corners[OW_MAX_CORNERS + 1];
};

static void count_item(struct census *census, uint32_t item)
{
    census->fronts += item != OW_ITEM_NONE && (item & 3) == OW_ITEM_FACE;
    census->reverses += item != OW_ITEM_NONE && (item & 3) == OW_ITEM_REVERSE;
    census->empty_children += item == OW_ITEM_NONE;
}

static void count_nodes(const struct ow_tree *tree, struct census *census)
{
    uint32_t at = tree->nodes_at;
    while (at < tree->polygons_at) {
        uint32_t word = ow_read_u32(tree->bytes, at);
        uint32_t count = word >> OW_NODE_COUNT_SHIFT;
        at += OW_NODE_WORD_BYTES;
        census->most_items = count > census->most_items ? count : census->most_items;
        if (word & OW_NODE_BOUNDED) {
            census->bounded++;
            at += OW_NODE_BOUNDS_BYTES;
        }
        if ((word & OW_NODE_KIND_MASK) == OW_NODE_SWITCH) {
            count_item(census, ow_read_u32(tree->bytes, at));
            count_item(census, ow_read_u32(tree->bytes, at + 4));
            at += OW_SWITCH_CHILDREN_BYTES + OW_SWITCH_PLANE_BYTES;
        }
        for (uint32_t i = 0; i < count; i++, at += 4) {
            count_item(census, ow_read_u32(tree->bytes, at));
        }
    }
}

static void count_polygons(const struct ow_tree *tree, struct census *census)
{
    uint32_t at = tree->polygons_at;
    for (uint32_t i = 0; i < tree->polygon_count && at + 6 <= tree->vertices_at; i++) {
        uint32_t corners = ow_read_u8(tree->bytes, at);
        uint32_t look = ow_read_u16(tree->bytes, at + 4);
        census->corners += corners;
        census->by_corners[corners]++;
        census->marked += (look & OW_POLYGON_MARKED) != 0;
        census->uneven += (look & OW_POLYGON_UNEVEN) != 0;
        at += ow_polygon_bytes(tree, at);
    }
}

static void print_flags(FILE *out, uint32_t flags)
{
    static const struct {
        uint32_t flag;
        const char *yes;
        const char *no;
    } words[] = {
        { OW_TREE_TWO_SIDED, "two-sided", "one-sided" },
        { OW_TREE_SWITCH_ONLY, "switches order everything", "sequences order faces" },
        { OW_TREE_CLOSED, "closed model", "open model" },
        { OW_TREE_INDEX32, "32-bit corners", "16-bit corners" },
        { OW_TREE_IDS, "source numbers kept", "no source numbers" },
        { OW_TREE_NORMALS, "vertex normals kept", "no vertex normals" },
    };
    fprintf(out, "flags          0x%02" PRIX32 ":", flags);
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        fprintf(out, "%s %s", i > 0 ? "," : "", flags & words[i].flag ? words[i].yes : words[i].no);
    }
    fputc('\n', out);
}

static void print_header(FILE *out, const struct blob_file *file)
{
    const struct ow_tree *tree = &file->tree;
    const struct lattice *lattice = &file->lattice;
    fprintf(out, "format         version %u, CRC-32 %08" PRIX32 ", valid\n", OW_BLOB_VERSION,
            ow_read_u32(tree->bytes, AT(crc32)));
    print_flags(out, tree->flags);
    fprintf(out, "lattice        step %.17g, origin %.17g,%.17g,%.17g\n", lattice->step,
            lattice->origin[0], lattice->origin[1], lattice->origin[2]);
    fprintf(out, "box            %d,%d,%d to %d,%d,%d\n", tree->box_min[0], tree->box_min[1],
            tree->box_min[2], tree->box_max[0], tree->box_max[1], tree->box_max[2]);
    fprintf(out, "tolerance      %g lattice steps\n", file->tolerance_q8 / 256.0);
}

static void print_tree(FILE *out, const struct ow_tree *tree, const struct census *census)
{
    fprintf(out,
            "nodes          %" PRIu32 ": %" PRIu32 " switches, %" PRIu32 " sequences, %" PRIu32
            " with bounds, %" PRIu32 " levels\n",
            tree->node_count, tree->switch_count, tree->node_count - tree->switch_count,
            census->bounded, tree->depth);
    fprintf(out,
            "items          %" PRIu32 " fronts, %" PRIu32 " backs, %" PRIu32
            " empty children, at most %" PRIu32 " in a node\n",
            census->fronts, census->reverses, census->empty_children, census->most_items);
    fprintf(out,
            "polygons       %" PRIu32 ": %.2f corners on average, at most %" PRIu32 ", %" PRIu32
            " with edges that were cut, %" PRIu32 " uneven\n",
            tree->polygon_count, (double)census->corners / tree->polygon_count, tree->max_corners,
            census->marked, census->uneven);
    fprintf(out, "by corners    ");
    for (uint32_t i = 3; i <= OW_MAX_CORNERS; i++) {
        if (census->by_corners[i] > 0) {
            fprintf(out, " %" PRIu32 ":%" PRIu32, i, census->by_corners[i]);
        }
    }
    fprintf(out, "\nvertices       %" PRIu32 "\ncolours        %" PRIu32 "\n", tree->vertex_count,
            tree->colour_count);
}

static void print_bytes(FILE *out, const struct ow_tree *tree)
{
    uint32_t instances_at = ow_read_u32(tree->bytes, AT(instances_at));
    fprintf(out,
            "bytes          %" PRIu32 ": header %" PRIu32 ", nodes %" PRIu32 ", polygons %" PRIu32
            ", vertices %" PRIu32 ", normals %" PRIu32 ", colours %" PRIu32 "\n",
            tree->blob_bytes, tree->nodes_at, tree->polygons_at - tree->nodes_at,
            tree->vertices_at - tree->polygons_at, tree->normals_at - tree->vertices_at,
            tree->colours_at - tree->normals_at, instances_at - tree->colours_at);
    fprintf(out, "bytes/polygon  %.2f\n", (double)tree->blob_bytes / tree->polygon_count);
}

void info_print(const char *path)
{
    struct blob_file file;
    blob_file_open(&file, path);
    struct census *census = xalloc_zero(1, sizeof *census);
    count_nodes(&file.tree, census);
    count_polygons(&file.tree, census);
    struct outfile *out = outfile_open("-");
    FILE *stream = outfile_stream(out);
    fprintf(stream, "file           %s\n", path);
    print_header(stream, &file);
    print_tree(stream, &file.tree, census);
    print_bytes(stream, &file.tree);
    outfile_commit(out);
    free(census);
    blob_file_close(&file);
}
