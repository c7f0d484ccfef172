/* SPDX-License-Identifier: 0BSD */
/*
 * Lines: the hidden-line picture [FKN80]. A face is its outline in the
 * foreground's colour and its pixels in the background's, and hides what is
 * behind both, on any surface.
 *
 * The line rule: along the longer axis of an edge, a line has at each pixel's
 * centre the one pixel that holds the edge's point there, and the pixels that
 * hold the two ends. So each of its pixels touches the edge, no line has a gap,
 * and the faces on both sides of an edge draw the same pixels.
 */
#ifndef OW_LINES_H
#define OW_LINES_H

#include "ow_frame.h"

/* Draws a face's lines and its pixels. */
extern const struct ow_face_kind ow_faces_in_lines;

/*
 * True if the edge from corner i of the face's outline to the next is not to
 * be drawn: cutting, triangulating or merging made it. Reverse faces count
 * their corners from the last.
 */
bool ow_edge_is_marked(const struct ow_tree *tree, const struct ow_face *face, uint32_t i);
#endif
