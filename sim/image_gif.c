/* SPDX-License-Identifier: 0BSD */
/* Animated GIF files, by giflib. Left out of the build with OW_SIM_NO_PNG. */
#include <gif_lib.h>
#include <stdlib.h>
#include <string.h>

#include "image.h"
#include "image_optional.h"

enum {
    COLOURS = 256,
    TRANSPARENT = 255, /* stands for "as in the last frame" */
    DISPOSE_KEEP = 1,  /* the next frame is drawn over this one */
    FLAG_TRANSPARENT = 1
};

/* What one call works with; frames as palette indices. */
struct gif {
    GifFileType *file;
    struct palette palette;
    uint32_t width;
    uint32_t height;
    uint8_t *indices;  /* of this frame */
    uint8_t *previous; /* of the last one */
    uint8_t *row;
    uint32_t delay_cs;
};

struct area {
    uint32_t x;
    uint32_t y;
    uint32_t width;
    uint32_t height;
};

static int put_bytes(GifFileType *file, const GifByteType *bytes, int count)
{
    return (int)fwrite(bytes, 1, (size_t)count, file->UserData);
}

static bool put_screen(struct gif *gif)
{
    GifColorType colours[COLOURS] = { { 0, 0, 0 } };
    for (uint32_t i = 0; i < gif->palette.count; i++) {
        uint32_t rgb = gif->palette.rgb[i];
        colours[i] =
            (GifColorType){ (GifByteType)(rgb >> 16), (GifByteType)(rgb >> 8), (GifByteType)rgb };
    }
    ColorMapObject *map = GifMakeMapObject(COLOURS, colours);
    if (map == NULL) {
        return false;
    }
    EGifSetGifVersion(gif->file, true);
    int result = EGifPutScreenDesc(gif->file, (int)gif->width, (int)gif->height, 8, 0, map);
    GifFreeMapObject(map);
    static const GifByteType for_ever[] = { 1, 0, 0 };
    return result == GIF_OK &&
           EGifPutExtensionLeader(gif->file, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
           EGifPutExtensionBlock(gif->file, 11, "NETSCAPE2.0") == GIF_OK &&
           EGifPutExtensionBlock(gif->file, sizeof for_ever, for_ever) == GIF_OK &&
           EGifPutExtensionTrailer(gif->file) == GIF_OK;
}

/* The smallest rectangle that holds all changes; one pixel if there are none. */
static struct area changed_area(const struct gif *gif)
{
    uint32_t left = gif->width;
    uint32_t right = 0;
    uint32_t top = gif->height;
    uint32_t bottom = 0;
    for (uint32_t y = 0; y < gif->height; y++) {
        for (uint32_t x = 0; x < gif->width; x++) {
            size_t at = (size_t)y * gif->width + x;
            if (gif->indices[at] != gif->previous[at]) {
                left = x < left ? x : left;
                right = x > right ? x : right;
                top = y < top ? y : top;
                bottom = y;
            }
        }
    }
    if (top == gif->height) {
        return (struct area){ 0, 0, 1, 1 };
    }
    return (struct area){ left, top, right - left + 1, bottom - top + 1 };
}

static bool put_control(const struct gif *gif)
{
    GifByteType control[] = { DISPOSE_KEEP << 2 | FLAG_TRANSPARENT, (GifByteType)gif->delay_cs,
                              (GifByteType)(gif->delay_cs >> 8), TRANSPARENT };
    return EGifPutExtension(gif->file, GRAPHICS_EXT_FUNC_CODE, sizeof control, control) == GIF_OK;
}

static bool put_frame(struct gif *gif, bool first)
{
    struct area area = { 0, 0, gif->width, gif->height };
    if (!first) {
        area = changed_area(gif);
    }
    if (!put_control(gif) || EGifPutImageDesc(gif->file, (int)area.x, (int)area.y, (int)area.width,
                                              (int)area.height, false, NULL) != GIF_OK) {
        return false;
    }
    for (uint32_t y = area.y; y < area.y + area.height; y++) {
        for (uint32_t x = 0; x < area.width; x++) {
            size_t at = (size_t)y * gif->width + area.x + x;
            bool same = !first && gif->indices[at] == gif->previous[at];
            gif->row[x] = same ? TRANSPARENT : gif->indices[at];
        }
        if (EGifPutLine(gif->file, gif->row, (int)area.width) != GIF_OK) {
            return false;
        }
    }
    return true;
}

static void take_frame(struct gif *gif, const struct image *frame)
{
    uint8_t *indices = gif->previous;
    gif->previous = gif->indices;
    gif->indices = indices;
    for (uint32_t y = 0; y < frame->height; y++) {
        for (uint32_t x = 0; x < frame->width; x++) {
            *indices++ = (uint8_t)palette_index(&gif->palette, image_pixel(frame, x, y));
        }
    }
}

static bool put_frames(struct gif *gif, const struct image *frames, uint32_t count)
{
    if (!put_screen(gif)) {
        return false;
    }
    for (uint32_t i = 0; i < count; i++) {
        take_frame(gif, &frames[i]);
        if (!put_frame(gif, i == 0)) {
            return false;
        }
    }
    return true;
}

static bool encode(struct gif *gif, FILE *stream, const struct image *frames, uint32_t count,
                   struct image_error *error)
{
    int code = 0;
    size_t pixels = (size_t)gif->width * gif->height;
    gif->indices = calloc(pixels, 1);
    gif->previous = calloc(pixels, 1);
    gif->row = calloc(gif->width, 1);
    if (gif->indices == NULL || gif->previous == NULL || gif->row == NULL) {
        return image_fail(error, "not enough memory for the GIF");
    }
    gif->file = EGifOpen(stream, put_bytes, &code);
    bool good = gif->file != NULL && put_frames(gif, frames, count);
    if (gif->file != NULL) {
        code = gif->file->Error;
        int close_code = 0;
        if (EGifCloseFile(gif->file, &close_code) != GIF_OK && good) {
            code = close_code;
            good = false;
        }
    }
    if (!good) {
        const char *text = GifErrorString(code);
        image_fail(error, "cannot write the GIF: %s", text != NULL ? text : "unknown error");
    }
    return good;
}

bool image_gif_write(FILE *stream, const struct image *frames, uint32_t count, uint32_t delay_cs,
                     struct image_error *error)
{
    struct gif gif = { .delay_cs = delay_cs };
    if (count == 0) {
        return image_fail(error, "no frame for the GIF");
    }
    gif.width = frames[0].width;
    gif.height = frames[0].height;
    for (uint32_t i = 1; i < count; i++) {
        if (frames[i].width != gif.width || frames[i].height != gif.height) {
            return image_fail(error, "the frames for the GIF differ in size");
        }
    }
    if (!palette_make(&gif.palette, frames, count, error)) {
        return false;
    }
    bool good = encode(&gif, stream, frames, count, error);
    free(gif.indices);
    free(gif.previous);
    free(gif.row);
    palette_free(&gif.palette);
    return good;
}
