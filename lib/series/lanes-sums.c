/* lanes-sums.c -- writes machine code for sums of products of coefficients; for a block of four orders together. */
#include "series/lanes-writer.h"

/* A sequence of terms has sums of `products` times the orders of a block; register c of the
 * i-th order's of one. */
static int
number_of_partial_sums(const qdot_lanes_writer *w, int products)
{
    return w->chains / (w->block * products);
}

static int
register_of_partial_sum(const qdot_lanes_writer *w, int products, int product, int i, int c)
{
    const int n = number_of_partial_sums(w, products);

    return (product * w->block + i) * n + c % n;
}

static const qdot_asm_base other_base[] = {QDOT_ASM_PARTNER, QDOT_ASM_SECOND_PARTNER};

/* What coefficient K + i - j of other factor p is multiplied from: a register that has it from
 * the terms before on, or its place. */
static qdot_operand
other(const qdot_lanes_writer *w, bool window, int p, int i, int j)
{
    const int B = w->block;

    return window ? qdot_asm_in(w->moment + 1 + p * B + ((i - j) % B + B) % B)
                  : qdot_asm_at(other_base[p], (i - j) * w->bytes);
}

/* Term j of a factor and its partner; and of a second one: of the orders that have coefficients below the
 * block's first alone in it. */
static void
write_term_of_sum(qdot_lanes_writer *w, bool window, int products, int j)
{
    const int last = w->block - 1;

    qdot_writer_emit(w, QDOT_ASM_LOAD, w->moment, 0,
                     qdot_asm_at(QDOT_ASM_FACTOR, j * w->bytes));
    for (int p = 0; window && j > last && p < products; p++)
        qdot_writer_emit(w, QDOT_ASM_LOAD, other(w, true, p, last, j).reg, 0,
                         other(w, false, p, last, j));
    for (int i = 0; i <= last && i < j; i++)
        for (int p = 0; p < products; p++)
            qdot_writer_emit(w, QDOT_ASM_MADD, register_of_partial_sum(w, products, p, i, j), w->moment,
                             other(w, window, p, i, j));
}

static int
smaller_number(int a, int b)
{
    return a < b ? a : b;
}

void
qdot_writer_terms(qdot_lanes_writer *w, bool window, int products, size_t *at)
{
    w->m.far = !w->windows; /* use long offsets in instructions, unless windows keep all offsets within one byte */
    for (int n = smaller_number((int)w->at.stride - 1, QDOT_SERIES_MOST + 1); n > 0; n--) {
        at[n] = w->m.bytes.n;
        write_term_of_sum(w, window, products, n);
    }
    w->m.far = false;
    qdot_asm_leave(&w->m);
}

static void
write_address(qdot_lanes_writer *w, qdot_asm_base to, qdot_lanes_row row, int order)
{
    const qdot_operand rm = qdot_writer_place(w, (qdot_lanes_at){row, order});

    if (!w->counting)
        qdot_asm_set(&w->m, to, (qdot_asm_base)rm.reg, rm.offset);
}

/* Jump into the sequence of terms, at the address in a register, or `less` terms later for lower orders. */
static void
write_jump_into_terms(qdot_lanes_writer *w, qdot_asm_base at, const size_t *terms, int less)
{
    if (less > 0)
        qdot_asm_set(&w->m, QDOT_ASM_TERMS_LEFT, at,
                     less * (int32_t)qdot_writer_term(w, terms));
    qdot_asm_enter_at(&w->m, less > 0 ? QDOT_ASM_TERMS_LEFT : at);
}

/* Call the code that adds terms n, n - 1, ..., 1 of the sums of a block from order K on; z: for two products only. */
static void
write_call_of_terms(qdot_lanes_writer *w, qdot_lanes_row x, qdot_lanes_row y,
                    const qdot_lanes_row *z, int n, int K)
{
    const qdot_lanes_row others[] = {y, z ? *z : y};
    const bool any = K > QDOT_WRITER_ANY / 2, square = n < K - 1;
    const bool window = w->windows && !square;

    qdot_lanes_keep(w, x);
    write_address(w, QDOT_ASM_FACTOR, x, 0);
    for (int i = 0; i < (z ? 2 : 1); i++) {
        qdot_lanes_keep(w, others[i]);
        write_address(w, other_base[i], others[i], K);
        for (int c = 0; window && c < n && c < w->block - 1; c++)
            qdot_writer_emit(w, QDOT_ASM_LOAD, other(w, true, i, c, n).reg, 0,
                             qdot_writer_place(w, (qdot_lanes_at){others[i], K - n + c}));
    }
    if (w->counting)
        return;
    if (any)
        write_jump_into_terms(w,
                              z        ? QDOT_ASM_TERMS_OF_PAIRS
                              : square ? QDOT_ASM_TERMS_OF_SQUARES
                               : QDOT_ASM_TERMS,
                              z        ? w->pair
                              : square ? w->half
                               : w->dot,
                              square ? (w->any - 1) / 2 - n : w->any - K);
    else
        qdot_asm_enter(&w->m, z ? w->pair[n] : square ? w->half[n] : w->dot[n]);
}

static void
clear_partial_sums(qdot_lanes_writer *w)
{
    qdot_writer_leave(w, w->first_free);
    for (int r = 0; r < w->chains; r++)
        qdot_writer_clear(w, r);
}

/* Add all partial sums of a sum into the first of them. */
static int
add_partial_sums(qdot_lanes_writer *w, int products, int product, int i)
{
    const int to = register_of_partial_sum(w, products, product, i, 0), n = number_of_partial_sums(w, products);

    for (int half = n / 2; half > 0; half /= 2)
        for (int c = 0; c < half; c++)
            qdot_writer_emit(w, QDOT_ASM_ADD, to + c, to + c, qdot_asm_in(to + c + half));
    return to;
}

static qdot_lanes_at
place_of_later_sum(const qdot_lanes_writer *w, size_t sum, int i)
{
    return qdot_lanes_number(w, w->numbers + QDOT_WRITER_RESTS * w->t->length +
                                    sum * (size_t)(w->block - 1) + (size_t)i - 1);
}

/* The index of the next sum of this order, with an entry for it in `ahead`. */
static size_t
new_sum_index(qdot_lanes_writer *w)
{
    const size_t sum = w->sum++;

    if (sum >= w->sums)
        w->sums = sum + 1;
    if (sum >= w->ahead.n && w->status == QDOT_OK)
        w->status = qdot_vec_push(&w->ahead, 0);
    return sum;
}

/* What n terms have made of a sum: of the block's first order, the value; of the others, kept
 * until they come. */
static qdot_lanes_sum
distribute_partial_sums(qdot_lanes_writer *w, size_t sum, int products, int product, int n)
{
    qdot_lanes_sum first = QDOT_LANES_NOTHING;

    if (n > 0) {
        first = qdot_writer_take(w);
        qdot_writer_emit(w, QDOT_ASM_LOAD, first, 0,
                         qdot_asm_in(add_partial_sums(w, products, product, 0)));
    }
    for (int i = 1; i < w->block && i < n; i++)
        qdot_writer_put(w, add_partial_sums(w, products, product, i), place_of_later_sum(w, sum, i));
    if (w->status == QDOT_OK)
        w->ahead.at[sum] = n;
    return first;
}

static qdot_lanes_sum
take_part_of_sum(qdot_lanes_writer *w, size_t sum)
{
    qdot_lanes_sum value = QDOT_LANES_NOTHING;

    if (w->status == QDOT_OK && w->ahead.at[sum] > w->phase)
        qdot_lanes_add(w, &value, false, place_of_later_sum(w, sum, w->phase));
    return value;
}

static bool
both_vary(const qdot_lanes_writer *w, const qdot_lanes_pair *pair)
{
    return w->rows[pair->x].moving && w->rows[pair->y].moving;
}

/* Add those products of order k that contain coefficients of its own block of orders, the newest ones last. */
static void
add_products_of_block(qdot_lanes_writer *w, qdot_lanes_sum *sum, size_t pairs,
                      const qdot_lanes_pair *pair, int k)
{
    for (int j = smaller_number(w->phase, k - 1); j > 0; j--)
        for (size_t i = 0; i < pairs; i++) {
            if (!both_vary(w, pair + i))
                continue;
            qdot_lanes_add_product(w, sum, false, (qdot_lanes_at){pair[i].x, j},
                                   (qdot_lanes_at){pair[i].y, k - j});
            if (k - j > w->phase)
                qdot_lanes_add_product(w, sum, false, (qdot_lanes_at){pair[i].x, k - j},
                                       (qdot_lanes_at){pair[i].y, j});
        }
}

qdot_lanes_sum
qdot_lanes_dots(qdot_lanes_writer *w, size_t pairs, const qdot_lanes_pair *pair, int k)
{
    const size_t number = new_sum_index(w);
    const int n = k - 1; /* number of terms of the sum at the first order of the block */
    qdot_lanes_sum sum = QDOT_LANES_NOTHING;
    size_t moving = 0;

    for (size_t i = 0; i < pairs; i++) {
        qdot_lanes_keep(w, pair[i].x);
        qdot_lanes_keep(w, pair[i].y);
        moving += both_vary(w, pair + i);
    }
    if (w->phase > 0) {
        sum = take_part_of_sum(w, number);
        add_products_of_block(w, &sum, pairs, pair, k);
        return sum;
    }
    if (n > 0 && moving > 0) {
        clear_partial_sums(w);
        for (size_t i = 0; i < pairs; i++)
            if (both_vary(w, pair + i))
                write_call_of_terms(w, pair[i].x, pair[i].y, NULL, n, k);
    }
    return distribute_partial_sums(w, number, 1, 0, moving > 0 ? n : 0);
}

void
qdot_writer_pair(qdot_lanes_writer *w, qdot_lanes_row x, qdot_lanes_row y,
                 qdot_lanes_row z, int k, qdot_lanes_sum *sums)
{
    const qdot_lanes_pair pairs[] = {{x, y}, {x, z}};
    size_t number[2];

    if (k < 2 || w->phase > 0 || !both_vary(w, pairs) || !both_vary(w, pairs + 1)) {
        for (int i = 0; i < 2; i++)
            sums[i] = qdot_lanes_dots(w, 1, pairs + i, k);
        return;
    }
    for (int i = 0; i < 2; i++)
        number[i] = new_sum_index(w);
    clear_partial_sums(w);
    write_call_of_terms(w, x, y, &z, k - 1, k);
    for (int i = 0; i < 2; i++)
        sums[i] = distribute_partial_sums(w, number[i], 2, i, k - 1);
}

/* Half of the terms, twice, and the one in the middle. Of those that are not of the block the
 * ones next to the middle are added with it. */
qdot_lanes_sum
qdot_writer_square(qdot_lanes_writer *w, qdot_lanes_row x, int k)
{
    const size_t number = new_sum_index(w);
    const int K = k - w->phase, n = K > 2 ? (K - 1) / 2 : 0, last = (k - 1) / 2;
    const int from = n > w->phase ? n : w->phase;
    const qdot_lanes_at middle = {x, k / 2};
    qdot_lanes_sum sum;

    qdot_lanes_keep(w, x);
    if (!w->rows[x].moving)
        return QDOT_LANES_NOTHING;
    if (w->phase > 0) {
        sum = take_part_of_sum(w, number);
    } else {
        if (n > 0) {
            clear_partial_sums(w);
            write_call_of_terms(w, x, x, NULL, n, K);
        }
        sum = distribute_partial_sums(w, number, 1, 0, n);
    }
    for (int j = last; j > from; j--)
        qdot_lanes_add_product(w, &sum, false, (qdot_lanes_at){x, j},
                               (qdot_lanes_at){x, k - j});
    for (int j = smaller_number(w->phase, last); j > 0; j--)
        qdot_lanes_add_product(w, &sum, false, (qdot_lanes_at){x, j},
                               (qdot_lanes_at){x, k - j});
    qdot_lanes_scale(w, &sum, qdot_lanes_scalar(w, 2));
    if (k > 0 && k % 2 == 0)
        qdot_lanes_add_product(w, &sum, false, middle, middle);
    return sum;
}

static qdot_lanes_at
place_of_remainder(const qdot_lanes_writer *w, size_t step, int i)
{
    return qdot_lanes_number(w, w->numbers + QDOT_WRITER_RESTS * step + (size_t)i);
}

void
qdot_writer_keep(qdot_lanes_writer *w, size_t step, int i, qdot_lanes_sum sum, bool stored)
{
    w->steps[step].rests[i] = sum != QDOT_LANES_NOTHING;
    if (stored && sum != QDOT_LANES_NOTHING)
        qdot_writer_put(w, sum, place_of_remainder(w, step, i));
}

qdot_lanes_sum
qdot_writer_kept(qdot_lanes_writer *w, size_t step, int i)
{
    qdot_lanes_sum sum = QDOT_LANES_NOTHING;

    if (qdot_writer_is_kept(w, step, i))
        qdot_lanes_add(w, &sum, false, place_of_remainder(w, step, i));
    return sum;
}
