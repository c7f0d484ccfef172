/* SPDX-License-Identifier: 0BSD */
/* Numbers: root, quotient and sine, all for set-up and none in an inner loop. */
#include "ow_fixed.h"

uint32_t ow_sqrt64(uint64_t x)
{
    uint64_t root = 0;
    for (uint64_t bit = (uint64_t)1 << 62; bit != 0; bit >>= 2) {
        uint64_t trial = root + bit;
        root >>= 1;
        if (x >= trial) {
            x -= trial;
            root += bit;
        }
    }
    return (uint32_t)root;
}

uint32_t ow_ratio(uint32_t numerator, uint32_t denominator, uint32_t shift)
{
    uint64_t rest = numerator;
    uint32_t quotient = 0;
    for (uint32_t i = 0; i < shift; i++) {
        rest <<= 1;
        quotient <<= 1;
        if (rest >= denominator) {
            rest -= denominator;
            quotient |= 1;
        }
    }
    return quotient;
}

/* Shifts x so that its highest bit is bit 31; returns by how much to the left (may be negative). */
static int32_t normalise(uint64_t x, uint32_t *mantissa)
{
    int32_t left = 0;
    while (x >> 32 != 0) {
        x >>= 1;
        left--;
    }
    uint32_t zeros = ow_leading_zeros((uint32_t)x);
    *mantissa = (uint32_t)x << zeros;
    return left + (int32_t)zeros;
}

struct ow_scale ow_scale_of(uint64_t numerator, uint64_t denominator)
{
    uint32_t n;
    uint32_t d;
    int32_t n_left = normalise(numerator, &n);
    int32_t d_left = normalise(denominator, &d);
    /* n/2 < d, so the ratio is below 1; it is above 1/4. */
    uint32_t quotient = ow_ratio(n >> 1, d, 32); /* n/d * 2^31, in 2^30 .. 2^32 */
    int32_t exponent = 31 + n_left - d_left;
    if (quotient >> 31) {
        quotient >>= 1;
        exponent--;
    }
    return (struct ow_scale){ quotient, exponent };
}

/* sin(i/256 of a quarter turn), 15 fraction bits. */
static const uint16_t quarter_sine_q15[257] = {
    0,     201,   402,   603,   804,   1005,  1206,  1407,  1608,  1809,  2009,  2210,  2411,
    2611,  2811,  3012,  3212,  3412,  3612,  3812,  4011,  4211,  4410,  4609,  4808,  5007,
    5205,  5404,  5602,  5800,  5998,  6195,  6393,  6590,  6787,  6983,  7180,  7376,  7571,
    7767,  7962,  8157,  8351,  8546,  8740,  8933,  9127,  9319,  9512,  9704,  9896,  10088,
    10279, 10469, 10660, 10850, 11039, 11228, 11417, 11605, 11793, 11980, 12167, 12354, 12540,
    12725, 12910, 13095, 13279, 13463, 13646, 13828, 14010, 14192, 14373, 14553, 14733, 14912,
    15091, 15269, 15447, 15624, 15800, 15976, 16151, 16326, 16500, 16673, 16846, 17018, 17190,
    17361, 17531, 17700, 17869, 18037, 18205, 18372, 18538, 18703, 18868, 19032, 19195, 19358,
    19520, 19681, 19841, 20001, 20160, 20318, 20475, 20632, 20788, 20943, 21097, 21251, 21403,
    21555, 21706, 21856, 22006, 22154, 22302, 22449, 22595, 22740, 22884, 23028, 23170, 23312,
    23453, 23593, 23732, 23870, 24008, 24144, 24279, 24414, 24548, 24680, 24812, 24943, 25073,
    25202, 25330, 25457, 25583, 25708, 25833, 25956, 26078, 26199, 26320, 26439, 26557, 26674,
    26791, 26906, 27020, 27133, 27246, 27357, 27467, 27576, 27684, 27791, 27897, 28002, 28106,
    28209, 28311, 28411, 28511, 28610, 28707, 28803, 28899, 28993, 29086, 29178, 29269, 29359,
    29448, 29535, 29622, 29707, 29792, 29875, 29957, 30038, 30118, 30196, 30274, 30350, 30425,
    30499, 30572, 30644, 30715, 30784, 30853, 30920, 30986, 31050, 31114, 31177, 31238, 31298,
    31357, 31415, 31471, 31527, 31581, 31634, 31686, 31737, 31786, 31834, 31881, 31927, 31972,
    32015, 32058, 32099, 32138, 32177, 32214, 32251, 32286, 32319, 32352, 32383, 32413, 32442,
    32470, 32496, 32522, 32546, 32568, 32590, 32610, 32629, 32647, 32664, 32679, 32693, 32706,
    32718, 32729, 32738, 32746, 32753, 32758, 32762, 32766, 32767, 32768,
};

ow_q30 ow_sin(ow_turn angle)
{
    uint32_t quarter = angle >> 30;
    uint32_t place = angle & 0x3FFFFFFF; /* in the quarter, 30 bits: 8 of index, 22 of fraction */
    if (quarter & 1) {
        place = 0x40000000 - place;
    }
    uint32_t index = place >> 22;
    uint32_t fraction = place >> 7 & 0x7FFF;
    uint32_t low = quarter_sine_q15[index];
    uint32_t step = index < 256 ? quarter_sine_q15[index + 1] - low : 0;
    int32_t sine = (int32_t)((low << 15) + step * fraction);
    return (quarter & 2) ? -sine : sine;
}

ow_q30 ow_cos(ow_turn angle)
{
    return ow_sin(angle + 0x40000000);
}
