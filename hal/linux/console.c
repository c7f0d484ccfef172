/* SPDX-License-Identifier: 0BSD */
/* KD_GRAPHICS and the cursor. */
#include "hal/linux/console.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/kd.h>
#include <stdint.h>
#include <string.h>

static const char hide_cursor[] = "\033[?25l";
static const char show_cursor[] = "\033[?25h";

static bool is_console(const struct linux_system *system, int fd)
{
    int mode;
    return linux_ioctl(system, fd, KDGETMODE, &mode) == 0;
}

static int set_mode(const struct linux_console *console, int mode)
{
    /* The mode is the argument itself, not what it points to. */
    return linux_ioctl(console->system, console->fd, KDSETMODE, (void *)(intptr_t)mode);
}

static int give_up(struct linux_console *console, const char *path, const char *call, bool quietly)
{
    int status = linux_fault_errno(&console->fault, path, call, errno);
    if (console->fd >= 0) {
        (void)console->system->close(console->fd);
        console->fd = -1;
    }
    if (status == OW_DENIED) {
        linux_fault_remedy(&console->fault, "start it from that console, or give --console none");
    }
    return quietly && status != OW_DENIED ? OW_OK : status;
}

int linux_console_open(struct linux_console *console, const struct linux_system *system,
                       const char *path)
{
    *console = (struct linux_console){ .system = system, .fd = -1 };
    if (strcmp(path, "none") == 0) {
        return OW_OK;
    }
    bool quietly = strcmp(path, "auto") == 0;
    if (quietly) {
        path = is_console(system, 0) ? "/proc/self/fd/0" : "/dev/tty0";
    }
    console->fd = system->open(path, O_RDWR | O_NOCTTY);
    if (console->fd < 0) {
        return give_up(console, path, "open", quietly);
    }
    if (linux_ioctl(system, console->fd, KDGETMODE, &console->before) != 0) {
        return give_up(console, path, "KDGETMODE", quietly);
    }
    return OW_OK;
}

int linux_console_take(struct linux_console *console)
{
    if (set_mode(console, KD_GRAPHICS) != 0) {
        return give_up(console, "the console", "KDSETMODE", false);
    }
    (void)!console->system->write(console->fd, hide_cursor, sizeof hide_cursor - 1);
    return OW_OK;
}

void linux_console_give_back(struct linux_console *console)
{
    if (console->fd >= 0) {
        (void)set_mode(console, console->before);
        (void)!console->system->write(console->fd, show_cursor, sizeof show_cursor - 1);
    }
}
