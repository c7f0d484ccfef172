/* SPDX-License-Identifier: 0BSD */
/* The compiler's exact numbers against schoolbook arithmetic on digits, limits included. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "tools/owc/exact.h"
#include "tools/owc/random.h"

/* ---- big integers: a sign and 16-bit digits, lowest first ---- */

enum { DIGITS = 20 };

struct big {
    int sign; /* -1, 0, 1 */
    uint32_t digits[DIGITS];
};

static int compare_sizes(const struct big *a, const struct big *b)
{
    for (int i = DIGITS - 1; i >= 0; i--) {
        if (a->digits[i] != b->digits[i]) {
            return a->digits[i] > b->digits[i] ? 1 : -1;
        }
    }
    return 0;
}

static struct big big_of(int64_t value)
{
    struct big r = { (value > 0) - (value < 0), { 0 } };
    uint64_t size = value < 0 ? 0 - (uint64_t)value : (uint64_t)value;
    for (int i = 0; i < 4; i++) {
        r.digits[i] = (uint32_t)(size >> 16 * i & 0xFFFF);
    }
    return r;
}

static struct big big_of_wide(wide value)
{
    struct big r = { wide_sign(value), { 0 } };
    uwide size = value < 0 ? 0 - (uwide)value : (uwide)value;
    for (int i = 0; i < 8; i++) {
        r.digits[i] = (uint32_t)(size >> 16 * i & 0xFFFF);
    }
    return r;
}

static struct big big_times(struct big a, struct big b)
{
    struct big r = { a.sign * b.sign, { 0 } };
    for (int i = 0; i < DIGITS; i++) {
        uint32_t carry = 0;
        for (int k = 0; i + k < DIGITS; k++) {
            uint32_t sum = r.digits[i + k] + a.digits[i] * b.digits[k] + carry;
            r.digits[i + k] = sum & 0xFFFF;
            carry = sum >> 16;
        }
        assert_int_equal(carry, 0);
    }
    return r;
}

static struct big big_plus(struct big a, struct big b)
{
    if (a.sign == 0 || b.sign == 0) {
        return a.sign == 0 ? b : a;
    }
    if (a.sign != b.sign && compare_sizes(&a, &b) < 0) {
        struct big swap = a;
        a = b;
        b = swap;
    }
    struct big r = { a.sign, { 0 } };
    int32_t carry = 0;
    uint32_t any = 0;
    for (int i = 0; i < DIGITS; i++) {
        int32_t other = (int32_t)b.digits[i] * (a.sign == b.sign ? 1 : -1);
        int32_t sum = (int32_t)a.digits[i] + other + carry;
        r.digits[i] = (uint32_t)(sum & 0xFFFF);
        carry = (sum - (sum & 0xFFFF)) / 65536;
        any |= r.digits[i];
    }
    r.sign = any ? r.sign : 0;
    return r;
}

static struct big big_minus(struct big a, struct big b)
{
    b.sign = -b.sign;
    return big_plus(a, b);
}

static void assert_same(struct big a, struct big b)
{
    assert_int_equal(a.sign, b.sign);
    assert_memory_equal(a.digits, b.digits, sizeof a.digits);
}

/* ---- random planes and points, often at the limits ---- */

static int64_t random_number(struct random *random, int bits)
{
    int64_t limit = ((int64_t)1 << bits) - 1;
    switch (random_below(random, 6)) {
    case 0:
        return limit;
    case 1:
        return -limit;
    case 2:
        return (int64_t)random_below(random, 5) - 2;
    default:
        return (int64_t)(random_next(random) % (2 * (uint64_t)limit + 1)) - limit;
    }
}

static struct plane random_plane(struct random *random)
{
    struct plane plane;
    memset(&plane, 0, sizeof plane);
    for (int k = 0; k < 3; k++) {
        plane.n[k] = (int32_t)random_number(random, NORMAL_BITS);
    }
    plane.d = random_number(random, OFFSET_BITS);
    return plane;
}

static struct big determinant(const struct big rows[3][3])
{
    struct big sum = big_of(0);
    for (int i = 0; i < 3; i++) {
        int a = (i + 1) % 3;
        int b = (i + 2) % 3;
        struct big minor =
            big_minus(big_times(rows[1][a], rows[2][b]), big_times(rows[1][b], rows[2][a]));
        sum = big_plus(sum, big_times(rows[0][i], minor));
    }
    return sum;
}

/* ---- tests ---- */

/* The schoolbook itself: products and differences that 64-bit numbers can tell. */
static void test_schoolbook(void **state)
{
    (void)state;
    struct random random = { 1 };
    for (int i = 0; i < 1000; i++) {
        int64_t a = random_number(&random, 31);
        int64_t b = random_number(&random, 31);
        assert_same(big_times(big_of(a), big_of(b)), big_of(a * b));
        assert_same(big_plus(big_of(a), big_of(b)), big_of(a + b));
        assert_same(big_minus(big_of(a), big_of(b)), big_of(a - b));
    }
}

/* n.v + d of lattice points is exact at all limits. */
static void test_side(void **state)
{
    (void)state;
    struct random random = { 2 };
    for (int i = 0; i < 5000; i++) {
        struct plane plane = random_plane(&random);
        int16_t point[3];
        struct big sum = big_of(plane.d);
        for (int k = 0; k < 3; k++) {
            point[k] = (int16_t)random_number(&random, POINT_BITS);
            sum = big_plus(sum, big_times(big_of(plane.n[k]), big_of(point[k])));
        }
        int64_t side = exact_side(&plane, point);
        assert_same(big_of(side), sum);
        assert_true(llabs(side) < (int64_t)1 << SIDE_BITS);
    }
}

/* Meeting points by Cramer's rule, and the side of a fourth plane, exact at all limits. */
static void test_meeting(void **state)
{
    (void)state;
    struct random random = { 3 };
    int met = 0;
    for (int i = 0; i < 5000; i++) {
        struct plane planes[4];
        struct meeting meeting;
        struct big rows[3][3];
        for (int p = 0; p < 4; p++) {
            planes[p] = random_plane(&random);
        }
        for (int p = 0; p < 3; p++) {
            for (int k = 0; k < 3; k++) {
                rows[p][k] = big_of(planes[p].n[k]);
            }
        }
        struct big w = determinant((const struct big(*)[3])rows);
        int sign = w.sign;
        assert_int_equal(exact_meet(&planes[0], &planes[1], &planes[2], &meeting), sign != 0);
        if (sign == 0) {
            continue;
        }
        met++;
        w.sign = 1;
        assert_same(big_of_wide(meeting.w), w);
        struct big value = big_times(big_of(planes[3].d), w);
        for (int k = 0; k < 3; k++) {
            struct big other[3][3];
            memcpy(other, rows, sizeof other);
            for (int p = 0; p < 3; p++) {
                other[p][k] = big_of(-planes[p].d);
            }
            struct big x = determinant((const struct big(*)[3])other);
            x.sign *= sign;
            assert_same(big_of_wide(meeting.x[k]), x);
            value = big_plus(value, big_times(big_of(planes[3].n[k]), x));
        }
        assert_same(big_of_wide(exact_side_meeting(&planes[3], &meeting)), value);
    }
    assert_true(met > 4000);
}

/* Three planes through one line have no meeting point. */
static void test_no_meeting(void **state)
{
    (void)state;
    struct plane a = { .n = { 1, 0, 0 }, .d = 5 };
    struct plane b = { .n = { 0, 8388607, 0 }, .d = 7 };
    struct plane c = { .n = { 3, 8388607, 0 }, .d = 11 };
    struct meeting meeting;
    assert_false(exact_meet(&a, &b, &c, &meeting));
}

/* Roots are rounded down: r r <= x < (r + 1)(r + 1), also at the largest square. */
static void test_sqrt(void **state)
{
    (void)state;
    struct random random = { 4 };
    for (int i = 0; i < 3000; i++) {
        uint64_t root = random_next(&random) >> random_below(&random, 64);
        uwide square = (uwide)root * root;
        assert_true(wide_sqrt(square) == root);
        assert_true(square == 0 || wide_sqrt(square - 1) == root - 1);
        assert_true(wide_sqrt(square + root) == root);
    }
    assert_true(wide_sqrt(~(uwide)0) == UINT64_MAX);
}

/* floor(T |n|): 3, 4, 12 has length 13; a share of a step; none; the longest normal. */
static void test_tolerance(void **state)
{
    (void)state;
    const int32_t n[3] = { 3, -4, 12 };
    assert_int_equal(exact_tolerance(n, 256), 13);
    assert_int_equal(exact_tolerance(n, 128), 6);
    assert_int_equal(exact_tolerance(n, 0), 0);
    const int32_t longest[3] = { 8388607, -8388607, 8388607 };
    assert_int_equal(exact_tolerance(longest, 256), 14529493); /* 8388607 * 1.7320508... */
    assert_true(exact_tolerance(longest, 65534u * 256) == 952175828911);
}

/* Quotients are rounded to the nearest, halves up, whatever the sign. */
static void test_quotient(void **state)
{
    (void)state;
    static const int64_t cases[][3] = { { 7, 2, 4 },   { -7, 2, -3 }, { 5, 10, 1 },
                                        { -5, 10, 0 }, { 4, 10, 0 },  { -6, 10, -1 },
                                        { 0, 3, 0 },   { 9, 3, 3 },   { -9, 3, -3 } };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_true(wide_round_quotient(cases[i][0], cases[i][1]) == cases[i][2]);
    }
}

/* A value counts as on the plane up to tolerance times weight, and not one more. */
static void test_sign(void **state)
{
    (void)state;
    struct plane plane = { .tolerance = 13 };
    wide weight = (wide)1 << 70;
    assert_int_equal(exact_sign(&plane, 13 * weight, weight), 0);
    assert_int_equal(exact_sign(&plane, 13 * weight + 1, weight), 1);
    assert_int_equal(exact_sign(&plane, -13 * weight, weight), 0);
    assert_int_equal(exact_sign(&plane, -13 * weight - 1, weight), -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_schoolbook), cmocka_unit_test(test_side),
        cmocka_unit_test(test_meeting),    cmocka_unit_test(test_no_meeting),
        cmocka_unit_test(test_sqrt),       cmocka_unit_test(test_tolerance),
        cmocka_unit_test(test_quotient),   cmocka_unit_test(test_sign),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
