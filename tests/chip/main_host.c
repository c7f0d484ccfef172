/* SPDX-License-Identifier: 0BSD */
/* scenes FLAT.owt SMOOTH.owt: draws the scenes on a machine with an operating system. */
#include <stdio.h>
#include <stdlib.h>

#include "tests/chip/scenes.h"

enum { TREE_BYTES_MAX = 1 << 22, MEMORY_BYTES = 1 << 22 };

uint32_t scene_units(void)
{
    return 0;
}

static void read_tree(struct ow_tree *tree, const char *name)
{
    FILE *file = fopen(name, "rb");
    void *bytes = malloc(TREE_BYTES_MAX);
    size_t size = file != NULL && bytes != NULL ? fread(bytes, 1, TREE_BYTES_MAX, file) : 0;
    int status = ow_tree_open(tree, bytes, (uint32_t)size);
    if (status < 0) {
        fprintf(stderr, "scenes: %s: %s\n", name, ow_status_text(status));
        exit(1);
    }
    fclose(file);
}

int main(int argc, char **argv)
{
    static struct ow_tree trees[2];
    static uint64_t memory[MEMORY_BYTES / 8];
    if (argc != 3) {
        fprintf(stderr, "usage: scenes FLAT.owt SMOOTH.owt\n");
        return 2;
    }
    read_tree(&trees[0], argv[1]);
    read_tree(&trees[1], argv[2]);
    for (uint32_t i = 0; i < scene_count; i++) {
        struct scene_result result;
        char line[128];
        bool smooth = scenes[i].shade == OW_SHADE_GOURAUD || scenes[i].shade == OW_SHADE_PHONG;
        scene_draw(&scenes[i], &trees[smooth], memory, sizeof memory, &result);
        scene_line(line, &scenes[i], &result);
        puts(line);
    }
    return 0;
}
