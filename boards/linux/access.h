/* SPDX-License-Identifier: 0BSD */
/* Who may use a device node, and what is missing. */
#ifndef OLDWELL_BOARDS_LINUX_ACCESS_H
#define OLDWELL_BOARDS_LINUX_ACCESS_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/stat.h>
#include <sys/types.h>

/* Whom the question is about. */
struct access_user {
    uid_t user;
    const gid_t *groups;
    size_t group_count;
};

/*
 * May this user read and write the node? Fills text with the reason, or with
 * what is missing and what to do. group: the name of the node's group, "" where
 * it has none.
 */
bool access_explain(const struct stat *node, const struct access_user *user, const char *group,
                    char *text, size_t bytes);

/* The same for this process and a path; false also where the path cannot be looked at. */
bool access_of_path(const char *path, char *text, size_t bytes);

#endif
