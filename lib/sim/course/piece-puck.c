/* piece-puck.c -- where discs sliding on a rough plane come to rest, and how they start again. */
#include "sim/course/piece.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "num/lu.h"
#include "sim/model/puck.h"

/* A disc starts with the speed that it would have after this fraction of the time t, */
static const double behind = 64 * DBL_EPSILON;
/* Like `behind`, but as a fraction of the duration of the run; the longer of the two times counts. */
static const double little = 0x1p-60;
/* Two directions count as equal if the cosine of the angle between them exceeds this. */
static const double straight = 0.999;
/* If that speed is 0: the disc starts with its speed after this fraction of the run's duration. */
static const double least = 0x1p-85;

/* The acceleration of a disc near rest depends on its direction e: d' = P + K e, with K s = -P for
 * the shares s. */
typedef struct {
    size_t k;
    double P[QDOT_PUCK_MOST], K[QDOT_PUCK_MOST * QDOT_PUCK_MOST],
        G[QDOT_PUCK_MOST * QDOT_PUCK_MOST];
} response;

static qdot_puck *
puck_at(const qdot_piece *x, size_t i)
{
    return &x->c->stage->switches.pucks.at[i];
}

/* Change the velocity with index a of a disc by `by`, and the velocities tied to it in proportion. */
static void
puck_change_velocity(const qdot_puck *puck, size_t a, double by, double *velocities)
{
    velocities[puck->velocity[a]] += by;
    for (size_t j = 0; j < puck->n_tied; j++)
        velocities[puck->tied[j]] += puck->follow[j][a] * by;
}

/* The acceleration d' in the present mode at the state y [n], with component a of the disc's motion
 * changed by `by`. */
static qdot_status
accelerations_with_velocity_change(qdot_piece *x, size_t i, const double *rest, size_t a, double by,
                                   qdot_puck_state *s, double *out)
{
    const qdot_puck *puck = puck_at(x, i);
    const qdot_ode_system *system = x->c->systems.at + x->mode;
    const size_t n = x->n / 2;
    double *y = qdot_malloc(2 * x->n * sizeof *y), *rates = y + x->n;
    qdot_status status = y ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        memcpy(y, rest, x->n * sizeof *y);
        puck_change_velocity(puck, a, by, y + n);
        status = system->rhs(x->start.t, y, rates, system->user);
    }
    if (status == QDOT_OK)
        status = qdot_stage_puck(x->c->stage, i, x->start.t, rest, s);
    for (size_t c = 0; c < puck->k && status == QDOT_OK; c++) {
        out[c] = s->rate[c];
        for (size_t j = 0; j < n; j++)
            out[c] += s->slopes[c * n + j] * rates[n + j];
    }
    qdot_free(y);
    return status;
}

/* Find how the acceleration of disc i depends on the direction of a small velocity, and its state of rest, rest [x->n]. */
static qdot_status
find_response(qdot_piece *x, size_t i, double *rest, response *r)
{
    const qdot_puck *puck = puck_at(x, i);
    const size_t k = puck->k, n = x->n / 2;
    qdot_puck_state s = {.slopes = qdot_malloc(k * n * sizeof(double))};
    double plus[QDOT_PUCK_MOST], minus[QDOT_PUCK_MOST];
    qdot_status status = s.slopes
                             ? qdot_stage_puck(x->c->stage, i, x->start.t, x->start.y, &s)
                             : QDOT_ENOMEM;

    if (status == QDOT_OK)
        memcpy(rest, x->start.y, x->n * sizeof *rest);
    for (size_t c = 0; c < k && status == QDOT_OK; c++)
        puck_change_velocity(puck, c, -s.d[c], rest + n);
    r->k = k;
    memcpy(r->G, s.G, k * k * sizeof *r->G);
    for (size_t a = 0; a < k && status == QDOT_OK; a++) {
        const double size = sqrt(r->G[a * k + a]);

        status = accelerations_with_velocity_change(x, i, rest, a, puck->radius / size, &s, plus);
        if (status == QDOT_OK)
            status = accelerations_with_velocity_change(x, i, rest, a, -puck->radius / size, &s, minus);
        for (size_t c = 0; c < k && status == QDOT_OK; c++) {
            r->K[c * k + a] = (plus[c] - minus[c]) / 2 * size;
            if (a == 0)
                r->P[c] = (plus[c] + minus[c]) / 2;
        }
    }
    qdot_free(s.slopes);
    return status;
}

/* Whether friction brakes the disc in every direction e of motion (e G K e < 0), by Cholesky factorisation. */
static bool
friction_brakes_all_motion(const response *r)
{
    const size_t k = r->k;
    double A[QDOT_PUCK_MOST * QDOT_PUCK_MOST];

    for (size_t a = 0; a < k; a++)
        for (size_t b = 0; b < k; b++) {
            A[a * k + b] = 0;
            for (size_t c = 0; c < k; c++)
                A[a * k + b] -=
                    r->G[a * k + c] * r->K[c * k + b] + r->G[b * k + c] * r->K[c * k + a];
        }
    for (size_t a = 0; a < k; a++) {
        if (!(A[a * k + a] > 0))
            return false;
        for (size_t b = a + 1; b < k; b++)
            for (size_t c = b; c < k; c++)
                A[c * k + b] -= A[b * k + a] * A[c * k + a] / A[a * k + a];
    }
    return true;
}

/* Solve (a - K) e = P for the direction e at acceleration a; returns its length sqrt(e G e), infinite if there is none. */
static double
find_start_direction(const response *r, double a, double *e)
{
    const size_t k = r->k;
    double A[QDOT_PUCK_MOST * QDOT_PUCK_MOST], square = 0;
    qdot_lu_row rows[QDOT_PUCK_MOST];

    for (size_t i = 0; i < k * k; i++)
        A[i] = (i % (k + 1) == 0 ? a : 0) - r->K[i];
    memcpy(e, r->P, k * sizeof *e);
    if (!qdot_lu_factor(k, A, rows))
        return INFINITY;
    qdot_lu_solve(k, A, rows, e);
    for (size_t i = 0; i < k; i++)
        for (size_t j = 0; j < k; j++)
            square += e[i] * r->G[i * k + j] * e[j];
    return sqrt(square);
}

/* Find the acceleration a >= 0 with which the disc starts, and its direction e, normalised by e G e = 1. */
static double
find_start_acceleration(const response *r, double *e)
{
    double low = 0, high = DBL_MIN, length;

    for (size_t i = 0; i < r->k * r->k; i++)
        high = fmax(high, fabs(r->K[i]));
    while (isfinite(high) && find_start_direction(r, high, e) > 1)
        high *= 2;
    for (int i = 0; i < 200 && low < high; i++) {
        const double middle = low + (high - low) / 2;

        if (middle == low || middle == high)
            break;
        *(find_start_direction(r, middle, e) > 1 ? &low : &high) = middle;
    }
    length = find_start_direction(r, low, e);
    for (size_t i = 0; i < r->k; i++)
        e[i] /= length;
    return low;
}

/* Raise the uncertainty of the times at which the last piece of the run ended to at least `late`. */
static void
raise_delay(qdot_piece *x, double late)
{
    for (size_t k = x->c->ends.n;
         k-- > 0 && x->c->ends.at[k].piece + 1 == x->c->tr.pieces.n;)
        x->c->ends.at[k].late = fmax(x->c->ends.at[k].late, late);
}

/* Whether disc i already moves in the direction e relative to its state of rest, as after starting by creeping. */
static bool
moves_in_direction(const qdot_piece *x, const qdot_puck *puck, const double *rest, const double *e)
{
    double along = 0, d2 = 0, e2 = 0;

    for (size_t c = 0; c < puck->k; c++) {
        const size_t at = x->n / 2 + puck->velocity[c];
        const double d = x->start.y[at] - rest[at];

        along += d * e[c];
        d2 += d * d;
        e2 += e[c] * e[c];
    }
    return along > straight * sqrt(d2 * e2);
}

/* Start disc i from rest, in the direction of the force that exceeds static friction. */
static qdot_status
start_disc(qdot_piece *x, size_t i, double speed)
{
    const qdot_puck *puck = puck_at(x, i);
    const double duration = fabs(x->t1 - x->c->tr.t[0]);
    double *rest = qdot_malloc(x->n * sizeof *rest), e[QDOT_PUCK_MOST], a, from,
           friction = 0;
    response r;
    qdot_status status = rest ? find_response(x, i, rest, &r) : QDOT_ENOMEM;

    if (status == QDOT_OK) {
        a = find_start_acceleration(&r, e);
        for (size_t c = 0; c < r.k * r.k; c++)
            friction = fmax(friction, fabs(r.K[c]));
        from = fmax(a * fmax(behind * fabs(x->start.t), little * duration),
                    friction * least * duration);
        if (!(speed > from && moves_in_direction(x, puck, rest, e))) {
            memcpy(x->start.y, rest, x->n * sizeof *rest);
            for (size_t c = 0; c < puck->k; c++)
                puck_change_velocity(puck, c, from * e[c], x->start.y + x->n / 2);
            if (a > 0)
                raise_delay(x, (speed + from) / a);
        }
    }
    qdot_free(rest);
    return status;
}

/* Puck i, near rest, comes to rest in the mode `behind`: within the time u = |w|/(its deceleration). The
 * motion goes on as if it had: q' + u (q'' - q''_rest), q - u^2/2 (q'' - q''_rest). */
static qdot_status
stop_disc(qdot_piece *x, size_t i, const response *r, size_t behind)
{
    const size_t n = x->n / 2, k = r->k;
    double *rates = qdot_malloc(2 * x->n * sizeof *rates), *rest = rates + x->n;
    double slows = 0, accelerates[QDOT_PUCK_MOST];
    qdot_puck_state now = {0};
    qdot_status status = rates ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_stage_puck(x->c->stage, i, x->start.t, x->start.y, &now);
    if (status == QDOT_OK)
        status = qdot_piece_rates(x, behind, rest);
    if (status == QDOT_OK && now.speed > 0)
        status = qdot_piece_rates(x, x->mode, rates);
    for (size_t a = 0; a < k && now.speed > 0; a++) {
        accelerates[a] = r->P[a];
        for (size_t b = 0; b < k; b++)
            accelerates[a] += r->K[a * k + b] * now.d[b] / now.speed;
    }
    for (size_t a = 0; a < k && now.speed > 0; a++)
        for (size_t b = 0; b < k; b++)
            slows -= now.d[a] / now.speed * r->G[a * k + b] * accelerates[b];
    for (size_t j = 0; j < n && status == QDOT_OK && slows > 0; j++) {
        const double u = now.speed / slows, more = rates[n + j] - rest[n + j];

        x->start.y[j] -= u * u / 2 * more;
        x->start.y[n + j] += u * more;
    }
    if (status == QDOT_OK && slows > 0)
        status = qdot_vec_push(&x->c->rests,
                               ((qdot_course_rest){puck_at(x, i)->surface, x->start.t,
                                                   x->start.t + now.speed / slows}));
    qdot_free(rates);
    return status;
}

/* Whether static friction can hold disc i in the present mode, as friction decelerates it; if so, stop it. */
static qdot_status
stop_disc_if_held(qdot_piece *x, size_t i, bool *may)
{
    const size_t mode = x->mode, surface = puck_at(x, i)->surface;
    double *rest = qdot_malloc(x->n * sizeof *rest);
    response r;
    qdot_status status = rest ? QDOT_OK : QDOT_ENOMEM;
    const int64_t side = x->side[surface];

    x->side[surface] = 1;
    if (status == QDOT_OK)
        status = qdot_piece_enter(x);
    if (status == QDOT_OK)
        status = find_response(x, i, rest, &r);
    *may = status == QDOT_OK && friction_brakes_all_motion(&r);
    if (*may && side == QDOT_SIDE_SLIDES)
        status = stop_disc(x, i, &r, mode);
    x->side[surface] = side;
    x->mode = mode;
    qdot_free(rest);
    return qdot_grave(status);
}

qdot_status
qdot_piece_pucks(qdot_piece *x, bool *can)
{
    *can = true;
    for (size_t i = 0; i < x->c->stage->switches.pucks.n && *can; i++) {
        const qdot_puck *puck = puck_at(x, i);
        qdot_puck_state now = {0};

        if (x->side[puck->surface] != 1) {
            QDOT_TRY(stop_disc_if_held(x, i, can));
            continue;
        }
        QDOT_TRY(qdot_stage_puck(x->c->stage, i, x->start.t, x->start.y, &now));
        if (now.speed <= puck->radius)
            QDOT_TRY(start_disc(x, i, now.speed));
    }
    return QDOT_OK;
}

qdot_status
qdot_piece_stop_pucks(qdot_piece *x, bool anew)
{
    const qdot_mode *old = qdot_piece_mode(x);

    for (size_t i = 0; i < x->c->stage->switches.pucks.n; i++) {
        const qdot_puck *puck = puck_at(x, i);
        int64_t *side = &x->side[puck->surface];
        qdot_puck_state now = {0};

        if (puck->radius == 0 || x->direction < 0 ||
            (!anew && old->side[puck->surface] != QDOT_SIDE_CREEPS))
            continue;
        QDOT_TRY(qdot_stage_puck(x->c->stage, i, x->start.t, x->start.y, &now));
        if (now.speed <= puck->radius)
            *side = QDOT_SIDE_SLIDES;
        else if (*side == QDOT_SIDE_SLIDES || anew)
            *side = 1;
    }
    return QDOT_OK;
}
