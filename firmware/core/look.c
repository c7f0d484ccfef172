/* SPDX-License-Identifier: 0BSD */
/* The look: what goes together. */
#include "ow_frame.h"

bool ow_look_fits(const struct ow_look *look, const struct ow_workspace *workspace)
{
    bool no_depth = look->depth_near == 0 && look->depth_far == 0;
    if (!no_depth && (look->depth_near < 0 || look->depth_far <= look->depth_near)) {
        return false;
    }
    if (look->light_count > OW_LIGHTS_MAX || (uint32_t)look->map > OW_MAP_SPECTRUM ||
        (uint32_t)look->shade > OW_SHADE_LINES) {
        return false;
    }
    if (look->budget > 0 && look->order != OW_FRONT_TO_BACK) {
        return false;
    }
    return !look->coverage || (workspace->samples != NULL && look->backdrop == NULL &&
                               look->order == OW_FRONT_TO_BACK && look->shade != OW_SHADE_ID &&
                               look->shade != OW_SHADE_LINES);
}
