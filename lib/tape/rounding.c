/* rounding.c -- estimates rounding errors of a tape; finds factors near 1 that make hidden errors visible. */
#include "tape/rounding.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/memory.h"
#include "num/samples.h"
#include "tape/instruction.h"
#include "tape/shake.h"

static const double unit = 0x1p-53;

/* --- rounding of one operation ------------------------------------------------------- */

enum { OPERANDS = 3 };

/* Values of an operation, of SINCOS two, and their slopes by its operands; and a product within it, which
 * is rounded before it is added. */
typedef struct {
    double value[2], slope[2][OPERANDS], product;
} results;

static bool
adds_product(uint32_t op)
{
    return op == QDOT_OP_MADD || op == QDOT_OP_MSUB || op == QDOT_OP_NMADD;
}

static void
find_values_and_derivatives(const qdot_instruction *i, const double *work, results *r)
{
    const double none = 0, a = work[i->x];
    double b = 0, c = 0, d = 0, e = 0;

    switch (i->op) {
#define X(ID, name, operands, operations, calls, statement, slopes, ...)                 \
    case QDOT_OP_##ID:                                                                   \
        if (operands > 1)                                                                \
            b = work[i->y];                                                              \
        if (operands > 2)                                                                \
            c = work[i->z];                                                              \
        statement;                                                                       \
        for (int k = 0; k < operands; k++) {                                             \
            const double da = k == 0, db = k == 1, dc = k == 2;                          \
            double dd, de = 0;                                                           \
            (void)a, (void)c, (void)da, (void)db, (void)dc, (void)none;                  \
            slopes;                                                                      \
            r->slope[0][k] = dd;                                                         \
            r->slope[1][k] = de;                                                         \
        }                                                                                \
        break;
#include "tape/operation.def"
#undef X
    default: break;
    }
    r->value[0] = d;
    r->value[1] = e;
    r->product = adds_product(i->op) ? a * b : i->op == QDOT_OP_MOD ? a - d : 0;
}

/* How many units an operation's own rounding may be; of functions that C libraries have to two units or
 * so, 2. */
static double
own_rounding_error(uint32_t op)
{
    switch (op) {
    case QDOT_OP_NEG:
    case QDOT_OP_ABS:
    case QDOT_OP_SIGN:
    case QDOT_OP_MIN:
    case QDOT_OP_MAX:
    case QDOT_OP_FLOOR:
    case QDOT_OP_LOOKUP:
    case QDOT_OP_LT:
    case QDOT_OP_LE:
    case QDOT_OP_EQ:
    case QDOT_OP_AND:
    case QDOT_OP_OR:
    case QDOT_OP_NOT:
    case QDOT_OP_SELECT: return 0;
    case QDOT_OP_SIN:
    case QDOT_OP_COS:
    case QDOT_OP_SINCOS:
    case QDOT_OP_EXP:
    case QDOT_OP_LOG:
    case QDOT_OP_POW: return 1;
    default: return qdot_operations[op].calls > 0 ? 2 : 1;
    }
}

static uint32_t
place_of_operand(const qdot_instruction *i, int operand)
{
    return operand == 0 ? i->x : operand == 1 ? i->y : i->z;
}

/* The product of a derivative and a change `by`; 0 if `by` is 0, even for an infinite derivative. */
static double
effect_of_change(double slope, double by)
{
    return by == 0 ? 0 : slope * by;
}

static bool
is_addition(uint32_t op)
{
    return op == QDOT_OP_ADD || op == QDOT_OP_SUB;
}

/* What a result loses, or the product within it, where it is below the least normal double. A sum of two doubles is
 * exact there, and a zero of an operand that is 0 is one. */
static double
loss_by_underflow(const qdot_instruction *i, const results *r, int result, const double *work)
{
    const double small = adds_product(i->op) ? r->product : r->value[result];
    const int factors = adds_product(i->op) ? 2 : qdot_operations[i->op].operands;

    if (!(fabs(small) < DBL_MIN) || is_addition(i->op) || own_rounding_error(i->op) == 0)
        return 0;
    for (int k = 0; k < factors; k++)
        if (work[place_of_operand(i, k)] == 0)
            return 0;
    return DBL_TRUE_MIN;
}

/* The error of a result that is rounded by so much of it and has lost so much, from those of the operands: the root of
 * the sum of squares, which might underflow. */
static double
error_of_result(const qdot_instruction *i, const results *r, int result, double rounding, double lost,
                const double *errors)
{
    enum { OWN, PRODUCT, LOST, FROM_OPERANDS };
    const int operands = qdot_operations[i->op].operands;
    double by[FROM_OPERANDS + OPERANDS] = {0}, most = 0, square = 0;

    by[OWN] = own_rounding_error(i->op) * rounding * r->value[result];
    by[PRODUCT] = rounding * r->product;
    by[LOST] = lost;
    for (int k = 0; k < operands; k++)
        by[FROM_OPERANDS + k] = effect_of_change(r->slope[result][k], errors[place_of_operand(i, k)]);
    for (int k = 0; k < FROM_OPERANDS + operands; k++) {
        if (isnan(by[k]))
            return by[k];
        most = fmax(most, fabs(by[k]));
    }
    if (most == 0 || isinf(most))
        return most;
    for (int k = 0; k < FROM_OPERANDS + operands; k++)
        square += by[k] / most * (by[k] / most);
    return most * sqrt(square);
}

static void
rounding_load(const qdot_tape *tape, const double *in, double *work)
{
    if (tape->inputs)
        memcpy(work, in, tape->inputs * sizeof *work);
    if (tape->constants)
        memcpy(work + tape->inputs, tape->constant, tape->constants * sizeof *work);
}

/* Evaluate all results of a tape, and their rounding errors, which are stored after the values in `work`. */
static void
evaluate_with_errors(const qdot_tape *tape, double rounding, double *work)
{
    double *errors = work + tape->places;
    results r = {0};

    for (const qdot_instruction *i = tape->code; i < tape->code + tape->length; i++) {
        double e[2];

        find_values_and_derivatives(i, work, &r);
        for (int k = 0; k < 2; k++)
            e[k] = error_of_result(i, &r, k, rounding, loss_by_underflow(i, &r, k, work), errors);
        work[i->to] = r.value[0];
        errors[i->to] = e[0];
        if (i->op == QDOT_OP_SINCOS) {
            work[i->y] = r.value[1];
            errors[i->y] = e[1];
        }
    }
}

void
qdot_rounding_bounds(const qdot_tape *tape, const double *in, const double *of_in, double *bounds,
                     double *work)
{
    double *errors = work + tape->places;

    rounding_load(tape, in, work);
    memset(errors, 0, tape->places * sizeof *errors);
    if (of_in)
        memcpy(errors, of_in, tape->inputs * sizeof *errors);
    for (size_t k = 0; k < tape->constants; k++)
        errors[tape->inputs + k] = fabs(tape->low[k]);
    evaluate_with_errors(tape, unit, work);
    for (size_t k = 0; k < tape->outputs; k++) {
        const double e = errors[tape->output[k]];

        bounds[k] = 2 * fmax(isfinite(e) ? e : 0, unit * fabs(work[tape->output[k]]));
    }
}

void
qdot_rounding_underflows(const qdot_tape *tape, const double *in, double *bounds, double *work)
{
    double *errors = work + tape->places;

    rounding_load(tape, in, work);
    memset(errors, 0, tape->places * sizeof *errors);
    evaluate_with_errors(tape, 0, work);
    for (size_t k = 0; k < tape->outputs; k++)
        bounds[k] = errors[tape->output[k]];
}

/* --- where rounding must be made visible --------------------------------------------- */

/* A result is one whose error is hidden if that is so many times what moving the inputs shows, and of its
 * size, and so many times what constants and factors show; an operand counts that makes so large a part
 * of it. */
static const double hidden = 8, hidden_still = 1.5, counts = 0.125;

/* States for tests: all inputs small, all large, then some of them small. SMALL, LARGE: powers of 2. */
enum { SMALL = -20, LARGE = 10, STATES = 8 };

/* What is shown: two directions in which the inputs are moved, and what constants and factors
 * make. */
enum { MOVED = 2, FACTORS = MOVED, SHOWN };

/* A factor differs from 1 by at most this many ulps. */
enum { FARTHEST = 64 };

typedef struct {
    const qdot_tape *tape;
    double *work, *errors, *shown[SHOWN]; /* [places] values; their errors; changes of results by perturbations */
    signed char *sides; /* [length x OPERANDS] the factor on an operand: 1 plus or minus so many ulps; 0: no factor */
    size_t count;
} marking;

/* Pseudo-random bits for input i in the k-th of several independent sequences. */
static uint32_t
pseudo_random_bits(size_t i, size_t k)
{
    uint32_t x = (uint32_t)(i + 1) * UINT32_C(2654435769) + (uint32_t)(k + 1) * UINT32_C(2246822519);

    x = (x ^ x >> 15) * UINT32_C(3266489917);
    return x ^ x >> 13;
}

static void
set_inputs_of_test_state(marking *m, size_t state)
{
    const size_t inputs = m->tape->inputs;
    double *in = m->work;

    memset(m->errors, 0, (1 + SHOWN) * m->tape->places * sizeof *m->errors);
    for (size_t i = 0; i < inputs; i++) {
        const uint32_t bits = pseudo_random_bits(i, 0);
        const bool small = state == 0 || (state > 1 && pseudo_random_bits(i, state) & 1);
        const double size = ldexp(1 + ldexp(bits >> 1, -31), small ? SMALL : state == 1 ? LARGE : 0);

        in[i] = bits & 1 ? size : -size;
        for (size_t k = 0; k < MOVED; k++)
            m->shown[k][i] = pseudo_random_bits(i, STATES + k) & 1 ? unit * in[i] : -unit * in[i];
    }
    for (size_t k = 0; k < m->tape->constants; k++) {
        const double value = in[inputs + k] = m->tape->constant[k];

        m->shown[FACTORS][inputs + k] = qdot_shake_double(value, m->tape->side[k]) - value;
    }
}

/* From here on operand x is off by a factor: by so many doubles above 1, or below it, where they lie
 * twice as near to each other. */
static void
apply_factor_to_operand(marking *m, uint32_t x, signed char side)
{
    m->shown[FACTORS][x] += (side > 0 ? 2 : 1) * side * unit * m->work[x];
    m->errors[x] = unit * fabs(m->work[x]);
}

/* Give factors to the operands of instruction `at` that make its error, all of which move the result
 * to one side. */
static void
choose_factors(marking *m, size_t at, const double *slope, double error, double shown)
{
    const qdot_instruction *i = m->tape->code + at;
    int up = (shown > 0) - (shown < 0);

    for (int k = 0; k < qdot_operations[i->op].operands; k++) {
        const uint32_t x = place_of_operand(i, k);
        const double units = m->errors[x] / (unit * fabs(m->work[x]));
        signed char *side = m->sides + OPERANDS * at + k;
        const int way = slope[k] * m->work[x] > 0 ? 1 : -1;

        if (m->errors[x] == 0 || fabs(effect_of_change(slope[k], m->errors[x])) < counts * error || !isfinite(units))
            continue;
        if (up == 0) /* round down, as the factor may be nearer to 1 */
            up = -way;
        m->count += *side == 0;
        if (*side ? *side > 0 : up == way)
            *side = (signed char)fmax(*side, fmin(FARTHEST, ceil(units / 2)));
        else
            *side = (signed char)fmin(*side, -fmin(FARTHEST, ceil(units)));
        apply_factor_to_operand(m, x, *side);
    }
}

/* Find how a result changes with the perturbations of its operands, by the instruction's derivatives. */
static void
find_change_of_result(const marking *m, const qdot_instruction *i, const double *slope, double *by)
{
    for (int k = 0; k < SHOWN; k++) {
        by[k] = 0;
        for (int o = 0; o < qdot_operations[i->op].operands; o++)
            by[k] += effect_of_change(slope[o], m->shown[k][place_of_operand(i, o)]);
    }
}

static bool
is_error_hidden(double error, double value, const double *by)
{
    double most = unit * fabs(value);

    for (int k = 0; k < MOVED; k++)
        most = fmax(most, fabs(by[k]));
    return isfinite(error) && error > fmax(hidden * most, hidden_still * fabs(by[FACTORS]));
}

/* Carry out instruction `at` with its factors near 1, and choose further factors if errors stay hidden. */
static void
carry_out_instruction(marking *m, size_t at)
{
    const qdot_instruction *i = m->tape->code + at;
    double error[2], by[2][SHOWN];
    results r = {0};

    for (int k = 0; k < OPERANDS; k++)
        if (m->sides[OPERANDS * at + k])
            apply_factor_to_operand(m, place_of_operand(i, k), m->sides[OPERANDS * at + k]);
    find_values_and_derivatives(i, m->work, &r);
    for (int k = 0; k < 2; k++) {
        const double *slope = r.slope[k];

        find_change_of_result(m, i, slope, by[k]);
        error[k] = error_of_result(i, &r, k, unit, 0, m->errors);
        if (is_error_hidden(error[k], r.value[k], by[k]))
            choose_factors(m, at, slope, error[k], by[k][FACTORS]);
    }
    for (int k = 0; k < 2; k++) {
        find_change_of_result(m, i, r.slope[k], by[k]);
        error[k] = error_of_result(i, &r, k, unit, 0, m->errors);
    }
    for (int k = 0; k < (i->op == QDOT_OP_SINCOS ? 2 : 1); k++) {
        const uint32_t to = k ? i->y : i->to;

        m->work[to] = r.value[k];
        m->errors[to] = isfinite(error[k]) ? error[k] : 0;
        for (int s = 0; s < SHOWN; s++)
            m->shown[s][to] = isfinite(by[k][s]) ? by[k][s] : 0;
    }
}

/* --- inserting factors near 1 -------------------------------------------------------- */

/* Allocate memory for `more` constants after those of the tape. */
static qdot_status
allocate_constants(qdot_tape *t, size_t more)
{
    const size_t n = t->constants + more;
    double *constant = qdot_realloc(t->constant, n * sizeof *constant), *low;
    signed char *side;
    qdot_expr *exact;

    if (constant)
        t->constant = constant;
    if ((side = qdot_realloc(t->side, n * sizeof *side)))
        t->side = side;
    if ((low = qdot_realloc(t->low, n * sizeof *low)))
        t->low = low;
    if ((exact = qdot_realloc(t->exact, n * sizeof *exact)))
        t->exact = exact;
    return constant && side && low && exact ? QDOT_OK : QDOT_ENOMEM;
}

/* The index of work-space place `place` after `more` constants have been inserted before it. */
static uint32_t
shifted_place(const qdot_tape *t, uint32_t place, size_t more)
{
    return place < t->inputs + t->constants ? place : place + (uint32_t)more;
}

/* Find the constant 1 + side ulps among the constants from `first` on; add it if it is missing. */
static uint32_t
find_or_add_factor(qdot_tape *t, size_t first, size_t *made, signed char side)
{
    size_t k = first;

    while (k < first + *made && t->side[k] != side)
        k++;
    if (k == first + *made) {
        t->constant[k] = 1;
        t->side[k] = side;
        t->low[k] = 0;
        t->exact[k] = QDOT_ONE;
        ++*made;
    }
    return (uint32_t)(t->inputs + k);
}

/* Insert the factors near 1 into the tape's code; their constants, at most `most`, follow the tape's own. */
static qdot_status
insert_factors(qdot_tape *t, const marking *m)
{
    const size_t constants = t->constants;
    size_t most = 0, made = 0;
    bool sides[2 * FARTHEST + 1] = {false};
    qdot_instruction *code = qdot_malloc((t->length + m->count) * sizeof *code), *to = code;

    for (size_t k = 0; k < OPERANDS * t->length; k++)
        if (m->sides[k] && !sides[m->sides[k] + FARTHEST]) {
            sides[m->sides[k] + FARTHEST] = true;
            most++;
        }
    if (!code || allocate_constants(t, most) != QDOT_OK) {
        qdot_free(code);
        return QDOT_ENOMEM;
    }
    for (size_t at = 0; at < t->length; at++) {
        qdot_instruction i = t->code[at];

        for (int k = 0; k < OPERANDS; k++) {
            const signed char side = m->sides[OPERANDS * at + k];
            const uint32_t x = shifted_place(t, place_of_operand(&i, k), most);

            if (side)
                *to++ = (qdot_instruction){.op = QDOT_OP_MUL, .to = x, .x = x,
                                           .y = find_or_add_factor(t, constants, &made, side)};
        }
        i.to = shifted_place(t, i.to, most);
        i.x = shifted_place(t, i.x, most);
        i.y = shifted_place(t, i.y, most);
        i.z = shifted_place(t, i.z, most);
        *to++ = i;
    }
    for (size_t k = 0; k < t->outputs; k++)
        t->output[k] = shifted_place(t, t->output[k], most);
    qdot_free(t->code);
    t->code = code;
    t->length += m->count;
    t->constants += most;
    t->places += most;
    return QDOT_OK;
}

qdot_status
qdot_rounding_show(qdot_tape *tape)
{
    double *room = qdot_malloc((2 + SHOWN) * (tape->places + 1) * sizeof *room);
    marking m = {.tape = tape, .work = room};
    qdot_status status;

    m.sides = qdot_calloc(OPERANDS * tape->length + 1, 1);
    status = room && m.sides ? QDOT_OK : QDOT_ENOMEM;
    if (status == QDOT_OK) {
        m.errors = room + tape->places;
        for (int k = 0; k < SHOWN; k++)
            m.shown[k] = m.errors + (size_t)(k + 1) * tape->places;
        for (size_t state = 0; state < STATES; state++) {
            set_inputs_of_test_state(&m, state);
            for (size_t at = 0; at < tape->length; at++)
                carry_out_instruction(&m, at);
        }
        if (m.count > 0)
            status = insert_factors(tape, &m);
    }
    qdot_free(room);
    qdot_free(m.sides);
    return status;
}
