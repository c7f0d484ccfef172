/* SPDX-License-Identifier: 0BSD */
/* Directions: to unit length without a division, and from the camera's axes to the model's. */
#include "ow_light.h"

void ow_to_model(int32_t model[3], const int32_t camera[3], const struct ow_view *view)
{
    for (int i = 0; i < 3; i++) {
        int64_t sum = (int64_t)camera[0] * view->right[i] + (int64_t)camera[1] * view->up[i] -
                      (int64_t)camera[2] * view->forward[i];
        model[i] = (int32_t)(sum >> 30);
    }
}
