/* SPDX-License-Identifier: 0BSD */
/* vmtool COMMAND ARGUMENT...: chooses the command. */
#include <errno.h>
#include <grp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/vm/tool/tool.h"

int failed(const char *what)
{
    fprintf(stderr, "vmtool: %s: %s\n", what, strerror(errno));
    return 1;
}

/* UID COMMAND...: runs the command as a user without groups. */
static int tool_as(int argc, char **argv)
{
    uid_t user = (uid_t)atoi(argv[0]);
    (void)argc;
    if (setgroups(0, NULL) != 0 || setgid(user) != 0 || setuid(user) != 0) {
        return failed("setuid");
    }
    execvp(argv[1], argv + 1);
    return failed(argv[1]);
}

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        int arguments; /* at least */
        int (*run)(int argc, char **argv);
    } commands[] = {
        { "as", 2, tool_as },     { "capture", 3, tool_capture }, { "console", 0, tool_console },
        { "fb", 1, tool_fb },     { "feed", 2, tool_feed },       { "hold", 2, tool_hold },
        { "keys", 1, tool_keys }, { "loop", 5, tool_loop },       { "master", 1, tool_master },
        { "size", 1, tool_size }, { "spi", 6, tool_spi },
    };
    for (size_t i = 0; argc > 1 && i < sizeof commands / sizeof commands[0]; i++) {
        if (strcmp(argv[1], commands[i].name) == 0 && argc - 2 >= commands[i].arguments) {
            return commands[i].run(argc - 2, argv + 2);
        }
    }
    fputs("vmtool: no such command, or too few arguments\n", stderr);
    return 2;
}
