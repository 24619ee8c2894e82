/* machine.c -- the stack on which expressions are evaluated. */
#include "lang/language/machine.h"

#include <string.h>

#include "base/memory.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/value-kind.h"
#include "lang/session/member.h"
#include "mech/scene/scene.h"

qdot_status
qdot_machine_push(qdot_machine *m, qdot_expr value)
{
    qdot_slot s = {.value = qdot_higher_in_motion(m->session->scene, value)};

    QDOT_TRY(qdot_value_kind_check(m->pool, s.value));
    return qdot_vec_push(&m->stack, s);
}

/* Whether the value must be recorded in session->passed, as one that must be defined. */
static bool
must_be_recorded(const qdot_machine *m, qdot_expr value)
{
    const qdot_passed *p = m->session->evaluation->passed;

    return p != NULL && !p->spoiled && p->branches == 0 && value != QDOT_NIL &&
           qdot_expr_is_scalar(m->pool, value) && qdot_expr_kind(m->pool, value) != QDOT_NUM;
}

qdot_status
qdot_machine_pass(qdot_machine *m, qdot_expr value)
{
    return must_be_recorded(m, value) ? qdot_vec_push(&m->session->evaluation->passed->value, value) : QDOT_OK;
}

qdot_status
qdot_machine_pass_power(qdot_machine *m, qdot_expr base, qdot_expr exponent, qdot_expr value)
{
    if (!must_be_recorded(m, value) || !qdot_expr_is_scalar(m->pool, base))
        return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&m->session->evaluation->passed->value, value));
    QDOT_TRY(qdot_vec_push(&m->session->evaluation->passed->root, base));
    return qdot_vec_push(&m->session->evaluation->passed->root, exponent);
}

qdot_status
qdot_machine_pass_begin(qdot_machine *m)
{
    qdot_passed_frame *frame = qdot_calloc(1, sizeof *frame);

    if (frame == NULL)
        return QDOT_ENOMEM;
    frame->outer = m->session->evaluation->passed;
    frame->below = m->passed;
    m->passed = frame;
    m->session->evaluation->passed = &frame->passed;
    return QDOT_OK;
}

void
qdot_machine_pass_end(qdot_machine *m)
{
    qdot_passed_frame *frame = m->passed;

    m->session->evaluation->passed = frame->outer;
    m->passed = frame->below;
    if (frame->outer != NULL)
        frame->outer->spoiled = true; /* the inner call may use only parts of its arguments, so the outer list is not valid */
    qdot_free(frame->passed.value.at);
    qdot_free(frame->passed.root.at);
    qdot_free(frame);
}

/* Functions of numbers only: what else is called may take its arguments apart. The body of a
 * user's own function is read in its turn. */
void
qdot_machine_spoil(qdot_machine *m, const char *name)
{
    qdot_fun_id id;

    if (m->session->evaluation->passed != NULL && !qdot_fun_find(name, &id) && strcmp(name, "sqrt") != 0 &&
        qdot_names_find(m->session->names, name) == NULL)
        m->session->evaluation->passed->spoiled = true;
}

qdot_status
qdot_machine_along_two(const char *inner, const char *outer)
{
    qdot_fail(QDOT_EINVAL, "this is along the run %.100s and the run %.100s", inner, outer);
    return qdot_hint("runs are compared by what is along each, as in `%.40s.x - %.40s.x`",
                     outer, inner);
}

qdot_status
qdot_machine_along_condition(const char *run)
{
    qdot_fail(QDOT_EINVAL, "a condition is along no run as a whole");
    return qdot_hint("name the run at what moves, as in `if(%.60s.x > 0, ...)`", run);
}

qdot_status
qdot_machine_enter(qdot_machine *m, qdot_slot *s)
{
    if (s->run == NULL)
        return QDOT_OK;
    s->value = qdot_member_of(m->session, s->run, s->value);
    s->run = NULL;
    return qdot_value_kind_check(m->pool, s->value);
}

qdot_status
qdot_machine_take_any(qdot_machine *m, size_t n)
{
    QDOT_TRY(qdot_grow(&m->args.at, &m->args.capacity, n, sizeof *m->args.at));
    for (size_t i = 0; i < n; i++) {
        QDOT_TRY(qdot_machine_enter(m, qdot_machine_top(m, n - i)));
        m->args.at[i] = qdot_machine_top(m, n - i)->value;
    }
    m->args.n = n;
    m->stack.n -= n;
    return QDOT_OK;
}

qdot_status
qdot_machine_take(qdot_machine *m, size_t n)
{
    QDOT_TRY(qdot_machine_take_any(m, n));
    for (size_t i = 0; i < n; i++) {
        if (m->args.at[i] == QDOT_NIL ||
            !(qdot_expr_node(m->pool, m->args.at[i])->holds & QDOT_HAS_WORDS))
            continue;
        (void)qdot_fail(QDOT_ETYPE, "a text is not a number");
        return qdot_hint("latex(...) is used alone, after `print`, in a list, or under a name");
    }
    return QDOT_OK;
}

bool
qdot_machine_all_scalars(const qdot_machine *m)
{
    for (size_t i = 0; i < m->args.n; i++)
        if (!qdot_expr_is_scalar(m->pool, m->args.at[i]))
            return false;
    return true;
}
