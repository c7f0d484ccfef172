/* SPDX-License-Identifier: 0BSD */
/* A line of text that is put together piece by piece; what does not fit is left out. */
#ifndef OW_DEVICE_TEXT_H
#define OW_DEVICE_TEXT_H

#include <stdint.h>

enum { TEXT_BYTES = 120 };

struct text {
    uint32_t length;
    char bytes[TEXT_BYTES];
};

static inline void text_char(struct text *text, char c)
{
    if (text->length < TEXT_BYTES - 1) {
        text->bytes[text->length++] = c;
        text->bytes[text->length] = '\0';
    }
}

static inline void text_add(struct text *text, const char *more)
{
    while (*more != '\0') {
        text_char(text, *more++);
    }
}

static inline void text_number(struct text *text, uint32_t value)
{
    char digits[10];
    uint32_t count = 0;
    do {
        digits[count++] = (char)('0' + value % 10);
        value /= 10;
    } while (value > 0);
    while (count > 0) {
        text_char(text, digits[--count]);
    }
}

static inline void text_signed(struct text *text, int32_t value)
{
    if (value < 0) {
        text_char(text, '-');
    }
    text_number(text, value < 0 ? 0u - (uint32_t)value : (uint32_t)value);
}

/* A name and its number, after a blank. */
static inline void text_pair(struct text *text, const char *name, int32_t value)
{
    text_char(text, ' ');
    text_add(text, name);
    text_char(text, ' ');
    text_signed(text, value);
}

#endif
