/* SPDX-License-Identifier: 0BSD */
/* What is wrong with the input, as text: stages return it, main prints it. */
#ifndef OWC_PROBLEM_H
#define OWC_PROBLEM_H

struct problem {
    long line; /* of the input file; 0: no line */
    char text[400];
};

/* Writes the text and returns false, so that a stage can return problem_set(...). */
_Bool problem_set(struct problem *problem, long line, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
