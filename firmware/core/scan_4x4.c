/* SPDX-License-Identifier: 0BSD */
/*
 * Stage "scan" for coverage: the same code on a screen of four times the width
 * and height, whose pixels are a quarter as large. Outlines stay as they are: a
 * coordinate in 1/256 pixel is one in 1/64 of a sample's pixel.
 */
#define OW_SCAN_SUB_BITS (OW_SUB_BITS - 2)
#define ow_scan ow_scan_4x4
#define ow_outline_box ow_outline_box_4x4

#include "scan.c"
