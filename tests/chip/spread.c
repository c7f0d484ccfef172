/* SPDX-License-Identifier: 0BSD */
/* spread N: copies standard input, each byte followed by N - 1 others that mean nothing. */
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv)
{
    int step = argc == 2 ? atoi(argv[1]) : 0;
    unsigned other = 0x5A;
    if (step < 1) {
        fprintf(stderr, "usage: spread N <file >file\n");
        return 2;
    }
    for (int c = getchar(); c != EOF; c = getchar()) {
        putchar(c);
        for (int i = 1; i < step; i++) {
            other = other * 5 + 3;
            putchar((int)(other >> 2 & 255));
        }
    }
    return fclose(stdout) == 0 ? 0 : 1;
}
