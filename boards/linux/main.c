/* SPDX-License-Identifier: 0BSD */
/* oldwell: the viewer on a Linux board's display. */
#include <signal.h>
#include <string.h>

#include "doctor.h"
#include "guardian.h"
#include "run.h"
#include "settings.h"
#include "tools/common/fail.h"

static struct oldwell_settings settings;
static struct run run;

static int draw(void *context)
{
    (void)context;
    if (settings.doctor) {
        struct report report = { .stream = stdout };
        return doctor_main(&report, &settings, &linux_system);
    }
    return run_main(&run, &settings, &linux_system);
}

/* Dies as the child did, so that who started us sees the same. */
static void end_by(int number)
{
    warn_line(NULL, 0, "the drawing process was ended by signal %d (%s)", number,
              strsignal(number));
    signal(number, SIG_DFL);
    raise(number);
}

/* With a console on the same screen: a guardian gives it back, whatever happens. */
static int draw_guarded(void)
{
    struct linux_console console;
    char text[600];
    int number;
    if (settings.doctor && settings.seconds == 0) {
        return draw(NULL);
    }
    if (linux_console_open(&console, &linux_system, settings.console) < 0) {
        linux_fault_text(&console.fault, text, sizeof text);
        warn_line(NULL, 0, "%s; text may be drawn over the picture", text);
    }
    if (console.fd < 0) {
        return draw(NULL);
    }
    int status = guardian_run(&console, draw, NULL, &number);
    if (number != 0) {
        end_by(number);
    }
    return status;
}

int main(int argc, char **argv)
{
    fail_set_program("oldwell");
    oldwell_settings_read(&settings, argc, argv);
    const struct output_kind *kind = output_kind_of(&settings);
    return kind != NULL && kind->on_console ? draw_guarded() : draw(NULL);
}
