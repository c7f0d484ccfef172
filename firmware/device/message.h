/* SPDX-License-Identifier: 0BSD */
/* A message on the panel, for when there is no picture: capitals, 5x7, as large as suits. */
#ifndef OW_DEVICE_MESSAGE_H
#define OW_DEVICE_MESSAGE_H

#include "hal/panel.h"

/*
 * Shows a text, broken at blanks and at '\n', on a dark ground. memory, aligned
 * to 4 bytes: a band for panels that take writes; a panel that lends needs
 * none. Returns OW_OK, OW_MEMORY (no room for a band of 8 lines), or what the
 * panel reports.
 */
int message_show(const struct ow_panel *panel, const char *text, void *memory, uint32_t bytes);

#endif
