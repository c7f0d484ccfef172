/* SPDX-License-Identifier: 0BSD */
/* The head of a PGM. */
#include "planes_file.h"

#include <stdbool.h>

#include "ow_view.h"

/* What is being read. */
struct head {
    const uint8_t *file;
    size_t bytes;
    size_t at;
};

static bool is_blank(uint8_t c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/* Blanks, and comments up to the line's end. False if there are none. */
static bool skip_blanks(struct head *head)
{
    size_t begin = head->at;
    while (head->at < head->bytes) {
        if (head->file[head->at] == '#') {
            while (head->at < head->bytes && head->file[head->at] != '\n') {
                head->at++;
            }
        } else if (is_blank(head->file[head->at])) {
            head->at++;
        } else {
            break;
        }
    }
    return head->at > begin;
}

/* A number 1 .. most after blanks; 0 if there is none. */
static uint32_t read_number(struct head *head, uint32_t most)
{
    uint32_t number = 0;
    if (!skip_blanks(head)) {
        return 0;
    }
    while (head->at < head->bytes && head->file[head->at] >= '0' && head->file[head->at] <= '9') {
        number = 10 * number + (head->file[head->at++] - (uint32_t)'0');
        if (number > most) {
            return 0;
        }
    }
    return number;
}

size_t planes_file_head(const uint8_t *file, size_t bytes, uint32_t size[2])
{
    struct head head = { file, bytes, 2 };
    if (bytes < 2 || file[0] != 'P' || file[1] != '5') {
        return 0;
    }
    size[0] = read_number(&head, OW_SCREEN_MAX);
    size[1] = read_number(&head, OW_SCREEN_MAX);
    uint32_t levels = read_number(&head, 255);
    if (size[0] == 0 || size[1] == 0 || levels != 255 || head.at >= bytes ||
        !is_blank(file[head.at])) {
        return 0;
    }
    head.at++;
    return bytes - head.at >= (size_t)size[0] * size[1] ? head.at : 0;
}
