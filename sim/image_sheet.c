/* SPDX-License-Identifier: 0BSD */
/* The contact sheet: all frames on one picture. */
#include <string.h>

#include "image.h"

enum { SHEET_GREY = 0x60 };

/* The mean of the block of at most k x k pixels that pixel x, y of the reduced frame stands for. */
static uint32_t mean_pixel(const struct image *frame, uint32_t x, uint32_t y, uint32_t k)
{
    uint32_t sum[3] = { 0, 0, 0 };
    uint32_t count = 0;
    for (uint32_t j = y * k; j < (y + 1) * k && j < frame->height; j++) {
        for (uint32_t i = x * k; i < (x + 1) * k && i < frame->width; i++) {
            uint32_t rgb = image_pixel(frame, i, j);
            sum[0] += rgb >> 16;
            sum[1] += rgb >> 8 & 255;
            sum[2] += rgb & 255;
            count++;
        }
    }
    count = count == 0 ? 1 : count;
    uint32_t half = count / 2;
    return (sum[0] + half) / count << 16 | (sum[1] + half) / count << 8 | (sum[2] + half) / count;
}

static uint32_t square_root_up(uint32_t x)
{
    uint32_t root = 0;
    while (root * root < x) {
        root++;
    }
    return root;
}

bool image_sheet(struct image *sheet, const struct image *frames, uint32_t count, uint32_t columns,
                 struct image_error *error)
{
    *sheet = (struct image){ 0 };
    if (count == 0) {
        return image_fail(error, "no frame for the sheet");
    }
    uint32_t across = columns != 0 ? columns : square_root_up(count);
    across = across > count ? count : across;
    uint32_t down = (count + across - 1) / across;
    uint32_t k = 1;
    while (k < frames[0].width && across * (frames[0].width / k + SHEET_GAP) > SHEET_WIDTH) {
        k++;
    }
    uint32_t width = (frames[0].width + k - 1) / k;
    uint32_t height = (frames[0].height + k - 1) / k;
    if (!image_make(sheet, across * (width + SHEET_GAP) + SHEET_GAP,
                    down * (height + SHEET_GAP) + SHEET_GAP, error)) {
        return false;
    }
    memset(sheet->rgb, SHEET_GREY, (size_t)3 * sheet->width * sheet->height);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t left = SHEET_GAP + i % across * (width + SHEET_GAP);
        uint32_t top = SHEET_GAP + i / across * (height + SHEET_GAP);
        for (uint32_t y = 0; y < height; y++) {
            for (uint32_t x = 0; x < width; x++) {
                image_set_pixel(sheet, left + x, top + y, mean_pixel(&frames[i], x, y, k));
            }
        }
    }
    return true;
}
