/* parameter-states.c -- finds parameters that events set, adds them to a request, and checks
 * their values against the declarations. */
#include "sim/model/parameter-states.h"

#include <math.h>
#include <string.h>

#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/walk.h"

/* --- parameters as coordinates of the request ----------------------------------------- */

typedef qdot_vec(qdot_expr) expressions;

/* List, without repetition, the parameters that the scene's events set. */
static qdot_status
list_parameters_set(const qdot_scene *scene, expressions *found)
{
    for (size_t i = 0; i < scene->events.n; i++)
        for (size_t k = 0; k < scene->events.at[i].targets.n; k++) {
            const qdot_expr target = scene->events.at[i].targets.at[k];
            bool known = !qdot_expr_is_class(scene->pool, target, QDOT_PARAM);

            for (size_t j = 0; j < found->n; j++)
                known = known || found->at[j] == target;
            if (!known)
                QDOT_TRY(qdot_vec_push(found, target));
        }
    return QDOT_OK;
}

/* Find the value of a parameter in the request; an error if it has none. */
static qdot_status
find_parameter_value(const qdot_scene *scene, const qdot_run_request *r, qdot_expr parameter,
                     qdot_expr *value)
{
    for (size_t i = 0; i < r->n_values; i++)
        if (r->symbols[i] == parameter) {
            *value = r->values[i];
            return QDOT_OK;
        }
    return qdot_constant_unset(scene->pool, parameter);
}

/* Fill the arrays of s, one after another in its memory; open: the parameters have no values yet. */
static qdot_status
fill_states(qdot_parameter_states *s, const qdot_scene *scene, const qdot_run_request *asked,
            const expressions *found, bool open)
{
    const size_t n = scene->coordinates.n, m = found->n, v = asked->n_values;
    qdot_pool *pool = scene->pool;
    qdot_expr *states, *symbols, *values, *q0, *v0;

    s->expressions = qdot_calloc(m + 2 * (v + m) + 2 * (n + m), sizeof *s->expressions);
    s->named = qdot_calloc(2 * (n + m), sizeof *s->named);
    if (!s->expressions || !s->named)
        return QDOT_ENOMEM;
    states = s->expressions;
    symbols = states + m;
    values = symbols + v + m;
    q0 = values + v + m;
    v0 = q0 + n + m;
    for (size_t k = 0; k < m; k++) {
        if (!open)
            QDOT_TRY(find_parameter_value(scene, asked, found->at[k], &q0[n + k]));
        v0[n + k] = QDOT_ZERO;
        states[k] = qdot_symbol_get(pool, QDOT_COORD,
                                    qdot_expr_symbol(pool, found->at[k])->name);
        QDOT_TRY(qdot_pool_check(pool));
        symbols[v + k] = found->at[k];
        values[v + k] = states[k];
    }
    for (size_t i = 0; i < v; i++) {
        symbols[i] = asked->symbols[i];
        values[i] = qdot_subs(pool, asked->values[i], (uint32_t)m, found->at, states);
        for (size_t k = 0; k < m; k++)
            if (symbols[i] == found->at[k])
                values[i] = states[k];
    }
    for (size_t i = 0; i < n; i++) {
        q0[i] = asked->q0 ? asked->q0[i] : QDOT_ZERO;
        v0[i] = asked->v0 ? asked->v0[i] : QDOT_ZERO;
    }
    for (size_t i = 0; i < n + m; i++) {
        s->named[i] = i >= n || !asked->q_named || asked->q_named[i];
        s->named[n + m + i] = i >= n || !asked->v_named || asked->v_named[i];
    }
    s->request.n_states = m;
    s->request.n_values = v + (open ? m : 0);
    s->request.states = states;
    s->request.symbols = symbols;
    s->request.values = values;
    s->request.q0 = asked->q0 ? q0 : NULL;
    s->request.v0 = asked->v0 ? v0 : NULL;
    s->request.q_named = asked->q_named ? s->named : NULL;
    s->request.v_named = asked->v_named ? s->named + n + m : NULL;
    return qdot_pool_check(pool);
}

qdot_status
qdot_parameter_states_init(qdot_parameter_states *s, const qdot_scene *scene,
                           const qdot_run_request *asked)
{
    expressions found = {0};
    qdot_status status = QDOT_OK;

    *s = (qdot_parameter_states){.request = *asked};
    if (asked->n_states > 0)
        return QDOT_OK;
    status = list_parameters_set(scene, &found);
    if (status == QDOT_OK && found.n > 0)
        status = fill_states(s, scene, asked, &found, false);
    qdot_free(found.at);
    if (status != QDOT_OK)
        qdot_parameter_states_clear(s);
    return status;
}

qdot_status
qdot_parameter_states_open(qdot_parameter_states *s, const qdot_scene *scene,
                           const qdot_run_request *asked, size_t n, const qdot_expr *parameters)
{
    expressions found = {0};
    qdot_status status = QDOT_OK;

    *s = (qdot_parameter_states){.request = *asked};
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        status = qdot_vec_push(&found, parameters[i]);
    if (status == QDOT_OK && n > 0)
        status = fill_states(s, scene, asked, &found, true);
    qdot_free(found.at);
    if (status != QDOT_OK)
        qdot_parameter_states_clear(s);
    return status;
}

void
qdot_parameter_states_clear(qdot_parameter_states *s)
{
    qdot_free(s->expressions);
    qdot_free(s->named);
    *s = (qdot_parameter_states){0};
}

size_t
qdot_parameter_states_coordinates(const qdot_scene *scene, const qdot_run_request *request)
{
    return scene->coordinates.n + request->n_states;
}

qdot_expr
qdot_parameter_states_coordinate(const qdot_scene *scene, const qdot_run_request *request,
                                 size_t i)
{
    const size_t n = scene->coordinates.n;

    return i < n ? scene->coordinates.at[i] : request->states[i - n];
}

qdot_status
qdot_parameter_states_occur(const qdot_plan *p, qdot_expr e, bool *some, bool *moves)
{
    const uint32_t motion = QDOT_HAS_TIME | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION |
                            QDOT_HAS_MULTIPLIER;
    const size_t n = p->n - p->n_states;
    qdot_expr atoms;

    *some = false;
    *moves = (qdot_expr_node(p->pool, e)->holds & motion) != 0;
    if (!(qdot_expr_node(p->pool, e)->holds & QDOT_HAS_COORD))
        return QDOT_OK;
    atoms = qdot_expr_atoms(p->pool, e, false);
    QDOT_TRY(qdot_pool_check(p->pool));
    for (uint32_t k = 0; k < qdot_expr_count(p->pool, atoms); k++)
        for (size_t i = 0; i < p->n; i++)
            if (qdot_expr_arg(p->pool, atoms, k) == p->inputs[i]) {
                *some = *some || i >= n;
                *moves = *moves || i < n;
            }
    return QDOT_OK;
}

/* --- declared conditions on parameters -------------------------------------------------- */

void
qdot_parameter_conditions_clear(qdot_parameter_conditions *c)
{
    for (size_t i = 0; i < c->n; i++)
        qdot_free(c->at[i].text);
    qdot_free(c->at);
    qdot_tape_free(c->sides);
    *c = (qdot_parameter_conditions){0};
}

typedef struct {
    const qdot_plan *plan;
    qdot_parameter_conditions *c;
    size_t capacity;
    expressions sides;
} builder;

/* The sign of a relation, "<" or ">=", in the direction in which it was typed. */
static const char *
sign_of_relation(int op, bool turned)
{
    static const char *const signs[2][2] = {{"<=", "<"}, {">=", ">"}};

    return op == QDOT_EQ ? "=" : signs[turned][op == QDOT_LT];
}

/* Add the condition `left OP right` if an event may violate it. */
static qdot_status
add_condition_if_breakable(builder *b, qdot_expr left, qdot_expr right, qdot_parameter_condition condition)
{
    qdot_pool *pool = b->plan->pool;
    const qdot_expr said[] = {left, right};
    qdot_expr side[2];
    qdot_text text = {0};
    bool some = false, moves = false, known = true;
    qdot_status status = QDOT_OK;

    for (int k = 0; k < 2; k++) {
        bool here, moving;

        side[k] = qdot_plan_substitute(b->plan, said[k]);
        QDOT_TRY(qdot_pool_check(pool));
        QDOT_TRY(qdot_parameter_states_occur(b->plan, side[k], &here, &moving));
        some = some || here;
        moves = moves || moving;
        known = known && !(qdot_expr_node(pool, side[k])->holds &
                           (QDOT_HAS_PARAM | QDOT_HAS_UFUN | QDOT_HAS_MOMENTUM));
    }
    if (!some || moves || !known)
        return QDOT_OK;
    for (int k = 0; k < 2 && status == QDOT_OK; k++) {
        if (k)
            qdot_text_format(&text, " %s ", sign_of_relation(condition.op, condition.turned));
        status = qdot_print(pool, said[k ^ condition.turned], QDOT_PLAIN, &text);
    }
    if (status == QDOT_OK)
        status = qdot_text_status(&text);
    if (status == QDOT_OK)
        status = qdot_grow(&b->c->at, &b->capacity, b->c->n + 1, sizeof *b->c->at);
    for (int k = 0; k < 2 && status == QDOT_OK; k++)
        status = qdot_vec_push(&b->sides, side[k]);
    if (status == QDOT_OK) {
        condition.text = qdot_strdup(qdot_text_str(&text));
        b->c->at[b->c->n++] = condition;
        status = condition.text ? QDOT_OK : QDOT_ENOMEM;
    }
    qdot_text_clear(&text);
    return status;
}

static qdot_status
add_all_conditions(builder *b, const qdot_scene *scene)
{
    qdot_pool *pool = scene->pool;

    for (size_t i = 0; i < b->plan->n_values; i++) {
        const qdot_expr x = b->plan->symbols[i];
        qdot_symbol s;

        if (!qdot_expr_is_class(pool, x, QDOT_PARAM))
            continue;
        s = *qdot_expr_symbol(pool, x);
        if (s.lo != QDOT_NIL)
            QDOT_TRY(add_condition_if_breakable(b, s.lo, x,
                                                (qdot_parameter_condition){.op = s.lo_open ? QDOT_LT : QDOT_LE,
                                                    .turned = true,
                                                    .why = "declared"}));
        if (s.hi != QDOT_NIL)
            QDOT_TRY(add_condition_if_breakable(b, x, s.hi,
                                                (qdot_parameter_condition){.op = s.hi_open ? QDOT_LT : QDOT_LE,
                                                    .why = "declared"}));
    }
    for (size_t i = 0; i < scene->assumed.n; i++) {
        const qdot_assumption *said = &scene->assumed.at[i];
        const int op = qdot_expr_node(pool, said->relation)->op;

        if (op == QDOT_EQ || op == QDOT_LT || op == QDOT_LE)
            QDOT_TRY(add_condition_if_breakable(b, qdot_expr_arg(pool, said->relation, 0),
                                                qdot_expr_arg(pool, said->relation, 1),
                                                (qdot_parameter_condition){
                             .op = op, .turned = said->turned, .why = "assumed"}));
    }
    for (size_t i = 0; i < scene->springs.n; i++)
        QDOT_TRY(add_condition_if_breakable(b, QDOT_ZERO, scene->springs.at[i].rest,
                                            (qdot_parameter_condition){
                         .op = QDOT_LE, .turned = true, .why = "what a spring's rest length is"}));
    return QDOT_OK;
}

qdot_status
qdot_parameter_conditions_find(const qdot_plan *plan, const qdot_scene *scene,
                               qdot_parameter_conditions *c)
{
    builder b = {.plan = plan, .c = c};
    qdot_status status = plan->n_states > 0 ? add_all_conditions(&b, scene) : QDOT_OK;

    if (status == QDOT_OK && b.sides.n > 0)
        status = qdot_tape_new(plan->pool, 2 * plan->n + 1, plan->inputs, b.sides.n,
                               b.sides.at, &c->sides);
    qdot_free(b.sides.at);
    return status;
}

/* The relative difference by which rounding may violate an equality. */
static const double equal = 1e-12;

static bool
relation_holds(int op, double left, double right)
{
    if (op == QDOT_EQ)
        return fabs(left - right) <= equal * fmax(1, fmax(fabs(left), fabs(right)));
    return op == QDOT_LT ? left < right : left <= right;
}

qdot_status
qdot_parameter_conditions_check(const qdot_parameter_conditions *c, const char *event, double t,
                                const double *y, size_t n)
{
    double *in, *side;
    qdot_status status = QDOT_OK;

    if (!c->sides)
        return QDOT_OK;
    in = qdot_malloc((2 * n + 1 + 2 * c->n + qdot_tape_work(c->sides)) * sizeof *in);
    if (!in)
        return QDOT_ENOMEM;
    side = in + 2 * n + 1;
    memcpy(in, y, 2 * n * sizeof *in);
    in[2 * n] = t;
    qdot_tape_eval(c->sides, in, side, side + 2 * c->n);
    for (size_t i = 0; i < c->n && status == QDOT_OK; i++, side += 2) {
        const qdot_parameter_condition *x = &c->at[i];

        if (!relation_holds(x->op, side[0], side[1]))
            status = qdot_fail(QDOT_EDOMAIN,
                               "at the event %.100s, t = %.15g: %.150s is %s, and %.10g %s "
                               "%.10g does not hold",
                               event, t, x->text, x->why,
                               side[x->turned], sign_of_relation(x->op, x->turned), side[!x->turned]);
    }
    qdot_free(in);
    return status;
}
