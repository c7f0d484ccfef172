/* SPDX-License-Identifier: 0BSD */
/* Figures a second. */
#include "stats.h"

#include <inttypes.h>
#include <stdio.h>
#include <sys/resource.h>

enum { SECOND_US = 1000000, MS_US = 1000 };

static uint64_t now_us(const struct stats *stats)
{
    struct timespec now = { 0 };
    (void)stats->system->now(&now);
    return (uint64_t)now.tv_sec * SECOND_US + (uint64_t)now.tv_nsec / 1000;
}

static uint64_t time_us(const struct timeval *time)
{
    return (uint64_t)time->tv_sec * SECOND_US + (uint64_t)time->tv_usec;
}

static uint64_t cpu_us(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) != 0
               ? 0
               : time_us(&usage.ru_utime) + time_us(&usage.ru_stime);
}

void stats_begin(struct stats *stats, const struct linux_system *system)
{
    *stats = (struct stats){ .system = system, .cpu_us = cpu_us() };
    stats->began_us = now_us(stats);
}

void stats_probe(void *context, enum ow_probe point)
{
    struct stats *stats = context;
    uint64_t now = now_us(stats);
    if (point == OW_PROBE_DRAW_BEGIN) {
        stats->probe_us = now;
    } else {
        stats->draw_us += now - stats->probe_us;
    }
}

void stats_frame(struct stats *stats, const struct ow_viewer *viewer, uint64_t step_us)
{
    stats->frames++;
    stats->step_us += step_us;
    stats->polygons_painted += viewer->stats.polygons_painted;
    stats->pixels_written += viewer->stats.pixels_written;
}

void stats_print(struct stats *stats)
{
    uint64_t passed_us = now_us(stats) - stats->began_us;
    uint64_t used_us = cpu_us() - stats->cpu_us;
    double seconds = passed_us > 0 ? (double)passed_us / SECOND_US : 1;
    double frames = stats->frames > 0 ? stats->frames : 1;
    fprintf(
        stderr,
        "{\"seconds\":%.3f,\"frames\":%" PRIu32
        ",\"frames_per_second\":%.2f,\"draw_ms\":%.3f,\"show_ms\":%.3f"
        ",\"polygons_painted\":%" PRIu64 ",\"pixels_written\":%" PRIu64 ",\"cpu_percent\":%.2f}\n",
        seconds, stats->frames, stats->frames / seconds, (double)stats->draw_us / frames / MS_US,
        (double)(stats->step_us - stats->draw_us) / frames / MS_US, stats->polygons_painted,
        stats->pixels_written, (double)used_us / (seconds * SECOND_US) * 100);
    stats_begin(stats, stats->system);
}
