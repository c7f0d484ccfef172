/* SPDX-License-Identifier: 0BSD */
/* A font of 5x7 pixels. */
#ifndef OW_DEVICE_FONT_H
#define OW_DEVICE_FONT_H

#include <stdint.h>

/* Line 0 .. 7 of a letter, the leftmost pixel lowest; small letters look like capitals. */
uint32_t font_line(char letter, uint32_t line);

#endif
