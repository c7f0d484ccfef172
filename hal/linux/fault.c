/* SPDX-License-Identifier: 0BSD */
/* Error numbers become statuses, and words with a remedy. */
#include "hal/linux/fault.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

struct meaning {
    int number;
    int status;
};

static const struct meaning meanings[] = {
    { ENOENT, OW_GONE },        { ENODEV, OW_GONE },
    { ENXIO, OW_GONE },         { ENOTDIR, OW_GONE },
    { ESHUTDOWN, OW_GONE },     { EACCES, OW_DENIED },
    { EPERM, OW_DENIED },       { EROFS, OW_DENIED },
    { EBUSY, OW_BUSY },         { EAGAIN, OW_AGAIN },
    { ETIMEDOUT, OW_TIMEOUT },  { ETIME, OW_TIMEOUT },
    { ENOTTY, OW_UNSUPPORTED }, { EOPNOTSUPP, OW_UNSUPPORTED },
    { ENOSYS, OW_UNSUPPORTED }, { ENOSPC, OW_FULL },
};

int linux_status_of(int number)
{
    for (size_t i = 0; i < sizeof meanings / sizeof meanings[0]; i++) {
        if (meanings[i].number == number) {
            return meanings[i].status;
        }
    }
    return OW_BUS;
}

static const char *usual_remedy(int status)
{
    switch (status) {
    case OW_GONE:
        return "connect the device and load its driver, or name another one";
    case OW_DENIED:
        return "run `oldwell doctor` to see which group or udev rule is missing";
    case OW_BUSY:
        return "end the program that holds it";
    case OW_TIMEOUT:
        return "see what the kernel says about it (dmesg)";
    case OW_BUS:
        return "check cables and supply, and what the kernel says (dmesg)";
    default:
        return "";
    }
}

static void copy(char *to, size_t bytes, const char *from)
{
    size_t length = strlen(from);
    length = length < bytes ? length : bytes - 1;
    memcpy(to, from, length);
    to[length] = '\0';
}

int linux_fault_note(struct linux_fault *fault, int status, const char *device, const char *call,
                     const char *why, const char *remedy)
{
    copy(fault->device, sizeof fault->device, device);
    copy(fault->call, sizeof fault->call, call != NULL ? call : "");
    copy(fault->why, sizeof fault->why, why);
    copy(fault->remedy, sizeof fault->remedy, remedy);
    fault->status = status;
    return status;
}

int linux_fault_errno(struct linux_fault *fault, const char *device, const char *call, int number)
{
    int status = linux_status_of(number);
    return linux_fault_note(fault, status, device, call, strerror(number), usual_remedy(status));
}

void linux_fault_remedy(struct linux_fault *fault, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(fault->remedy, sizeof fault->remedy, format, arguments);
    va_end(arguments);
}

void linux_fault_text(const struct linux_fault *fault, char *text, size_t bytes)
{
    snprintf(text, bytes, "%s: %s%s%s%s%s", fault->device, fault->call,
             fault->call[0] != '\0' ? ": " : "", fault->why, fault->remedy[0] != '\0' ? "; " : "",
             fault->remedy);
}
