/* prove.c -- puts in what is known of signs and domains, then repeats the proof of equal.c on
 * easier forms. */
#include "normal/prove/prove.h"

#include "normal/field/together.h"
#include "normal/prove/angle-basis.h"
#include "normal/prove/domain.h"
#include "normal/prove/equal.h"
#include "normal/prove/rewrite.h"
#include "normal/prove/unify.h"

#define ROUNDS 3 /* how often the proof is repeated after arguments of nested functions were unified */

/* Replace symbols so that conditions and bounds hold; conditions that cannot be eliminated follow
 * the relations. */
static qdot_status
insert_domains(qdot_problem *p, const qdot_facts *facts, bool implied, bool *empty)
{
    qdot_domain_rest rest;
    qdot_status status =
        qdot_domain_unfold(p->pool, facts, 2 + p->nr, p->e, p->nr, implied, &rest);
    const size_t n = rest.positive.n;
    qdot_expr *all = status == QDOT_OK
                         ? qdot_realloc(p->e, (2 + p->nr + n + 1) * sizeof *all)
                         : NULL;

    if (all != NULL) {
        p->e = all;
        p->np = n;
        p->conditional = n > 0;
        for (size_t i = 0; i < n; i++)
            p->e[2 + p->nr + i] = rest.positive.at[i];
    }
    qdot_free(rest.positive.at);
    *empty = rest.empty;
    return status != QDOT_OK ? status : all == NULL ? QDOT_ENOMEM : QDOT_OK;
}

static qdot_status
prove_harder(qdot_pool *pool, qdot_expr left, qdot_expr right, const qdot_facts *facts,
             bool implied, bool *equal, bool *empty)
{
    static const qdot_unify_way plainly = {.prove = qdot_prove_equal};
    bool changed = true, exponentials = false;
    qdot_problem p;
    qdot_status status;
    qdot_facts own;

    *equal = false;
    QDOT_TRY(qdot_problem_begin(&p, pool, left, right, facts));
    status = insert_domains(&p, facts, implied, empty);
    if (status == QDOT_OK && implied && *empty) {
        *equal = true;
        return qdot_problem_finish(&p, status);
    }
    for (size_t i = 0; i < qdot_problem_count(&p) && status == QDOT_OK; i++)
        exponentials |= qdot_rewrite_has_exp(pool, p.e[i]);
    for (size_t i = 0; i < qdot_problem_count(&p) && status == QDOT_OK; i++)
        p.e[i] = qdot_rewrite(pool, p.e[i], exponentials);
    if (status == QDOT_OK && !qdot_pool_failed(pool))
        status = qdot_problem_note_positive(&p);
    if (status == QDOT_OK)
        status = qdot_problem_prepare(&p);
    if (status == QDOT_OK)
        status = qdot_problem_in_field(&p, true, equal);
    for (int round = 0; round < ROUNDS && status == QDOT_OK && changed && !*equal;
         round++) {
        own = (qdot_facts){.n_relations = p.nr, .relations = p.e + 2};
        status = qdot_unify(pool, qdot_problem_count(&p), p.e, &own, &plainly, &changed);
        if (status == QDOT_OK && changed)
            status = qdot_problem_prepare(&p);
        if (status == QDOT_OK && changed)
            status = qdot_problem_in_field(&p, true, equal);
    }
    if (status == QDOT_OK && !*equal && !qdot_pool_failed(pool))
        status = qdot_together(pool, qdot_problem_count(&p), p.e, &changed);
    if (status == QDOT_OK && !*equal && changed && !qdot_pool_failed(pool)) {
        status = qdot_problem_prepare(&p);
        if (status == QDOT_OK)
            status = qdot_problem_in_field(&p, true, equal);
    }
    if (status == QDOT_OK && !*equal && !qdot_pool_failed(pool)) {
        own = (qdot_facts){.n_relations = p.nr, .relations = p.e + 2};
        status = qdot_angle_basis(pool, qdot_problem_count(&p), p.e, &own, &changed);
        if (status == QDOT_OK && changed)
            status = qdot_problem_prepare(&p);
        if (status == QDOT_OK && changed)
            status = qdot_problem_in_field(&p, true, equal);
    }
    return qdot_problem_finish(&p, status);
}

qdot_status
qdot_prove_harder(qdot_pool *pool, qdot_expr left, qdot_expr right,
                  const qdot_facts *facts, bool *equal)
{
    bool empty;

    return prove_harder(pool, left, right, facts, false, equal, &empty);
}

qdot_status
qdot_prove_defined(qdot_pool *pool, qdot_expr left, qdot_expr right,
                   const qdot_facts *facts, bool *equal, bool *empty)
{
    bool none = false;
    qdot_status status = prove_harder(pool, left, right, facts, true, equal, &none);

    if (empty != NULL)
        *empty = none;
    else
        *equal &= !none; /* do not claim equality on an empty domain */
    return status;
}
