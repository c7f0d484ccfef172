/* SPDX-License-Identifier: 0BSD */
/*
 * Coverage [FAG83]: each pixel has 4x4 samples. The picture is that of a screen
 * of four times the width and height with two sub-pixel bits fewer (vertices and
 * edges stay where they are), 16 of its pixels summed exactly and rounded once.
 * Smooth shading takes one colour for all samples that a face has of a pixel: the
 * one at the pixel's centre, or at the point of the outline that is nearest to it.
 */
#ifndef OW_COVERAGE_H
#define OW_COVERAGE_H

#include "ow_frame.h"

enum { OW_SIDE = 4, OW_SAMPLES = 16, OW_ALL_SAMPLES = 0xFFFF };

/* Covers pixels on a surface of its own. */
extern const struct ow_face_kind ow_faces_covering;

/* ow_scan.h's functions, window, box and spans counted in samples. */
bool ow_outline_box_4x4(const struct ow_outline_point *points, uint32_t count,
                        const struct ow_window *window, struct ow_box *box);
void ow_scan_4x4(const struct ow_outline_point *points, uint32_t count, enum ow_winding rule,
                 const struct ow_box *box, struct ow_scan_edge *edges, struct ow_span_sink *sink);

#endif
