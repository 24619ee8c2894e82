/* All zeros in a box: against zeros known beforehand, and what cannot be decided. */
#include <setjmp.h>
#include <math.h>
#include <stdlib.h>

#include "normal/kit.h"

#include <cmocka.h>

#include "base/memory.h"
#include "normal/refute/enclosure.h"
#include "normal/solve/zeros-parts.h"
#include "normal/solve/zeros.h"

enum { MOST = QDOT_ZEROS_MOST_UNKNOWNS };

/* Where one unknown is searched: "x -3 3 []", an end "-" for none, "turn" for an angle; then its group. */
static void
read_range(const char *text, qdot_expr *x, qdot_zeros_range *range)
{
    char name[40], lo[80] = "-", hi[80] = "-", ends[8] = "()";

    *range = (qdot_zeros_range){0};
    assert_true(
        sscanf(text, " %39s %79s %79s %7s %u", name, lo, hi, ends, &range->group) >= 2);
    *x = text_read(pool, name);
    range->turn = strcmp(lo, "turn") == 0;
    if (!range->turn && strcmp(lo, "-") != 0)
        range->lo = text_read(pool, lo);
    if (!range->turn && strcmp(hi, "-") != 0)
        range->hi = text_read(pool, hi);
    range->lo_open = ends[0] == '(';
    range->hi_open = ends[1] == ')';
}

/* Parts of a text between semicolons. */
static size_t
parts(const char *text, char to[MOST][400])
{
    size_t n = 0;

    for (;; text++) {
        size_t length = strcspn(text, ";");

        assert_true(n < MOST && length < 400);
        memcpy(to[n], text, length);
        to[n++][length] = '\0';
        text += length;
        if (*text == '\0')
            return n;
    }
}

static qdot_status
find(const char *equations, const char *ranges, uint64_t budget, qdot_zeros *z)
{
    char F_text[MOST][400], range_text[MOST][400];
    qdot_expr F[MOST], x[MOST];
    qdot_zeros_range range[MOST];
    size_t n = parts(equations, F_text);

    assert_int_equal(parts(ranges, range_text), n);
    for (size_t i = 0; i < n; i++)
        read_range(range_text[i], &x[i], &range[i]);
    for (size_t i = 0; i < n; i++)
        F[i] = text_read(pool, F_text[i]);
    return qdot_zeros_find(pool, n, F, x, range, budget, z);
}

/* Equations, ranges, the first unknown at each zero in order (a zero that is not simple with a *), proved to be all. */
static const struct {
    const char *equations, *ranges, *zeros;
} rows[] = {
    {"x^2 - 2", "x - -", "-1.4142135623730951 1.4142135623730951"},
    {"x^5 - x + 1", "x - -", "-1.1673039782614187"},
    {"x^2 + 1", "x - -", ""},
    /* ends, open and closed, decided exactly */
    {"sin(x)", "x 0 2*pi ()", "3.141592653589793"},
    {"sin(x)", "x 0 2*pi []", "0 3.141592653589793 6.283185307179586"},
    {"sin(x)", "x 0 2*pi (]", "3.141592653589793 6.283185307179586"},
    {"x^2 - 2", "x 0 sqrt(2) []", "1.4142135623730951"},
    {"x^2 - 2", "x 0 sqrt(2) [)", ""},
    {"x^2 - 2", "x 0 1414213562373095/1000000000000000 []", ""},
    {"x^2 - 2", "x 0 14142135623730951/10000000000000000 []", "1.4142135623730951"},
    {"x^2*(x - 1)", "x 0 1 (]", "1"},
    {"x*log(x)", "x 0 10 ()", "1"},
    {"y^2 - 1; x - y", "x -1 1 []; y - -", "-1 1"},
    {"y^2 - 1; x - y", "x -1 1 (]; y - -", "1"},
    {"sin(x)*cos(y) + sin(x); y - 1/2", "x 0 pi (]; y - -", "3.141592653589793"},
    /* a turn has no seam */
    {"sin(x) - 1/2", "x turn", "0.5235987755982989 2.6179938779914944"},
    {"sin(x)", "x turn", "0 3.141592653589793"},
    {"2*sin(u)*cos(v) + cos(u)*sin(v); 2*cos(u)*sin(v) + sin(u)*cos(v)", "u turn; v turn",
     "-1.5707963267948966 -1.5707963267948966 0 0 1.5707963267948966 1.5707963267948966 "
     "3.141592653589793 3.141592653589793"},
    {"-4*sin(2*u - v) - 2*cos(u)*sin(v); 2*sin(2*u - v) - 2*sin(u)*cos(v)",
     "u turn; v turn",
     "-2.0943951023931953 -2.0943951023931953 -0.84106867056793 -0.84106867056793 0 0 "
     "0.84106867056793 0.84106867056793 2.0943951023931953 2.0943951023931953 "
     "3.141592653589793 3.141592653589793"},
    /* multiple zeros, close zeros */
    {"(x - 1)^2*(x + 3)", "x -5 5 []", "-3 1*"},
    {"sin(x) - 1", "x turn", "1.5707963267948966*"},
    {"exp(x) - 1 - x", "x -5 5 []", "0*"},
    {"tan(x) - x", "x -5 5 []", "-4.493409457909064 0* 4.493409457909064"},
    {"x^2*(x - 1)^2 - 1/10000000000", "x -1 2 []",
     "-9.99990000199995e-06 1.00001000020000e-05 0.99998999989999804 1.0000099999000021"},
    {"cos(x - 1) - 1 + 1/2000000000000000000", "x -1 2 []", "0.999999999 1.000000001"},
    {"(x - 1)*(x - 1 - 1/1000000)*(x^2 + 1); y - x", "x - -; y - -", "1 1.000001"},
    {"(x - 1)^2 + (y - 2)^2; x*y - 2", "x -3 3 []; y -3 3 []", "1*"},
    {"x*(x^2 + y^2); y*(x^2 + y^2)", "x - -; y - -", "0*"},
    {"4*x*(x^2 + y^2) - 1; 4*y*(x^2 + y^2)", "x - -; y - -", "0.6299605249474366"},
    {"x*sin(x)", "x -4 4 []", "-3.141592653589793 0* 3.141592653589793"},
    /* poles */
    {"1/x - 2*x", "x - -", "-0.7071067811865476 0.7071067811865476"},
    {"sin(x)/x", "x -4 4 []", "-3.141592653589793 3.141592653589793"},
    {"1/x^2 - 3/x^3 + 1/100", "x 0 - ()", "2.7841799032180994"},
    {"x/(x^2 + y^2)^(3/2) - x + 1/10; y/(x^2 + y^2)^(3/2) - 2*y + 1/20", "x - -; y - -",
     "-0.96609262657825967 -0.10671078686109109 -0.093974107953050973 1.0334987538475349"},
    /* kinks */
    {"abs(x) - x/2 - 1", "x - -", "-0.6666666666666666 2"},
    {"max(x, 2*x)", "x -5 5 []", "0"},
    {"abs(x)", "x - -", "0*"},
    {"abs(x)*(x - 1) + max(x - 2, 0)", "x -3 3 []", "0* 1"},
    {"x + x^2 - y; abs(y) - x/2", "x -4 4 []; y -4 4 []", "0*"},
    /* to infinity and beyond */
    {"tanh(x) - x/2", "x - -", "-1.9150080481545375 0 1.9150080481545375"},
    {"sin(x) - x/10", "x - -",
     "-8.4232039323604919 -7.068174358095817 -2.8523418944500918 0 2.8523418944500918 "
     "7.068174358095817 8.4232039323604919"},
    {"exp(x)*(x^2 - 1)", "x - -", "-1 1"},
    {"exp(exp(x)) - 10", "x -100 100 []", "0.834032445247956"},
    {"1/cosh(x)^2 - 1/2", "x - -", "-0.881373587019543 0.881373587019543"},
    {"2*y + 4*y^3 + x/2; 2*x - 1 + y/2", "x - -; y -1 1 ()", "0.5321943492500909"},
    /* at an end where the slope is infinite */
    {"sqrt(x) - sin(x)", "x 0 - []", "0*"},
    {"sqrt(x) - sin(x)", "x 0 - (]", ""},
    {"sqrt(x) - 2*sin(x)", "x 0 1 []", "0* 0.255512327649307"},
    {"sqrt(x - 1) - log(x)/2", "x 1 - []", "1*"},
    {"x^(1/3) - sinh(x)", "x 0 - []", "0* 0.8412101231536524"},
    /* by growth */
    {"x*exp(-x^2) - 1/10", "x - -", "0.1010258483156852 1.67963061042845"},
    {"exp(x) - x^2", "x - -", "-0.7034674224983917"},
    {"exp(x) - x^10", "x - -", "-0.9127652716086226 1.1183255915896297 35.77152063957297"},
    {"exp(x) + x^2", "x - -", ""},
    {"exp(x) - x", "x - -", ""},
    {"log(x) - x + 2", "x 0 - ()", "0.15859433956303937 3.1461932206205825"},
    {"log(x)/x - 1/10", "x 0 - ()", "1.1183255915896297 35.77152063957297"},
    {"2^x - x - 2", "x - -", "-1.6900930676193095 2"},
    {"cosh(x) - 2*x - 1", "x - -", "0 2.466497136207526"},
    {"sqrt(x) - cos(x)", "x 0 - []", "0.6417143708728826"},
    {"x^2*exp(-x) - 1/2", "x - -",
     "-0.5398352769028200 1.487962065498177 2.617866613066813"},
    {"x + 20*sin(x)/x^2 - 40", "x 1 - ()", "39.9906037498864"},
    {"x^2 + y^2 - 1; 2*z*x; 1 + 2*z*y", "x - -; y - -; z - - () 1", "0 0"},
    {"x; y^2 - 100", "x 0 - []; y - -", "0 0"},
    {"x; y^2 - 100", "x 0 - (); y - -", ""},
    {"y - 3; x*y - x^2*y + 2", "x - -; y - -", "-0.4574271077563381 1.4574271077563381"},
    {"x^3 - 3*x*y^2 - 1; 3*x^2*y - y^3", "x - -; y - -", "-0.5 -0.5 1"},
    {"3*x*(x^2 + y^2 + z^2) - x; y*(x^2 + y^2 + z^2) - 2*y; z*(x^2 + y^2 + z^2) - z/2",
     "x - -; y - -; z - -", "-0.5773502691896257 0 0 0 0 0 0.5773502691896257"},
};

static void
all_zeros_are_found_and_proved(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        const char *at = rows[k].zeros;
        qdot_zeros z;
        size_t i = 0;

        assert_int_equal(find(rows[k].equations, rows[k].ranges, 0, &z), QDOT_OK);
        if (!z.complete)
            fail_msg("%s: not complete: %zu places in doubt, %s", rows[k].equations,
                     z.doubts, z.beyond ? "beyond" : "within");
        for (; *at != '\0'; i++) {
            char *end;
            double want = strtod(at, &end);
            bool simple = *end != '*';

            at = end + !simple + strspn(end + !simple, " ");
            if (i >= z.count)
                fail_msg("%s: only %zu zeros", rows[k].equations, z.count);
            if (fabs(z.at[i * z.n] - want) >
                1e-12 + 4e-15 * fabs(want) + z.radius[i * z.n])
                fail_msg("%s: %.17g, not %.17g", rows[k].equations, z.at[i * z.n], want);
            if (z.simple[i] != simple)
                fail_msg("%s: %.17g is %ssimple", rows[k].equations, want,
                         z.simple[i] ? "" : "not ");
            assert_true(z.radius[i * z.n] < 1e-13);
        }
        if (z.count != i)
            fail_msg("%s: %zu zeros, not %zu", rows[k].equations, z.count, i);
        qdot_zeros_clear(&z);
    }
}

static unsigned
next_random(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 16;
}

/* A random sum of terms c x^a exp(b x^d) log(x)^k, some with a wave, as a text. */
static void
write_terms(unsigned *seed, char *text, size_t size)
{
    static const char *const tops[] = {"", "*exp(x)", "*exp(-x)", "*exp(2*x)", "*exp(-x^2/2)",
                                       "*exp(sqrt(x))", "*log(x)", "*log(x)^2", "*sinh(x/2)",
                                       "*exp(x - 3*log(2)*x)", "*tanh(x)", "*atan(x)",
                                       "*exp(exp(x/3))", "*exp(-exp(x))", "*(x + 1)^(x/2)", "*x^(1/x)"},
                      *const powers[] = {"1", "x", "x^2", "x^3", "sqrt(x)", "1/x", "x^5", "x^(2/3)"},
                      *const waves[] = {"", "", "", "*sin(x)", "*cos(3*x)", "*(2 + cos(x))"};
    int n = 2 + next_random(seed) % 3;

    text[0] = '\0';
    for (int i = 0; i < n; i++) {
        size_t length = strlen(text);

        snprintf(text + length, size - length, "%s%u*%s%s%s", i > 0 ? next_random(seed) % 2 ? " - " : " + " : "",
                 1 + next_random(seed) % 9, powers[next_random(seed) % 8],
                 tops[next_random(seed) % 16], waves[next_random(seed) % 6]);
    }
}

/* Beyond R there are no zeros: the sign stays the same, at many places in balls. */
static void
growth_excludes_only_what_has_no_zeros(void **state)
{
    enum { SUMS = 300, PLACES = 200 };
    unsigned seed = 5, bounded = 0;
    qdot_expr x = text_read(pool, "x");

    (void)state;
    for (int k = 0; k < SUMS; k++) {
        char text[400];
        qdot_enclosure *bounds;
        qdot_expr f;
        double R, last = 0;

        write_terms(&seed, text, sizeof text);
        f = text_read(pool, text);
        assert_int_equal(qdot_zeros_far(pool, f, x, 1, &R), QDOT_OK);
        if (isinf(R))
            continue;
        bounded++;
        assert_int_equal(qdot_enclosure_new(pool, 1, &f, 1, &x, &bounds), QDOT_OK);
        for (int i = 0; i < PLACES; i++) {
            qdot_interval X = qdot_interval_point(R * (1 + i * 0.02 + i * i * 0.003)), y;

            qdot_enclosure_eval(bounds, &X, false);
            y = qdot_enclosure_get(bounds, 0)->y;
            if (y.lo <= 0 && y.hi >= 0) /* beyond doubles */
                continue;
            if (last * y.lo < 0)
                fail_msg("%s changes sign beyond %g, before %g", text, R, X.lo);
            last = y.lo > 0 ? 1 : -1;
        }
        qdot_enclosure_free(bounds);
    }
    assert_true(bounded > SUMS / 2);
}

/* Near 0, where they or their slopes have no bounds, these keep away from what they are compared with. */
static void
growth_excludes_zeros_beside_a_place(void **state)
{
    static const struct {
        const char *f;
        size_t zeros;
        bool proved;
    } rows[] = {{"r^r - 2", 1, true},          {"r^r - 1/2", 0, true},           {"r^r - 9/10", 2, true},
                {"r*log(r) + 1/10", 2, true},  {"sqrt(r)*log(r) + 1/10", 2, true}, {"r*log(r)^2 - 1/10", 3, true},
                {"exp(exp(r)) - r - 9", 1, true}, {"r^(1/r) - 6/5", 2, true},    {"r^r - 1", 1, false}};

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        qdot_expr f = text_read(pool, rows[i].f), r = text_read(pool, "r");
        qdot_zeros_range range = {.lo = QDOT_ZERO, .lo_open = true, .hi = QDOT_NIL, .held = QDOT_NIL};
        qdot_zeros found;

        assert_int_equal(qdot_zeros_find(pool, 1, &f, &r, &range, 0, &found), QDOT_OK);
        if (found.count != rows[i].zeros || found.complete != rows[i].proved)
            fail_msg("%s: %zu zeros, complete %d", rows[i].f, found.count, found.complete);
        qdot_zeros_clear(&found);
    }
}

/* What cannot be decided is said: a place in doubt, the far away, the budget. */
static void
what_is_not_proved_is_said(void **state)
{
    static const struct {
        const char *equations, *ranges;
        bool doubt, beyond, exhausted;
    } beside[] = {
        {"sin(x) - 1/2", "x - -", false, true, false},
        {"x*sin(x) - 1", "x - -", false, true, false},
        {"sign(x - 1)", "x -3 3 []", true, false, false},
        {"x^2 + y^2 + z^2 - 3; x*y*z - 1; x - y + z^2 - 1", "x - -; y - -; z - -", true,
         false, false},
        {"x^2 - y^2; x^2 - 2*x*y + y^2", "x -3 3 []; y -3 3 []", false, false, true},
    };

    (void)state;
    for (size_t k = 0; k < sizeof beside / sizeof *beside; k++) {
        qdot_zeros z;

        assert_int_equal(find(beside[k].equations, beside[k].ranges, 0, &z), QDOT_OK);
        if (z.complete || (z.doubts > 0) != beside[k].doubt ||
            z.beyond != beside[k].beyond || z.exhausted != beside[k].exhausted)
            fail_msg("%s: complete %d, %zu doubts, beyond %d, exhausted %d",
                     beside[k].equations, z.complete, z.doubts, z.beyond, z.exhausted);
        qdot_zeros_clear(&z);
    }
}

/* Products of lines, mixed so that they do not factor: every crossing is a zero. */
static void
crossings_of_random_lines_are_found(void **state)
{
    uint64_t seed = 1;

    (void)state;
    for (int k = 0; k < 30; k++) {
        double a[4][3], x[4], least = INFINITY;
        char text[800];
        qdot_text F = {0};
        qdot_zeros z;
        size_t n = 0;

        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 3; j++) {
                seed = seed * 6364136223846793005u + 1442695040888963407u;
                a[i][j] = (double)(int)(seed >> 33 & 15) - 7;
            }
        for (int i = 0; i < 4; i++) { /* line 0 or 1 with line 2 or 3 */
            const double *p = a[i / 2], *q = a[2 + i % 2];
            double det = p[0] * q[1] - p[1] * q[0];

            if (det == 0)
                least = 0;
            x[n++] = (p[2] * q[1] - p[1] * q[2]) / det;
        }
        for (int i = 0; i < 4 && least > 0; i++)
            for (int j = 0; j < i; j++)
                least = fmin(least, fabs(x[i] - x[j]));
        if (!(least > 1e-6))
            continue;
        for (int i = 0; i < 4; i++)
            snprintf(text + 200 * i, 200, "(%d*x + %d*y - %d + 0)", (int)a[i][0],
                     (int)a[i][1], (int)a[i][2]);
        for (char *c = text; c < text + sizeof text; c++)
            if (*c == '-' && c[1] == ' ' && c[2] == '-') /* - -3 */
                c[0] = '+', c[2] = ' ';
        qdot_text_format(&F, "%s*%s; %s*%s + 3*%s*%s", text, text + 200, text + 400,
                         text + 600, text, text + 200);
        assert_int_equal(find(qdot_text_str(&F), "x - -; y - -", 0, &z), QDOT_OK);
        if (!z.complete || z.count != 4)
            fail_msg("%s: %zu zeros, complete %d", qdot_text_str(&F), z.count,
                     z.complete);
        for (int i = 0; i < 4; i++) {
            double off = INFINITY;

            for (size_t l = 0; l < z.count; l++)
                off = fmin(off, fabs(z.at[2 * l] - x[i]));
            assert_true(off < 1e-12 * (1 + fabs(x[i])));
        }
        qdot_zeros_clear(&z);
        qdot_text_clear(&F);
    }
}

static void
wrong_questions_are_refused(void **state)
{
    qdot_zeros z;

    (void)state;
    assert_int_equal(find("x - y", "x -1 1 []", 0, &z), QDOT_ETYPE);
    assert_int_equal(find("(x + 1)^2 - x^2 - 2*x - 1", "x -1 1 []", 0, &z), QDOT_EDOMAIN);
    assert_int_equal(find("sin(1/x)", "x 0 1 (]", 200, &z), QDOT_OK);
    assert_true(z.exhausted && !z.complete);
    qdot_zeros_clear(&z);
}

/* Values and slopes at random points of random boxes lie within their bounds. */
static void
bounds_hold(void **state)
{
    static const char *const of[] = {"sin(x)*cos(y) + x^2", "exp(-x^2)*y",
                                     "x/(1 + y^2)",         "tan(x/3)*y",
                                     "abs(x - y)*x",        "max(x, y^2)",
                                     "sqrt(1 + x^2)/y",     "atan2(x, 3 + y)",
                                     "log(4 + x)*y^3",      "tanh(x)*sinh(y)",
                                     "acosh(5 + x)",        "asin(x/4)*acos(y/4)",
                                     "(2 + cos(x))^y",      "erf(x)*erfc(y)",
                                     "atan(x*y)^(-1)",      "cosh(x)^(-2)*asinh(y)",
                                     "min(x, y)*x",     "(4 + x)^(1/3)*y^(-3)",
                                     "1/sin(2 + x/9)",      "atanh(x/4)*sign(y)"};
    qdot_expr x[2] = {text_read(pool, "x"), text_read(pool, "y")};
    uint64_t seed = 7;

    (void)state;
    for (size_t k = 0; k < sizeof of / sizeof *of; k++) {
        qdot_expr e = text_read(pool, of[k]);
        qdot_enclosure *s;

        assert_int_equal(qdot_enclosure_new(pool, 1, &e, 2, x, &s), QDOT_OK);
        for (int trial = 0; trial < 200; trial++) {
            double u[6];
            qdot_interval X[2], a[2], b[2];
            qdot_enclosure_value over, at_a, at_b;
            double change = 0, lo = 0, hi = 0;

            for (int i = 0; i < 6; i++) {
                seed = seed * 6364136223846793005u + 1442695040888963407u;
                u[i] = (double)(seed >> 11) / 9007199254740992.0;
            }
            for (int j = 0; j < 2; j++) {
                double width = trial % 2 ? 0.1 : 3, from = -3 + 5.5 * u[j];

                X[j] = (qdot_interval){from, fmin(from + width, 3.5)};
                a[j] = qdot_interval_point(X[j].lo + u[2 + j] * (X[j].hi - X[j].lo));
                b[j] = qdot_interval_point(X[j].lo + u[4 + j] * (X[j].hi - X[j].lo));
            }
            qdot_enclosure_eval(s, X, true);
            over = *qdot_enclosure_get(s, 0);
            qdot_enclosure_eval(s, a, false);
            at_a = *qdot_enclosure_get(s, 0);
            qdot_enclosure_eval(s, b, false);
            at_b = *qdot_enclosure_get(s, 0);
            if (at_a.state == QDOT_ENCLOSURE_WHOLE &&
                !(over.y.lo <= at_a.y.hi && over.y.hi >= at_a.y.lo))
                fail_msg("%s: %g..%g is not in %g..%g", of[k], at_a.y.lo, at_a.y.hi,
                         over.y.lo, over.y.hi);
            if (over.state != QDOT_ENCLOSURE_WHOLE)
                continue;
            change = at_b.y.lo - at_a.y.hi;
            for (int j = 0; j < 2; j++) {
                double d = b[j].lo - a[j].lo;

                lo += fmin(over.slope[j].lo * d, over.slope[j].hi * d);
                hi += fmax(over.slope[j].lo * d, over.slope[j].hi * d);
            }
            if (isfinite(lo) && isfinite(hi) &&
                !(change >= lo - 1e-9 * (1 + fabs(lo)) &&
                  change <= hi + 1e-9 * (1 + fabs(hi))))
                fail_msg("%s: a change of %g is not in %g..%g", of[k], change, lo, hi);
        }
        qdot_enclosure_free(s);
    }
}

/* Ranges of zeros that are known are not searched: the others are found, where else the search would be ended. */
static void
known_ranges_are_not_searched(void **state)
{
    qdot_expr x = text_read(pool, "x"), F = text_read(pool, "max(x, 0)*(cos(x) - x)"),
              inside = qdot_rel(pool, QDOT_LE, x, QDOT_ZERO);
    qdot_zeros_range range = {.lo = text_read(pool, "-2"), .hi = text_read(pool, "5")};
    qdot_expr set = qdot_list(pool, 1, &inside);
    qdot_zeros z;

    (void)state;
    assert_int_equal(qdot_zeros_find(pool, 1, &F, &x, &range, 0, &z), QDOT_OK);
    assert_true(z.exhausted);
    qdot_zeros_clear(&z);
    range.held = qdot_list(pool, 1, &set);
    assert_int_equal(qdot_zeros_find(pool, 1, &F, &x, &range, 0, &z), QDOT_OK);
    assert_false(z.exhausted);
    assert_int_equal(z.count, 1);
    assert_true(fabs(z.at[0] - 0.7390851332151607) < 1e-15);
    assert_int_equal(z.doubts, 1); /* the end of the range */
    assert_true(fabs(z.doubt[0]) < 1e-12 && z.reach[0] < 1e-12);
    qdot_zeros_clear(&z);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(known_ranges_are_not_searched, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(all_zeros_are_found_and_proved, open_pool,
                                        close_pool),
        cmocka_unit_test_setup_teardown(growth_excludes_only_what_has_no_zeros, open_pool,
                                        close_pool),
        cmocka_unit_test_setup_teardown(growth_excludes_zeros_beside_a_place, open_pool, close_pool),
        cmocka_unit_test_setup_teardown(what_is_not_proved_is_said, open_pool,
                                        close_pool),
        cmocka_unit_test_setup_teardown(crossings_of_random_lines_are_found, open_pool,
                                        close_pool),
        cmocka_unit_test_setup_teardown(wrong_questions_are_refused, open_pool,
                                        close_pool),
        cmocka_unit_test_setup_teardown(bounds_hold, open_pool, close_pool),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
