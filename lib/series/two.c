/* two.c -- a series program in sums of two doubles. */
#include "series/two.h"

#include <stdint.h>

#include "num/kinds.h"
#include "series/program.h"

struct qdot_tape_two {
    qdot_program program;
    size_t stride;
    qdot_two *numbers; /* [rows x stride], the inputs first */
    double *note;      /* [rows] by how much the newest coefficient changes */
    const qdot_two_functions *functions;
    void (*order)(const qdot_tape_two *t, const qdot_program_step *i, int k);
};

static inline qdot_two *
place(const qdot_tape_two *t, qdot_program_row row)
{
    return t->numbers + (size_t)row * t->stride;
}

/* --- order 0 ------------------------------------------------------------------------ */

static inline qdot_two
truth(double x)
{
    return (qdot_two){x, 0};
}

static inline bool
is_less(qdot_two a, qdot_two b)
{
    return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}

static inline qdot_two
whole_part(qdot_two a)
{
    const double hi = floor(a.hi);

    return hi == a.hi ? qdot_two_of(hi, floor(a.lo)) : (qdot_two){hi, 0};
}

/* 1 - tanh^2 beside tanh. */
static qdot_two
hyperbolic_tangent(const qdot_two_functions *f, qdot_two a, qdot_two *slope)
{
    const qdot_two d = f->tanh(a);

    *slope = qdot_two_add_double(qdot_two_neg(qdot_two_mul(d, d)), 1);
    return d;
}

static void
value(const qdot_tape_two *t, const qdot_program_step *i)
{
    const qdot_two_functions *f = t->functions;
    const qdot_two a = place(t, i->x)[0], b = place(t, i->y)[0], c = place(t, i->z)[0];
    qdot_two d;

    switch (i->zero) {
    case QDOT_OP_NEG: d = qdot_two_neg(a); break;
    case QDOT_OP_ADD: d = qdot_two_add(a, b); break;
    case QDOT_OP_SUB: d = qdot_two_sub(a, b); break;
    case QDOT_OP_MUL: d = qdot_two_mul(a, b); break;
    case QDOT_OP_MADD: d = qdot_two_add(qdot_two_mul(a, b), c); break;
    case QDOT_OP_MSUB: d = qdot_two_sub(qdot_two_mul(a, b), c); break;
    case QDOT_OP_NMADD: d = qdot_two_sub(c, qdot_two_mul(a, b)); break;
    case QDOT_OP_DIV: d = qdot_two_div(a, b); break;
    case QDOT_OP_SQRT: d = qdot_two_sqrt(a); break;
    case QDOT_OP_POW: d = f->pow(a, b); break;
    case QDOT_ZERO_POWER: d = f->pow(b, c); break;
    case QDOT_OP_SINCOS: f->sincos(a, &d, place(t, i->second)); break;
    case QDOT_ZERO_SINHCOSH: f->sinhcosh(a, &d, place(t, i->second)); break;
    case QDOT_OP_TANH: d = hyperbolic_tangent(f, a, place(t, i->second)); break;
    case QDOT_OP_ATAN2: d = f->atan2(a, b); break;
    case QDOT_OP_EXP: d = f->exp(a); break;
    case QDOT_OP_LOG: d = f->log(a); break;
    case QDOT_OP_ERF: d = f->erf(a); break;
    case QDOT_OP_ERFC: d = f->erfc(a); break;
    case QDOT_OP_ASIN: d = f->asin(a); break;
    case QDOT_OP_ACOS: d = f->acos(a); break;
    case QDOT_OP_ATAN: d = f->atan(a); break;
    case QDOT_OP_ASINH: d = f->asinh(a); break;
    case QDOT_OP_ACOSH: d = f->acosh(a); break;
    case QDOT_OP_ATANH: d = f->atanh(a); break;
    case QDOT_OP_ABS: d = a.hi < 0 ? qdot_two_neg(a) : a; break;
    case QDOT_OP_SIGN: d = truth(isnan(a.hi) ? a.hi : (a.hi > 0) - (a.hi < 0)); break;
    case QDOT_OP_MIN: d = isnan(a.hi) || is_less(a, b) ? a : b; break;
    case QDOT_OP_MAX: d = isnan(a.hi) || is_less(b, a) ? a : b; break;
    case QDOT_OP_MOD:
        d = qdot_two_sub(a, qdot_two_mul(b, whole_part(qdot_two_div(a, b))));
        break;
    case QDOT_OP_FLOOR: d = whole_part(a); break;
    case QDOT_OP_LT: d = truth(is_less(a, b)); break;
    case QDOT_OP_LE: d = truth(is_less(a, b) || (a.hi == b.hi && a.lo == b.lo)); break;
    case QDOT_OP_EQ: d = truth(a.hi == b.hi && a.lo == b.lo); break;
    case QDOT_OP_AND: d = truth(a.hi != 0 && b.hi != 0); break;
    case QDOT_OP_OR: d = truth(a.hi != 0 || b.hi != 0); break;
    case QDOT_OP_NOT: d = truth(a.hi == 0); break;
    case QDOT_OP_SELECT: d = a.hi != 0 ? b : c; break;
    default: d = truth(NAN); /* an operation without a value here does not pass the tests */
    }
    place(t, i->to)[0] = d;
}

/* --- order k ------------------------------------------------------------------------ */

#define NAME(x) portable_##x
#include "series/two.def"
#undef NAME

#ifdef QDOT_X86_KINDS
QDOT_KIND_AVX2
#define NAME(x) fma_##x
#include "series/two.def"
#undef NAME
QDOT_KIND_END
#endif

void
qdot_tape_two_order(qdot_tape_two *t, int k)
{
    const qdot_program_step *i = t->program.steps.at + (k > 0 ? t->program.still : 0);

    for (; i->op != QDOT_T_END; i++)
        if (k > 0)
            t->order(t, i, k);
        else
            value(t, i);
}

/* --- correction ---------------------------------------------------------------------- */

/* Coefficient k of a row changes by its note. */
static void
change(qdot_tape_two *t, qdot_program_row row, int k)
{
    if (row != QDOT_NO_ROW)
        place(t, row)[k] = qdot_two_add_double(place(t, row)[k], t->note[row]);
}

void
qdot_tape_two_correct(qdot_tape_two *t, int k, size_t n, const double *by)
{
    const qdot_program_step *i = t->program.steps.at + t->program.still;
    double *note = t->note, U1, U2;

    for (size_t r = 0; r < n; r++) {
        note[r] = by[r];
        change(t, (qdot_program_row)r, k);
    }
    for (; i->op != QDOT_T_END; i++) {
#define ZERO(row) place(t, i->row)[0].hi
#define NOTE(row) note[i->row]
#define OVER_ZERO(p, row) (p) / ZERO(row)
#define OVER_TWICE_ZERO(p, row) 0.5 * (p) / ZERO(row)
#define FUSED(a, b, c) (a) * (b) + (c)
#define NOTHING 0
#include "series/linear.def"
        change(t, i->to, k);
        change(t, i->second, k);
        change(t, i->third, k);
        change(t, i->d, k);
    }
}

/* --- building ------------------------------------------------------------------------ */

static void
set_constants(qdot_tape_two *t, const qdot_tape *tape)
{
    for (qdot_program_row r = 0; r < t->program.rows.n; r++) {
        const qdot_program_row_info *row = t->program.rows.at + r;

        if (row->source == QDOT_ROW_CONSTANT)
            place(t, r)[0] = (qdot_two){tape->constant[row->at], tape->low[row->at]};
        else if (row->source == QDOT_ROW_WHOLE)
            place(t, r)[0] = (qdot_two){row->at, 0};
    }
}

static qdot_status
make(qdot_tape_two *t, const qdot_tape *tape, int most, size_t moving)
{
    const qdot_program *p = &t->program;

    QDOT_TRY(qdot_program_init(tape, moving, most == 0, &t->program));
    t->stride = (size_t)most + 1;
    t->functions = qdot_two_functions_get();
    t->order = portable_order;
#ifdef QDOT_X86_KINDS
    if (qdot_kind_is_here(1))
        t->order = fma_order;
#endif
    t->numbers = qdot_calloc(p->rows.n * t->stride + 1, sizeof *t->numbers);
    t->note = qdot_calloc(p->rows.n + 1, sizeof *t->note);
    if (!t->numbers || !t->note)
        return QDOT_ENOMEM;
    set_constants(t, tape);
    return QDOT_OK;
}

qdot_status
qdot_tape_two_new(const qdot_tape *tape, int most, size_t moving, qdot_tape_two **two)
{
    qdot_tape_two *t = qdot_calloc(1, sizeof *t);
    qdot_status status;

    *two = NULL;
    if (!t)
        return QDOT_ENOMEM;
    status = make(t, tape, most, moving);
    if (status != QDOT_OK) {
        qdot_tape_two_free(t);
        return status;
    }
    *two = t;
    return QDOT_OK;
}

void
qdot_tape_two_free(qdot_tape_two *t)
{
    if (!t)
        return;
    qdot_program_clear(&t->program);
    qdot_free(t->numbers);
    qdot_free(t->note);
    qdot_free(t);
}

qdot_two *
qdot_tape_two_input(qdot_tape_two *t, size_t i)
{
    return place(t, (qdot_program_row)i);
}

size_t
qdot_tape_two_stride(const qdot_tape_two *t)
{
    return t->stride;
}

const qdot_two *
qdot_tape_two_output(const qdot_tape_two *t, size_t i)
{
    return place(t, t->program.outputs.at[i]);
}

bool
qdot_tape_two_is_constant(const qdot_tape_two *t, size_t i)
{
    return t->program.rows.at[t->program.outputs.at[i]].still;
}
