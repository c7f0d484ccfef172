/* SPDX-License-Identifier: 0BSD */
/*
 * A palette for a set of frames. Few colours are kept as they are; many are
 * parted by median cut. Every choice has a fixed order, so that the same frames
 * give the same palette everywhere.
 */
#include <stdlib.h>

#include "image.h"

struct palette_entry {
    uint32_t rgb;
    uint32_t index;  /* in the palette */
    uint64_t pixels; /* 0: the place is free */
};

/* Entries first .. first+count-1 of the list, which one palette colour will stand for. */
struct box {
    uint32_t first;
    uint32_t count;
    uint32_t shift; /* the channel that varies most: 16, 8 or 0 */
    uint32_t range; /* of that channel */
    uint64_t pixels;
};

/* ---- the table of colours, open addressing ---- */

static struct palette_entry *find(const struct palette *palette, uint32_t rgb)
{
    uint32_t mask = palette->capacity - 1;
    uint32_t at = (rgb * 2654435761u) >> 7 & mask;
    while (palette->table[at].pixels != 0 && palette->table[at].rgb != rgb) {
        at = (at + 1) & mask;
    }
    return &palette->table[at];
}

static bool grow(struct palette *palette, struct image_error *error)
{
    struct palette_entry *old = palette->table;
    uint32_t places = palette->capacity;
    uint32_t capacity = places == 0 ? 4096 : 2 * places;
    struct palette_entry *table = calloc(capacity, sizeof *table);
    if (table == NULL) {
        return image_fail(error, "not enough memory for the palette");
    }
    palette->table = table;
    palette->capacity = capacity;
    for (uint32_t i = 0; i < places; i++) {
        if (old[i].pixels != 0) {
            *find(palette, old[i].rgb) = old[i];
        }
    }
    free(old);
    return true;
}

static bool count_colours(struct palette *palette, const struct image *frame,
                          struct image_error *error)
{
    for (uint32_t y = 0; y < frame->height; y++) {
        for (uint32_t x = 0; x < frame->width; x++) {
            if (2 * palette->used >= palette->capacity && !grow(palette, error)) {
                return false;
            }
            struct palette_entry *entry = find(palette, image_pixel(frame, x, y));
            if (entry->pixels == 0) {
                entry->rgb = image_pixel(frame, x, y);
                palette->used++;
            }
            entry->pixels++;
        }
    }
    return true;
}

/* ---- median cut ---- */

static uint32_t channel(uint32_t rgb, uint32_t shift)
{
    return rgb >> shift & 255;
}

/* By one channel, then by the whole colour: colours differ, so the order is total. */
static int compare(const void *a, const void *b, uint32_t shift)
{
    uint32_t left = ((const struct palette_entry *)a)->rgb;
    uint32_t right = ((const struct palette_entry *)b)->rgb;
    if (channel(left, shift) != channel(right, shift)) {
        return channel(left, shift) < channel(right, shift) ? -1 : 1;
    }
    return left < right ? -1 : left > right;
}

static int compare_red(const void *a, const void *b)
{
    return compare(a, b, 16);
}

static int compare_green(const void *a, const void *b)
{
    return compare(a, b, 8);
}

static int compare_blue(const void *a, const void *b)
{
    return compare(a, b, 0);
}

static void measure(struct box *box, const struct palette_entry *list)
{
    box->pixels = 0;
    box->range = 0;
    box->shift = 8;
    for (uint32_t i = 0; i < box->count; i++) {
        box->pixels += list[box->first + i].pixels;
    }
    static const uint32_t shifts[] = { 8, 16, 0 }; /* the eye sees green best */
    for (uint32_t s = 0; s < 3; s++) {
        uint32_t low = 255;
        uint32_t high = 0;
        for (uint32_t i = 0; i < box->count; i++) {
            uint32_t value = channel(list[box->first + i].rgb, shifts[s]);
            low = value < low ? value : low;
            high = value > high ? value : high;
        }
        if (high - low > box->range) {
            box->range = high - low;
            box->shift = shifts[s];
        }
    }
}

/* The box whose colours are worst served by one: many pixels, far apart. */
static struct box *worst_box(struct box *boxes, uint32_t count)
{
    struct box *worst = NULL;
    double most = 0;
    for (uint32_t i = 0; i < count; i++) {
        double badness = (double)boxes[i].pixels * boxes[i].range * boxes[i].range;
        if (boxes[i].count > 1 && badness > most) {
            most = badness;
            worst = &boxes[i];
        }
    }
    return worst;
}

/* Leaves the half with the lower values in *box; both halves hold at least one colour. */
static struct box cut(struct box *box, struct palette_entry *list)
{
    struct palette_entry *part = list + box->first;
    qsort(part, box->count, sizeof *part,
          box->shift == 16  ? compare_red
          : box->shift == 8 ? compare_green
                            : compare_blue);
    uint64_t pixels = part[0].pixels;
    uint32_t lower = 1;
    while (lower < box->count - 1 && 2 * (pixels + part[lower].pixels) <= box->pixels) {
        pixels += part[lower++].pixels;
    }
    struct box upper = { .first = box->first + lower, .count = box->count - lower };
    box->count = lower;
    measure(box, list);
    measure(&upper, list);
    return upper;
}

static uint32_t mean_colour(const struct box *box, const struct palette_entry *list)
{
    uint32_t rgb = 0;
    for (uint32_t shift = 0; shift <= 16; shift += 8) {
        uint64_t sum = box->pixels / 2;
        for (uint32_t i = 0; i < box->count; i++) {
            const struct palette_entry *entry = &list[box->first + i];
            sum += entry->pixels * channel(entry->rgb, shift);
        }
        rgb |= (uint32_t)(sum / box->pixels) << shift;
    }
    return rgb;
}

static void choose(struct palette *palette, struct palette_entry *list)
{
    struct box boxes[PALETTE_COLOURS];
    uint32_t count = 1;
    boxes[0] = (struct box){ .count = palette->used };
    measure(&boxes[0], list);
    while (count < PALETTE_COLOURS) {
        struct box *box = worst_box(boxes, count);
        if (box == NULL) {
            break;
        }
        boxes[count++] = cut(box, list);
    }
    for (uint32_t i = 0; i < count; i++) {
        palette->rgb[i] = mean_colour(&boxes[i], list);
        for (uint32_t k = 0; k < boxes[i].count; k++) {
            find(palette, list[boxes[i].first + k].rgb)->index = i;
        }
    }
    palette->count = count;
}

bool palette_make(struct palette *palette, const struct image *frames, uint32_t count,
                  struct image_error *error)
{
    *palette = (struct palette){ 0 };
    for (uint32_t i = 0; i < count; i++) {
        if (!count_colours(palette, &frames[i], error)) {
            palette_free(palette);
            return false;
        }
    }
    struct palette_entry *list = malloc(palette->used * sizeof *list);
    if (list == NULL) {
        palette_free(palette);
        return image_fail(error, "not enough memory for the palette");
    }
    uint32_t used = 0;
    for (uint32_t i = 0; i < palette->capacity; i++) {
        if (palette->table[i].pixels != 0) {
            list[used++] = palette->table[i];
        }
    }
    qsort(list, used, sizeof *list, compare_red);
    choose(palette, list);
    free(list);
    return true;
}

uint32_t palette_index(const struct palette *palette, uint32_t rgb)
{
    return find(palette, rgb)->index;
}

void palette_free(struct palette *palette)
{
    free(palette->table);
    *palette = (struct palette){ 0 };
}
