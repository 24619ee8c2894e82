/* unit.c -- finds units and prefixes by their names, and reads products and powers of them. */
#include "units/unit.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/spelling.h"

typedef struct {
    const char *name, *factor;
    int pi, exponent[QDOT_BASES];
    bool prefixes;
} unit_row;

enum { NO, ALL };

static const unit_row units[] = {
#define UNIT(name, factor, pi, a, b, c, d, e, f, g, prefixes) {name, factor, pi, {a, b, c, d, e, f, g}, prefixes},
#include "units/unit.def"
#undef UNIT
};

static const struct {
    const char *name;
    int power;
} prefixes[] = {
#define PREFIX(name, power) {name, power},
#include "units/prefix.def"
#undef PREFIX
};

/* Scales whose zero is not that of their dimension; what is said instead. */
static const struct {
    const char *name, *hint;
} offsets[] = {
    {"degC", "20 degrees Celsius are `293.15 [K]`; a difference of them is in [K]"},
    {"celsius", "20 degrees Celsius are `293.15 [K]`; a difference of them is in [K]"},
    {"Celsius", "20 degrees Celsius are `293.15 [K]`; a difference of them is in [K]"},
    {"degF", "T degrees Fahrenheit are (T + 459.67)*5/9 kelvin: `(T + 459.67)*(5/9 [K])`"},
    {"fahrenheit", "T degrees Fahrenheit are (T + 459.67)*5/9 kelvin: `(T + 459.67)*(5/9 [K])`"},
};

void
qdot_unit_init(qdot_unit *unit)
{
    *unit = (qdot_unit){.dimension = qdot_dimension_none()};
    fmpq_init(unit->factor);
    fmpq_one(unit->factor);
}

void
qdot_unit_clear(qdot_unit *unit)
{
    fmpq_clear(unit->factor);
}

/* --- names ---------------------------------------------------------------------------- */

const char *
qdot_unit_name_at(size_t i)
{
    return i < sizeof units / sizeof *units ? units[i].name : NULL;
}

/* The row of a name and the power of ten of its prefix; NULL: there is none. */
static const unit_row *
find_unit(const char *name, size_t n, int *power)
{
    *power = 0;
    if (n == 4 && memcmp(name, "hbar", 4) == 0) /* Planck's constant to most, not hectobar */
        return NULL;
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (strlen(units[i].name) == n && memcmp(units[i].name, name, n) == 0)
            return &units[i];
    for (size_t k = 0; k < sizeof prefixes / sizeof *prefixes; k++) {
        const size_t skip = strlen(prefixes[k].name);

        if (skip >= n || memcmp(prefixes[k].name, name, skip) != 0)
            continue;
        for (size_t i = 0; i < sizeof units / sizeof *units; i++)
            if (units[i].prefixes && strlen(units[i].name) == n - skip &&
                memcmp(units[i].name, name + skip, n - skip) == 0) {
                *power = prefixes[k].power;
                return &units[i];
            }
    }
    return NULL;
}

bool
qdot_unit_is_name(const char *text)
{
    int power;

    return find_unit(text, strlen(text), &power) != NULL;
}

/* 10^power as a rational number. */
static void
set_power_of_ten(fmpq_t x, int64_t power)
{
    fmpz_t ten;

    fmpz_init_set_ui(ten, 10);
    fmpz_pow_ui(fmpq_numref(x), ten, (ulong)(power < 0 ? -power : power));
    fmpz_one(fmpq_denref(x));
    if (power < 0)
        fmpq_inv(x, x);
    fmpz_clear(ten);
}

/* An integer or decimal number such as "1.602e-19", up to `end`. */
static void
set_decimal(fmpq_t x, const char *text, const char *end)
{
    int64_t power = 0;
    bool fraction = false;
    fmpq_t scale;

    fmpq_zero(x);
    for (; text < end && *text != 'e'; text++) {
        if (*text == '.') {
            fraction = true;
            continue;
        }
        fmpz_mul_ui(fmpq_numref(x), fmpq_numref(x), 10);
        fmpz_add_ui(fmpq_numref(x), fmpq_numref(x), (ulong)(*text - '0'));
        power -= fraction;
    }
    if (text < end)
        power += strtoll(text + 1, NULL, 10);
    fmpq_init(scale);
    set_power_of_ten(scale, power);
    fmpq_mul(x, x, scale);
    fmpq_clear(scale);
}

/* The factor of a row, times a power of ten. */
static void
set_factor(fmpq_t x, const char *text, int power)
{
    const char *slash = strchr(text, '/'), *end = text + strlen(text);
    fmpq_t y;

    fmpq_init(y);
    set_decimal(x, text, slash != NULL ? slash : end);
    if (slash != NULL) {
        set_decimal(y, slash + 1, end);
        fmpq_div(x, x, y);
    }
    set_power_of_ten(y, power);
    fmpq_mul(x, x, y);
    fmpq_clear(y);
}

/* --- reading --------------------------------------------------------------------------- */

enum { DEPTH = 8 }; /* largest depth of brackets */

typedef struct {
    const char *text, *at;
    int depth;
} reader;

/* Multiply by b^x, x = n/d. QDOT_EDOMAIN: the factor of that power is not rational. */
static qdot_status
multiply_by_power(qdot_unit *a, const qdot_unit *b, qdot_exponent x)
{
    qdot_status status = QDOT_OK;
    fmpq_t f;

    fmpq_init(f);
    fmpq_set(f, b->factor);
    if (x.d != 1) {
        fmpz_t up, down;

        fmpz_init(up);
        fmpz_init(down);
        if (!fmpz_root(up, fmpq_numref(f), x.d) || !fmpz_root(down, fmpq_denref(f), x.d) || (b->pi * x.n) % x.d != 0)
            status = qdot_fail(QDOT_EDOMAIN, "a unit with no exact factor to SI units");
        fmpz_set(fmpq_numref(f), up);
        fmpz_set(fmpq_denref(f), down);
        fmpz_clear(up);
        fmpz_clear(down);
    }
    if (status == QDOT_OK) {
        fmpq_pow_si(f, f, x.n);
        fmpq_mul(a->factor, a->factor, f);
        a->pi += b->pi * x.n / x.d;
        a->angle = a->angle || b->angle;
        a->dimension = qdot_dimension_addmul(a->dimension, b->dimension, x);
        if (qdot_dimension_failed(a->dimension))
            status = qdot_fail(QDOT_EDOMAIN, "a unit with too large a power");
    }
    fmpq_clear(f);
    return status;
}

static qdot_status
fail_at(reader *r, const char *at, const char *message)
{
    r->at = at;
    return qdot_fail(QDOT_ESYNTAX, "%s", message);
}

/* Read digits, up to three of them. */
static qdot_status
unit_read_integer(reader *r, int64_t *value)
{
    const char *begin = r->at;

    for (*value = 0; isdigit((unsigned char)*r->at) && r->at < begin + 4; r->at++)
        *value = 10 * *value + (*r->at - '0');
    if (r->at == begin || r->at > begin + 3)
        return fail_at(r, begin, "the power of a unit is a short number, as in m^2 or m^(1/2)");
    return QDOT_OK;
}

static qdot_status
unit_read_exponent(reader *r, qdot_exponent *x)
{
    const bool bracket = *r->at == '(';
    int64_t n, d = 1;
    bool minus;

    r->at += bracket;
    minus = *r->at == '-';
    r->at += minus;
    QDOT_TRY(unit_read_integer(r, &n));
    if (bracket && *r->at == '/') {
        r->at++;
        QDOT_TRY(unit_read_integer(r, &d));
    }
    if (d == 0)
        return fail_at(r, r->at - 1, "division by zero");
    if (bracket && *r->at++ != ')')
        return fail_at(r, r->at - 1, "expected `)` in a unit");
    *x = qdot_exponent_make(minus ? -n : n, d);
    return QDOT_OK;
}

/* What was meant by a name that is no unit: s^2 where s2 is written, another word or other letters for a unit, the nearest name; NULL: not known. */
static const char *
guess_unit(const char *name, size_t n, qdot_text *meant)
{
    static const struct {
        const char *theirs, *ours;
    } words[] = {{"sec", "s"}, {"secs", "s"}, {"degrees", "deg"}, {"radians", "rad"}, {"radian", "rad"}, {"hour", "h"}, {"hours", "h"},
                 {"hr", "h"}, {"minutes", "min"}, {"minute", "min"}, {"metres", "m"}, {"meters", "m"}, {"Kelvin", "K"}, {"kph", "km/h"},
                 {"kmh", "km/h"}};
    const size_t letters = strcspn(name, "0123456789");
    qdot_spelling near;
    int power;

    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strlen(words[i].theirs) == n && memcmp(words[i].theirs, name, n) == 0)
            return qdot_text_add(meant, words[i].ours), qdot_text_str(meant);
    if (letters > 0 && letters < n && find_unit(name, letters, &power) != NULL) {
        qdot_text_format(meant, "%.*s^%.*s", (int)letters, name, (int)(n - letters), name + letters);
        return qdot_text_str(meant);
    }
    for (size_t i = 0; i < n; i++)
        qdot_text_char(meant, (char)tolower((unsigned char)name[i]));
    if (n > 1 && !meant->failed && find_unit(qdot_text_str(meant), n, &power) != NULL)
        return qdot_text_str(meant);
    qdot_text_truncate(meant, 0);
    qdot_text_add_n(meant, name, n);
    qdot_spelling_begin(&near, qdot_text_str(meant));
    for (size_t i = 0; n > 2 && i < sizeof units / sizeof *units; i++)
        qdot_spelling_offer(&near, units[i].name);
    if (near.best == NULL)
        return NULL;
    qdot_text_truncate(meant, 0);
    return qdot_text_add(meant, near.best), qdot_text_str(meant);
}

static qdot_status
report_unknown(reader *r, const char *name, size_t n)
{
    qdot_text spelled = {0}, meant = {0};
    const char *guess;

    qdot_text_add_n(&spelled, name, n);
    for (size_t i = 0; i < sizeof offsets / sizeof *offsets; i++)
        if (strcmp(offsets[i].name, qdot_text_str(&spelled)) == 0) {
            qdot_fail(QDOT_EDOMAIN, "%s is a scale with an offset, by which no number can be multiplied", offsets[i].name);
            qdot_text_clear(&spelled);
            r->at = name;
            return qdot_hint("%s", offsets[i].hint);
        }
    guess = guess_unit(name, n, &meant);
    qdot_fail(QDOT_ENAME, "there is no unit `%.40s`", qdot_text_str(&spelled));
    if (guess != NULL)
        qdot_hint("did you mean `%s`?", qdot_text_str(&meant));
    qdot_text_clear(&meant);
    qdot_text_clear(&spelled);
    r->at = name;
    return QDOT_ENAME;
}

static qdot_status
unit_read_name(reader *r, qdot_unit *unit)
{
    const char *name = r->at;
    const unit_row *row;
    size_t n = 0;
    int power;

    while (isalnum((unsigned char)name[n]) || name[n] == '_')
        n++;
    row = find_unit(name, n, &power);
    if (row == NULL)
        return report_unknown(r, name, n);
    r->at += n;
    set_factor(unit->factor, row->factor, power);
    unit->pi = row->pi;
    unit->dimension = qdot_dimension_make(row->exponent);
    unit->angle = row->pi == 1 || strcmp(row->name, "rad") == 0 || strcmp(row->name, "radian") == 0;
    return QDOT_OK;
}

static qdot_status unit_read_product(reader *r, qdot_unit *unit);

/* Read one factor and multiply by it, or by its inverse. */
static qdot_status
unit_read_factor(reader *r, bool below, qdot_unit *unit)
{
    qdot_exponent x = {1, 1};
    qdot_status status = QDOT_OK;
    qdot_unit one;

    qdot_unit_init(&one);
    if (*r->at == '(') {
        r->at++;
        status = ++r->depth > DEPTH ? fail_at(r, r->at - 1, "too many brackets in a unit") : unit_read_product(r, &one);
        r->depth--;
        if (status == QDOT_OK && *r->at++ != ')')
            status = fail_at(r, r->at - 1, "expected `)` in a unit");
    } else if (*r->at == '1') {
        r->at++;
        if (isdigit((unsigned char)*r->at) || *r->at == '.')
            status = fail_at(r, r->at - 1, "the only number in a unit is 1, as in [1/s]");
    } else if (isalpha((unsigned char)*r->at)) {
        status = unit_read_name(r, &one);
    } else {
        status = fail_at(r, r->at, isdigit((unsigned char)*r->at) ? "the only number in a unit is 1, as in [1/s]"
                                                                  : "expected the name of a unit, as in [m/s^2]");
    }
    if (status == QDOT_OK && *r->at == '^') {
        r->at++;
        status = unit_read_exponent(r, &x);
    }
    if (below)
        x.n = -x.n;
    if (status == QDOT_OK)
        status = multiply_by_power(unit, &one, x);
    qdot_unit_clear(&one);
    return status;
}

static qdot_status
unit_read_product(reader *r, qdot_unit *unit)
{
    bool below = false;

    QDOT_TRY(unit_read_factor(r, false, unit));
    while (*r->at == '*' || *r->at == '/') {
        if (below && *r->at == '*') {
            (void)fail_at(r, r->at, "a `*` after a `/` in a unit: is it above or below?");
            return qdot_hint("as in [J/(kg*K)] or [J*K/kg]");
        }
        below = *r->at++ == '/';
        QDOT_TRY(unit_read_factor(r, below, unit));
    }
    return QDOT_OK;
}

qdot_status
qdot_unit_read(const char *text, qdot_unit *unit, size_t *at)
{
    reader r = {.text = text, .at = text};
    qdot_status status = unit_read_product(&r, unit);

    if (status == QDOT_OK && *r.at != '\0') {
        status = fail_at(&r, r.at, "a unit is a product of powers, as in [kg*m/s^2]");
        if (isalpha((unsigned char)*r.at) || *r.at == ' ')
            status = qdot_hint("`*` stands between units, as in [N*m]");
    }
    *at = (size_t)(r.at - text);
    return status;
}
