/* SPDX-License-Identifier: 0BSD */
/* Permissions of device nodes in words. */
#include "access.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { GROUPS_MOST = 256, LINE_BYTES = 4096, NAME_BYTES = 64 };

static bool is_member(const struct access_user *user, gid_t group)
{
    for (size_t i = 0; i < user->group_count; i++) {
        if (user->groups[i] == group) {
            return true;
        }
    }
    return false;
}

bool access_explain(const struct stat *node, const struct access_user *user, const char *group,
                    char *text, size_t bytes)
{
    bool by_group = (node->st_mode & S_IRGRP) != 0 && (node->st_mode & S_IWGRP) != 0;
    if (user->user == 0) {
        snprintf(text, bytes, "root may use it");
        return true;
    }
    if (node->st_uid == user->user && (node->st_mode & S_IRUSR) != 0 &&
        (node->st_mode & S_IWUSR) != 0) {
        snprintf(text, bytes, "its owner may use it");
        return true;
    }
    if (by_group && is_member(user, node->st_gid)) {
        snprintf(text, bytes, "group %s may use it", group[0] != '\0' ? group : "of the node");
        return true;
    }
    if ((node->st_mode & S_IROTH) != 0 && (node->st_mode & S_IWOTH) != 0) {
        snprintf(text, bytes, "everybody may use it");
        return true;
    }
    if (by_group && node->st_gid != 0 && group[0] != '\0') {
        snprintf(text, bytes,
                 "group %s may use it and you are not in it; "
                 "as root: usermod -aG %s USER, then log in again",
                 group, group);
    } else {
        snprintf(text, bytes,
                 "only root may use it; install the udev rule 70-oldwell.rules, then as root: "
                 "udevadm control --reload && udevadm trigger");
    }
    return false;
}

/* From /etc/group: the C library's own way needs shared libraries. */
static void find_group_name(gid_t group, char *name, size_t bytes)
{
    char line[LINE_BYTES];
    FILE *stream = fopen("/etc/group", "re");
    name[0] = '\0';
    while (stream != NULL && name[0] == '\0' && fgets(line, sizeof line, stream) != NULL) {
        unsigned number;
        size_t length = strcspn(line, ":");
        const char *second = strchr(line + length + (line[length] == ':'), ':');
        if (second != NULL && length < bytes && sscanf(second, ":%u", &number) == 1 &&
            number == group) {
            memcpy(name, line, length);
            name[length] = '\0';
        }
    }
    if (stream != NULL) {
        fclose(stream);
    }
}

bool access_of_path(const char *path, char *text, size_t bytes)
{
    gid_t groups[GROUPS_MOST + 1];
    char name[NAME_BYTES];
    struct stat node;
    if (stat(path, &node) != 0) {
        snprintf(text, bytes, "%s", strerror(errno));
        return false;
    }
    int count = getgroups(GROUPS_MOST, groups);
    count = count < 0 ? 0 : count;
    groups[count++] = getegid();
    find_group_name(node.st_gid, name, sizeof name);
    const struct access_user user = { geteuid(), groups, (size_t)count };
    return access_explain(&node, &user, name, text, bytes);
}
