/* layer.c -- finds non-integer powers of switching functions, which need a layer around u = 0; the layers' widths. */
#include "sim/model/layer.h"

#include <math.h>

#include "expr/build.h"
#include "expr/constant.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"

/* The shortest time in which a motion crosses a layer, relative to the largest |t|: 1024 spacings of doubles. */
static const double passage = 0x1p-42;

/* The width of a layer in units of a step's error; the fraction of the tolerance that a layer may neglect. */
static const double beyond_steps = 16, share = 0.01;

/* Whether `base` is 0 where u is 0: u, -u, |u|, or the larger or smaller of u and 0; *only: the sign of u
 * on the one side where it is not 0, else 0. */
static bool
is_base_of_surface(qdot_pool *pool, qdot_expr base, qdot_expr u, int *only)
{
    const bool function = qdot_expr_kind(pool, base) == QDOT_FUN;
    const qdot_fun_id id =
        function ? (qdot_fun_id)qdot_expr_node(pool, base)->op : QDOT_SIGN;

    *only = 0;
    if (id == QDOT_ABS)
        base = qdot_expr_arg(pool, base, 0);
    if ((id == QDOT_MAX || id == QDOT_MIN) && qdot_expr_count(pool, base) == 2) {
        const qdot_expr a = qdot_expr_arg(pool, base, 0),
                        b = qdot_expr_arg(pool, base, 1);

        if (a == QDOT_ZERO || b == QDOT_ZERO) {
            base = a == QDOT_ZERO ? b : a;
            *only = (id == QDOT_MAX) == (base == u) ? 1 : -1;
        }
    }
    return base == u || base == qdot_neg(pool, u);
}

bool
qdot_layers_is_broken(const qdot_pool *pool, qdot_expr product, uint32_t k, double *p)
{
    const qdot_expr exponent = qdot_expr_arg(pool, product, k + 1);
    int64_t whole;

    return (qdot_expr_node(pool, exponent)->holds & ~(uint32_t)QDOT_HAS_FUN) == 0 &&
           !qdot_expr_to_int(pool, exponent, &whole) &&
           qdot_constant_double((qdot_pool *)pool, exponent, p) == QDOT_OK;
}

static void
record_power(qdot_surface *x, double p)
{
    if (p < 0 || x->power < 0)
        x->power = -1;
    else if (x->power == 0 || p < x->power)
        x->power = p;
}

static void
record_powers_in_product(qdot_pool *pool, size_t m, qdot_surface *surfaces, qdot_expr product)
{
    double p;
    int only;

    for (uint32_t k = 1; k + 1 < qdot_expr_count(pool, product); k += 2) {
        if (!qdot_layers_is_broken(pool, product, k, &p))
            continue;
        for (size_t i = 0; i < m; i++)
            if (!surfaces[i].steps
                && is_base_of_surface(pool, qdot_expr_arg(pool, product, k), surfaces[i].u, &only))
                record_power(&surfaces[i], p);
    }
}

qdot_status
qdot_layers_find(qdot_pool *pool, size_t m, qdot_surface *surfaces, size_t n,
                 const qdot_expr *e)
{
    qdot_walk walk;

    if (m == 0)
        return QDOT_OK;
    QDOT_TRY(qdot_walk_begin_n(pool, n, e, &walk));
    for (size_t i = 0; i < walk.n; i++)
        if (qdot_expr_kind(pool, walk.at[i]) == QDOT_PROD)
            record_powers_in_product(pool, m, surfaces, walk.at[i]);
    qdot_walk_end(&walk);
    for (size_t i = 0; i < m; i++)
        surfaces[i].power = fmax(surfaces[i].power, 0);
    return qdot_pool_check(pool);
}

bool
qdot_layers_in_time(const qdot_pool *pool, const qdot_surface *surface)
{
    return (qdot_expr_node(pool, surface->u)->holds
            & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER))
           == 0;
}

/* The least width of a layer, in units of U, that exceeds the errors of a method by series; 0 if it
 * needs none. */
static double
layer_width_for_series(const qdot_pool *pool, const qdot_surface *surface, double tol)
{
    /* no layer around u = 0 is needed for exponents below 1 (friction laws), nor for u(t) of time alone: its zeros are
     * located exactly */
    if (surface->power < 1 || qdot_layers_in_time(pool, surface))
        return 0;
    return fmin(beyond_steps * pow(tol, 1.25), pow(share * tol, 1 / (1 + surface->power)));
}

void
qdot_layers_measure(const qdot_pool *pool, size_t m, qdot_surface *surfaces, const double *speed, double latest,
                    double tol)
{
    double largest = 0;

    for (size_t i = 0; i < m; i++)
        if (surfaces[i].power > 0 && isfinite(speed[i]))
            largest = fmax(largest, speed[i]);
    largest = largest > 0 ? largest : 1;
    for (size_t i = 0; i < m; i++) {
        const double width = fmax(passage * latest, layer_width_for_series(pool, &surfaces[i], tol)) * (speed[i] > 0 ? speed[i] : largest);

        if (surfaces[i].power > 0 && isnormal(width)) /* a power of two makes layer boundaries exact */
            surfaces[i].layer = exp2(ilogb(width));
    }
}

qdot_expr
qdot_layers_rim(qdot_pool *pool, const qdot_surface *surface)
{
    return qdot_pow_int(pool, qdot_expr_int(pool, 2), ilogb(surface->layer));
}

/* A share that ends above 1 by so much: a motion held for so long is behind by its square, and beyond that
 * the forces drive it away at the rim, too. */
enum { MORE_EXPONENT = -30 };

qdot_expr
qdot_layers_share(qdot_pool *pool, qdot_expr share)
{
    const qdot_expr more = qdot_pow_int(pool, qdot_expr_int(pool, 2), MORE_EXPONENT);

    return qdot_mul(pool, qdot_sub(pool, QDOT_ONE, more), share);
}

bool
qdot_layers_has(qdot_pool *pool, size_t m, const qdot_surface *surfaces, qdot_expr product, uint32_t k,
                size_t *surface, int *only)
{
    double p;
    bool broken = false;

    for (size_t i = 0; i < m; i++) {
        if (surfaces[i].layer == 0)
            continue;
        if (!broken && !qdot_layers_is_broken(pool, product, k, &p))
            return false;
        broken = true;
        *surface = i;
        if (is_base_of_surface(pool, qdot_expr_arg(pool, product, k), surfaces[i].u, only))
            return true;
    }
    return false;
}

bool
qdot_layers_hold(qdot_pool *pool, size_t m, const qdot_surface *surfaces, qdot_expr node)
{
    size_t surface;
    int only;

    if (qdot_expr_kind(pool, node) != QDOT_PROD)
        return false;
    for (uint32_t k = 1; k + 1 < qdot_expr_count(pool, node); k += 2)
        if (qdot_layers_has(pool, m, surfaces, node, k, &surface, &only))
            return true;
    return false;
}
