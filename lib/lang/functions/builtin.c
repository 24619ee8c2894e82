/* builtin.c -- the table of the language's functions, used for calls and for help. */
#include "lang/functions/builtin.h"

#include <limits.h>
#include <string.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "lang/answer/expression.h"
#include "lang/functions/algebra.h"
#include "lang/functions/equilibria.h"
#include "lang/functions/numeric.h"
#include "lang/functions/series.h"
#include "lang/functions/solve.h"
#include "lang/session/along.h"
#include "lang/session/labels.h"
#include "lang/session/member.h"
#include "lang/session/range.h"
#include "mech/dynamics/quantity.h"
#include "mech/study/geometry.h"
#include "mech/study/hamilton.h"

/* --- calls of elementary functions -------------------------------------------------- */

static qdot_expr
elementary_of(qdot_pool *pool, qdot_expr scalar, void *user)
{
    return qdot_fun1(pool, *(const qdot_fun_id *)user, scalar);
}

/* Of one argument on every scalar inside it; of more, of numbers. min and max of one list
 * or vector are those of its members, of one number that moves those of its run, or
 * of the latest. */
static qdot_status
apply_elementary(qdot_session *s, qdot_fun_id id, uint32_t n, const qdot_expr *args,
                 qdot_expr *value)
{
    qdot_kind kind = qdot_expr_kind(s->pool, args[0]);
    qdot_expr *members;
    uint32_t count;

    if (n == 1 && id != QDOT_MIN && id != QDOT_MAX)
        return qdot_value_kind_give(
            s->pool, qdot_value_map(s->pool, args[0], elementary_of, &id), value);
    if (n == 1 && qdot_expr_is_scalar(s->pool, args[0]) &&
        ((qdot_expr_node(s->pool, args[0])->holds & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY)) ||
         qdot_member_any(s, args[0])))
        return qdot_range_value(s, NULL, qdot_fun_name(id), 1, args, NULL, value);
    if (n > 1 || (kind != QDOT_LIST && kind != QDOT_VEC) ||
        qdot_expr_count(s->pool, args[0]) == 0) {
        for (uint32_t i = 0; i < n; i++)
            if (!qdot_expr_is_scalar(s->pool, args[i]))
                return qdot_fail(QDOT_ETYPE, "%s takes numbers, not %s",
                                 qdot_fun_name(id),
                                 qdot_value_kind_words(s->pool, args[i]));
        return qdot_value_kind_give(s->pool, qdot_fun(s->pool, id, n, args), value);
    }
    count = qdot_expr_count(s->pool, args[0]);
    members = qdot_malloc(count * sizeof *members);
    if (members == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < count; i++)
        members[i] = qdot_expr_arg(s->pool, args[0], i);
    qdot_status status = count == 1 ? qdot_value_kind_give(s->pool, members[0], value)
                                    : apply_elementary(s, id, count, members, value);
    qdot_free(members);
    return status;
}

#define X(ID, ...)                                                                       \
    static qdot_status call_##ID(qdot_session *s, uint32_t n, const qdot_expr *args,     \
                                 qdot_expr *value)                                       \
    {                                                                                    \
        return apply_elementary(s, QDOT_##ID, n, args, value);                                 \
    }
#include "expr/function.def"
#undef X

static qdot_expr
sqrt_of(qdot_pool *pool, qdot_expr scalar, void *user)
{
    (void)user;
    return qdot_sqrt(pool, scalar);
}

static qdot_status
call_sqrt(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    (void)n;
    return qdot_value_kind_give(s->pool, qdot_value_map(s->pool, args[0], sqrt_of, NULL),
                                value);
}

/* --- size and LaTeX text of an expression ------------------------------------------- */

static qdot_status
call_size(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    uint64_t size = qdot_expr_size(s->pool, args[0]);

    (void)n;
    return qdot_value_kind_give(
        s->pool, qdot_expr_int(s->pool, size > LONG_MAX ? LONG_MAX : (long)size), value);
}

/* Find the LaTeX text of an expression; for a list a list of texts. */
static qdot_status
call_latex(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    bool list = qdot_expr_kind(s->pool, args[0]) == QDOT_LIST;
    uint32_t count = list ? qdot_expr_count(s->pool, args[0]) : 1;
    qdot_expr *members = qdot_calloc(count + 1, sizeof *members);
    qdot_status status = members == NULL ? QDOT_ENOMEM : QDOT_OK;

    (void)n;
    for (uint32_t i = 0; i < count && status == QDOT_OK; i++) {
        qdot_text text = {0};

        status = qdot_expression_print(
            s, list ? qdot_expr_arg(s->pool, args[0], i) : args[0], QDOT_LATEX, &text);
        if (status == QDOT_OK)
            members[i] = qdot_symbol_get(s->pool, QDOT_WORDS, qdot_text_str(&text));
        qdot_text_clear(&text);
    }
    if (status == QDOT_OK)
        status = qdot_value_kind_give(
            s->pool, list ? qdot_list(s->pool, count, members) : members[0], value);
    qdot_free(members);
    return status;
}

/* --- vectors and matrices ----------------------------------------------------------- */

#define ONE(word, function)                                                              \
    static qdot_status call_##word(qdot_session *s, uint32_t n, const qdot_expr *args,   \
                                   qdot_expr *value)                                     \
    {                                                                                    \
        (void)n;                                                                         \
        return qdot_algebra_give_short(s, function(s->pool, args[0]), value);            \
    }
#define TWO(word, function)                                                              \
    static qdot_status call_##word(qdot_session *s, uint32_t n, const qdot_expr *args,   \
                                   qdot_expr *value)                                     \
    {                                                                                    \
        (void)n;                                                                         \
        return qdot_algebra_give_short(s, function(s->pool, args[0], args[1]), value);   \
    }
TWO(dot, qdot_dot)
TWO(cross, qdot_cross)
ONE(norm, qdot_norm)
ONE(transpose, qdot_transpose)
ONE(det, qdot_det)
ONE(inverse, qdot_inverse)
ONE(trace, qdot_trace)
#undef ONE
#undef TWO

/* --- geometry and bodies ------------------------------------------------------------ */

static qdot_status
place_check(qdot_session *s, const char *name, qdot_expr R)
{
    if (qdot_expr_is_scalar(s->pool, R) || qdot_expr_kind(s->pool, R) == QDOT_VEC)
        return QDOT_OK;
    return qdot_fail(QDOT_ETYPE, "%s(R) takes a vector r(q), not %s", name,
                     qdot_value_kind_words(s->pool, R));
}

/* --- stability of an equilibrium ------------------------------------------------------- */

static qdot_status
call_stability(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    (void)n;
    return qdot_equilibria_stability(s, args[0], value);
}

/* --- geometry of r(q), or of a line element ----------------------------------------- */

/* Define the handler of a function whose only argument is a position vector R. */
#define OF_PLACE(word, module)                                                           \
    static qdot_status call_##word(qdot_session *s, uint32_t n, const qdot_expr *args,   \
                                   qdot_expr *value)                                     \
    {                                                                                    \
        (void)n;                                                                         \
        QDOT_TRY(place_check(s, #word, args[0]));                                        \
        return qdot_value_kind_give(s->pool, module##_##word(s->scene, args[0]), value); \
    }
/* Define the handler of a function of a field and of the position vector R in whose frame it is given. */
#define OF_FIELD(word)                                                                   \
    static qdot_status call_##word(qdot_session *s, uint32_t n, const qdot_expr *args,   \
                                   qdot_expr *value)                                     \
    {                                                                                    \
        (void)n;                                                                         \
        QDOT_TRY(place_check(s, #word, args[1]));                                        \
        return qdot_value_kind_give(                                                     \
            s->pool, qdot_geometry_##word(s->scene, args[0], args[1]), value);           \
    }
OF_PLACE(ds2, qdot_mech)
OF_PLACE(speed2, qdot_mech)
OF_PLACE(metric, qdot_mech)
OF_PLACE(christoffel, qdot_geometry)
OF_PLACE(riemann, qdot_geometry)
OF_PLACE(ricci, qdot_geometry)
OF_PLACE(scalar_curvature, qdot_geometry)
OF_PLACE(geodesic, qdot_geometry)
OF_PLACE(volume_element, qdot_geometry)
OF_PLACE(scale_factors, qdot_geometry)
OF_FIELD(gradient)
OF_FIELD(divergence)
OF_FIELD(curl)
OF_FIELD(laplacian)

typedef struct {
    qdot_session *session;
    qdot_expr f, g; /* the two functions; g nil: the vector whose components are mapped */
} bracket;

static qdot_expr
bracket_with(qdot_pool *pool, qdot_expr scalar, void *user)
{
    bracket *b = user, inner = {b->session, scalar, QDOT_NIL};

    if (b->g == QDOT_NIL)
        return qdot_hamilton_poisson(b->session->scene, b->f, scalar);
    return qdot_value_map(pool, b->g, bracket_with, &inner);
}

/* Compute {f, g}, component by component where f or g is a vector. */
static qdot_status
call_poisson(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    bracket b = {s, QDOT_NIL, args[1]};

    (void)n;
    if (!qdot_expr_is_scalar(s->pool, args[0]) && !qdot_expr_is_scalar(s->pool, args[1]))
        return qdot_fail(QDOT_ETYPE, "one of the two in poisson(f, g) is a number");
    return qdot_value_kind_give(
        s->pool, qdot_value_map(s->pool, args[0], bracket_with, &b), value);
}
#undef OF_PLACE
#undef OF_FIELD

static qdot_status
call_routhian(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    for (uint32_t i = 0; i < n; i++) {
        if (!qdot_expr_is_coordinate(s->pool, args[i]))
            return qdot_fail(QDOT_ETYPE, "routhian( ) takes coordinates");
        for (uint32_t j = 0; j < i; j++)
            if (args[j] == args[i])
                return qdot_fail(QDOT_EINVAL, "`%.200s` is named twice",
                                 qdot_expr_symbol(s->pool, args[i])->name);
    }
    return qdot_value_kind_give(s->pool, qdot_hamilton_routhian(s->scene, n, args), value);
}

static qdot_expr
over_place(qdot_session *s, uint32_t n, const qdot_expr *args)
{
    return qdot_mech_metric_coordinates(s->scene, args[n - 1]);
}

/* Find the label spelled by the symbol `carrier`: of a body, or of a particle if particles are allowed. */
static qdot_status
label_of(qdot_session *s, qdot_expr carrier, bool particles, const char **label)
{
    const qdot_symbol *symbol = qdot_expr_symbol(s->pool, carrier);

    if (symbol == NULL || symbol->class != QDOT_FORMAL)
        return qdot_fail(QDOT_ETYPE, "the first argument is the name of a body%s",
                         particles ? " or particle" : "");
    *label = symbol->name;
    if (qdot_scene_find_body(s->scene, *label) != NULL)
        return QDOT_OK;
    if (qdot_scene_find_particle(s->scene, *label) != NULL) {
        if (particles)
            return QDOT_OK;
        return qdot_fail(QDOT_ETYPE, "`%.200s` is a particle, not a body", *label);
    }
    return qdot_labels_unknown(s->scene, particles ? "body or particle" : "body", *label);
}

static qdot_status
call_point(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    const char *label = NULL;

    QDOT_TRY(label_of(s, args[0], n == 1, &label));
    return qdot_value_kind_give(
        s->pool, qdot_scene_point(s->scene, label, n == 2 ? args[1] : QDOT_NIL), value);
}

static qdot_status
call_spin(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    const char *label = NULL;

    (void)n;
    QDOT_TRY(label_of(s, args[0], false, &label));
    return qdot_value_kind_give(s->pool, qdot_scene_spin(s->scene, label), value);
}

static qdot_status
call_velocity(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    const char *label = NULL;

    (void)n;
    QDOT_TRY(label_of(s, args[0], false, &label));
    return qdot_value_kind_give(s->pool, qdot_scene_velocity(s->scene, label, args[1]),
                                value);
}

/* --- numbers of a run --------------------------------------------------------------- */

#define OF_RANGE(word)                                                                   \
    static qdot_status call_##word(qdot_session *s, uint32_t n, const qdot_expr *args,   \
                                   qdot_expr *value)                                     \
    {                                                                                    \
        return qdot_range_value(s, NULL, #word, n, args, NULL, value);                   \
    }
OF_RANGE(mean)
OF_RANGE(drift)
#undef OF_RANGE

static qdot_status
call_value(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    return qdot_along_value(s, NULL, n, args, value);
}

/* --- the table of functions --------------------------------------------------------- */

/* `sum` is evaluated by the parser's own form (lang/language/parse.c); this row is never called. */
static qdot_status
call_form(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    (void)s, (void)n, (void)args, (void)value;
    return qdot_fail(QDOT_EINVAL, "a form of the language is not a function");
}

#define ROW(least, most, word, usage, summary, example)                                  \
    {                                                                                    \
#word, least, most, call_##word, usage, summary, example, 0, NULL                \
    }
#define ALGEBRA(least, most, word, usage, summary, example)                              \
    {                                                                                    \
#word, least, most, qdot_algebra_##word, usage, summary, example, 0, NULL        \
    }
#define UNBUILT(least, most, word, usage, summary, example)                              \
    {                                                                                    \
        word, least, most, NULL, usage, summary, example, QDOT_BUILTIN_UNBUILT, NULL     \
    }
/* Table row of a function whose entries are indexed by the coordinates of R, its last argument. */
#define PLACE(n, word, usage, summary, example)                                          \
    {                                                                                    \
#word, n, n, call_##word, usage, summary, example, 0, over_place                 \
    }

#define ELEMENTARY(ID, name, least, most, traits, lo, hi, inverse, operation, value, ball, image, usage, \
                   summary, example)                                                              \
    {name,    least,   most,                                                             \
     call_##ID, usage, summary, example, QDOT_##ID == QDOT_IF ? QDOT_BUILTIN_FORM : 0, NULL},

static const qdot_builtin rows[] = {
#define X ELEMENTARY
#define KINKED(...)
#include "expr/function.def"
#undef X
    ROW(1, 1, sqrt, "sqrt(x)", "square root, x >= 0", "sqrt(9/4)"),
#define X(...)
#define KINKED ELEMENTARY
#include "expr/function.def"
#undef X
    {"sum", 4, 4, call_form, "sum(EXPR, k, a, b)", "the sum over k = a ... b",
     "sum(k^2, k, 1, 3)", QDOT_BUILTIN_FORM, NULL},

    ALGEBRA(2, 3, diff, "diff(e, x) or diff(e, x, n)",
        "partial derivative, n times; all other symbols held", "diff(sin(t)^2, t)"),
    ALGEBRA(1, 1, ddt, "ddt(e)", "total time derivative", "ddt(t^2)"),
    ALGEBRA(
        2, -1, subs, QDOT_ALGEBRA_SUBS,
        "e with the replacements made, all at once; a list of equations may stand there",
        "subs(t^2, t = 3)"),
    ALGEBRA(1, 1, lhs, "lhs(a = b)", "left side of an equation", "lhs(t = 2)"),
    ALGEBRA(1, 1, rhs, "rhs(a = b)", "right side of an equation", "rhs(t = 2)"),
    ALGEBRA(1, 1, residual, "residual(a = b)", "left side minus right side",
        "residual(t = 2)"),
    ALGEBRA(1, 1, expand, "expand(e)", "products multiplied out", "expand((t + 1)^2)"),
    ALGEBRA(2, 2, collect, "collect(e, x)", "e as a sum over powers of x",
        "collect(t*2 + t*pi, t)"),
    ALGEBRA(1, 1, simplify, "simplify(e)", "the shortest form found",
        "simplify(sin(t)^2 + cos(t)^2)"),
    ALGEBRA(1, 1, factor, "factor(e)", "e as a product of irreducible factors",
            "factor(t^2 - 1)"),
    {"solve", 2, 2, qdot_solve_call,
     "solve(a = b, x), solve(a = b, x, lo..hi), solve(a = b, x = guess)",
     "every real x, a list; angles between -pi and pi; where no formula gives all, in numbers; of lists of "
     "equations and unknowns; with a range or a guess in numbers",
     "solve(t^2 = 4, t)", QDOT_BUILTIN_RANGE | QDOT_BUILTIN_PASSED, NULL},
    ALGEBRA(3, -1, series, QDOT_SERIES,
            "Taylor series about x = a, y = b: terms up to total degree n",
            "series(cos(t), t = 0, 4)"),
    UNBUILT(2, 4, "integral", "integral(e, x) or integral(e, x, a, b)", "antiderivative, integral",
            "integral(t^2, t)"),
    UNBUILT(2, 2, "limit", "limit(e, x = a)", "limit of e as x tends to a",
            "limit(sin(t)/t, t = 0)"),
    UNBUILT(2, -1, "euler_lagrange", "euler_lagrange(L, y, x, t)",
            "equations of a density in undefined functions", "euler_lagrange(L, y, x, t)"),
    ROW(1, 1, size, "size(e)", "number of operations in e", "size(t^2 + 1)"),
    ROW(1, 1, latex, "latex(e)", "e as a text in LaTeX; of a list one each",
        "latex(t^2)"),

    ROW(2, 2, dot, "dot(u, v)", "scalar product", "dot((1, 2), (3, 4))"),
    ROW(2, 2, cross, "cross(u, v)", "vector product; in the plane a1*b2 - a2*b1",
        "cross((1, 0), (0, 1))"),
    ROW(1, 1, norm, "norm(u)", "length of a vector", "norm((3, 4))"),
    ROW(1, 1, transpose, "transpose(M)", "rows and columns exchanged",
        "transpose([1, 2; 3, 4])"),
    ROW(1, 1, det, "det(M)", "determinant", "det([1, 2; 3, 4])"),
    ROW(1, 1, inverse, "inverse(M)", "inverse matrix", "inverse([1, 2; 3, 4])"),
    ALGEBRA(1, 1, eigenvalues, "eigenvalues(M)",
            "the eigenvalues of a matrix, which must be real, each repeated by its multiplicity",
            "eigenvalues([2, 1; 1, 2])"),
    ROW(1, 1, trace, "trace(M)", "sum of the diagonal", "trace([1, 2; 3, 4])"),

    ROW(1, 1, ds2, "ds2(R) or ds2(bob)", "line element of r(q), in differentials",
        "ds2((r*cos(theta), r*sin(theta)))"),
    ROW(1, 1, speed2, "speed2(R) or speed2(bob)", "(ds/dt)^2, in velocities",
        "speed2((r*cos(theta), r*sin(theta)))"),
    {"metric", 1, 1, call_metric, "metric(R)", "metric of r(q) or of a line element",
     "metric((r*cos(theta), r*sin(theta)))[theta, theta]", 0, over_place},
    PLACE(1, christoffel, "christoffel(R) or christoffel(R)[r, theta, theta]",
          "Christoffel symbols of r(q) or of ds^2; the first index is the upper one",
          "christoffel((r*cos(theta), r*sin(theta)))[r, theta, theta]"),
    PLACE(1, riemann, "riemann(R) or riemann(R)[a, b, c, d]",
          "Riemann's tensor R^a_bcd, the first index the upper one",
          "riemann(dtheta^2 + sin(theta)^2*dphi^2)[theta, phi, theta, phi]"),
    PLACE(1, ricci, "ricci(R) or ricci(R)[a, b]", "Ricci's tensor R_ab",
          "ricci(dtheta^2 + sin(theta)^2*dphi^2)[phi, phi]"),
    PLACE(1, scale_factors, "scale_factors(R) or scale_factors(R)[theta]",
          "scale factors, the lengths of dr/dq",
          "scale_factors((r*cos(theta), r*sin(theta)))[theta]"),
    PLACE(1, geodesic, "geodesic(R) or geodesic(R)[theta]", "the equations of geodesics",
          "geodesic((r*cos(theta), r*sin(theta)))[r]"),
    ROW(1, 1, scalar_curvature, "scalar_curvature(R)",
        "scalar curvature; 2/a^2 on a sphere",
        "scalar_curvature(dtheta^2 + sin(theta)^2*dphi^2)"),
    ROW(1, 1, volume_element, "volume_element(R)", "volume element, sqrt(det g)",
        "volume_element((r*cos(theta), r*sin(theta)))"),
    PLACE(2, gradient, "gradient(f, R)", "gradient in the orthonormal frame of r(q)",
          "gradient(r^2*theta, (r*cos(theta), r*sin(theta)))"),
    ROW(2, 2, divergence, "divergence(F, R)",
        "divergence of a field given in the orthonormal frame of r(q)",
        "divergence((r, 0), (r*cos(theta), r*sin(theta)))"),
    PLACE(2, curl, "curl(F, R)",
          "curl of a field given in the orthonormal frame of r(q); in the plane a number",
          "curl((0, r), (r*cos(theta), r*sin(theta)))"),
    ROW(2, 2, laplacian, "laplacian(f, R)", "Laplacian of a scalar in coordinates r(q)",
        "laplacian(log(r), (r*cos(theta), r*sin(theta)))"),
    ROW(2, 2, poisson, "poisson(f, g)",
        "Poisson's bracket over the scene's coordinates q and momenta p[q]",
        "poisson(r, p[r])"),
    ROW(1, -1, routhian, "routhian(phi, ...)",
        "Routh's function L - sum p q' over these coordinates, their velocities replaced",
        "routhian(phi)"),
    {"stability", 1, 1, call_stability, "stability(equilibria[k])",
     "what is proved of it: stable, unstable, stable_to_first_order, undecided; while "
     "parameters are free if(CONDITION, stable, undecided)",
     "stability(equilibria[1])", 0, NULL},
    {"point", 1, 2, call_point, "point(body, P)", "where the body-fixed point P is",
     "point(plate, (a, b))", QDOT_BUILTIN_LABEL, NULL},
    {"spin", 1, 1, call_spin, "spin(body)", "angular velocity; a number in the plane",
     "spin(plate)", QDOT_BUILTIN_LABEL, NULL},
    {"velocity", 2, 2, call_velocity, "velocity(body, P)",
     "velocity of the body's material at the place P", "velocity(plate, (x, y))",
     QDOT_BUILTIN_LABEL, NULL},

    {"value", 2, -1, call_value, "value(e, ..., t)",
     "e along the latest run at time t; value(a.e, t) along the run a",
     "value(theta, 20)", QDOT_BUILTIN_RUN, NULL},

    {"numeric", 1, 2, qdot_numeric, "numeric(e), numeric(e, digits)",
     "the number of e, with its error; symbols without a value stay", "numeric(sqrt(2), 30)", 0,
     NULL},
    {"N", 1, 2, qdot_numeric, "N(e), N(e, digits)", "short for numeric", "N(pi, 30)",
     QDOT_BUILTIN_SHORT, NULL},
    {"mean", 1, -1, call_mean, "mean(e, a..b)",
     "the mean over a range of a run; max and min likewise", "mean(theta^2, 10..20)",
     QDOT_BUILTIN_RUN, NULL},
    {"drift", 1, -1, call_drift, "drift(e), drift(e, a..b)",
     "the largest change of e since the beginning of the run, or of the range", "drift(energy)",
     QDOT_BUILTIN_RUN, NULL},
};

const qdot_builtin *
qdot_builtin_at(size_t i)
{
    return i < sizeof rows / sizeof *rows ? &rows[i] : NULL;
}

const qdot_builtin *
qdot_builtin_find(const char *name)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (rows[i].name[0] == name[0] && strcmp(rows[i].name, name) == 0)
            return &rows[i];
    return NULL;
}
