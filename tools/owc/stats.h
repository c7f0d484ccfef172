/* SPDX-License-Identifier: 0BSD */
/* The statistics of a compilation as one flat JSON object. */
#ifndef OWC_STATS_H
#define OWC_STATS_H

#include "blob_write.h"
#include "compile.h"
#include "tools/common/outfile.h"

void stats_write(struct outfile *out, const struct blob *blob, const struct compile_stats *stats,
                 double seconds);

#endif
