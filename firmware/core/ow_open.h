/* SPDX-License-Identifier: 0BSD */
/* What opening is made of. Private to the core. */
#ifndef OW_OPEN_H
#define OW_OPEN_H

#include <stdbool.h>

#include "ow_tree.h"

/* Opens a tree; its instances must please this judge, NULL: there must be none. */
enum ow_status ow_open(struct ow_tree *tree, const void *bytes, uint32_t size,
                       bool (*instances_are_valid)(const struct ow_tree *tree));

/* Bytes of the node at this offset of the blob; 0 if it does not fit its section. */
uint32_t ow_node_bytes(const struct ow_tree *tree, uint32_t at);

#endif
