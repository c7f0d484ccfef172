/* SPDX-License-Identifier: 0BSD */
/* The driver's parts, for each other: command_panel.c calls command_window.c, command_pixels.c. */
#ifndef OW_HAL_PANEL_COMMAND_STAGES_H
#define OW_HAL_PANEL_COMMAND_STAGES_H

#include "hal/panel/command_panel.h"

/* command_window.c: says how memory lies on the glass for device->rotation. */
void command_turn(struct ow_command_panel *device);
int command_send_map(struct ow_command_panel *device);

/* command_window.c: OW_UNSUPPORTED unless the controller can turn the picture so. */
int command_can_turn(const struct ow_command_panel_config *config, uint32_t rotation);

/* command_window.c: aims what follows at a rectangle of the picture. */
int command_set_window(struct ow_command_panel *device, const struct ow_panel_rect *rect);

/* command_pixels.c: sends a rectangle's pixels; *calls: bus transfers that use them still. */
int command_send_pixels(struct ow_command_panel *device, const struct ow_panel_rect *rect,
                        const uint8_t *pixels, uint32_t stride, uint32_t *calls);

/* command_panel.c: sends a command when no pixels are under way any more. */
int command_send(struct ow_command_panel *device, uint8_t code, const uint8_t *parameters,
                 uint32_t count);

/* command_panel.c: waits until at most pending transfers use their bytes. */
int command_wait_bus(struct ow_command_panel *device, uint32_t pending);

#endif
