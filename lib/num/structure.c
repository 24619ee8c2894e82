/* structure.c -- finds blocks of connected unknowns by union-find, numbered in order of first appearance. */
#include "num/structure.h"

#include "base/memory.h"

static size_t
find_block_root(size_t *parent, size_t i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

/* Join two blocks: the smaller root becomes the root of both, so a block's root is its first member. */
static void
join_blocks(size_t *parent, size_t i, size_t j)
{
    i = find_block_root(parent, i);
    j = find_block_root(parent, j);
    if (i < j)
        parent[j] = i;
    else
        parent[i] = j;
}

/* Count the members of each block, then list them: a counting sort by block. */
static void
collect_blocks(qdot_structure *s, size_t *parent, size_t *block)
{
    for (size_t i = 0; i < s->n; i++) {
        size_t r = find_block_root(parent, i);

        block[i] = r == i ? s->blocks++ : block[r];
        s->start[block[i] + 1]++;
    }
    for (size_t b = 0; b < s->blocks; b++)
        s->start[b + 1] += s->start[b];
    for (size_t i = 0; i < s->n; i++)
        s->index[s->start[block[i]]++] = i;
    for (size_t b = s->blocks; b > 0; b--)
        s->start[b] = s->start[b - 1];
    s->start[0] = 0;
}

qdot_status
qdot_structure_find(const bool *pattern, size_t n, qdot_structure *out)
{
    size_t *parent = qdot_calloc(n + 1, sizeof *parent);
    size_t *block = qdot_calloc(n + 1, sizeof *block);
    qdot_status status = QDOT_ENOMEM;

    *out = (qdot_structure){.n = n};
    out->start = qdot_calloc(n + 2, sizeof *out->start);
    out->index = qdot_calloc(n + 1, sizeof *out->index);
    if (parent && block && out->start && out->index) {
        for (size_t i = 0; i < n; i++)
            parent[i] = i;
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++)
                if (i != j && pattern[i * n + j])
                    join_blocks(parent, i, j);
        collect_blocks(out, parent, block);
        status = QDOT_OK;
    } else {
        qdot_structure_clear(out);
    }
    qdot_free(parent);
    qdot_free(block);
    return status;
}

void
qdot_structure_clear(qdot_structure *s)
{
    qdot_free(s->start);
    qdot_free(s->index);
    *s = (qdot_structure){0};
}
