/* pool.c -- the pool of expressions: it shares equal nodes, and stores symbols, numbers and the first failure. */
#include "expr/pool.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <flint/flint.h>
#include <flint/fmpz.h>
#include <gmp.h>

#include "base/interrupt.h"
#include "base/scope.h"
#include "base/text.h"
#include "expr/exact.h"
#include "expr/printed.h"

static uint32_t
mix_into_hash(uint32_t h, uint32_t x)
{
    h ^= x + 0x9e3779b9u + (h << 6) + (h >> 2);
    h *= 0x85ebca6bu;
    return h ^ (h >> 15);
}

/* --- failures of the pool ------------------------------------------------------------- */

qdot_expr
qdot_pool_fail(qdot_pool *pool)
{
    if (pool->error.status == QDOT_OK)
        pool->error = *qdot_last_error();
    return QDOT_NIL;
}

qdot_expr
qdot_pool_refuse(qdot_pool *pool, qdot_status status, const char *format, ...)
{
    char message[sizeof pool->error.message];
    va_list ap;

    if (pool->error.status != QDOT_OK)
        return QDOT_NIL;
    va_start(ap, format);
    vsnprintf(message, sizeof message, format, ap);
    va_end(ap);
    (void)qdot_fail(status, "%s", message);
    return qdot_pool_fail(pool);
}

qdot_status
qdot_pool_check(qdot_pool *pool)
{
    qdot_error error = pool->error;

    if (error.status == QDOT_OK)
        return QDOT_OK;
    pool->error.status = QDOT_OK;
    return qdot_fail_again(&error);
}

bool
qdot_pool_failed(const qdot_pool *pool)
{
    return FAILED(pool);
}

uint64_t
qdot_pool_budget(qdot_pool *pool, uint64_t work)
{
    uint64_t left = pool->budget;

    pool->budget = work;
    return left;
}

void
qdot_pool_unfinished(qdot_pool *pool)
{
    pool->unfinished = true;
}

bool
qdot_pool_unfinished_taken(qdot_pool *pool)
{
    bool was = pool->unfinished;

    pool->unfinished = false;
    return was;
}

/* --- one node for equal expressions (interning) --------------------------------------- */

static bool
is_same_node(const qdot_pool *pool, qdot_expr e, qdot_kind kind, uint16_t op, uint32_t n,
             const qdot_expr *args, uint32_t hash)
{
    const qdot_node *node = NODE(pool, e);

    return node->hash == hash && node->kind == kind && node->op == op && node->n == n &&
           (n == 0 || memcmp(ARGS(pool, e), args, n * sizeof *args) == 0);
}

static qdot_status
enlarge_hash_table(qdot_pool *pool)
{
    uint32_t size = (pool->mask + 1) * 2;
    uint32_t *bigger = qdot_calloc(size, sizeof *bigger);

    if (bigger == NULL)
        return QDOT_ENOMEM;
    for (uint32_t e = 1; e < pool->nodes.n; e++) {
        uint32_t i = NODE(pool, e)->hash & (size - 1);

        while (bigger[i] != 0)
            i = (i + 1) & (size - 1);
        bigger[i] = e;
    }
    qdot_free(pool->table);
    pool->table = bigger;
    pool->mask = size - 1;
    return QDOT_OK;
}

/* Append a node and enter it in the hash table. */
static qdot_expr
append_node(qdot_pool *pool, const qdot_node *node)
{
    uint32_t i;

    if (pool->nodes.n >= 0x40000000u)
        return qdot_pool_refuse(pool, QDOT_ELIMIT, "too large: more than 10^9 nodes");
    if (pool->nodes.n * 2 > pool->mask) {
        /* not recorded in the present scope, because the pool outlives the scope */
        qdot_scope *scope = qdot_scope_pause();
        qdot_status status = enlarge_hash_table(pool);

        qdot_scope_resume(scope);
        if (status != QDOT_OK)
            return qdot_pool_fail(pool);
    }
    if (qdot_vec_push(&pool->nodes, *node) != QDOT_OK)
        return qdot_pool_fail(pool);
    i = node->hash & pool->mask;
    while (pool->table[i] != 0)
        i = (i + 1) & pool->mask;
    pool->table[i] = (uint32_t)pool->nodes.n - 1;
    NODE(pool, pool->table[i])->size = qdot_size_kept(pool, pool->table[i]);
    return pool->table[i];
}

bool
qdot_pool_interrupted(qdot_pool *pool)
{
    if (!qdot_interrupt_is_set())
        return false;
    (void)qdot_interrupt_check();
    qdot_pool_fail(pool);
    return true;
}

/* Whether to make another node: counts it against the work budget (more for many args), and tests for Ctrl-C. */
static bool
may_continue_work(qdot_pool *pool, uint32_t args)
{
    uint64_t cost = 1 + args / 16;

    if (pool->error.status != QDOT_OK)
        return false;
    if (qdot_pool_interrupted(pool))
        return false;
    if (pool->budget == UINT64_MAX)
        return true;
    if (pool->budget < cost) {
        pool->budget = 0;
        qdot_pool_refuse(pool, QDOT_ELIMIT, "the work budget is spent");
        return false;
    }
    pool->budget -= cost;
    return true;
}

qdot_expr
qdot_pool_intern(qdot_pool *pool, qdot_kind kind, uint16_t op, uint32_t n,
                 const qdot_expr *args, uint8_t sign)
{
    uint32_t hash = mix_into_hash(mix_into_hash(kind, op), n), i;
    qdot_node node = {.kind = (uint8_t)kind, .sign = sign, .op = op, .n = n};
    bool inside = args >= pool->args.at && args < pool->args.at + pool->args.n;
    size_t offset = inside ? (size_t)(args - pool->args.at) : 0;

    if (!may_continue_work(pool, n))
        return QDOT_NIL;
    for (uint32_t k = 0; k < n; k++) {
        if (args[k] == QDOT_NIL)
            return qdot_pool_refuse(pool, QDOT_EINVAL, "an expression without a value");
        hash = mix_into_hash(hash, args[k]);
    }
    for (i = hash & pool->mask; pool->table[i] != 0; i = (i + 1) & pool->mask)
        if (is_same_node(pool, pool->table[i], kind, op, n, args, hash))
            return pool->table[i];
    for (uint32_t k = 0; k < n; k++) {
        const qdot_node *child = NODE(pool, args[k]);

        node.holds |= child->holds;
        node.touches |= child->touches;
        if (node.height <= child->height)
            node.height = child->height + 1;
    }
    if (kind == QDOT_FUN || kind == QDOT_INTEGRAL)
        node.holds |= QDOT_HAS_FUN;
    if (kind == QDOT_INTEGRAL)
        node.holds &= ~(uint32_t)QDOT_HAS_INFINITY;
    if (kind == QDOT_UFUN)
        node.holds |= QDOT_HAS_UFUN;
    if (kind > QDOT_INTEGRAL)
        node.touches |= QDOT_TOUCHES_VALUE;
    node.hash = hash;
    node.at = (uint32_t)pool->args.n;
    if (pool->args.n + n > UINT32_MAX / 2)
        return qdot_pool_refuse(pool, QDOT_ELIMIT, "too large: more than 2^31 arguments");
    if (qdot_grow(&pool->args.at, &pool->args.capacity, pool->args.n + n, sizeof *args))
        return qdot_pool_fail(pool);
    if (inside)
        args = pool->args.at + offset;
    if (n > 0)
        memmove(pool->args.at + pool->args.n, args, n * sizeof *args);
    pool->args.n += n;
    return append_node(pool, &node);
}

/* --- numbers as nodes ----------------------------------------------------------------- */

static uint8_t
sign_of_number(const fmpq *x)
{
    int s = qdot_rational_sgn(x);

    return s > 0 ? QDOT_POS : s < 0 ? QDOT_NEG : QDOT_GE0 | QDOT_LE0;
}

static uint32_t
hash_fmpz(uint32_t h, const fmpz_t x)
{
    if (!COEFF_IS_MPZ(*x))
        return mix_into_hash(mix_into_hash(h, (uint32_t)*x), (uint32_t)((uint64_t)*x >> 32));
    h = mix_into_hash(h, (uint32_t)fmpz_fdiv_ui(x, 4294967291u));
    return mix_into_hash(h, (uint32_t)fmpz_bits(x) * 2 + (fmpz_sgn(x) < 0));
}

static bool
is_small_rational(const fmpq_t x)
{
    return !COEFF_IS_MPZ(*fmpq_numref(x)) && !COEFF_IS_MPZ(*fmpq_denref(x));
}

bool
qdot_number_too_large(qdot_pool *pool, const fmpq_t x)
{
    if (is_small_rational(x))
        return false;
    if (fmpz_bits(fmpq_numref(x)) <= QDOT_MAX_BITS &&
        fmpz_bits(fmpq_denref(x)) <= QDOT_MAX_BITS)
        return false;
    qdot_pool_refuse(pool, QDOT_ELIMIT, "an exact number of more than 10^6 digits");
    return true;
}

/* Allocate memory in the pool, which never moves; NULL if memory runs out. */
static void *
allocate_in_pool(qdot_pool *pool, size_t bytes)
{
    qdot_scope *scope = qdot_scope_pause(); /* not recorded in the present scope, because the pool outlives the scope */
    void *room = qdot_arena_take(pool->arena, bytes);

    qdot_scope_resume(scope);
    return room;
}

/* *y = x for as long as the pool lives: a large integer is one of GMP's that is only read, in the
 * pool's own memory, so that any thread may use it, whose FLINT made it or not. */
static bool
store_integer(qdot_pool *pool, fmpz *y, const fmpz_t x)
{
    const __mpz_struct *from;
    size_t bytes;
    char *room;

    *y = *x;
    if (!COEFF_IS_MPZ(*x))
        return true;
    from = COEFF_TO_PTR(*x);
    bytes = mpz_size(from) * sizeof(mp_limb_t);
    room = allocate_in_pool(pool, sizeof *from + bytes);
    if (room == NULL)
        return false;
    memcpy(room + sizeof *from, mpz_limbs_read(from), bytes);
    *y = PTR_TO_COEFF(mpz_roinit_n((__mpz_struct *)(void *)room,
                                   (mp_limb_t *)(void *)(room + sizeof *from),
                                   mpz_sgn(from) * (mp_size_t)mpz_size(from)));
    return true;
}

qdot_expr
qdot_expr_fmpq(qdot_pool *pool, const fmpq_t x)
{
    qdot_node node = {.kind = QDOT_NUM, .sign = sign_of_number(x)};
    bool small = is_small_rational(x);
    fmpq *copy;

    if (!may_continue_work(pool, 0) || qdot_number_too_large(pool, x))
        return QDOT_NIL;
    node.hash = hash_fmpz(hash_fmpz(QDOT_NUM, fmpq_numref(x)), fmpq_denref(x));
    for (uint32_t i = node.hash & pool->mask; pool->table[i] != 0;
         i = (i + 1) & pool->mask) {
        qdot_expr e = pool->table[i];

        if (NODE(pool, e)->hash == node.hash && NODE(pool, e)->kind == QDOT_NUM &&
            (small ? *fmpq_numref(RATIONAL(pool, e)) == *fmpq_numref(x) &&
                         *fmpq_denref(RATIONAL(pool, e)) == *fmpq_denref(x)
                   : qdot_rational_equal(RATIONAL(pool, e), x)))
            return e;
    }
    node.at = (uint32_t)pool->numbers.n;
    copy = allocate_in_pool(pool, sizeof *copy);
    if (copy == NULL || !store_integer(pool, fmpq_numref(copy), fmpq_numref(x)) ||
        !store_integer(pool, fmpq_denref(copy), fmpq_denref(x)) ||
        qdot_vec_push(&pool->numbers, copy) != QDOT_OK)
        return qdot_pool_fail(pool);
    return append_node(pool, &node);
}

/* --- symbols as nodes ----------------------------------------------------------------- */

qdot_expr
qdot_pool_find_symbol(const qdot_pool *pool, const qdot_symbol *wanted, uint32_t *hash)
{
    uint32_t h = mix_into_hash(mix_into_hash(mix_into_hash(QDOT_SYM, wanted->class), wanted->base), wanted->order);

    if (wanted->base == QDOT_NIL)
        for (const char *c = wanted->name; *c != '\0'; c++)
            h = mix_into_hash(h, (unsigned char)*c);
    *hash = h;
    for (uint32_t i = h & pool->mask; pool->table[i] != 0; i = (i + 1) & pool->mask) {
        qdot_expr e = pool->table[i];
        const qdot_symbol *s = NODE(pool, e)->hash == h ? qdot_expr_symbol(pool, e) : NULL;

        if (s != NULL && s->class == wanted->class && s->base == wanted->base &&
            s->order == wanted->order && !s->hidden &&
            (wanted->base != QDOT_NIL || strcmp(s->name, wanted->name) == 0))
            return e;
    }
    return QDOT_NIL;
}

qdot_expr
qdot_pool_make_symbol(qdot_pool *pool, const qdot_symbol *wanted)
{
    qdot_node node = {.kind = QDOT_SYM, .sign = wanted->sign};
    qdot_symbol copy = *wanted;
    qdot_scope *scope;
    qdot_expr e;

    if (!may_continue_work(pool, 0))
        return QDOT_NIL;
    e = qdot_pool_find_symbol(pool, wanted, &node.hash);
    if (e != QDOT_NIL)
        return e;
    scope = qdot_scope_pause();
    copy.name = qdot_arena_strndup(pool->arena, wanted->name, strlen(wanted->name));
    qdot_scope_resume(scope);
    if (copy.name == NULL)
        return qdot_pool_fail(pool);
    if (wanted->base == QDOT_NIL)
        copy.rank = (uint32_t)pool->symbols.n;
    node.at = (uint32_t)pool->symbols.n;
    node.touches = 1u << node.at % 31;
    node.holds = wanted->class == QDOT_CONST   ? 0
                 : wanted->class != QDOT_COORD ? 1u << wanted->class
                 : wanted->order == 0          ? QDOT_HAS_COORD
                 : wanted->order == 1          ? QDOT_HAS_VELOCITY
                                               : QDOT_HAS_ACCELERATION;
    if (qdot_vec_push(&pool->symbols, copy) != QDOT_OK)
        return qdot_pool_fail(pool);
    return append_node(pool, &node);
}

/* --- creating and freeing a pool ------------------------------------------------------- */

qdot_pool *
qdot_pool_new(void)
{
    qdot_pool *pool = qdot_calloc(1, sizeof *pool);
    bool good;

    if (pool == NULL)
        return NULL;
    pool->budget = UINT64_MAX;
    pool->mask = 1023;
    pool->table = qdot_calloc(pool->mask + 1, sizeof *pool->table);
    pool->arena = qdot_arena_new();
    pool->printed = qdot_printed_new();
    if (pool->table == NULL || pool->arena == NULL || pool->printed == NULL ||
        qdot_vec_push(&pool->nodes, ((qdot_node){0})) != QDOT_OK ||
        qdot_grow(&pool->args.at, &pool->args.capacity, 64, sizeof *pool->args.at)) {
        qdot_pool_free(pool);
        return NULL;
    }
    good = qdot_expr_ratio(pool, 0, 1) == QDOT_ZERO &&
           qdot_expr_ratio(pool, 1, 1) == QDOT_ONE &&
           qdot_expr_ratio(pool, -1, 1) == QDOT_MINUS_ONE &&
           qdot_expr_ratio(pool, 1, 2) == QDOT_HALF &&
           qdot_pool_make_symbol(pool,
                               &(qdot_symbol){.class = QDOT_CONST, .name = "pi", .sign = QDOT_POS}) ==
               QDOT_PI &&
           qdot_symbol_get(pool, QDOT_CONST, "true") == QDOT_TRUE &&
           qdot_symbol_get(pool, QDOT_CONST, "false") == QDOT_FALSE &&
           qdot_symbol_get(pool, QDOT_TIME, "t") == QDOT_T &&
           qdot_pool_make_symbol(pool, &(qdot_symbol){.class = QDOT_INFINITE,
                                                    .name = "infinity",
                                                    .sign = QDOT_POS}) == QDOT_INFINITY;
    if (!good) {
        qdot_pool_free(pool);
        return NULL;
    }
    return pool;
}

void
qdot_pool_free(qdot_pool *pool)
{
    if (pool == NULL)
        return;
    qdot_free(pool->numbers.at);
    qdot_free(pool->nodes.at);
    qdot_free(pool->args.at);
    qdot_free(pool->symbols.at);
    qdot_free(pool->ufuns.at);
    qdot_free(pool->variables.at);
    qdot_free(pool->factors.at);
    qdot_free(pool->table);
    qdot_arena_free(pool->arena);
    qdot_printed_free(pool->printed);
    qdot_free(pool->memo);
    qdot_free(pool);
}

size_t
qdot_pool_count(const qdot_pool *pool)
{
    return pool->nodes.n;
}

size_t
qdot_pool_bytes(const qdot_pool *pool)
{
    return pool->nodes.capacity * sizeof *pool->nodes.at +
           pool->args.capacity * sizeof *pool->args.at +
           pool->numbers.capacity * sizeof *pool->numbers.at + pool->numbers.n * sizeof **pool->numbers.at +
           pool->symbols.capacity * sizeof *pool->symbols.at +
           (pool->mask + 1) * sizeof *pool->table;
}

/* --- reading nodes --------------------------------------------------------------------- */

const qdot_node *
qdot_expr_node(const qdot_pool *pool, qdot_expr e)
{
    return NODE(pool, e);
}

uint8_t
qdot_expr_sign(const qdot_pool *pool, qdot_expr e)
{
    return e == QDOT_NIL ? 0 : qdot_expr_node(pool, e)->sign;
}

const qdot_expr *
qdot_expr_args(const qdot_pool *pool, qdot_expr e)
{
    return ARGS(pool, e);
}

qdot_kind
qdot_expr_kind(const qdot_pool *pool, qdot_expr e)
{
    return NODE(pool, e)->kind;
}

qdot_expr
qdot_expr_arg(const qdot_pool *pool, qdot_expr e, uint32_t i)
{
    return ARGS(pool, e)[i];
}

uint32_t
qdot_expr_count(const qdot_pool *pool, qdot_expr e)
{
    return NODE(pool, e)->n;
}

bool
qdot_expr_is_scalar(const qdot_pool *pool, qdot_expr e)
{
    return qdot_pool_is_scalar(pool, e);
}

const fmpq *
qdot_expr_rational(const qdot_pool *pool, qdot_expr e)
{
    return NUMBER(pool, e);
}

bool
qdot_expr_to_int(const qdot_pool *pool, qdot_expr e, int64_t *value)
{
    const fmpq *x = NUMBER(pool, e);

    if (x == NULL || !fmpz_is_one(fmpq_denref(x)))
        return false;
    if (COEFF_IS_MPZ(x->num) && !qdot_integer_fits(fmpq_numref(x)))
        return false;
    *value = COEFF_IS_MPZ(x->num) ? qdot_integer_get(fmpq_numref(x)) : x->num;
    return true;
}
