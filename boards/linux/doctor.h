/* SPDX-License-Identifier: 0BSD */
/* oldwell doctor: what is right with this board and its display, and what to do. */
#ifndef OLDWELL_BOARDS_LINUX_DOCTOR_H
#define OLDWELL_BOARDS_LINUX_DOCTOR_H

#include "hal/linux/system.h"
#include "report.h"
#include "settings.h"

/* Looks at everything, then shows the test pattern for some seconds. The exit status. */
int doctor_main(struct report *report, const struct oldwell_settings *settings,
                const struct linux_system *system);

#endif
