/* SPDX-License-Identifier: 0BSD */
/*
 * Output files that are whole or absent.
 *
 * The bytes go to a temporary file in the target's folder; outfile_commit renames it onto the
 * target. fail(), exit() and the signals that end a program remove what was not committed.
 * Nothing here returns an error: each function prints one line and exits with status 1.
 * A target that is not a regular file (/dev/null, a fifo) is written in place.
 * Use it from one thread only. A forked child must not use files that its parent opened.
 *
 *     struct outfile *out = outfile_open(path);
 *     fprintf(outfile_stream(out), "...");
 *     outfile_commit(out);
 */
#ifndef OLDWELL_TOOLS_COMMON_OUTFILE_H
#define OLDWELL_TOOLS_COMMON_OUTFILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Files that may be open at one time; one more is an error (status 1). */
enum { OUTFILE_LIMIT = 16 };

struct outfile;

/*
 * Opens `path` for writing; "-" is standard output. Fails if the folder is missing, if `path` is
 * a folder, or if an existing file is write protected. A symbolic link is kept, its target is
 * replaced.
 */
struct outfile *outfile_open(const char *path);

/* The stream to write to; it belongs to the outfile, do not close it. */
FILE *outfile_stream(struct outfile *out);

/* The name for messages: the path as given, or "standard output". */
const char *outfile_name(const struct outfile *out);

/* True if the bytes go straight to standard output or to a file that is not a regular one. */
bool outfile_is_direct(const struct outfile *out);

/* Flushes, checks for write errors (a full disk), renames. `out` is gone afterwards. */
void outfile_commit(struct outfile *out);

/*
 * Commits several files that belong together: all are flushed and checked before the first is
 * renamed. If a rename fails, the ones renamed before it are removed again.
 */
void outfile_commit_all(struct outfile *const *outs, size_t count);

/* Throws one file away; `out` is gone afterwards. */
void outfile_discard(struct outfile *out);

/* Removes every temporary file that is still there; the outfiles are not to be used after it. */
void outfile_discard_all(void);

#endif
