/* mates.c -- hands out items to other ranks (processes of MPI), and receives their answers. */
#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "parallel/ranks.h"
#include "parallel/workers-parts.h"
#include "parallel/workers.h"

/* A message to each and one from it take rank 0 some microseconds: with many ranks chunks are
 * longer, so that it does a few thousand a second. */
static const double chunk_seconds = 0.25, seconds_a_rank = 5e-4;
static const double look_again = 0.2; /* seconds between two checks for ranks that no longer answer */
enum { MOST_CHUNK = 1 << 20 };

struct qdot_mate {
    qdot_hand hand;
    bool ready, lost;
    size_t workers;
};

/* The headers of messages between ranks. */
typedef struct {
    uint64_t number, workers;
} ready;
typedef struct {
    uint64_t number, first, count;
} chunk;
typedef struct {
    uint64_t number;
} answer;

/* --- rank 0: work for the other ranks ---------------------------------------------------- */

qdot_status
qdot_mates_new(qdot_crew *c)
{
    if (qdot_ranks_count() == 1 || qdot_rank() > 0)
        return QDOT_OK;
    c->mates = qdot_calloc(qdot_ranks_count(), sizeof *c->mates);
    return c->mates ? QDOT_OK : QDOT_ENOMEM;
}

void
qdot_mates_free(qdot_crew *c)
{
    for (size_t i = 0; c->mates && i < qdot_ranks_count(); i++)
        qdot_text_clear(&c->mates[i].hand.come);
    qdot_free(c->mates);
    qdot_text_clear(&c->out);
}

/* Give a rank up to two chunks of items, so that it need not wait between them. */
static void
give_chunks(qdot_crew *c, size_t rank)
{
    qdot_mate *m = &c->mates[rank];
    const double seconds = fmax(chunk_seconds, seconds_a_rank * (double)c->ready);

    if (m->hand.n == 0)
        qdot_ranks_expect(rank);
    while (m->ready && m->hand.n < 2) {
        const qdot_items_chunk r =
            qdot_hand_out(c, &m->hand, seconds * (double)m->workers, MOST_CHUNK);
        const chunk bytes = {c->number, r.first, r.count};

        if (r.count == 0)
            break;
        qdot_ranks_send(rank, QDOT_RANK_CHUNK, &bytes, sizeof bytes);
    }
}

static qdot_status
receive_from_rank(qdot_crew *c, const qdot_rank_message *m)
{
    qdot_mate *mate = &c->mates[m->from];
    const char *at = qdot_text_str(&m->bytes);
    ready r;
    answer a;

    mate->lost = false;
    if (m->what == QDOT_RANK_READY && m->bytes.n == sizeof r) {
        memcpy(&r, at, sizeof r);
        if (r.number == c->number && !mate->ready) {
            mate->ready = true;
            mate->workers = (size_t)r.workers;
            c->ready++;
        }
    } else if (m->what == QDOT_RANK_ANSWER && m->bytes.n >= sizeof a) {
        memcpy(&a, at, sizeof a);
        if (a.number == c->number)
            return qdot_hand_take(c, &mate->hand, at + sizeof a, m->bytes.n - sizeof a);
    }
    return QDOT_OK;
}

/* Hand out again the items that lost ranks have not answered. A rank that is heard again no longer counts as lost. */
static qdot_status
hand_out_lost(qdot_crew *c)
{
    const double now = qdot_wall_now();

    if (now - c->looked < look_again)
        return QDOT_OK;
    c->looked = now;
    for (size_t i = 1; i < qdot_ranks_count(); i++)
        if (c->mates[i].hand.n > 0 && qdot_ranks_is_lost(i)) {
            c->mates[i].lost = true;
            QDOT_TRY(qdot_hand_drop(c, &c->mates[i].hand));
        }
    return QDOT_OK;
}

qdot_status
qdot_mates_serve(qdot_crew *c)
{
    qdot_rank_message m = {0};
    qdot_status status = QDOT_OK;

    if (c->mates == NULL)
        return QDOT_OK;
    while (status == QDOT_OK && qdot_ranks_next(&m)) {
        status = receive_from_rank(c, &m);
        give_chunks(c, m.from);
    }
    qdot_text_clear(&m.bytes);
    QDOT_TRY(status);
    QDOT_TRY(hand_out_lost(c));
    for (size_t i = 1; i < qdot_ranks_count() && c->items.again.n > 0; i++)
        if (c->mates[i].hand.n == 0 && !c->mates[i].lost)
            give_chunks(c, i);
    return QDOT_OK;
}

/* --- other ranks: work for rank 0 -------------------------------------------------------- */

void
qdot_mates_report(const qdot_crew *c)
{
    const ready bytes = {c->number, c->job->workers};

    qdot_ranks_send(0, QDOT_RANK_READY, &bytes, sizeof bytes);
}

qdot_status
qdot_mates_take(qdot_crew *c, bool *over)
{
    qdot_rank_message m = {0};
    qdot_status status = QDOT_OK;
    chunk r;

    if (c->items.left > 0)
        qdot_ranks_beat();
    while (status == QDOT_OK && !(*over = qdot_ranks_has_shared()) &&
           qdot_ranks_next(&m)) {
        if (m.what != QDOT_RANK_CHUNK || m.bytes.n != sizeof r)
            continue;
        memcpy(&r, m.bytes.at, sizeof r);
        if (r.number == c->number)
            status = qdot_items_begin(
                &c->items, (qdot_items_chunk){(size_t)r.first, (size_t)r.count});
    }
    qdot_text_clear(&m.bytes);
    return status;
}

qdot_status
qdot_mates_send(qdot_crew *c, bool all)
{
    enum { FULL = QDOT_RANKS_SHORT - sizeof(answer) };
    const answer a = {c->number};
    size_t at = 0;
    char bytes[QDOT_RANKS_SHORT];

    QDOT_TRY(qdot_text_status(&c->out));
    while (c->out.n - at >= FULL || (all && c->out.n > at)) {
        const size_t n = c->out.n - at < FULL ? c->out.n - at : FULL;

        memcpy(bytes, &a, sizeof a);
        memcpy(bytes + sizeof a, c->out.at + at, n);
        qdot_ranks_send(0, QDOT_RANK_ANSWER, bytes, sizeof a + n);
        at += n;
    }
    if (at > 0) {
        memmove(c->out.at, c->out.at + at, c->out.n - at);
        qdot_text_truncate(&c->out, c->out.n - at);
    }
    return QDOT_OK;
}
