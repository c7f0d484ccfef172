/* SPDX-License-Identifier: 0BSD */
/* Numbers: reciprocal, root, quotient, scale and sine against double and their definition. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>
#include <math.h>

#include "ow_fixed.h"

static const double pi = 3.14159265358979323846;

static uint64_t random_state = 1;

static uint64_t random_bits(void)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    uint64_t high = random_state >> 32;
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return high << 32 | random_state >> 32;
}

/* A number whose length in bits is random too. */
static uint64_t random_length(void)
{
    return random_bits() >> (random_bits() % 64);
}

static void leading_zeros_are_counted(void **state)
{
    (void)state;
    assert_int_equal(ow_leading_zeros(0), 32);
    for (uint32_t i = 0; i < 32; i++) {
        assert_int_equal(ow_leading_zeros(1u << i), 31 - i);
        assert_int_equal(ow_leading_zeros(0xFFFFFFFFu >> i), i);
    }
}

/* |y - 2^63/x| <= 2^-29 * 2^63/x, that is |x*y - 2^63| <= 2^34. */
static void check_reciprocal(uint32_t x)
{
    uint32_t y = ow_reciprocal(x);
    uint64_t product = (uint64_t)x * y, one = (uint64_t)1 << 63;
    uint64_t error = product > one ? product - one : one - product;
    if (y < 0x80000000u || error > (uint64_t)1 << 34) {
        print_error("reciprocal of %u is %u\n", x, y);
        fail();
    }
}

static void reciprocals_are_within_their_bound(void **state)
{
    (void)state;
    for (uint32_t high = 0x8000; high <= 0xFFFF; high++) {
        check_reciprocal(high << 16);
        check_reciprocal(high << 16 | 0xFFFF);
        for (uint32_t k = 0; k < 60; k++) {
            check_reciprocal(high << 16 | (uint32_t)(random_bits() & 0xFFFF));
        }
    }
}

static void roots_are_rounded_down(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 200000; i++) {
        uint64_t x = i < 1000 ? i : random_length();
        if (i % 3 == 0) { /* about squares */
            uint64_t root = x >> 33 << 1 | 1;
            x = root * root - (i % 2);
        }
        uint64_t root = ow_sqrt64(x);
        assert_true(root * root <= x);
        assert_true(root == 0xFFFFFFFFu || (root + 1) * (root + 1) > x);
    }
    assert_int_equal(ow_sqrt64(UINT64_MAX), 0xFFFFFFFFu);
}

static void ratios_are_rounded_down(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 200000; i++) {
        uint32_t d = (uint32_t)random_length(), n = (uint32_t)random_length();
        d += d == 0;
        n %= d;
        uint32_t shift = (uint32_t)(random_bits() % 33);
        assert_int_equal(ow_ratio(n, d, shift), ((uint64_t)n << shift) / d);
    }
    assert_int_equal(ow_ratio(0xFFFFFFFE, 0xFFFFFFFF, 32), 0xFFFFFFFE);
}

static void scales_are_close_and_normal(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 200000; i++) {
        uint64_t n = random_length(), d = random_length();
        n += n == 0;
        d += d == 0;
        struct ow_scale scale = ow_scale_of(n, d);
        assert_true(scale.mantissa >= 1u << 30 && scale.mantissa < 1u << 31);
        double due = (double)n / (double)d;
        assert_true(fabs(ldexp(scale.mantissa, -scale.exponent) / due - 1) <= ldexp(1, -29));
    }
    assert_int_equal(ow_scale_of(1, 1).mantissa, 1 << 30);
    assert_int_equal(ow_scale_of(1, 1).exponent, 30);
}

static void sines_are_within_their_bound(void **state)
{
    (void)state;
    double worst = 0;
    for (uint32_t i = 0; i < 1000000; i++) {
        uint32_t angle = i < 4096 ? i << 20 : (uint32_t)random_bits();
        double turn = 2 * pi * angle / 4294967296.0;
        worst = fmax(worst, fabs(ldexp(ow_sin(angle), -30) - sin(turn)));
        worst = fmax(worst, fabs(ldexp(ow_cos(angle), -30) - cos(turn)));
    }
    print_message("worst error of a sine: 2^%.2f\n", log2(worst));
    assert_true(worst <= ldexp(1, -15));
}

static void sines_are_exact_at_quarters_and_symmetric(void **state)
{
    (void)state;
    assert_int_equal(ow_sin(0), 0);
    assert_int_equal(ow_sin(0x40000000), 1 << 30);
    assert_int_equal(ow_sin(0x80000000u), 0);
    assert_int_equal(ow_sin(0xC0000000u), -(1 << 30));
    assert_int_equal(ow_cos(0), 1 << 30);
    assert_int_equal(ow_cos(0x40000000), 0);
    for (uint32_t i = 0; i < 100000; i++) {
        uint32_t angle = (uint32_t)random_bits();
        assert_int_equal(ow_sin(0u - angle), -ow_sin(angle));
        assert_int_equal(ow_sin(0x80000000u - angle), ow_sin(angle));
        assert_int_equal(ow_cos(angle), ow_sin(angle + 0x40000000));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(leading_zeros_are_counted),
        cmocka_unit_test(reciprocals_are_within_their_bound),
        cmocka_unit_test(roots_are_rounded_down),
        cmocka_unit_test(ratios_are_rounded_down),
        cmocka_unit_test(scales_are_close_and_normal),
        cmocka_unit_test(sines_are_within_their_bound),
        cmocka_unit_test(sines_are_exact_at_quarters_and_symmetric),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
