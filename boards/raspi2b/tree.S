/* SPDX-License-Identifier: 0BSD */
/* The built-in tree, as the compiler wrote it: the file named by TREE. */
    .section .tree, "a"
    .balign 4
    .global board_tree, board_tree_end
board_tree:
    .incbin TREE
board_tree_end:
