/* taylor-text.c -- keeps generated machine code: keys of programs, executable memory, a small cache. */
#include "series/taylor-text.h"

#include <stdatomic.h>
#include <string.h>

#include "base/memory.h"
#include "machine/asm.h"

#if defined __x86_64__ && defined __LP64__ && (defined __unix__ || defined __APPLE__)
#define CAN_RUN
#include <sys/mman.h>
#ifdef MAP_POPULATE /* map all pages at once instead of by one page fault for each */
#define POPULATED MAP_POPULATE
#else
#define POPULATED 0
#endif
#endif

enum {
    page = 4096,
    /* space before the first instruction, where sanitizers look for information about a function */
    head = 64,
    kept = 16,
    most_kept = 1 << 16 /* largest code kept, in bytes: longer code is rare and takes long to run */
};

/* The cache. It holds a reference to each text; while a thread has taken a text out, others do not see it. */
static _Atomic(qdot_taylor_text *) shelf[kept];
static atomic_uint next_place;

/* --- keys that identify programs ---------------------------------------------------- */

enum { OF_ALL = 9, OF_STEP = 10, OF_BLOCK = 3, OF_UNKNOWN = 3, OF_COUPLING = 3 };

static uint32_t
index_of_row(const qdot_taylor *t, const double *x)
{
    return x ? qdot_taylor_row(t, x) : UINT32_MAX;
}

static size_t
length_of_key(const qdot_taylor *t)
{
    size_t n = OF_ALL + t->outputs + OF_STEP * (t->length + t->n_links);

    for (size_t k = 0; k < t->n_blocks; k++)
        n += OF_BLOCK + OF_UNKNOWN * t->blocks[k].n +
             OF_COUPLING * t->blocks[k].n_couplings;
    return n;
}

static uint32_t *
append_step_to_key(const qdot_taylor *t, const qdot_taylor_step *s, uint32_t *to)
{
    const uint32_t words[OF_STEP] = {s->op,
                                     s->zero,
                                     (uint32_t)s->sign,
                                     index_of_row(t, s->to),
                                     index_of_row(t, s->second),
                                     index_of_row(t, s->third),
                                     index_of_row(t, s->d),
                                     index_of_row(t, s->x),
                                     index_of_row(t, s->y),
                                     index_of_row(t, s->z)};

    memcpy(to, words, sizeof words);
    return to + OF_STEP;
}

static uint32_t *
append_block_to_key(const qdot_taylor *t, const qdot_taylor_block *b, uint32_t *to)
{
    *to++ = (uint32_t)b->n;
    *to++ = (uint32_t)b->solved;
    *to++ = (uint32_t)b->n_couplings;
    for (size_t i = 0; i < b->n; i++) {
        *to++ = index_of_row(t, b->f[i]);
        *to++ = index_of_row(t, b->a[i]);
        *to++ = index_of_row(t, b->r[i]);
    }
    for (size_t c = 0; c < b->n_couplings; c++) {
        *to++ = b->couplings[c].i;
        *to++ = index_of_row(t, b->couplings[c].M);
        *to++ = index_of_row(t, b->couplings[c].a);
    }
    return to;
}

static void
write_key(const qdot_taylor *t, uint32_t *to)
{
    const uint32_t words[OF_ALL] = {
        (uint32_t)t->rows,     (uint32_t)t->stride,  (uint32_t)t->moving,
        (uint32_t)t->still,    (uint32_t)t->length,  (uint32_t)t->n_links,
        (uint32_t)t->n_blocks, (uint32_t)t->outputs, (uint32_t)qdot_asm_kind()};

    memcpy(to, words, sizeof words);
    to += OF_ALL;
    for (size_t i = 0; i < t->outputs; i++)
        *to++ = index_of_row(t, t->output[i]);
    for (size_t i = 0; i < t->length + t->n_links; i++)
        to = append_step_to_key(t, t->steps + i, to);
    for (size_t k = 0; k < t->n_blocks; k++)
        to = append_block_to_key(t, t->blocks + k, to);
}

/* --- the cache of generated code ---------------------------------------------------- */

void
qdot_taylor_text_give(qdot_taylor_text *text)
{
    if (!text || atomic_fetch_sub(&text->users, 1) > 1)
        return;
#ifdef CAN_RUN
    if (text->memory)
        munmap(text->memory, text->size);
#endif
    qdot_free(text->key);
    qdot_free(text->blocks);
    qdot_free(text);
}

/* The cached machine code for this key that serves these orders, with a further reference; NULL if there is none. */
static qdot_taylor_text *
find_in_cache(const uint32_t *key, size_t length, qdot_taylor_orders orders)
{
    for (size_t i = 0; i < kept; i++) {
        qdot_taylor_text *text = atomic_exchange(shelf + i, NULL), *none = NULL;
        bool found;

        if (!text)
            continue;
        found = text->from <= orders.to && orders.most <= text->to &&
                text->exact == (orders.most >= QDOT_TAYLOR_EXACT_FROM) && text->length == length &&
                memcmp(text->key, key, length * sizeof *key) == 0;
        if (found)
            atomic_fetch_add(&text->users, 1);
        if (!atomic_compare_exchange_strong(shelf + i, &none, text))
            qdot_taylor_text_give(text); /* another thread has stored the same code in the meantime: drop this one */
        if (found)
            return text;
    }
    return NULL;
}

qdot_status
qdot_taylor_text_take(const qdot_taylor *t, qdot_taylor_orders orders, qdot_taylor_text **text)
{
    const size_t length = length_of_key(t);
    qdot_taylor_text *empty = qdot_calloc(1, sizeof *empty);

    *text = NULL;
    if (!empty)
        return QDOT_ENOMEM;
    atomic_init(&empty->users, 1);
    empty->length = length;
    empty->key = qdot_malloc(length * sizeof *empty->key);
    if (!empty->key) {
        qdot_taylor_text_give(empty);
        return QDOT_ENOMEM;
    }
    write_key(t, empty->key);
    *text = find_in_cache(empty->key, length, orders);
    if (*text)
        qdot_taylor_text_give(empty);
    else
        *text = empty;
    return QDOT_OK;
}

bool
qdot_taylor_text_fill(qdot_taylor_text *text, const unsigned char *code, size_t n)
{
#ifdef CAN_RUN
    text->used = n;
    text->size = (head + n + page - 1) / page * page;
    text->memory = mmap(NULL, text->size, PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS | POPULATED, -1, 0);
    if (text->memory == MAP_FAILED) {
        text->memory = NULL;
        return false;
    }
    memcpy((unsigned char *)text->memory + head, code, n);
    if (mprotect(text->memory, text->size, PROT_READ | PROT_EXEC) == 0)
        return true;
    munmap(text->memory, text->size);
    text->memory = NULL;
    return false;
#else
    (void)text, (void)code, (void)n;
    return false;
#endif
}

const unsigned char *
qdot_taylor_text_first(const qdot_taylor_text *text)
{
    return (const unsigned char *)text->memory + head;
}

void
qdot_taylor_text_keep(qdot_taylor_text *text)
{
    if (text->used > most_kept)
        return;
    atomic_fetch_add(&text->users, 1);
    qdot_taylor_text_give(
        atomic_exchange(shelf + atomic_fetch_add(&next_place, 1) % kept, text));
}
