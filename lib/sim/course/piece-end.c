/* piece-end.c -- carries out what ends a piece: an event, a bound or a switch. */
#include "sim/course/piece.h"
#include "sim/model/contact.h"

#include <math.h>
#include <string.h>

/* In fractions of the time since the run began, however long it goes on: an event or switch accumulates if it
 * occurs more than MOST_REPEATS times within a MOMENT, or as often at intervals with the SAME_RATIO whose sum
 * ends NEAR. A motion that comes to rest at x is lost in rounding when it moves by less than an ulp of
 * x, which it does for an interval of 1e-8 of its time. */
enum { MOST_REPEATS = 4 };
#define MOMENT 1e-9
#define NEAR 1e-6
#define SAME_RATIO 1e-3

/* A run is also given up if its last LOOKED_AT pieces were so short that so many would follow: for
 * the time and memory that they would take. */
enum { LOOKED_AT = 20000 };
const double qdot_piece_most_to_come = 2e7;

void
qdot_piece_stop(qdot_piece *x, bool failed)
{
    x->c->failed = failed;
    x->c->tr.result.outcome = failed ? QDOT_ODE_FAILED : QDOT_ODE_STOPPED;
}

void
qdot_piece_stop_at(qdot_piece *x, size_t surface, int64_t side, const char *before,
                   const char *behind)
{
    qdot_text text = {0};

    if (qdot_stage_describe(x->c->stage, surface, side, &text) != QDOT_OK)
        qdot_text_truncate(&text, 0);
    snprintf(x->c->reason, sizeof x->c->reason, "stopped at t = %.15g: %s %.200s%s", x->start.t,
             before, text.n > 0 ? qdot_text_str(&text) : "a surface", behind);
    qdot_text_clear(&text);
    qdot_piece_stop(x, true);
}

static void
report_domain_left(qdot_piece *x, const qdot_watched *w)
{
    const qdot_domain *d = &x->c->stage->domains.at[w->index];

    snprintf(x->c->reason, sizeof x->c->reason,
             "%.100s left its domain %.200s at t = "
             "%.15g",
             qdot_piece_mode(x)->plan->names[d->coordinate], d->text, x->t_act);
}

/* `then` of an event in two doubles, from its inputs and what these leave out [n], into out and
 * rest [changes]. */
static qdot_status
evaluate_then_in_double_double(qdot_piece *x, const qdot_staged_event *e, const double *in, const double *low,
                               double *out, double *rest)
{
    const size_t at = (size_t)(e - x->c->stage->events.at);
    qdot_tape_two *two;

    if (!x->thens[at])
        QDOT_TRY(qdot_tape_two_new(e->then, 0, x->n + 1, &x->thens[at]));
    two = x->thens[at];
    for (size_t i = 0; i <= x->n; i++)
        *qdot_tape_two_input(two, i) = (qdot_two){in[i], i < x->n ? low[i] : x->start.t_low};
    qdot_tape_two_order(two, 0);
    for (size_t i = 0; i < e->changes; i++) {
        const qdot_two value = qdot_tape_two_output(two, i)[0];

        if (!isfinite(value.hi) || !isfinite(value.lo))
            continue;
        out[i] = value.hi;
        rest[i] = value.lo;
    }
    return QDOT_OK;
}

qdot_status
qdot_piece_change(qdot_piece *x, const qdot_staged_event *e, double t, const double *old,
                  const double *low, double *y, double *rest)
{
    const qdot_plan *p = qdot_piece_mode(x)->plan;
    const qdot_ode_system *system = &x->c->systems.at[x->mode];
    qdot_constrained *held = qdot_bind_held(system->user);
    size_t inputs = qdot_plan_inputs(p);
    double *in =
        qdot_calloc(inputs + 2 * e->changes + 1 + qdot_tape_work(e->then), sizeof *in);
    bool *set = qdot_calloc(2 * p->n, sizeof *set);
    double *out = in ? in + inputs : NULL;
    qdot_status status = in && set ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        memcpy(in, old, x->n * sizeof *in);
        in[x->n] = t;
        if (e->accelerations)
            status = qdot_bind_accelerations(system, t, old, in + x->n + 1);
    }
    if (status == QDOT_OK) {
        double *left = out + e->changes;

        qdot_tape_eval(e->then, in, out, left + e->changes + 1);
        if (low && rest && !e->accelerations)
            status = evaluate_then_in_double_double(x, e, in, low, out, left);
        for (size_t i = 0; i < e->changes; i++) {
            if (!isfinite(out[i]))
                status = qdot_fail(
                    QDOT_EDOMAIN, "the event %.100s gives %.100s no value at t = %.15g",
                    e->name,
                    e->targets[i] < p->n ? p->names[e->targets[i]] : "a velocity", t);
            y[e->targets[i]] = out[i];
            if (rest)
                rest[e->targets[i]] = left[i];
            set[e->targets[i]] = true;
        }
    }
    if (status == QDOT_OK)
        status = qdot_parameter_conditions_check(&x->c->stage->conditions, e->name, t, y, p->n);
    if (status == QDOT_OK && held)
        status = qdot_constrained_put(held, t, rest ? x->start.t_low : 0, y, rest,
                                      e->positions ? set : NULL,
                                      e->velocities ? set + p->n : NULL, e->name);
    qdot_free(in);
    qdot_free(set);
    return status;
}

qdot_piece_repeat *
qdot_piece_repeat_of(const qdot_piece *x, qdot_watched_kind kind, size_t index)
{
    for (size_t i = 0; i < x->repeats.n; i++)
        if (x->repeats.at[i].kind == kind && x->repeats.at[i].index == index)
            return &x->repeats.at[i];
    return NULL;
}

/* For intervals that shrink by a constant ratio, with the next end at t: the sum of all following
 * ones; infinite if they do not shrink so. */
static double
remaining_time_of_repeats(qdot_piece_repeat *r, double t)
{
    double interval = fabs(t - r->last), ratio = interval / r->interval;

    r->steady = ratio < 1 && fabs(ratio - r->ratio) <= SAME_RATIO * (1 - ratio)
                    ? r->steady + 1
                    : 0;
    r->last = t;
    r->interval = interval;
    r->ratio = ratio;
    return r->steady >= MOST_REPEATS ? interval * ratio / (1 - ratio) : INFINITY;
}

/* Whether occurrences accumulate: too many within a moment, or at intervals that shrink by a
 * constant ratio towards a near time. *left: the time until then. */
static qdot_status
is_accumulating(qdot_piece *x, const qdot_watched *w, double t, bool *yes, double *left)
{
    const double since = fabs(t - x->c->tr.t[0]), reach = since > 0 ? since : fabs(t);
    qdot_piece_repeat *r = qdot_piece_repeat_of(x, w->kind, w->index);

    *yes = false;
    *left = 0;
    if (!r) {
        qdot_piece_repeat new = {
            .kind = w->kind, .index = w->index, .n = 1, .since = t, .last = t, .at_once = 1};

        return qdot_vec_push(&x->repeats, new);
    }
    r->at_once = t == r->last ? r->at_once + 1 : 1;
    if (fabs(t - r->since) > MOMENT * reach) {
        r->since = t;
        r->n = 0;
    }
    *left = remaining_time_of_repeats(r, t);
    *yes = ++r->n > MOST_REPEATS || *left <= NEAR * reach || r->soon;
    *left = isfinite(*left) ? *left : 0;
    return QDOT_OK;
}

/* Whether the blows of event w all came at one instant; *look: it is time to try those that follow, at ever longer
 * intervals. */
static bool
is_repeated_at_one_instant(const qdot_piece *x, const qdot_watched *w, int way, bool *look)
{
    const qdot_piece_repeat *r = qdot_piece_repeat_of(x, w->kind, w->index);
    size_t n = r ? r->at_once : 0;

    if (w->kind != QDOT_WATCH_EVENT || n <= MOST_REPEATS
        || qdot_contacts_surface(&x->c->stage->switches, w->index, way) == SIZE_MAX)
        return false;
    for (n = n - 1; n % 2 == 0; n /= 2)
        ;
    *look = *look || n == 1;
    return true;
}

/* Whether the switch w comes ever faster only because bounces do, as the switch at the top of each bounce under drag: an
 * event whose contact may last was met since the last one. Then that event decides whether the motion comes to rest. */
static bool
is_between_contacts(const qdot_piece *x, const qdot_watched *w, double t)
{
    const qdot_piece_repeat *own =
        w->kind == QDOT_WATCH_SURFACE ? qdot_piece_repeat_of(x, w->kind, w->index) : NULL;

    for (size_t i = 0; i < x->repeats.n && own; i++) {
        const qdot_piece_repeat *r = &x->repeats.at[i];

        if (r->kind == QDOT_WATCH_EVENT && r->interval > 0 && fabs(t - r->last) <= own->interval
            && (qdot_contacts_surface(&x->c->stage->switches, r->index, 1) != SIZE_MAX
                || qdot_contacts_surface(&x->c->stage->switches, r->index, -1) != SIZE_MAX))
            return true;
    }
    return false;
}

/* Append a description of the event or switch that ended the piece to a message. */
static void
describe_end(const qdot_piece *x, const qdot_watched *w, qdot_text *to)
{
    if (w->kind == QDOT_WATCH_EVENT)
        qdot_text_format(to, "the event %.100s", x->c->stage->events.at[w->index].name);
    else if (qdot_stage_describe(x->c->stage, w->index, qdot_piece_mode(x)->side[w->index], to)
             != QDOT_OK)
        qdot_text_add(to, "a switch of the equations");
}

static void
report_accumulation(qdot_piece *x, const qdot_watched *w, double t, double left)
{
    qdot_text text = {0};

    describe_end(x, w, &text);
    if (w->kind == QDOT_WATCH_SURFACE && qdot_piece_is_of_the_past(x, w->index)) {
        snprintf(x->c->reason, sizeof x->c->reason, "stopped at t = %.15g: the motion cannot be followed at %.200s%s", t,
                 qdot_text_str(&text), QDOT_PIECE_PAST_SWITCHES);
        qdot_text_clear(&text);
        return;
    }
    snprintf(
        x->c->reason, sizeof x->c->reason,
        "stopped at t = %.15g: %.200s comes ever faster there, without end before t = "
        "%.10g",
        t, qdot_text_str(&text), t + copysign(left, x->direction));
    qdot_text_clear(&text);
}

/* Whether pieces as short as the last one would make too many of them; then c->reason says so. */
static bool
would_need_too_many_pieces(qdot_piece *x, const qdot_watched *w, double t)
{
    const qdot_trajectory *tr = &x->c->tr;
    double since, to_come;
    qdot_text text = {0};

    if (tr->pieces.n % LOOKED_AT != 0)
        return false;
    since = t - tr->t[tr->pieces.at[tr->pieces.n - LOOKED_AT].first];
    to_come = LOOKED_AT * ((x->t1 - t) / since);
    if (to_come <= qdot_piece_most_to_come) /* the comparison is false if time does not advance */
        return false;
    describe_end(x, w, &text);
    snprintf(x->c->reason, sizeof x->c->reason,
             "stopped at t = %.15g: %.200s came %d times within %.3g; %.1e more would follow until "
             "t = %.10g",
             t, qdot_text_str(&text), LOOKED_AT, fabs(since), to_come, x->t1);
    qdot_text_clear(&text);
    return true;
}

/* For a companion run: whether in the main run event w, just recorded, occurs again at the same instant. */
static bool
recurs_in_main_run(const qdot_piece *x, const qdot_watched *w)
{
    const qdot_course *run = x->c->leader;
    const size_t k = x->c->ends.n;

    for (size_t i = k; i < run->ends.n && run->ends.at[i].t == run->ends.at[k - 1].t; i++)
        if (run->ends.at[i].what.kind == w->kind && run->ends.at[i].what.index == w->index)
            return true;
    return false;
}

/* Of a companion: whether the motion of the run comes to rest on the event that ended this piece; *led: the run says
 * that, for it has a piece behind this one. What the bounces to come are left out for is the same in both then. */
static bool
rests_in_main_run(const qdot_piece *x, const qdot_watched *w, int way, bool *led)
{
    const qdot_course *run = x->c->leader;
    const size_t next = x->c->tr.pieces.n, surface = qdot_contacts_surface(&x->c->stage->switches, w->index, way);

    *led = run && w->kind == QDOT_WATCH_EVENT && surface != SIZE_MAX && next < run->tr.pieces.n
           && !recurs_in_main_run(x, w);
    return *led && x->c->stage->modes.at[run->tr.pieces.at[next].mode]->side[surface] == QDOT_SIDE_SLIDES;
}

/* The event w comes ever faster (*fast), or its next bounce is low: see whether its contact lasts from here on or will
 * soon. If either, *fast becomes false: the run goes on. */
static qdot_status
try_to_begin_contact(qdot_piece *x, const qdot_watched *w, int way, double left, bool *fast)
{
    qdot_piece_repeat *r = qdot_piece_repeat_of(x, w->kind, w->index);
    bool lasts, soon;

    QDOT_TRY(qdot_piece_rest(x, w->index, way, left, &lasts, &soon));
    if (r && *fast)
        r->soon = soon;
    if (r && lasts) /* forget its counter: bounces that follow later are counted anew */
        *r = x->repeats.at[--x->repeats.n];
    *fast = *fast && !lasts && !soon;
    return QDOT_OK;
}

/* Bodies that touched are pushed together from the start of the piece on: *lasts: their contact does. If it may not last
 * they meet there. */
static qdot_status
rest_together(qdot_piece *x, const qdot_root *root, size_t event, bool *lasts)
{
    bool soon;

    QDOT_TRY(qdot_piece_rest(x, event, qdot_root_way(root), 0, lasts, &soon));
    if (*lasts)
        return QDOT_OK;
    return qdot_vec_push(&x->c->occurrences,
                         ((qdot_occurrence){.event = event, .t = x->t_act, .way = (int)x->direction * root->way}));
}

bool
qdot_piece_has_crossed_flatly(const qdot_piece *x, size_t i)
{
    for (size_t k = 0; k < x->fired.n; k++)
        if (x->fired.at[k].function == i)
            return x->fired.at[k].cubic;
    return false;
}

void
qdot_piece_find_delay(qdot_piece *x)
{
    bool found = false;

    x->late = x->blur = 0;
    for (size_t i = 0; i < x->roots.n; i++) {
        const qdot_root *root = &x->roots.at[i];
        const double late = fabs(x->t_act - root->t) + root->late;

        x->late = found ? fmin(x->late, late) : late;
        x->blur = fmax(x->blur, root->blur);
        found = true;
    }
}

/* After an event that occurs at the start of a piece, |g| counts as 0 up to this many times |g| at
 * the start. */
static const double counted = 0x1p11;

/* Record the signs and values of all watched functions before an event changes the state. */
static qdot_status
record_functions_before(qdot_piece *x, double t, double *g)
{
    const qdot_mode *m = qdot_piece_mode(x);
    const int *first = qdot_watch_first(qdot_piece_watch(x));
    const qdot_trajectory *tr = &x->c->tr;
    const bool instant = tr->t[tr->pieces.at[tr->pieces.n - 1].first] == t;

    /* the effect of a rounding error of t: each position errs by its velocity times that */
    memcpy(x->y, x->largest, x->n * sizeof *x->y);
    for (size_t i = 0; i < x->n / 2; i++)
        x->y[i] = fmax(x->y[i], fabs(t) * x->largest[x->n / 2 + i]);
    QDOT_TRY(qdot_watch_look(qdot_piece_watch(x), t, x->start.y, x->y, x->signs, g, x->touching));
    for (size_t i = 0; i < m->m; i++) {
        x->untouched[i] = true;
        if (instant && x->turned[i]) /* this contact's rebound has just begun: its function is still 0 */
            continue;
        x->left[i] = first[i];
        x->turned[i] = false;
    }
    for (size_t i = 0; i < x->fired.n; i++) {
        qdot_root *root = &x->fired.at[i];

        x->untouched[root->function] = false;
        if (instant) /* the event was counted at the start of the piece: its zero there is no new occurrence */
            root->residual = fmax(root->residual, counted * fabs(g[root->function]));
    }
    return QDOT_OK;
}

/* If rounding of the places hides the function at a touch, all of its neighbourhood counts as 0, in units of that noise:
 * the crossing that seems to follow has been counted with the touch. */
static const double whole = 0x1p12;

static qdot_status
widen_touching_roots(qdot_piece *x, double t)
{
    for (size_t i = 0; i < x->fired.n; i++) {
        qdot_root *root = &x->fired.at[i];
        double noise;

        if (root->way != 0 || qdot_piece_mode(x)->watched[root->function].kind != QDOT_WATCH_EVENT)
            continue;
        QDOT_TRY(qdot_watch_noise_of(qdot_piece_watch(x), t, x->start.y, x->y, root->function, &noise));
        if (root->residual <= 4 * noise)
            root->residual = whole * noise;
    }
    return QDOT_OK;
}

/* Evaluate the watched functions just after the end of the piece, in the new state. */
static qdot_status
evaluate_functions_behind(qdot_piece *x, double t, double *g)
{
    const qdot_mode *m = qdot_piece_mode(x);
    double *now = g + m->m;
    int *signs = qdot_malloc(m->m * sizeof *signs);
    qdot_status status = signs ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_watch_look(qdot_piece_watch(x), t, x->start.y, NULL, signs, now, NULL);
    for (size_t i = 0; i < m->m && status == QDOT_OK; i++)
        x->untouched[i] = x->untouched[i] && now[i] == g[i];
    qdot_free(signs);
    return status;
}

/* The way that event i is met behind the change; 0 also where it is the only one and the motion has no rates there: the
 * run says so where it goes on. */
static qdot_status
direction_behind_event(qdot_piece *x, size_t i, bool alone, int *way)
{
    qdot_status status = qdot_piece_way(x, i, way);

    if (!alone || (status != QDOT_EDOMAIN && status != QDOT_ESINGULAR))
        return status;
    *way = 0;
    return QDOT_OK;
}

/* Carry out `then` of the event that root k is of, among others at the same instant. One whose crossing an event before
 * it has turned back does nothing if it would turn it about once more. An event that turns its own crossing back may
 * be met again, by what the others do. */
static qdot_status
apply_event(qdot_piece *x, size_t k, double *old)
{
    const qdot_root *root = &x->roots.at[k];
    const qdot_staged_event *e = &x->c->stage->events.at[qdot_piece_mode(x)->watched[root->function].index];
    const bool alone = x->roots.n == 1;
    double *y = x->start.y, *low = old + x->n;
    int before = 0, behind = 0;

    if (!alone && x->start.jumped)
        QDOT_TRY(qdot_piece_way(x, root->function, &before));
    memcpy(old, y, x->n * sizeof *y);
    qdot_piece_low(x, low);
    memcpy(x->start.low, low, x->n * sizeof *low);
    QDOT_TRY(qdot_piece_change(x, e, x->t_act, old, low, y, x->start.low));
    memcpy(x->start.low_of, y, x->n * sizeof *y);
    QDOT_TRY(direction_behind_event(x, root->function, alone, &behind));
    if (root->way != 0 && before == -root->way && behind == root->way) {
        memcpy(y, old, x->n * sizeof *y);
        memcpy(x->start.low_of, old, x->n * sizeof *y);
        memcpy(x->start.low, low, x->n * sizeof *low);
        behind = before;
    } else {
        for (size_t i = 0; i < k; i++)
            x->untouched[x->roots.at[i].function] = x->turned[x->roots.at[i].function];
    }
    x->turned[root->function] = root->way != 0 && behind != root->way;
    x->untouched[root->function] = false;
    if (x->turned[root->function])
        x->left[root->function] = -root->way;
    for (size_t i = 0; i < x->n; i++)
        x->largest[i] = fmax(x->largest[i], fabs(y[i]));
    x->start.jumped = true;
    return QDOT_OK;
}

/* Carry out the impacts that follow at this instant if they never end; c->reason: why that failed. */
static qdot_status
resolve_endless_impacts(qdot_piece *x)
{
    bool endless, known;

    QDOT_TRY(qdot_piece_try_blows(x, &endless, &known));
    if (endless) /* the endless sequence of events has been carried out */
        x->pushed.n = 0;
    if (!known)
        report_accumulation(x, &qdot_piece_mode(x)->watched[x->roots.at[0].function], x->t_act, 0);
    for (size_t i = x->repeats.n; i-- > 0 && endless;) /* similar impacts may follow later: reset the counters */
        if (x->repeats.at[i].kind == QDOT_WATCH_EVENT && x->repeats.at[i].last == x->t_act)
            x->repeats.at[i] = x->repeats.at[--x->repeats.n];
    return QDOT_OK;
}

qdot_status
qdot_piece_act(qdot_piece *x, bool *over)
{
    double *old = qdot_malloc(2 * x->n * sizeof *old);
    double *g = qdot_malloc(2 * qdot_piece_mode(x)->m * sizeof *g);
    qdot_status status = old && g ? QDOT_OK : QDOT_ENOMEM;
    const qdot_mode *m = qdot_piece_mode(x);
    const double t = x->t_act;
    bool at_once = false;

    x->fired.n = 0;
    x->crossed.n = x->pushed.n = 0;
    /* backwards in time: undo the events in opposite order */
    for (size_t i = 0; i < x->roots.n / 2 && x->c->stage->back; i++) {
        const qdot_root swapped = x->roots.at[i];

        x->roots.at[i] = x->roots.at[x->roots.n - 1 - i];
        x->roots.at[x->roots.n - 1 - i] = swapped;
    }
    for (size_t i = 0; i < x->roots.n && status == QDOT_OK; i++)
        status = qdot_vec_push(&x->fired, x->roots.at[i]);
    if (status == QDOT_OK)
        status = record_functions_before(x, t, g);
    if (status == QDOT_OK)
        status = widen_touching_roots(x, t);
    for (size_t i = 0; i < x->roots.n && status == QDOT_OK; i++) {
        const qdot_root *root = &x->roots.at[i];
        const qdot_watched *w = &m->watched[root->function];
        double left = 0;
        bool fast = false, low = false, led, rests, once, lasts = false;

        if (w->kind != QDOT_WATCH_EVENT || qdot_staged_event_acts(&x->c->stage->events.at[w->index]))
            status = qdot_vec_push(
                &x->c->ends,
                ((qdot_course_end){x->c->tr.pieces.n - 1, root->function, t, *w,
                                   root->blur}));
        if (status != QDOT_OK)
            break;
        if (w->kind == QDOT_WATCH_DOMAIN) {
            report_domain_left(x, w);
            *over = true;
            qdot_piece_stop(x, true);
            break;
        }
        if (w->kind == QDOT_WATCH_SURFACE && root->way == 0) /* u touches 0: side-search.c compares both sides */
            continue;
        if (w->kind == QDOT_WATCH_SURFACE) {
            x->side[w->index] = w->inside == 0 ? root->way : w->beyond;
            x->start.anew = x->start.anew || root->jump;
            if (w->inside != 0 && !root->jump)
                status = qdot_vec_push(&x->crossed, w->index);
        } else {
            const qdot_staged_event *e = &x->c->stage->events.at[w->index];

            if (root->rests)
                status = rest_together(x, root, w->index, &lasts);
            if (lasts)
                continue;
            if (e->undoing)
                status = qdot_piece_check_undone(x, root);
            if (x->c->reason[0] != '\0') {
                *over = true;
                qdot_piece_stop(x, true);
                break;
            }
            if (e->then && status == QDOT_OK)
                status = apply_event(x, i, old);
            if (e->stop && status == QDOT_OK) {
                x->c->stopped_by = w->index;
                *over = true;
                qdot_piece_stop(x, false);
            }
            if (!e->stop && !e->then)
                continue;
        }
        if (status == QDOT_OK)
            status = is_accumulating(x, w, t, &fast, &left);
        once = fast && is_repeated_at_one_instant(x, w, qdot_root_way(root), &at_once);
        fast = fast && !once;
        rests = rests_in_main_run(x, w, qdot_root_way(root), &led) && !once;
        led = led && !once;
        if (status == QDOT_OK && !led && !fast && !*over && w->kind == QDOT_WATCH_EVENT)
            status = qdot_piece_may_be_low(x, w->index, qdot_root_way(root), &low);
        if (status == QDOT_OK && (led ? rests : fast || low) && !*over && w->kind == QDOT_WATCH_EVENT)
            status = try_to_begin_contact(x, w, qdot_root_way(root), led ? 0 : low ? INFINITY : left, &fast);
        fast = fast && !led && !is_between_contacts(x, w, t);
        if (fast && !*over)
            report_accumulation(x, w, t, left);
        if (status == QDOT_OK && !*over && (fast || would_need_too_many_pieces(x, w, t))) {
            *over = true;
            qdot_piece_stop(x, true);
        }
    }
    if (x->start.jumped)
        x->crossed.n = 0;
    if (x->start.jumped && status == QDOT_OK)
        status = evaluate_functions_behind(x, t, g);
    if (x->start.jumped && status == QDOT_OK && !*over) {
        status = qdot_piece_keep_contacts(x);
        if (status == QDOT_OK && at_once && x->c->reason[0] == '\0')
            status = resolve_endless_impacts(x);
        *over = x->c->reason[0] != '\0';
        if (*over)
            qdot_piece_stop(x, true);
    }
    qdot_free(old);
    qdot_free(g);
    return status;
}
