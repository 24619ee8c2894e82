/* transfer.c -- copies expressions from one pool to another, node by node. */
#include "lang/session/transfer.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"

static qdot_expr
copy_symbol(const qdot_pool *from, qdot_pool *to, qdot_expr e)
{
    qdot_symbol s = *qdot_expr_symbol(from, e);
    qdot_expr made, lo = QDOT_NIL, hi = QDOT_NIL;

    if (e == QDOT_T || s.class == QDOT_CONST)
        return e; /* constants and t have the same id in every pool */
    switch (s.class) {
    case QDOT_COORD:
        if (s.order > 0)
            return qdot_symbol_jet(to, qdot_transfer(from, to, s.base), s.order);
        break;
    case QDOT_MOMENTUM:
    case QDOT_DIFFERENTIAL:
    case QDOT_DELTA: return qdot_symbol_of(to, s.class, qdot_transfer(from, to, s.base));
    default: break;
    }
    made = qdot_symbol_get(to, s.class, s.name);
    if (made == QDOT_NIL || qdot_expr_symbol(to, made)->lo != QDOT_NIL ||
        qdot_expr_symbol(to, made)->hi != QDOT_NIL)
        return made; /* a symbol that the target pool already has */
    if (s.lo != QDOT_NIL)
        lo = qdot_transfer(from, to, s.lo);
    if (s.hi != QDOT_NIL)
        hi = qdot_transfer(from, to, s.hi);
    if (lo != QDOT_NIL || hi != QDOT_NIL)
        qdot_symbol_domain(to, made, lo, s.lo_open, hi, s.hi_open);
    return made;
}

static qdot_expr
copy_undefined_function(const qdot_pool *from, qdot_pool *to, qdot_expr e, const qdot_expr *args)
{
    const qdot_ufun *f = qdot_ufun_get(from, qdot_expr_node(from, e)->op);
    uint32_t *orders = qdot_calloc(f->arity, sizeof *orders), id;
    qdot_expr *formals = qdot_calloc(f->arity, sizeof *formals), made = QDOT_NIL;

    if (orders == NULL || formals == NULL) {
        qdot_free(orders);
        qdot_free(formals);
        return qdot_pool_fail(to);
    }
    for (uint32_t i = 0; i < f->arity; i++) {
        int64_t order = 0;

        (void)qdot_expr_to_int(from, qdot_expr_arg(from, e, f->arity + i), &order);
        orders[i] = (uint32_t)order;
        formals[i] = qdot_transfer(from, to, qdot_expr_arg(from, f->formals, i));
    }
    if (qdot_ufun_declare(to, f->name, f->arity, formals, &id) == QDOT_OK)
        made = qdot_ufun_apply(to, id, args, orders);
    else
        made = qdot_pool_fail(to);
    qdot_free(orders);
    qdot_free(formals);
    return made;
}

/* Copy one node whose children have been copied. */
static qdot_expr
copy_node(const qdot_pool *from, qdot_pool *to, qdot_expr e, const qdot_expr *args)
{
    const qdot_node *node = qdot_expr_node(from, e);
    qdot_expr made;

    switch ((qdot_kind)node->kind) {
    case QDOT_NUM: return qdot_expr_fmpq(to, qdot_expr_rational(from, e));
    case QDOT_SYM: return copy_symbol(from, to, e);
    case QDOT_SUM:
        made = args[0];
        for (uint32_t i = 1; i + 1 < node->n; i += 2)
            made = qdot_add(to, made, qdot_mul(to, args[i], args[i + 1]));
        return made;
    case QDOT_PROD:
        made = args[0];
        for (uint32_t i = 1; i + 1 < node->n; i += 2)
            made = qdot_mul(to, made, qdot_pow(to, args[i], args[i + 1]));
        return made;
    case QDOT_FUN: return qdot_fun(to, (qdot_fun_id)node->op, node->n, args);
    case QDOT_UFUN: return copy_undefined_function(from, to, e, args);
    case QDOT_INTEGRAL: return qdot_integral_copy(from, e, to, args);
    case QDOT_REL: return qdot_rel(to, (qdot_rel_op)node->op, args[0], args[1]);
    case QDOT_LOGIC: return qdot_logic(to, (qdot_logic_op)node->op, node->n, args);
    case QDOT_VEC: return qdot_vector(to, node->n, args);
    case QDOT_MAT:
        return qdot_matrix(to, node->op == 0 ? 0 : node->n / node->op, node->op, args);
    case QDOT_LIST: return qdot_list(to, node->n, args);
    }
    return QDOT_NIL;
}

qdot_expr
qdot_transfer(const qdot_pool *from, qdot_pool *to, qdot_expr e)
{
    qdot_vec(qdot_expr) args = {0};
    qdot_expr made = QDOT_NIL;
    qdot_walk w;

    if (e == QDOT_NIL)
        return QDOT_NIL;
    if (qdot_walk_begin(from, e, &w) != QDOT_OK)
        return qdot_pool_fail(to);
    for (size_t i = 0; i < w.n; i++) {
        uint32_t n = qdot_expr_kind(from, w.at[i]) == QDOT_NUM ||
                             qdot_expr_kind(from, w.at[i]) == QDOT_SYM
                         ? 0
                         : qdot_expr_count(from, w.at[i]);

        args.n = 0;
        for (uint32_t k = 0; k < n; k++) {
            qdot_expr child =
                (qdot_expr)qdot_walk_get(&w, qdot_expr_arg(from, w.at[i], k));

            if (qdot_vec_push(&args, child) != QDOT_OK) {
                made = qdot_pool_fail(to);
                goto done;
            }
        }
        made = copy_node(from, to, w.at[i], args.at);
        if (made == QDOT_NIL)
            break;
        qdot_walk_set(&w, w.at[i], made);
    }
done:
    qdot_free(args.at);
    qdot_walk_end(&w);
    return made;
}
