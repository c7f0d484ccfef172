/* SPDX-License-Identifier: 0BSD */
/* Sines and cosines of degrees, exact at the multiples of 90 and symmetric between them. */
#include "tools/owgen/circle.h"

#include <math.h>

double circle_sin(double degrees)
{
    const double to_radians = 3.14159265358979323846 / 180;
    double angle = fmod(degrees, 360);
    angle = angle < 0 ? angle + 360 : angle;
    double sign = 1;
    if (angle >= 180) {
        angle -= 180;
        sign = -1;
    }
    angle = angle > 90 ? 180 - angle : angle;
    /* The series near 0 is used on both halves, so that equal angles give equal values. */
    return sign * (angle <= 45 ? sin(angle * to_radians) : cos((90 - angle) * to_radians));
}

double circle_cos(double degrees)
{
    return circle_sin(degrees + 90);
}
