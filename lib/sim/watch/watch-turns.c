/* watch-turns.c -- the direction of a function f if another function g_i with the same zeros is
 * watched (qdot_watch_turns). */
#include "sim/watch/watch-parts.h"

#include <string.h>

struct qdot_watch_turn {
    qdot_tape *tape; /* the factor `turn` (repeated-zeros.h); NULL: the user's f rises and falls with g_i */
    double *in;      /* inputs of `tape`, followed by its work space */
    bool half;
};

void
qdot_watch_clear_turns(qdot_watch *w)
{
    for (size_t i = 0; i < w->m && w->turns; i++) {
        qdot_tape_free(w->turns[i].tape);
        qdot_free(w->turns[i].in);
    }
    qdot_free(w->turns);
    w->turns = NULL;
}

qdot_status
qdot_watch_turns(qdot_watch *w, size_t i, qdot_expr turn, bool half)
{
    const qdot_plan *p = w->plan;
    struct qdot_watch_turn *own;

    if (turn == QDOT_NIL)
        return QDOT_OK;
    if (!w->turns)
        w->turns = qdot_calloc(w->m + 1, sizeof *w->turns);
    if (!w->turns)
        return QDOT_ENOMEM;
    own = w->turns + i;
    own->half = half;
    QDOT_TRY(qdot_tape_new(p->pool, qdot_plan_inputs(p), p->inputs, 1, &turn, &own->tape));
    own->in = qdot_calloc(qdot_tape_inputs(own->tape) + qdot_tape_work(own->tape) + 1, sizeof *own->in);
    return own->in ? QDOT_OK : QDOT_ENOMEM;
}

/* The sign of the factor `turn` (direction of f relative to g_i) at the state in own->in. */
static int
sign_of_turn(const qdot_watch *w, double t, size_t i)
{
    struct qdot_watch_turn *own = w->turns + i;
    double out;

    own->in[2 * w->n] = t;
    qdot_tape_eval(own->tape, own->in, &out, own->in + qdot_tape_inputs(own->tape));
    return qdot_watch_sign(out);
}

bool
qdot_watch_is_turned(qdot_watch *w, double t, const double *y, size_t i)
{
    if (!w->turns || !w->turns[i].tape || w->turns[i].half)
        return false;
    memcpy(w->turns[i].in, y, 2 * w->n * sizeof *y);
    return sign_of_turn(w, t, i) < 0;
}

qdot_status
qdot_watch_push(qdot_watch *w, qdot_root root)
{
    const struct qdot_watch_turn *own = w->turns ? w->turns + root.function : NULL;
    bool hidden;

    if (own && own->tape) {
        bool other;

        QDOT_TRY(w->reader.read(root.t, own->in, w->reader.user));
        other = sign_of_turn(w, root.t, root.function) < 0;
        root.turned = other && !own->half;
        root.pole = root.pole || (other && own->half);
    }
    QDOT_TRY(qdot_watch_is_hidden(w, root.function, &hidden));
    return hidden ? QDOT_OK : qdot_vec_push(&w->roots, root);
}
