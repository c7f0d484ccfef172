/* SPDX-License-Identifier: 0BSD */
/* Sines and cosines of degrees, exact at the multiples of 90 and symmetric between them. */
#ifndef OLDWELL_TOOLS_OWGEN_CIRCLE_H
#define OLDWELL_TOOLS_OWGEN_CIRCLE_H

double circle_sin(double degrees);
double circle_cos(double degrees);

#endif
