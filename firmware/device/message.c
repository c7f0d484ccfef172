/* SPDX-License-Identifier: 0BSD */
/* Text to pixels, a row of characters at a time. */
#include "message.h"

#include "font.h"

enum {
    CELL = 6,         /* pixels from a character to the next */
    ROW = 8,          /* pixels from a row of characters to the next */
    SCALE_WIDTH = 160 /* a panel's pixels for each pixel of the font */
};

struct page {
    struct ow_panel_info info;
    uint32_t scale;
    uint32_t columns;
    uint32_t stride;
    uint32_t ink;
    uint32_t ground;
};

/* Characters of the row that begins at text; *next: where the next row begins. */
static uint32_t row_length(const char *text, uint32_t columns, const char **next)
{
    uint32_t length = 0;
    uint32_t blank = 0; /* the last place where the row may be broken */
    while (text[length] != '\0' && text[length] != '\n' && length <= columns) {
        if (text[length] == ' ') {
            blank = length;
        }
        length++;
    }
    if (length > columns) {
        length = blank > 0 ? blank : columns;
    }
    *next = text + length;
    if (**next == ' ' || **next == '\n') {
        (*next)++;
    }
    return length;
}

/* One line of pixels of a row of characters, line 0 .. ROW-1 of the font. */
static void draw_line(const struct page *page, uint8_t *pixels, const char *text, uint32_t length,
                      uint32_t line)
{
    const struct ow_pixel_format *format = page->info.format;
    format->fill(pixels, 0, page->info.width, page->ground);
    for (uint32_t i = 0; i < length; i++) {
        uint32_t bits = font_line(text[i], line);
        for (uint32_t x = 0; bits != 0; x++, bits >>= 1) {
            uint32_t from = (i * CELL + x) * page->scale;
            if (bits & 1) {
                format->fill(pixels, from, from + page->scale, page->ink);
            }
        }
    }
}

/* Lines first .. first+count-1 of the panel. *text: the row that the lines are of. */
static void draw_lines(const struct page *page, uint8_t *pixels, uint32_t first, uint32_t count,
                       const char **text)
{
    uint32_t row_lines = ROW * page->scale;
    for (uint32_t y = first; y < first + count; y++) {
        const char *next;
        uint32_t length = row_length(*text, page->columns, &next);
        draw_line(page, pixels + (y - first) * page->stride, *text, length,
                  y % row_lines / page->scale);
        if (y % row_lines == row_lines - 1) {
            *text = next;
        }
    }
}

/* Until the band may be written again. A panel that never answers is the watchdog's. */
static int wait_free(const struct ow_panel *panel)
{
    int status;
    do {
        status = ow_panel_done(panel, 0);
    } while (status == OW_AGAIN);
    return status;
}

static int write_bands(const struct ow_panel *panel, const struct page *page, const char *text,
                       void *memory, uint32_t bytes)
{
    uint32_t lines = bytes / page->stride / page->info.align_y * page->info.align_y;
    if (lines == 0) {
        return OW_MEMORY;
    }
    int status = OW_OK;
    for (uint32_t y = 0; y < page->info.height && status >= 0; y += lines) {
        uint32_t left = page->info.height - y;
        uint32_t count = left < lines ? left : lines;
        draw_lines(page, memory, y, count, &text);
        struct ow_panel_rect rect = { 0, (uint16_t)y, page->info.width, (uint16_t)count };
        status = panel->ops->write(panel->device, &rect, memory, page->stride, count == left);
        status = status < 0 ? status : wait_free(panel);
    }
    return status;
}

int message_show(const struct ow_panel *panel, const char *text, void *memory, uint32_t bytes)
{
    struct page page;
    int status = ow_panel_check(panel, &page.info);
    if (status < 0) {
        return status;
    }
    page.scale = page.info.width / SCALE_WIDTH > 0 ? page.info.width / SCALE_WIDTH : 1;
    page.columns = page.info.width / page.scale / CELL;
    page.ink = page.info.format->pack(0xFFFFFF);
    page.ground = page.info.format->pack(0);
    page.stride = (ow_row_bytes(page.info.format, page.info.width) + 3) / 4 * 4;
    if (!ow_panel_lends(panel)) {
        return write_bands(panel, &page, text, memory, bytes);
    }
    struct ow_panel_buffer buffer;
    status = panel->ops->lend(panel->device, &buffer);
    if (status < 0) {
        return status;
    }
    page.stride = buffer.stride;
    draw_lines(&page, buffer.pixels, 0, page.info.height, &text);
    struct ow_panel_rect all = { 0, 0, page.info.width, page.info.height };
    return panel->ops->show(panel->device, &all, 1);
}
