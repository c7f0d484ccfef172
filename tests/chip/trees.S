/* SPDX-License-Identifier: 0BSD */
/* The scenes' trees: without and with vertex normals. */
    .section .tree, "a"
    .balign 4
    .global flat_tree, flat_tree_end, smooth_tree, smooth_tree_end
flat_tree:
    .incbin FLAT_TREE
flat_tree_end:
    .balign 4
smooth_tree:
    .incbin SMOOTH_TREE
smooth_tree_end:
