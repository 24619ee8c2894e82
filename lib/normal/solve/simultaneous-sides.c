/* simultaneous-sides.c -- a branch for each side of a switch such as |u|, max or if(...), put into all equations. */
#include "expr/build.h"
#include "expr/list.h"
#include "expr/node.h"
#include "normal/solve/condition-forms.h"
#include "normal/solve/sides.h"
#include "normal/solve/simultaneous.h"

/* Continue a branch on one side of a switch: with further conditions, and the equation `jump` (nil: none). */
static qdot_status
continue_on_side(qdot_simultaneous *s, const qdot_simultaneous_branch *b, const qdot_sides *sides, size_t side,
                 qdot_expr relations, qdot_expr jump)
{
    qdot_pool *pool = s->pool;
    bool free = b->conditions == QDOT_NIL;
    qdot_simultaneous_branch next = {
        .equations = qdot_sides_put(sides, side, b->equations),
        .known = qdot_sides_put(sides, side, b->known),
        .conditions = free ? QDOT_NIL : qdot_sides_put(sides, side, b->conditions),
        .first = b->first == QDOT_NIL ? QDOT_NIL : qdot_sides_put(sides, side, b->first),
        .whole = qdot_sides_put(sides, side, b->whole == QDOT_NIL ? s->equations : b->whole)};
    qdot_status status = qdot_pool_check(pool);

    if (status != QDOT_OK) /* skip the side: an equation is not defined on it */
        return status == QDOT_EDOMAIN ? QDOT_OK : status;
    if (jump != QDOT_NIL)
        next.equations = qdot_list_appended(pool, next.equations, 1, &jump);
    next.conditions = qdot_conditions_all(pool, next.conditions, relations);
    next.conditions = qdot_conditions_at(pool, next.conditions, 0, NULL, NULL, &s->facts);
    QDOT_TRY(qdot_pool_check(pool));
    return next.conditions == QDOT_FALSE ? QDOT_OK : qdot_vec_push(&s->todo, next);
}

qdot_status
qdot_simultaneous_on_all_sides(qdot_simultaneous *s, const qdot_simultaneous_branch *b, qdot_expr choice)
{
    qdot_expr all = qdot_list_appended(s->pool, b->equations, 1, &b->known);
    qdot_sides sides = {0};
    qdot_status status;

    if (b->first != QDOT_NIL)
        all = qdot_list_appended(s->pool, all, 1, &b->first);
    if (b->conditions != QDOT_NIL)
        all = qdot_list_appended(s->pool, all, 1, &b->conditions);
    QDOT_TRY(qdot_pool_check(s->pool));
    status = qdot_sides_of(s->pool, all, choice, &sides);
    s->complete = s->complete && sides.n > 0;
    if (status == QDOT_OK && sides.jump != QDOT_NIL)
        status = continue_on_side(s, b, &sides, sides.n, QDOT_NIL, sides.jump);
    for (size_t i = sides.n; i-- > 0 && status == QDOT_OK;)
        status = continue_on_side(s, b, &sides, i, sides.relations[i], QDOT_NIL);
    qdot_sides_clear(&sides);
    return status;
}

qdot_expr
qdot_simultaneous_common_switch(const qdot_simultaneous *s, qdot_expr e, qdot_expr others)
{
    qdot_expr choice = QDOT_NIL;

    if (qdot_expr_count(s->pool, others) == 0 && qdot_simultaneous_unknowns_in(s, e) == 1)
        return QDOT_NIL;
    for (size_t i = 0; i < s->unknowns.n && choice == QDOT_NIL; i++)
        choice = qdot_sides_choice(s->pool, e, s->unknowns.at[i]);
    return choice;
}
