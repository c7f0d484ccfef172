/* SPDX-License-Identifier: 0BSD */
/* Camera pixels to screen pixels. YUV is ITU-R BT.601 in limited range. */
#include "video_backdrop.h"

enum { CHUNK = 64 };

static uint32_t clamp(int32_t value)
{
    return value < 0 ? 0 : value > 255 ? 255 : (uint32_t)value;
}

/* Sums are kept positive before they are shifted: 2^17 is more than any negative one. */
static uint32_t channel(int32_t sum)
{
    return clamp(((sum + 128 + (1 << 17)) >> 8) - (1 << 9));
}

static uint32_t yuv_to_rgb(uint8_t luma, uint8_t blue, uint8_t red)
{
    int32_t y = 298 * (luma - 16);
    int32_t u = blue - 128;
    int32_t v = red - 128;
    return channel(y + 409 * v) << 16 | channel(y - 100 * u - 208 * v) << 8 | channel(y + 516 * u);
}

static uint32_t source_pixel(const struct ow_video_backdrop *backdrop, uint32_t x, uint32_t y)
{
    const struct ow_video_frame *frame = &backdrop->frame;
    const uint8_t *line = frame->planes[0] + y * frame->strides[0];
    switch (backdrop->info.format) {
    case OW_VIDEO_RGB565: {
        uint32_t value = (uint32_t)line[2 * x] | (uint32_t)line[2 * x + 1] << 8;
        return ow_format_rgb565.unpack(value);
    }
    case OW_VIDEO_XRGB8888:
        return (uint32_t)line[4 * x] | (uint32_t)line[4 * x + 1] << 8 |
               (uint32_t)line[4 * x + 2] << 16;
    case OW_VIDEO_YUYV: {
        const uint8_t *pair = line + (x / 2) * 4;
        return yuv_to_rgb(pair[x % 2 * 2], pair[1], pair[3]);
    }
    default: { /* OW_VIDEO_NV12 */
        const uint8_t *pair = frame->planes[1] + y / 2 * frame->strides[1] + x / 2 * 2;
        return yuv_to_rgb(line[x], pair[0], pair[1]);
    }
    }
}

/*
 * Pixels first .. stop-1 of the panel's line. Along a line one coordinate of the
 * picture stays and the other moves, backwards if it is turned by one or two.
 */
static void read_line(const struct ow_video_backdrop *backdrop, uint32_t *rgb, uint32_t line,
                      uint32_t first, uint32_t stop)
{
    bool downwards = backdrop->turns & 1;
    bool backwards = backdrop->turns == 1 || backdrop->turns == 2;
    uint32_t count = stop - first;
    uint32_t start = backwards ? backdrop->width - stop : first;
    uint32_t stays = backdrop->turns < 2 ? line : backdrop->height - 1u - line;
    uint32_t moves = (start + (downwards ? backdrop->top : backdrop->left)) * backdrop->step;
    uint32_t other =
        (stays + (downwards ? backdrop->left : backdrop->top)) * backdrop->step / backdrop->repeat;
    uint32_t at = moves / backdrop->repeat;
    uint32_t rest = moves % backdrop->repeat;
    for (uint32_t i = 0; i < count; i++) {
        rgb[backwards ? count - 1 - i : i] =
            downwards ? source_pixel(backdrop, other, at) : source_pixel(backdrop, at, other);
        if (backdrop->repeat == 1) {
            at += backdrop->step;
        } else if (++rest == backdrop->repeat) { /* then a step is 1 */
            rest = 0;
            at++;
        }
    }
}

static void fill(void *context, const struct ow_pixel_format *format, uint8_t *row, uint32_t line,
                 uint32_t first, uint32_t end)
{
    const struct ow_video_backdrop *backdrop = context;
    uint32_t rgb[CHUNK];
    if (!backdrop->has_frame) {
        format->fill(row, first, end, format->pack(backdrop->colour));
        return;
    }
    while (first < end) {
        uint32_t stop = end - first > CHUNK ? first + CHUNK : end;
        read_line(backdrop, rgb, line, first, stop);
        format->store(row, first, stop, rgb);
        first = stop;
    }
}

/* The smallest whole number of screen pixels, at least 1, with which size covers needed. */
static uint32_t times(uint32_t size, uint32_t needed)
{
    return (needed + size - 1) / size;
}

int ow_video_backdrop_begin(struct ow_video_backdrop *backdrop, const struct ow_video_info *info,
                            uint16_t width, uint16_t height, uint8_t quarter_turns)
{
    bool sideways = quarter_turns & 1;
    uint32_t across = sideways ? height : width;
    uint32_t down = sideways ? width : height;
    uint32_t colour = backdrop->colour;
    if (info->width == 0 || info->height == 0 || width == 0 || height == 0 || quarter_turns > 3) {
        return OW_ARGUMENT;
    }
    if (info->format != OW_VIDEO_RGB565 && info->format != OW_VIDEO_XRGB8888 &&
        info->format != OW_VIDEO_YUYV && info->format != OW_VIDEO_NV12) {
        return OW_UNSUPPORTED;
    }
    uint32_t wide = info->width / across;
    uint32_t high = info->height / down;
    uint32_t step = wide < high ? wide : high;
    uint32_t more = times(info->width, across);
    uint32_t more_down = times(info->height, down);
    uint32_t repeat = more > more_down ? more : more_down;
    step = step == 0 ? 1 : step;
    *backdrop = (struct ow_video_backdrop){
        .colour = colour,
        .info = *info,
        .width = width,
        .height = height,
        .turns = quarter_turns,
        .step = step,
        .repeat = repeat,
        .left = (info->width * repeat / step - across) / 2,
        .top = (info->height * repeat / step - down) / 2,
    };
    return OW_OK;
}

struct ow_backdrop ow_backdrop_of_video(struct ow_video_backdrop *backdrop)
{
    return (struct ow_backdrop){ fill, backdrop };
}
