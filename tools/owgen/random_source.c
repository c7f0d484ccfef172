/* SPDX-License-Identifier: 0BSD */
/* Random numbers that are the same on every machine: the splitmix64 generator. */
#include "tools/owgen/random_source.h"

uint64_t random_bits(struct random_source *source)
{
    source->state += UINT64_C(0x9e3779b97f4a7c15);
    uint64_t bits = source->state;
    bits = (bits ^ bits >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    bits = (bits ^ bits >> 27) * UINT64_C(0x94d049bb133111eb);
    return bits ^ bits >> 31;
}

double random_between(struct random_source *source, double low, double high)
{
    double share = (double)(random_bits(source) >> 11) * (1.0 / 9007199254740992.0);
    return low + (high - low) * share;
}
