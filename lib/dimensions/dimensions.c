/* dimensions.c -- the dimensions of expressions as affine forms, each node once, from the leaves. */
#include "dimensions/dimensions.h"

#include "dimensions/form.h"
#include "dimensions/groups.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/unit.h"

struct qdot_dimensions {
    qdot_pool *pool;
    qdot_stands_for stands_for;
    const void *user;
    qdot_forms forms;
    qdot_vec(const qdot_form *) of;    /* of node e; NULL: not visited yet */
    qdot_vec(uint64_t) key;            /* what unknown i is: a symbol, a function, an argument of a function */
    qdot_vec(qdot_expr) stack;
};

static const qdot_exponent minus = {-1, 1};

qdot_dimensions *
qdot_dimensions_new(qdot_pool *pool, qdot_stands_for stands_for, const void *user)
{
    qdot_dimensions *d = qdot_calloc(1, sizeof *d);

    if (d != NULL)
        *d = (qdot_dimensions){.pool = pool, .stands_for = stands_for, .user = user};
    return d;
}

void
qdot_dimensions_free(qdot_dimensions *d)
{
    if (d == NULL)
        return;
    qdot_forms_clear(&d->forms);
    qdot_free(d->of.at);
    qdot_free(d->key.at);
    qdot_free(d->stack.at);
    qdot_free(d);
}

size_t
qdot_dimensions_rank(const qdot_dimensions *d)
{
    return d->forms.rank;
}

/* --- unknowns --------------------------------------------------------------------------- */

/* The unknown of a symbol: its id; of a function and of its arguments: numbers past all ids. */
static uint64_t
key_of_function(uint32_t id, uint32_t argument)
{
    return UINT64_C(1) << 32 | (uint64_t)id << 8 | argument;
}

static const qdot_form *
unknown_of(qdot_dimensions *d, uint64_t key)
{
    uint32_t i = 0;

    while (i < d->key.n && d->key.at[i] != key)
        i++;
    if (i == d->key.n && (qdot_vec_push(&d->key, key) != QDOT_OK || qdot_forms_unknown(&d->forms, &i) != QDOT_OK))
        return NULL;
    return qdot_form_unknown(&d->forms, i);
}

static qdot_dimension
base_dimension(int base)
{
    int exponent[QDOT_BASES] = {0};

    exponent[base] = 1;
    return qdot_dimension_make(exponent);
}

/* --- failures --------------------------------------------------------------------------- */

static void
add_form(qdot_dimensions *d, const qdot_form *f, qdot_text *out)
{
    const qdot_form *reduced = qdot_form_reduce(&d->forms, f);
    bool first = true;

    if (reduced == NULL || reduced->none) {
        qdot_text_add(out, "a vector");
        return;
    }
    if (reduced->n == 0) {
        qdot_dimension_words(reduced->constant, out);
        return;
    }
    qdot_text_add(out, "a quantity of the dimension of ");
    for (uint32_t i = 0; i < reduced->n; i++) {
        const uint64_t key = d->key.at[reduced->at[i].unknown];
        const qdot_exponent x = reduced->at[i].x;

        qdot_text_add(out, first ? "" : "*");
        first = false;
        if (key >> 32 != 0)
            qdot_text_add(out, qdot_ufun_get(d->pool, (uint32_t)(key >> 8 & 0xFFFFFF))->name);
        else if (qdot_print(d->pool, (qdot_expr)key, QDOT_PLAIN, out) != QDOT_OK)
            out->failed = true;
        if (x.d != 1)
            qdot_text_format(out, "^(%d/%d)", x.n, x.d);
        else if (x.n != 1)
            qdot_text_format(out, x.n < 0 ? "^(%d)" : "^%d", x.n);
    }
    if (!qdot_dimension_is_none(reduced->constant)) {
        qdot_text_add(out, " times ");
        qdot_dimension_base_unit(reduced->constant, out);
    }
}

/* Fail: a and b differ. `format` takes both in words. */
static qdot_status
report_difference(qdot_dimensions *d, const qdot_form *a, const qdot_form *b, const char *format)
{
    qdot_text left = {0}, right = {0}, whole = {0};
    qdot_status status;
    int side = 0;

    add_form(d, a, &left);
    add_form(d, b, &right);
    for (const char *c = format; *c != '\0'; c++)
        if (c[0] == '%' && c[1] == 's') {
            qdot_text_add(&whole, qdot_text_str(side++ == 0 ? &left : &right));
            c++;
        } else {
            qdot_text_char(&whole, *c);
        }
    status = qdot_text_status(&whole);
    if (status == QDOT_OK)
        status = qdot_fail(QDOT_ETYPE, "%.480s", qdot_text_str(&whole));
    qdot_text_clear(&left);
    qdot_text_clear(&right);
    qdot_text_clear(&whole);
    return status;
}

static qdot_status
join_forms(qdot_dimensions *d, const qdot_form *a, const qdot_form *b, const char *format)
{
    bool agree;

    QDOT_TRY(qdot_forms_join(&d->forms, a, b, &agree));
    return agree ? QDOT_OK : report_difference(d, a, b, format);
}

static qdot_status
join_number(qdot_dimensions *d, const qdot_form *a, const char *format)
{
    return join_forms(d, a, qdot_form_constant(&d->forms, qdot_dimension_none()), format);
}

/* --- nodes ------------------------------------------------------------------------------ */

static const qdot_form *
of_arg(const qdot_dimensions *d, qdot_expr e, uint32_t i)
{
    return d->of.at[qdot_expr_arg(d->pool, e, i)];
}

/* The variable of an integral with ends, a symbol of this integral alone; nil: e is none. */
static qdot_expr
variable_of(const qdot_dimensions *d, qdot_expr e)
{
    char name[96];

    if (qdot_expr_kind(d->pool, e) != QDOT_INTEGRAL || !qdot_integral_is_definite(d->pool, e))
        return QDOT_NIL;
    snprintf(name, sizeof name, "%.60s of integral %u", qdot_integral_name(d->pool, e), (unsigned)e);
    return qdot_symbol_get(d->pool, QDOT_FORMAL, name);
}

/* The i-th node that must be visited before e: its args, but the integrand with this integral's own variable. */
static qdot_expr
part_of(const qdot_dimensions *d, qdot_expr e, uint32_t i)
{
    const qdot_expr x = i == 0 ? variable_of(d, e) : QDOT_NIL;

    return x == QDOT_NIL ? qdot_expr_arg(d->pool, e, i) : qdot_integral_open(d->pool, e, x);
}

/* What must be visited before the symbol or integral e though it is none of its args: the expression that a symbol stands for,
 * the coordinate of a derivative or momentum, the variable of an integral; nil: nothing. */
static qdot_expr
what_comes_before(const qdot_dimensions *d, qdot_expr e)
{
    const qdot_symbol *s = qdot_expr_symbol(d->pool, e);
    qdot_expr base, other = QDOT_NIL;

    if (s == NULL && qdot_expr_kind(d->pool, e) == QDOT_UFUN)
        return qdot_ufun_delayed(d->pool, qdot_expr_node(d->pool, e)->op);
    if (s == NULL)
        return variable_of(d, e);
    base = s->base;
    if (d->stands_for != NULL && (s->class == QDOT_FORMAL || s->class == QDOT_MOMENTUM || s->class == QDOT_MULTIPLIER))
        other = d->stands_for(d->user, e);
    return other != QDOT_NIL ? other : base;
}

static qdot_status
symbol_form(qdot_dimensions *d, qdot_expr e, const qdot_form **form)
{
    static const int action[QDOT_BASES] = {2, 1, -1};
    const qdot_symbol s = *qdot_expr_symbol(d->pool, e);
    const qdot_expr before = what_comes_before(d, e);
    const int unit = qdot_unit_symbol_base(d->pool, e);

    if (s.class == QDOT_CONST || s.class == QDOT_WORDS)
        *form = s.class == QDOT_WORDS || e == QDOT_TRUE || e == QDOT_FALSE
                    ? qdot_form_none(&d->forms)
                    : qdot_form_constant(&d->forms, qdot_dimension_none());
    else if (unit >= 0)
        *form = qdot_form_constant(&d->forms, base_dimension(unit));
    else if (before == QDOT_NIL && qdot_symbol_is_number(d->pool, e)) /* the number of a result; its unit stands beside it */
        *form = qdot_form_constant(&d->forms, qdot_dimension_none());
    else if (s.class == QDOT_TIME)
        *form = qdot_form_constant(&d->forms, base_dimension(2));
    else if (before == QDOT_NIL)
        *form = unknown_of(d, e);
    else if (s.class == QDOT_COORD)
        *form = qdot_form_addmul(&d->forms, d->of.at[before], qdot_form_constant(&d->forms, base_dimension(2)),
                                 (qdot_exponent){-(int32_t)s.order, 1});
    else if (s.class == QDOT_MOMENTUM && before == s.base)
        *form = qdot_form_addmul(&d->forms, qdot_form_constant(&d->forms, qdot_dimension_make(action)), d->of.at[before],
                                 minus);
    else
        *form = d->of.at[before];
    return QDOT_OK;
}

static qdot_status
sum_form(qdot_dimensions *d, qdot_expr e, const qdot_form **form)
{
    const uint32_t n = qdot_expr_count(d->pool, e);

    *form = of_arg(d, e, 1);
    for (uint32_t i = 3; i < n; i += 2)
        QDOT_TRY(join_forms(d, *form, of_arg(d, e, i), "%s is added to %s"));
    return qdot_expr_arg(d->pool, e, 0) == QDOT_ZERO ? QDOT_OK : join_number(d, *form, "%s is added to %s");
}

/* The exponent as a small rational number, if it is one. */
static bool
small_exponent(const qdot_pool *pool, qdot_expr x, qdot_exponent *small)
{
    const fmpq *q = qdot_expr_rational(pool, x);

    if (q == NULL || !fmpz_fits_si(fmpq_numref(q)) || !fmpz_fits_si(fmpq_denref(q)))
        return false;
    *small = qdot_exponent_make(fmpz_get_si(fmpq_numref(q)), fmpz_get_si(fmpq_denref(q)));
    return small->d != 0;
}

static qdot_status
product_form(qdot_dimensions *d, qdot_expr e, const qdot_form **form)
{
    const uint32_t n = qdot_expr_count(d->pool, e);

    *form = qdot_form_constant(&d->forms, qdot_dimension_none());
    for (uint32_t i = 1; i < n; i += 2) {
        const qdot_form *base = of_arg(d, e, i);
        qdot_exponent x;

        if (small_exponent(d->pool, qdot_expr_arg(d->pool, e, i + 1), &x)) {
            *form = qdot_form_addmul(&d->forms, *form, base, x);
            continue;
        }
        QDOT_TRY(join_number(d, of_arg(d, e, i + 1), "the exponent is %s, not %s"));
        QDOT_TRY(join_number(d, base, "the base of a power with symbols in its exponent is %s, not %s"));
    }
    return QDOT_OK;
}

/* The arguments from `first` on are of one dimension, that of the function. */
static qdot_status
common_form(qdot_dimensions *d, qdot_expr e, uint32_t first, const qdot_form **form)
{
    *form = of_arg(d, e, first);
    for (uint32_t i = first + 1; i < qdot_expr_count(d->pool, e); i++) {
        if ((*form)->any)
            *form = of_arg(d, e, i);
        QDOT_TRY(join_forms(d, *form, of_arg(d, e, i), "%s and %s are arguments of one function"));
    }
    return QDOT_OK;
}

static qdot_status
function_form(qdot_dimensions *d, qdot_expr e, const qdot_form **form)
{
    const uint32_t n = qdot_expr_count(d->pool, e);

    switch ((qdot_fun_id)qdot_expr_node(d->pool, e)->op) {
    case QDOT_ABS:
    case QDOT_MIN:
    case QDOT_MAX:
    case QDOT_MOD:
    case QDOT_HOLD: return common_form(d, e, 0, form);
    case QDOT_IF: return common_form(d, e, 1, form);
    case QDOT_ATAN2:
        QDOT_TRY(common_form(d, e, 0, form));
        *form = qdot_form_constant(&d->forms, qdot_dimension_none());
        return QDOT_OK;
    case QDOT_SIGN: *form = qdot_form_constant(&d->forms, qdot_dimension_none()); return QDOT_OK;
    default: break;
    }
    *form = qdot_form_constant(&d->forms, qdot_dimension_none());
    for (uint32_t i = 0; i < n; i++) {
        char format[64];

        snprintf(format, sizeof format, "the argument of %.20s is %%s, not %%s",
                 qdot_fun_name((qdot_fun_id)qdot_expr_node(d->pool, e)->op));
        QDOT_TRY(join_number(d, of_arg(d, e, i), format));
    }
    return QDOT_OK;
}

static qdot_status
undefined_form(qdot_dimensions *d, qdot_expr e, const qdot_form **form)
{
    const uint32_t id = qdot_expr_node(d->pool, e)->op, n = qdot_expr_count(d->pool, e) / 2;
    const qdot_expr delayed = what_comes_before(d, e); /* x of x(t - tau) */

    *form = delayed != QDOT_NIL ? d->of.at[delayed] : unknown_of(d, key_of_function(id, 0));
    for (uint32_t i = 0; i < n; i++) {
        const qdot_form *argument = delayed != QDOT_NIL ? qdot_form_constant(&d->forms, base_dimension(2))
                                                        : unknown_of(d, key_of_function(id, i + 1));
        qdot_exponent order = {0, 1};

        QDOT_TRY(join_forms(d, of_arg(d, e, i), argument, "the argument of a function is %s, and elsewhere %s"));
        if (small_exponent(d->pool, qdot_expr_arg(d->pool, e, n + i), &order) && order.n != 0)
            *form = qdot_form_addmul(&d->forms, *form, argument, (qdot_exponent){-order.n, 1});
    }
    return QDOT_OK;
}

static qdot_status
integral_form(qdot_dimensions *d, qdot_expr e, const qdot_form **form)
{
    const qdot_expr own = variable_of(d, e), x = own != QDOT_NIL ? own : qdot_expr_arg(d->pool, e, 1);

    for (uint32_t i = 1; own != QDOT_NIL && i < 3; i++)
        QDOT_TRY(join_forms(d, d->of.at[x], of_arg(d, e, i), "an integral over %s has an end that is %s"));
    *form = qdot_form_addmul(&d->forms, d->of.at[part_of(d, e, 0)], d->of.at[x], (qdot_exponent){1, 1});
    return QDOT_OK;
}

static qdot_status
node_form(qdot_dimensions *d, qdot_expr e, const qdot_form **form)
{
    if (qdot_infinite(d->pool, e) != 0) {
        *form = qdot_form_any(&d->forms);
        return QDOT_OK;
    }
    switch (qdot_expr_kind(d->pool, e)) {
    case QDOT_NUM:
        *form = e == QDOT_ZERO ? qdot_form_any(&d->forms) : qdot_form_constant(&d->forms, qdot_dimension_none());
        return QDOT_OK;
    case QDOT_SYM: return symbol_form(d, e, form);
    case QDOT_SUM: return sum_form(d, e, form);
    case QDOT_PROD: return product_form(d, e, form);
    case QDOT_FUN: return function_form(d, e, form);
    case QDOT_UFUN: return undefined_form(d, e, form);
    case QDOT_INTEGRAL: return integral_form(d, e, form);
    case QDOT_REL:
        *form = qdot_form_none(&d->forms);
        return join_forms(d, of_arg(d, e, 0), of_arg(d, e, 1), "%s is compared with %s");
    default: *form = qdot_form_none(&d->forms); return QDOT_OK;
    }
}

/* Give every node below e its form, those below it first. */
qdot_status
qdot_dimensions_visit(qdot_dimensions *d, qdot_expr e)
{
    d->stack.n = 0;
    QDOT_TRY(qdot_vec_push(&d->stack, e));
    while (d->stack.n > 0) {
        const qdot_expr at = d->stack.at[d->stack.n - 1], before = what_comes_before(d, at);
        const uint32_t n = at == QDOT_NIL ? 0 : qdot_expr_count(d->pool, at);
        const size_t waiting = d->stack.n;
        const qdot_form *form = NULL;

        while (d->of.n <= at || d->of.n <= before)
            QDOT_TRY(qdot_vec_push(&d->of, (const qdot_form *)NULL));
        if (at == QDOT_NIL || d->of.at[at] != NULL) {
            d->stack.n--;
            continue;
        }
        for (uint32_t i = 0; i < n; i++) {
            const qdot_expr arg = part_of(d, at, i);

            if (arg >= d->of.n || d->of.at[arg] == NULL)
                QDOT_TRY(qdot_vec_push(&d->stack, arg));
        }
        if (before != QDOT_NIL && d->of.at[before] == NULL)
            QDOT_TRY(qdot_vec_push(&d->stack, before));
        if (d->stack.n > waiting)
            continue;
        QDOT_TRY(node_form(d, at, &form));
        if (form == NULL)
            return qdot_last_error()->status == QDOT_ELIMIT ? QDOT_ELIMIT : QDOT_ENOMEM;
        d->of.at[at] = form;
        d->stack.n--;
    }
    return QDOT_OK;
}

/* --- statements about expressions ------------------------------------------------------- */

qdot_status
qdot_dimensions_join(qdot_dimensions *d, qdot_expr a, qdot_expr b, const char *format)
{
    const uint32_t n = qdot_expr_count(d->pool, a);

    if (qdot_expr_kind(d->pool, a) >= QDOT_VEC && qdot_expr_kind(d->pool, a) == qdot_expr_kind(d->pool, b) &&
        n == qdot_expr_count(d->pool, b)) {
        for (uint32_t i = 0; i < n; i++)
            QDOT_TRY(qdot_dimensions_join(d, qdot_expr_arg(d->pool, a, i), qdot_expr_arg(d->pool, b, i), format));
        return QDOT_OK;
    }
    QDOT_TRY(qdot_dimensions_visit(d, a));
    QDOT_TRY(qdot_dimensions_visit(d, b));
    return join_forms(d, d->of.at[a], d->of.at[b], format);
}

qdot_status
qdot_dimensions_fix(qdot_dimensions *d, qdot_expr e, qdot_dimension is, const char *format)
{
    if (qdot_expr_kind(d->pool, e) >= QDOT_VEC) {
        for (uint32_t i = 0; i < qdot_expr_count(d->pool, e); i++)
            QDOT_TRY(qdot_dimensions_fix(d, qdot_expr_arg(d->pool, e, i), is, format));
        return QDOT_OK;
    }
    QDOT_TRY(qdot_dimensions_visit(d, e));
    return join_forms(d, d->of.at[e], qdot_form_constant(&d->forms, is), format);
}

/* --- what is known ---------------------------------------------------------------------- */

/* The reduced form of a scalar, or the common one of a vector's components; NULL: none. */
static const qdot_form *
form_of(qdot_dimensions *d, qdot_expr e)
{
    const qdot_form *form = NULL;

    if (qdot_expr_kind(d->pool, e) == QDOT_REL)
        return form_of(d, qdot_expr_arg(d->pool, e, 0));
    if (qdot_expr_kind(d->pool, e) < QDOT_VEC)
        return qdot_dimensions_visit(d, e) == QDOT_OK ? qdot_form_reduce(&d->forms, d->of.at[e]) : NULL;
    for (uint32_t i = 0; i < qdot_expr_count(d->pool, e); i++) {
        const qdot_form *one = form_of(d, qdot_expr_arg(d->pool, e, i)), *difference;

        if (one == NULL)
            return NULL;
        if (form == NULL || form->any) {
            form = one;
            continue;
        }
        difference = one->any ? form : qdot_form_addmul(&d->forms, form, one, minus);
        if (!one->any && (difference == NULL || difference->n > 0 || !qdot_dimension_is_none(difference->constant)))
            return NULL;
    }
    return form;
}

qdot_dimension_state
qdot_dimensions_of(qdot_dimensions *d, qdot_expr e, qdot_dimension *dimension)
{
    const qdot_form *form = e == QDOT_NIL ? NULL : form_of(d, e);

    *dimension = form != NULL ? form->constant : qdot_dimension_none();
    if (form == NULL || form->none)
        return QDOT_DIMENSION_NONE;
    return form->any ? QDOT_DIMENSION_ANY : form->n > 0 ? QDOT_DIMENSION_FREE : QDOT_DIMENSION_KNOWN;
}

void
qdot_dimensions_words(qdot_dimensions *d, qdot_expr e, qdot_text *out)
{
    const qdot_form *form = form_of(d, e);

    if (form != NULL)
        add_form(d, form, out);
}

/* --- groups ----------------------------------------------------------------------------- */

qdot_status
qdot_dimensions_groups(qdot_dimensions *d, size_t n, const qdot_expr *x, size_t *count, int32_t **power)
{
    const size_t rows = QDOT_BASES + d->key.n + n;
    qdot_exponent *a = qdot_calloc(rows * n + 1, sizeof *a);
    qdot_status status = a == NULL ? QDOT_ENOMEM : QDOT_OK;

    *count = 0;
    *power = NULL;
    for (size_t i = 0; a != NULL && i < rows * n; i++)
        a[i] = (qdot_exponent){0, 1};
    for (size_t j = 0; j < n && status == QDOT_OK; j++) {
        const qdot_form *form;

        status = qdot_dimensions_visit(d, x[j]);
        form = status == QDOT_OK ? qdot_form_reduce(&d->forms, d->of.at[x[j]]) : NULL;
        if (form == NULL) {
            status = status == QDOT_OK ? QDOT_ENOMEM : status;
            continue;
        }
        for (int i = 0; i < QDOT_BASES; i++)
            a[(size_t)i * n + j] = form->constant.of[i];
        for (uint32_t i = 0; i < form->n; i++)
            a[(QDOT_BASES + form->at[i].unknown) * n + j] = form->at[i].x;
    }
    if (status == QDOT_OK)
        status = qdot_groups_find(rows, n, a, count, power);
    qdot_free(a);
    return status;
}
