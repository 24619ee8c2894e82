/* lanes-sums.c -- sums of products over orders, two orders at a time. */
#include "tape/lanes-writer.h"

/* A sequence of terms has sums of `products` times two orders; register c of sum s. */
static int
chains_of(const qdot_lanes_writer *w, int products)
{
    return w->chains / (2 * products);
}

static int
chain(const qdot_lanes_writer *w, int products, int sum, int c)
{
    return sum * chains_of(w, products) + c % chains_of(w, products);
}

/* Where coefficient k - j of the other factor i is while term j is at work. */
static int
other(const qdot_lanes_writer *w, int i, int j)
{
    return w->moment + 1 + 2 * i + j % 2;
}

static const qdot_x86_base other_base[] = {QDOT_X86_R8, QDOT_X86_R13};

/* Term j of rax and r8; and of rax and r13. Coefficient k + 1 - j is that of term j - 1, too. */
static void
emit_term(qdot_lanes_writer *w, int products, int j)
{
    const int32_t at = (int32_t)(j * QDOT_WRITER_GROUP);

    qdot_writer_emit(w, QDOT_X86_LOAD_ALL, w->moment, 0, qdot_x86_at(QDOT_X86_RAX, at));
    for (int i = 0; i < products; i++) {
        qdot_writer_emit(w, QDOT_X86_MADD_ALL, chain(w, products, 2 * i, j), w->moment,
                         qdot_x86_reg(other(w, i, j)));
        if (j == 1)
            continue;
        qdot_writer_emit(w, QDOT_X86_LOAD_ALL, other(w, i, j - 1), 0,
                         qdot_x86_at(other_base[i], (int32_t)QDOT_WRITER_GROUP - at));
        qdot_writer_emit(w, QDOT_X86_MADD_ALL, chain(w, products, 2 * i + 1, j),
                         w->moment, qdot_x86_reg(other(w, i, j - 1)));
    }
}

void
qdot_writer_terms(qdot_lanes_writer *w, int products, size_t *at)
{
    w->x.far = true;
    for (int n = (int)w->stride - 1; n > 0; n--) {
        at[n] = w->x.bytes.n;
        emit_term(w, products, n);
    }
    w->x.far = false;
    qdot_x86_leave(&w->x);
}

static void
address(qdot_lanes_writer *w, qdot_x86_base to, qdot_lanes_row row, int order)
{
    const qdot_x86_rm rm = qdot_writer_place(w, (qdot_lanes_at){row, order});

    if (!w->counting)
        qdot_x86_address(&w->x, to, (qdot_x86_base)rm.reg, rm.offset);
}

/* Where a register says, or at so many terms less: sums of a lower order than the steps. */
static void
enter_in_loop(qdot_lanes_writer *w, qdot_x86_base at, int less)
{
    if (less > 0)
        qdot_x86_address(&w->x, QDOT_X86_R12, at,
                         less * (int32_t)(w->dot[2] - w->dot[3]));
    qdot_x86_enter_at(&w->x, less > 0 ? QDOT_X86_R12 : at);
}

/* Terms n, n - 1, ..., 1 of order k are added; z of two products only. In a loop the number
 * of a square's may be even or odd. */
static void
call_terms(qdot_lanes_writer *w, qdot_lanes_row x, qdot_lanes_row y,
           const qdot_lanes_row *z, int n, int k)
{
    const qdot_lanes_row others[] = {y, z ? *z : y};
    const bool any = k > QDOT_WRITER_ANY / 2, square = n < k - 1;

    address(w, QDOT_X86_RAX, x, 0);
    for (int i = 0; i < (z ? 2 : 1); i++) {
        address(w, other_base[i], others[i], k);
        for (int even = 0; even < (any && square ? 2 : 1); even++)
            qdot_writer_emit(w, QDOT_X86_LOAD_ALL, other(w, i, n + even), 0,
                             qdot_writer_place(w, (qdot_lanes_at){others[i], k - n}));
    }
    if (w->counting)
        return;
    if (any)
        enter_in_loop(w, z ? QDOT_X86_R14 : square ? QDOT_X86_R15 : QDOT_X86_R11,
                      QDOT_WRITER_ANY + k % 2 - k);
    else
        qdot_x86_enter(&w->x, z ? w->pair[n] : w->dot[n]);
}

static void
clear_chains(qdot_lanes_writer *w)
{
    for (int r = 0; r < w->chains; r++)
        qdot_writer_clear(w, r);
}

/* The chains of a sum become one register. */
static qdot_lanes_sum
add_up(qdot_lanes_writer *w, int products, int sum)
{
    const int from = chain(w, products, sum, 0), n = chains_of(w, products);
    const qdot_lanes_sum to = qdot_writer_take(w);

    if (n > 2) {
        qdot_writer_emit(w, QDOT_X86_ADD_ALL, from, from, qdot_x86_reg(from + 1));
        qdot_writer_emit(w, QDOT_X86_ADD_ALL, from + 2, from + 2, qdot_x86_reg(from + 3));
    }
    if (n > 1)
        qdot_writer_emit(w, QDOT_X86_ADD_ALL, to, from, qdot_x86_reg(from + n / 2));
    else
        qdot_writer_emit(w, QDOT_X86_LOAD_ALL, to, 0, qdot_x86_reg(from));
    return to;
}

static qdot_lanes_at
ahead(const qdot_lanes_writer *w, size_t sum)
{
    return qdot_lanes_number(w, w->numbers + QDOT_WRITER_RESTS * w->t->length + sum);
}

/* The number of the sum that comes. */
static size_t
next_sum(qdot_lanes_writer *w)
{
    const size_t sum = w->sum++;

    if (sum >= w->sums)
        w->sums = sum + 1;
    if (sum >= w->ahead.n && w->status == QDOT_OK)
        w->status = qdot_vec_push(&w->ahead, false);
    return sum;
}

/* What an even order has made of a sum for the next one. */
static void
keep_ahead(qdot_lanes_writer *w, size_t sum, qdot_lanes_sum value)
{
    if (w->status != QDOT_OK)
        return;
    w->ahead.at[sum] = value != QDOT_LANES_NOTHING;
    if (value != QDOT_LANES_NOTHING)
        qdot_lanes_store(w, value, ahead(w, sum));
}

static qdot_lanes_sum
take_ahead(qdot_lanes_writer *w, size_t sum)
{
    qdot_lanes_sum value = QDOT_LANES_NOTHING;

    if (w->status == QDOT_OK && w->ahead.at[sum])
        qdot_lanes_add(w, &value, false, ahead(w, sum));
    return value;
}

static bool
both_move(const qdot_lanes_writer *w, const qdot_lanes_pair *pair)
{
    return w->moving[pair->x] && w->moving[pair->y];
}

/* Terms 1 and k - 1: all of order 2, and what order k - 1 has not made of an odd one. */
static void
add_outer(qdot_lanes_writer *w, qdot_lanes_sum *sum, const qdot_lanes_pair *pair, int k)
{
    for (int j = 1; j<k; j += k> 2 ? k - 2 : 1)
        qdot_lanes_add_product(w, sum, false, (qdot_lanes_at){pair->x, j},
                               (qdot_lanes_at){pair->y, k - j});
}

qdot_lanes_sum
qdot_lanes_dots(qdot_lanes_writer *w, size_t pairs, const qdot_lanes_pair *pair, int k)
{
    const size_t number = next_sum(w);
    qdot_lanes_sum sum = QDOT_LANES_NOTHING;
    size_t moving = 0;

    for (size_t i = 0; i < pairs; i++) {
        qdot_lanes_keep(w, pair[i].x);
        qdot_lanes_keep(w, pair[i].y);
        moving += both_move(w, pair + i);
    }
    if (k < 2 || moving == 0)
        return sum;
    if (k % 2 != 0 || k == 2) {
        if (k > 2)
            sum = take_ahead(w, number);
        for (size_t i = 0; i < pairs; i++)
            if (both_move(w, pair + i))
                add_outer(w, &sum, pair + i, k);
        if (k == 2)
            keep_ahead(w, number, QDOT_LANES_NOTHING);
        return sum;
    }
    clear_chains(w);
    for (size_t i = 0; i < pairs; i++)
        if (both_move(w, pair + i))
            call_terms(w, pair[i].x, pair[i].y, NULL, k - 1, k);
    sum = add_up(w, 1, 0);
    keep_ahead(w, number, add_up(w, 1, 1));
    return sum;
}

void
qdot_writer_pair(qdot_lanes_writer *w, qdot_lanes_row x, qdot_lanes_row y,
                 qdot_lanes_row z, int k, qdot_lanes_sum *sums)
{
    const qdot_lanes_pair pairs[] = {{x, y}, {x, z}};
    size_t number[2];

    if (k < 4 || k % 2 != 0 || !both_move(w, pairs) || !both_move(w, pairs + 1)) {
        for (int i = 0; i < 2; i++)
            sums[i] = qdot_lanes_dots(w, 1, pairs + i, k);
        return;
    }
    for (int i = 0; i < 2; i++)
        number[i] = next_sum(w);
    clear_chains(w);
    call_terms(w, x, y, &z, k - 1, k);
    for (int i = 0; i < 2; i++) {
        sums[i] = add_up(w, 2, 2 * i);
        keep_ahead(w, number[i], add_up(w, 2, 2 * i + 1));
    }
}

/* Half of the terms, twice, and the one in the middle. */
qdot_lanes_sum
qdot_writer_square(qdot_lanes_writer *w, qdot_lanes_row x, int k)
{
    const size_t number = next_sum(w);
    const qdot_lanes_at middle = {x, k / 2}, first = {x, 1};
    const qdot_lanes_at two = qdot_lanes_scalar(w, 2);
    qdot_lanes_sum sum = QDOT_LANES_NOTHING, more = sum;

    qdot_lanes_keep(w, x);
    if (k < 2 || !w->moving[x])
        return sum;
    if (k % 2 != 0) {
        sum = take_ahead(w, number);
        qdot_lanes_add_product(w, &sum, false, first, (qdot_lanes_at){x, k - 1});
        qdot_lanes_scale(w, &sum, two);
        return sum;
    }
    if (k >= 4) {
        clear_chains(w);
        call_terms(w, x, x, NULL, k / 2 - 1, k);
        sum = add_up(w, 1, 0);
        more = add_up(w, 1, 1);
        qdot_lanes_add_product(w, &more, false, middle, (qdot_lanes_at){x, k / 2 + 1});
        qdot_lanes_scale(w, &sum, two);
    }
    keep_ahead(w, number, more);
    qdot_lanes_add_product(w, &sum, false, middle, middle);
    return sum;
}

static qdot_lanes_at
rest(const qdot_lanes_writer *w, size_t step, int i)
{
    return qdot_lanes_number(w, w->numbers + QDOT_WRITER_RESTS * step + (size_t)i);
}

void
qdot_writer_keep(qdot_lanes_writer *w, size_t step, int i, qdot_lanes_sum sum)
{
    w->rests[QDOT_WRITER_RESTS * step + (size_t)i] = sum != QDOT_LANES_NOTHING;
    if (sum != QDOT_LANES_NOTHING)
        qdot_lanes_store(w, sum, rest(w, step, i));
}

qdot_lanes_sum
qdot_writer_kept(qdot_lanes_writer *w, size_t step, int i)
{
    qdot_lanes_sum sum = QDOT_LANES_NOTHING;

    if (w->rests[QDOT_WRITER_RESTS * step + (size_t)i])
        qdot_lanes_add(w, &sum, false, rest(w, step, i));
    return sum;
}
