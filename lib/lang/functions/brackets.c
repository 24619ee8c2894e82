/* brackets.c -- Poisson's bracket, Lie series, canonical transformations. */
#include "base/memory.h"
#include "base/text.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/functions/builtin.h"
#include "lang/session/bind.h"
#include "lang/session/evaluation.h"
#include "mech/hamilton/generating.h"
#include "mech/hamilton/hamilton.h"
#include "normal/prove/decide.h"

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

/* The matrix of {f_i, g_j}, f and g vectors or lists. */
static qdot_status
bracket_matrix(qdot_session *s, qdot_expr f, qdot_expr g, qdot_expr *value)
{
    const uint32_t rows = qdot_expr_count(s->pool, f), columns = qdot_expr_count(s->pool, g);
    qdot_expr *entries = qdot_malloc(((size_t)rows * columns + 1) * sizeof *entries);

    if (entries == NULL)
        return QDOT_ENOMEM;
    for (uint32_t k = 0; k < rows * columns; k++)
        entries[k] = qdot_hamilton_poisson(s->scene, qdot_expr_arg(s->pool, f, k / columns),
                                           qdot_expr_arg(s->pool, g, k % columns));
    *value = qdot_matrix(s->pool, rows, columns, entries);
    qdot_free(entries);
    return qdot_value_kind_check(s->pool, *value);
}

static bool
is_row(const qdot_pool *pool, qdot_expr e)
{
    return (qdot_expr_kind(pool, e) == QDOT_VEC || qdot_expr_kind(pool, e) == QDOT_LIST) && qdot_expr_count(pool, e) > 0;
}

/* Compute {f, g}, component by component where f or g is a vector; of two vectors the matrix. */
qdot_status
qdot_call_poisson(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    bracket b = {s, QDOT_NIL, args[1]};

    (void)n;
    if (is_row(s->pool, args[0]) && is_row(s->pool, args[1]))
        return bracket_matrix(s, args[0], args[1], value);
    if (!qdot_expr_is_scalar(s->pool, args[0]) && !qdot_expr_is_scalar(s->pool, args[1]))
        return qdot_fail(QDOT_ETYPE, "poisson(f, g) takes numbers and vectors");
    return qdot_value_kind_give(
        s->pool, qdot_value_map(s->pool, args[0], bracket_with, &b), value);
}

/* --- Lie series ------------------------------------------------------------------------- */

typedef struct {
    qdot_session *session;
    qdot_expr W;
    int64_t order;
} lie_series;

/* f + {f, W} + {{f, W}, W}/2! + ... */
static qdot_expr
lie_series_of(qdot_pool *pool, qdot_expr f, void *user)
{
    const lie_series *l = user;
    qdot_expr sum = f, term = f;

    for (int64_t k = 1; k <= l->order && term != QDOT_ZERO && term != QDOT_NIL; k++) {
        term = qdot_div(pool, qdot_hamilton_poisson(l->session->scene, term, l->W), qdot_expr_int(pool, k));
        sum = qdot_add(pool, sum, term);
    }
    return sum;
}

qdot_status
qdot_call_lie(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    enum { HIGHEST = 100 };
    lie_series l = {s, args[1], 0};

    (void)n;
    QDOT_TRY(qdot_session_integer(s, args[2], &l.order));
    if (l.order < 0 || l.order > HIGHEST)
        return qdot_fail(QDOT_EDOMAIN, "the order of a Lie series is a number from 0 to %d", HIGHEST);
    if (!qdot_expr_is_scalar(s->pool, l.W))
        return qdot_fail(QDOT_ETYPE, "the generator W in lie(f, W, n) is a number");
    return qdot_value_kind_give(s->pool, qdot_value_map(s->pool, args[0], lie_series_of, &l), value);
}

/* --- canonical transformations ---------------------------------------------------------- */

/* Whether value = wanted is proved but for the places where a sign(u) in it jumps: sign(u)^2 = 1 elsewhere. A notice names them. */
static qdot_status
prove_beside_jumps(qdot_session *s, qdot_expr value, qdot_expr wanted, bool *proved)
{
    qdot_facts facts = qdot_scene_facts(s->scene);
    qdot_vec(qdot_expr) relations = {0};
    qdot_text text = {0};
    qdot_walk w;
    qdot_status status = qdot_walk_begin(s->pool, value, &w);

    *proved = false;
    QDOT_TRY(status);
    qdot_text_add(&text, "except where");
    for (size_t i = 0; i < w.n && status == QDOT_OK; i++) {
        if (qdot_expr_kind(s->pool, w.at[i]) != QDOT_FUN || qdot_expr_node(s->pool, w.at[i])->op != QDOT_SIGN)
            continue;
        qdot_text_add(&text, relations.n > 0 ? ", " : " ");
        status = qdot_print(s->pool, qdot_expr_arg(s->pool, w.at[i], 0), QDOT_PLAIN, &text);
        qdot_text_add(&text, " = 0");
        if (status == QDOT_OK)
            status = qdot_vec_push(&relations, qdot_sub(s->pool, qdot_pow_int(s->pool, w.at[i], 2), QDOT_ONE));
    }
    qdot_walk_end(&w);
    for (size_t i = 0; i < facts.n_relations && relations.n > 0 && status == QDOT_OK; i++)
        status = qdot_vec_push(&relations, facts.relations[i]);
    if (relations.n > 0 && status == QDOT_OK) {
        facts.relations = relations.at;
        facts.n_relations = relations.n;
        *proved = qdot_is_zero(s->pool, qdot_sub(s->pool, value, wanted), &facts);
        status = qdot_pool_check(s->pool);
    }
    qdot_free(relations.at);
    if (*proved)
        return qdot_answer_notice_once_text(s, status, &text);
    qdot_text_clear(&text);
    return status;
}

/* Whether {a, b} = wanted is proved; if it is refuted, a notice tells what it is. */
static qdot_status
compare_bracket(qdot_session *s, qdot_expr a, qdot_expr b, qdot_expr wanted, qdot_verdict *verdict)
{
    const qdot_facts facts = qdot_scene_facts(s->scene);
    const qdot_expr value = qdot_hamilton_poisson(s->scene, qdot_expr_arg(s->pool, a, 1), qdot_expr_arg(s->pool, b, 1));
    qdot_decision decision;
    qdot_text text = {0};
    qdot_status status;

    QDOT_TRY(qdot_pool_check(s->pool));
    QDOT_TRY(qdot_decide_equal(s->pool, value, wanted, &facts, &decision));
    *verdict = decision.verdict;
    if (*verdict != QDOT_PROVED) {
        bool proved;

        QDOT_TRY(prove_beside_jumps(s, value, wanted, &proved));
        if (proved)
            *verdict = QDOT_PROVED;
    }
    if (*verdict == QDOT_PROVED)
        return QDOT_OK;
    qdot_text_format(&text, "the bracket {%s, %s} = ", qdot_expr_symbol(s->pool, qdot_expr_arg(s->pool, a, 0))->name,
                     qdot_expr_symbol(s->pool, qdot_expr_arg(s->pool, b, 0))->name);
    status = qdot_print(s->pool, value, QDOT_PLAIN, &text);
    qdot_text_format(&text, *verdict == QDOT_REFUTED ? " is not %d" : ": undecided whether that is %d", wanted == QDOT_ONE);
    return qdot_answer_notice_text(s, status, &text);
}

/* Whether q, its momentum or its velocity stands in the equations. */
static bool
stands_among(const qdot_session *s, uint32_t n, const qdot_expr *equations, qdot_expr q)
{
    const qdot_expr symbols[] = {q, qdot_symbol_of(s->pool, QDOT_MOMENTUM, q), qdot_symbol_jet(s->pool, q, 1)};
    bool stands = false;

    for (uint32_t k = 0; k < n; k++)
        for (int j = 0; j < 3; j++)
            stands |= qdot_expr_contains(s->pool, qdot_expr_arg(s->pool, equations[k], 1), symbols[j]);
    return stands;
}

/* The number of coordinates of the scene that, or whose momenta or velocities, stand in the equations. */
static size_t
coordinates_in(const qdot_session *s, uint32_t n, const qdot_expr *equations)
{
    size_t count = 0;

    for (size_t i = 0; i < s->scene->coordinates.n; i++)
        count += stands_among(s, n, equations, s->scene->coordinates.at[i]);
    return count;
}

/* The old coordinates and momenta that occur, and the new ones with their functions; x->q has room for 6n. */
static void
fill_transformation(const qdot_session *s, uint32_t n, const qdot_expr *args, qdot_transformation *x, qdot_expr *room)
{
    size_t found = 0;

    for (size_t i = 0; i < s->scene->coordinates.n; i++) {
        const qdot_expr q = s->scene->coordinates.at[i];

        if (stands_among(s, n, args, q)) {
            room[found] = q;
            room[n / 2 + found++] = qdot_symbol_of(s->pool, QDOT_MOMENTUM, q);
        }
    }
    for (uint32_t k = 0; k < n; k++) {
        room[(2 + k % 2) * (n / 2) + k / 2] = qdot_expr_arg(s->pool, args[k], 0);
        room[(4 + k % 2) * (n / 2) + k / 2] = qdot_hamilton_in_momenta(s->scene, qdot_expr_arg(s->pool, args[k], 1));
    }
    *x = (qdot_transformation){n / 2, room, room + n / 2, room + n, room + 3 * (n / 2), room + 2 * n, room + 5 * (n / 2)};
}

/* Append "a, b", of each pair the first, or where its bit is set the second. */
static void
add_names(const qdot_session *s, size_t n, const qdot_expr *first, const qdot_expr *second, unsigned bits, qdot_text *text)
{
    for (size_t i = 0; i < n; i++)
        qdot_text_format(text, "%s%s", i > 0 ? ", " : "", qdot_expr_symbol(s->pool, bits >> i & 1 ? second[i] : first[i])->name);
}

/* Append "function F2(", or "function of mixed type F(". */
static void
add_type(const qdot_generating *F, size_t n, qdot_text *text)
{
    const unsigned all = (1u << n) - 1;

    if ((F->of_p == 0 || F->of_p == all) && (F->of_P == 0 || F->of_P == all))
        qdot_text_format(text, "function F%d(", 1 + (F->of_P != 0) + 2 * (F->of_p != 0));
    else
        qdot_text_add(text, "function of mixed type F(");
}

/* Give a notice of a generating function, if one is found. */
static qdot_status
tell_generating_function(qdot_session *s, uint32_t n, const qdot_expr *args)
{
    const qdot_facts facts = qdot_scene_facts(s->scene);
    qdot_expr *room = qdot_calloc(3 * (size_t)n + 1, sizeof *room);
    qdot_generating found = {.F = QDOT_NIL};
    qdot_transformation x;
    qdot_text text = {0};
    qdot_status status = room == NULL ? QDOT_ENOMEM : QDOT_OK;

    if (status == QDOT_OK) {
        fill_transformation(s, n, args, &x, room);
        status = qdot_pool_check(s->pool);
    }
    if (status == QDOT_OK)
        status = qdot_generating_find(s->pool, &x, &facts, &found);
    if (status == QDOT_OK && found.F != QDOT_NIL) {
        qdot_text_add(&text, "generating ");
        add_type(&found, x.n, &text);
        add_names(s, x.n, x.q, x.p, found.of_p, &text);
        qdot_text_add(&text, ", ");
        add_names(s, x.n, x.Q, x.P, found.of_P, &text);
        qdot_text_add(&text, ") = ");
        status = qdot_answer_notice_text(s, qdot_print(s->pool, found.F, QDOT_PLAIN, &text), &text);
    }
    qdot_free(room);
    return status;
}

/* canonical(Q = ..., P = ..., Q2 = ..., P2 = ...): whether {Q_i, Q_j} = {P_i, P_j} = 0, {Q_i, P_j} = 1 for i = j, else 0. */
qdot_status
qdot_call_canonical(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    bool canonical = true;
    size_t coordinates;

    for (uint32_t i = 0; i < n; i++)
        if (!qdot_value_kind_is_equation(s->pool, args[i]) ||
            qdot_expr_symbol(s->pool, qdot_expr_arg(s->pool, args[i], 0)) == NULL ||
            !qdot_expr_is_scalar(s->pool, qdot_expr_arg(s->pool, args[i], 1))) {
            qdot_fail(QDOT_ETYPE, "canonical( ) takes new coordinates and momenta by pairs");
            return s->scene->coordinates.n == 0
                       ? qdot_hint("as in canonical(Q = p[x], P = -x)")
                       : qdot_hint("as in canonical(Q = p[%.60s], P = -%.60s)", qdot_expr_symbol(s->pool, s->scene->coordinates.at[0])->name,
                                   qdot_expr_symbol(s->pool, s->scene->coordinates.at[0])->name);
        }
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < i; j++)
            if (qdot_expr_arg(s->pool, args[i], 0) == qdot_expr_arg(s->pool, args[j], 0))
                return qdot_fail(QDOT_EINVAL, "%.100s is given twice", qdot_expr_symbol(s->pool, qdot_expr_arg(s->pool, args[i], 0))->name);
    if (n % 2 != 0)
        return qdot_fail(QDOT_EINVAL, "the new momentum that belongs to %.100s is missing",
                         qdot_expr_symbol(s->pool, qdot_expr_arg(s->pool, args[n - 1], 0))->name);
    coordinates = coordinates_in(s, n, args);
    QDOT_TRY(qdot_pool_check(s->pool));
    if (coordinates != n / 2)
        return qdot_fail(QDOT_EINVAL, "%u pair%s for %zu coordinate%s: as many are needed", n / 2, n == 2 ? "" : "s",
                         coordinates, coordinates == 1 ? "" : "s");
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = i + 1; j < n; j++) {
            qdot_verdict verdict;

            QDOT_TRY(compare_bracket(s, args[i], args[j], i % 2 == 0 && j == i + 1 ? QDOT_ONE : QDOT_ZERO, &verdict));
            canonical &= verdict == QDOT_PROVED;
            if (verdict == QDOT_UNDECIDED)
                return qdot_fail(QDOT_EFAILED, "undecided whether this transformation is canonical");
        }
    if (canonical && s->evaluation->asks)
        QDOT_TRY(tell_generating_function(s, n, args));
    *value = canonical ? QDOT_TRUE : QDOT_FALSE;
    return QDOT_OK;
}
