/* dimension.c -- exponents of the base quantities, and the names of dimensions. */
#include "units/dimension.h"

#include <stdlib.h>

static const struct row {
    const char *words, *unit;
    int exponent[QDOT_BASES];
} rows[] = {
#define DIMENSION(words, unit, ...) {words, unit, {__VA_ARGS__}},
#include "units/dimension.def"
#undef DIMENSION
};

qdot_exponent
qdot_exponent_make(int64_t n, int64_t d)
{
    int64_t a = n < 0 ? -n : n, b = d;

    while (a != 0) {
        const int64_t rest = b % a;

        b = a;
        a = rest;
    }
    if (b == 0)
        return (qdot_exponent){0, 0};
    n /= b;
    d /= b;
    if (n > INT32_MAX || n < -INT32_MAX || d > INT32_MAX || d < 1)
        return (qdot_exponent){0, 0};
    return (qdot_exponent){(int32_t)n, (int32_t)d};
}

qdot_exponent
qdot_exponent_addmul(qdot_exponent a, qdot_exponent b, qdot_exponent c)
{
    const qdot_exponent p = qdot_exponent_make((int64_t)b.n * c.n, (int64_t)b.d * c.d);
    const int64_t left = (int64_t)a.n * p.d, right = (int64_t)p.n * a.d;

    return (left > 0) == (right > 0) && llabs(left) > INT64_MAX - llabs(right)
               ? (qdot_exponent){0, 0}
               : qdot_exponent_make(left + right, (int64_t)a.d * p.d);
}

qdot_dimension
qdot_dimension_make(const int exponent[QDOT_BASES])
{
    qdot_dimension a;

    for (int i = 0; i < QDOT_BASES; i++)
        a.of[i] = (qdot_exponent){exponent[i], 1};
    return a;
}

qdot_dimension
qdot_dimension_none(void)
{
    return qdot_dimension_make((const int[QDOT_BASES]){0});
}

qdot_dimension
qdot_dimension_addmul(qdot_dimension a, qdot_dimension b, qdot_exponent x)
{
    for (int i = 0; i < QDOT_BASES; i++)
        a.of[i] = qdot_exponent_addmul(a.of[i], b.of[i], x);
    return a;
}

bool
qdot_dimension_equal(qdot_dimension a, qdot_dimension b)
{
    for (int i = 0; i < QDOT_BASES; i++)
        if (a.of[i].n != b.of[i].n || a.of[i].d != b.of[i].d)
            return false;
    return true;
}

bool
qdot_dimension_is_none(qdot_dimension a)
{
    return qdot_dimension_equal(a, qdot_dimension_none());
}

bool
qdot_dimension_failed(qdot_dimension a)
{
    for (int i = 0; i < QDOT_BASES; i++)
        if (a.of[i].d == 0)
            return true;
    return false;
}

/* The row of a dimension that has a name; NULL: it has none. */
static const struct row *
find_row(qdot_dimension a)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (qdot_dimension_equal(a, qdot_dimension_make(rows[i].exponent)))
            return &rows[i];
    return NULL;
}

void
qdot_dimension_words(qdot_dimension a, qdot_text *out)
{
    const struct row *row = find_row(a);

    if (row != NULL) {
        qdot_text_add(out, row->words);
        return;
    }
    qdot_text_add(out, "a quantity in ");
    qdot_dimension_unit(a, out);
}

void
qdot_dimension_unit(qdot_dimension a, qdot_text *out)
{
    const struct row *row = find_row(a);

    if (row != NULL)
        qdot_text_add(out, row->unit);
    else
        qdot_dimension_base_unit(a, out);
}

static void
add_power(const char *base, qdot_exponent x, bool turned, qdot_text *out)
{
    const int n = turned ? -x.n : x.n;

    qdot_text_add(out, base);
    if (x.d != 1)
        qdot_text_format(out, "^(%d/%d)", n, x.d);
    else if (n != 1)
        qdot_text_format(out, "^%d", n);
}

void
qdot_dimension_base_unit(qdot_dimension a, qdot_text *out)
{
    /* kg*m/s^2, with kg first as it is usual */
    static const struct {
        int base;
        const char *name;
    } order[QDOT_BASES] = {{1, "kg"}, {0, "m"}, {2, "s"}, {3, "A"}, {4, "K"}, {5, "mol"}, {6, "cd"}};
    int up = 0, down = 0, written = 0;

    for (int i = 0; i < QDOT_BASES; i++) {
        up += a.of[i].n > 0;
        down += a.of[i].n < 0;
    }
    for (int i = 0; i < QDOT_BASES; i++)
        if (a.of[order[i].base].n > 0) {
            qdot_text_add(out, written++ > 0 ? "*" : "");
            add_power(order[i].name, a.of[order[i].base], false, out);
        }
    if (down == 0)
        return;
    qdot_text_add(out, up == 0 ? "1/" : "/");
    qdot_text_add(out, down > 1 ? "(" : "");
    written = 0;
    for (int i = 0; i < QDOT_BASES; i++)
        if (a.of[order[i].base].n < 0) {
            qdot_text_add(out, written++ > 0 ? "*" : "");
            add_power(order[i].name, a.of[order[i].base], true, out);
        }
    qdot_text_add(out, down > 1 ? ")" : "");
}
