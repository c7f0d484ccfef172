/* SPDX-License-Identifier: 0BSD */
/*
 * A camera's picture behind the model: what the model leaves unlit shows it.
 * The picture covers the screen from its middle: a source pixel covers a square
 * of screen pixels, or one of each so many is taken, by a whole number.
 */
#ifndef OW_VIDEO_BACKDROP_H
#define OW_VIDEO_BACKDROP_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/camera.h"
#include "ow_draw.h"

struct ow_video_backdrop {
    struct ow_video_frame frame; /* shown; the owner changes it between two frames */
    bool has_frame;              /* false: colour instead */
    uint32_t colour;             /* 0x00RRGGBB */

    /* Private. */
    struct ow_video_info info;
    uint16_t width; /* of the panel, pixels */
    uint16_t height;
    uint8_t turns;
    uint32_t step;   /* source pixels from a screen pixel to the next */
    uint32_t repeat; /* screen pixels that a source pixel covers; one of both is 1 */
    uint32_t left;   /* of the whole picture at this scale, what lies beyond the screen's edge */
    uint32_t top;
};

/*
 * Gets ready for frames like info on a panel of this size whose picture is
 * turned by quarter turns clockwise. No frame is there yet. OW_ARGUMENT: a size
 * of 0; OW_UNSUPPORTED: a format that is none of hal/camera.h's.
 */
int ow_video_backdrop_begin(struct ow_video_backdrop *backdrop, const struct ow_video_info *info,
                            uint16_t width, uint16_t height, uint8_t quarter_turns);

/* For struct ow_look; the backdrop stays where it is. */
struct ow_backdrop ow_backdrop_of_video(struct ow_video_backdrop *backdrop);

#endif
