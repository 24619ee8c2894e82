/* items.c -- records which items of a parallel computation are done, handed out or left. */
#include "parallel/items.h"

enum { ANSWERED = 1, KILLED = 2 };

qdot_status
qdot_items_new(qdot_items *items, size_t first, size_t end, const bool *skip, bool fresh)
{
    *items = (qdot_items){
        .first = first, .end = end, .next = fresh ? first : end, .skip = skip};
    for (size_t k = items->next; k < end; k++)
        items->left += !(skip && skip[k]);
    items->state = qdot_calloc(end - first + 1, sizeof *items->state);
    return items->state ? QDOT_OK : QDOT_ENOMEM;
}

void
qdot_items_free(qdot_items *items)
{
    qdot_free(items->again.at);
    qdot_free(items->state);
}

/* Take a chunk of the items that have never been handed out. */
static qdot_items_chunk
take_new_items(qdot_items *items, double most)
{
    const bool *skip = items->skip;
    qdot_items_chunk r = {.count = 0};

    while (items->next < items->end && skip && skip[items->next])
        items->next++;
    r.first = items->next;
    while (items->next < items->end && !(skip && skip[items->next]) &&
           (r.count == 0 || (double)r.count + 1 <= most)) {
        items->next++;
        r.count++;
    }
    return r;
}

qdot_items_chunk
qdot_items_take(qdot_items *items, double most)
{
    qdot_items_chunk *last, r;

    if (items->again.n == 0)
        return take_new_items(items, most);
    last = &items->again.at[items->again.n - 1];
    r = *last;
    if (r.count > 1 && (double)r.count > most)
        r.count = most > 1 ? (size_t)most : 1;
    last->first += r.count;
    last->count -= r.count;
    if (last->count == 0)
        items->again.n--;
    return r;
}

qdot_status
qdot_items_give(qdot_items *items, qdot_items_chunk chunk)
{
    const size_t end = chunk.first + chunk.count;

    for (size_t k = chunk.first, next; k < end; k = next) {
        for (next = k; next < end && !(items->state[next - items->first] & ANSWERED);)
            next++;
        if (next > k)
            QDOT_TRY(qdot_vec_push(&items->again, ((qdot_items_chunk){k, next - k})));
        else
            next++;
    }
    return QDOT_OK;
}

qdot_status
qdot_items_begin(qdot_items *items, qdot_items_chunk chunk)
{
    if (chunk.first < items->first || chunk.first > items->end ||
        chunk.count > items->end - chunk.first)
        return QDOT_OK; /* ignore a chunk that was not handed out here */
    for (size_t k = chunk.first; k < chunk.first + chunk.count; k++)
        items->state[k - items->first] &= (unsigned char)~ANSWERED;
    items->left += chunk.count;
    return qdot_items_give(items, chunk);
}

bool
qdot_items_answer(qdot_items *items, size_t k)
{
    unsigned char *state;

    if (k < items->first || k >= items->end)
        return false;
    state = &items->state[k - items->first];
    if (*state & ANSWERED)
        return false;
    *state |= ANSWERED;
    items->left--;
    return true;
}

bool
qdot_items_survives(qdot_items *items, size_t k)
{
    unsigned char *state = &items->state[k - items->first];
    const bool first = !(*state & KILLED);

    *state |= KILLED;
    return first;
}
