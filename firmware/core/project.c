/* SPDX-License-Identifier: 0BSD */
/*
 * Stage "project" for all vertices at once: a tight loop, for workspaces whose
 * cache has an entry for each. Others project a vertex when a face asks for it.
 */
#include "ow_project.h"

void ow_project_all(const struct ow_tree *tree, const struct ow_view *view,
                    struct ow_cached_vertex *cache)
{
    const struct ow_tree t = *tree; /* copies, so that no store can touch what the loop reads */
    const struct ow_view v = *view;
    for (uint32_t i = 0; i < t.vertex_count; i++) {
        cache[i].point = ow_project_vertex(&t, &v, i);
    }
}
