/* SPDX-License-Identifier: 0BSD */
/* Frames go to a file, over each other. */
#include "hal/linux/raw_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

static int failed(struct linux_raw_file *file, const char *call)
{
    return linux_fault_errno(&file->fault, file->config.device, call, errno);
}

int linux_raw_file_open(struct linux_raw_file *file, const struct linux_raw_file_config *config)
{
    *file = (struct linux_raw_file){ .config = *config };
    file->stride = (ow_row_bytes(config->format, config->width) + 3) / 4 * 4;
    file->fd = config->system->open(config->device, O_RDWR | O_CREAT);
    if (file->fd < 0) {
        return failed(file, "open");
    }
    file->frame = calloc(config->height, file->stride);
    if (file->frame == NULL) {
        linux_raw_file_close(file);
        return linux_fault_note(&file->fault, OW_MEMORY, config->device, NULL,
                                "not enough memory for a frame", "");
    }
    return OW_OK;
}

void linux_raw_file_close(struct linux_raw_file *file)
{
    if (file->fd >= 0 && file->config.system != NULL) {
        (void)file->config.system->close(file->fd);
    }
    free(file->frame);
    file->frame = NULL;
    file->fd = -1;
}

static int raw_info(void *device, struct ow_panel_info *info)
{
    const struct linux_raw_file *file = device;
    *info = (struct ow_panel_info){
        .width = file->config.width,
        .height = file->config.height,
        .format = file->config.format,
        .align_x = 1,
        .align_y = 1,
        .buffers = 1,
    };
    return OW_OK;
}

static int raw_lend(void *device, struct ow_panel_buffer *buffer)
{
    struct linux_raw_file *file = device;
    *buffer = (struct ow_panel_buffer){ file->frame, file->stride, file->known ? 1 : 0 };
    return OW_OK;
}

static int raw_show(void *device, const struct ow_panel_rect *changed, uint32_t count)
{
    struct linux_raw_file *file = device;
    const struct linux_system *system = file->config.system;
    size_t bytes = (size_t)file->stride * file->config.height;
    (void)changed;
    file->known = count > 0;
    if (count == 0) {
        return OW_OK;
    }
    if (lseek(file->fd, 0, SEEK_SET) < 0) {
        return failed(file, "lseek");
    }
    for (size_t at = 0; at < bytes;) {
        ssize_t written = system->write(file->fd, file->frame + at, bytes - at);
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written <= 0) {
            file->known = false;
            return failed(file, "write");
        }
        at += (size_t)written;
    }
    file->frames++;
    return OW_OK;
}

const struct ow_panel_ops linux_raw_file_ops = {
    .info = raw_info,
    .lend = raw_lend,
    .show = raw_show,
};
