/* SPDX-License-Identifier: 0BSD */
/* The statistics of a compilation as one flat JSON object. */
#include "stats.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>

#include "tools/common/fail.h"

struct number {
    const char *key;
    double value;
};

static void add_numbers(cJSON *object, const struct number *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (cJSON_AddNumberToObject(object, numbers[i].key, numbers[i].value) == NULL) {
            fail(FAIL_INPUT, NULL, 0, "out of memory");
        }
    }
}

void stats_write(struct outfile *out, const struct blob *blob, const struct compile_stats *stats,
                 double seconds)
{
    uint32_t connecting = blob->nodes - blob->switches;
    const struct number numbers[] = {
        { "source_polygons", stats->source_polygons },
        { "input_polygons", stats->input_polygons },
        { "output_polygons", blob->polygons },
        { "splits", stats->splits },
        { "nodes", blob->nodes },
        { "switch_nodes", blob->switches },
        { "connecting_nodes", connecting },
        { "depth", blob->switch_depth },
        { "one_way_relations", (double)stats->relations },
        { "vertices", blob->vertices },
        { "blob_bytes", blob->size },
        { "bytes_per_polygon", (double)blob->size / blob->polygons },
        { "seconds", seconds },
        { "degenerate_dropped", stats->degenerate_dropped },
        { "degenerate_kept", stats->degenerate_kept },
        { "repeated_dropped", stats->repeated_dropped },
        { "lines_dropped", (double)stats->lines_dropped },
        { "uneven_triangulated", stats->uneven_cut },
        { "planes", stats->planes },
        { "shared_planes", stats->shared_planes },
        { "merged_polygons", stats->merged },
        { "vanished_pieces", stats->vanished },
        { "inserted_corners", stats->inserted },
        { "uneven_pieces", stats->uneven },
        { "long_polygons_cut", stats->long_cut },
        { "rounded_meetings", stats->rounded_meetings },
        { "closed", stats->closed },
        { "sides", stats->two_sided ? 2 : 1 },
    };
    cJSON *object = cJSON_CreateObject();
    if (object == NULL) {
        fail(FAIL_INPUT, NULL, 0, "out of memory");
    }
    add_numbers(object, numbers, sizeof numbers / sizeof numbers[0]);
    char *text = cJSON_Print(object);
    if (text == NULL) {
        fail(FAIL_INPUT, NULL, 0, "out of memory");
    }
    fprintf(outfile_stream(out), "%s\n", text);
    cJSON_free(text);
    cJSON_Delete(object);
}
