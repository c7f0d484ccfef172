/* SPDX-License-Identifier: 0BSD */
/* oldwell: the viewer on a Linux board's display. */
#include "run.h"
#include "settings.h"
#include "tools/common/fail.h"

int main(int argc, char **argv)
{
    static struct oldwell_settings settings;
    static struct run run;
    fail_set_program("oldwell");
    oldwell_settings_read(&settings, argc, argv);
    return run_main(&run, &settings, &linux_system);
}
