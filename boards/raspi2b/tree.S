/* SPDX-License-Identifier: 0BSD */
/* The built-in tree, as the compiler wrote it: the file named by TREE. */
    .section .tree, "a"
    .balign 4
    .global board_tree
board_tree:
    .incbin TREE
tree_end:
    .section .rodata.board_tree_bytes, "a"
    .balign 4
    .global board_tree_bytes
board_tree_bytes:
    .4byte tree_end - board_tree
