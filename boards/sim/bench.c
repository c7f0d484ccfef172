/* SPDX-License-Identifier: 0BSD */
/* --bench: passes over all views until the figures are steady. */
#include "bench.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/sim_clock.h"

enum { PASSES_MIN = 5 };
static const uint64_t ENOUGH_NS = 1000000000;    /* passes go on for a second */
static const uint64_t TOO_LONG_NS = 60000000000; /* a huge scene gets fewer than PASSES_MIN */

void bench_probe(void *context, enum ow_probe point)
{
    struct bench *bench = context;
    uint64_t now_ns = sim_host_ns();
    if (point == OW_PROBE_DRAW_BEGIN) {
        bench->begun_ns = now_ns;
    } else {
        bench->pass_ns += now_ns - bench->begun_ns;
    }
}

/* The yardstick: setting as many bytes as a frame has, at the same moment on the same machine. */
static double time_memset(struct bench *bench)
{
    if (bench->yard == NULL) {
        bench->yard = malloc(bench->yard_bytes);
    }
    if (bench->yard == NULL) {
        return 0;
    }
    uint64_t begun_ns = sim_host_ns();
    memset(bench->yard, (int)bench->passes, bench->yard_bytes);
    *(volatile uint8_t *)bench->yard; /* nobody may leave it out */
    return (double)(sim_host_ns() - begun_ns) / 1e6;
}

bool bench_end_pass(struct bench *bench, uint32_t frames, uint64_t wanted)
{
    uint64_t now_ns = sim_host_ns();
    if (bench->started_ns == 0) {
        bench->started_ns = now_ns; /* the first pass warms the caches, it counts if alone */
    }
    bench->ms_memset[bench->passes] = time_memset(bench);
    bench->ms_per_frame[bench->passes++] = (double)bench->pass_ns / 1e6 / frames;
    bench->pass_ns = 0;
    if (wanted != 0) {
        return bench->passes < wanted;
    }
    uint64_t spent_ns = now_ns - bench->started_ns;
    if (bench->passes == BENCH_PASSES_MAX || spent_ns > TOO_LONG_NS) {
        return false;
    }
    return bench->passes < 1 + PASSES_MIN || spent_ns < ENOUGH_NS;
}

static int compare(const void *a, const void *b)
{
    double left = *(const double *)a;
    double right = *(const double *)b;
    return (left > right) - (left < right);
}

static double median_of(double *values, uint32_t count)
{
    qsort(values, count, sizeof *values, compare);
    return (values[(count - 1) / 2] + values[count / 2]) / 2;
}

void bench_print(struct bench *bench, const struct settings *settings, uint32_t frames,
                 const struct ow_stats *sum, uint32_t crc)
{
    uint32_t warm = bench->passes > 1 ? 1 : 0; /* without the first pass, if there are others */
    double *times = bench->ms_per_frame + warm;
    double median = median_of(times, bench->passes - warm);
    double memset_median = median_of(bench->ms_memset + warm, bench->passes - warm);
    free(bench->yard);
    bench->yard = NULL;
    printf("{\"order\":\"%s\",\"shade\":\"%s\",\"format\":\"%s\",\"width\":%" PRIu32
           ",\"height\":%" PRIu32 ",\"frames\":%" PRIu32 ",\"ms_per_frame_min\":%.6f,"
           "\"ms_per_frame_median\":%.6f,",
           order_name(settings->look.order), shade_name(settings->look.shade),
           settings->format->name, settings->size[0], settings->size[1], frames, times[0], median);
    printf("\"polygons_visited\":%" PRIu32 ",\"polygons_painted\":%" PRIu32
           ",\"pixels_written\":%" PRIu32 ",\"pixels_background\":%" PRIu32 ",\"spans\":%" PRIu32
           ",\"crc32\":%" PRIu32 ",\"ms_memset_median\":%.6f}\n",
           sum->polygons_visited, sum->polygons_painted, sum->pixels_written,
           sum->pixels_background, sum->spans, crc, memset_median);
}
