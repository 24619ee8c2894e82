/* residual-tree.c -- groups the functions of a residual into nodes and finds the parent of each node. */
#include "sim/form/residual-tree.h"

#include <string.h>

#include "base/memory.h"

#define NONE UINT32_MAX

typedef struct {
    const qdot_residual *r;
    qdot_residual_tree *t;
    size_t n;
    uint32_t
        *group; /* [functions] another function of the same node (links to its first one); itself for the first */
    uint32_t *first; /* [n] for each coordinate, the index of the first function found that depends on it; NONE: none */
} builder;

static uint32_t
first_function_of_node(builder *b, uint32_t f)
{
    while (b->group[f] != f)
        f = b->group[f] = b->group[b->group[f]];
    return f;
}

static bool
join_nodes(builder *b, uint32_t f, uint32_t g)
{
    f = first_function_of_node(b, f);
    g = first_function_of_node(b, g);
    if (f == g)
        return false;
    b->group[f > g ? f : g] = f > g ? g : f;
    return true;
}

/* Join functions into nodes: those of one term or coordinate, then those whose children share a node, repeatedly. */
static void
join_functions(builder *b)
{
    const qdot_residual *r = b->r;
    bool changed = true;

    for (uint32_t f = 0; f < r->functions; f++)
        b->group[f] = f;
    for (size_t i = 0; i < b->n; i++)
        b->first[i] = NONE;
    for (size_t w = 0; w < r->n_weights; w++)
        join_nodes(b, r->weights[w].to, r->weights[w].from);
    for (size_t j = 0; j < r->n_slopes; j++) {
        uint32_t *first = b->first + r->slopes[j].coordinate;

        if (*first == NONE)
            *first = r->slopes[j].function;
        join_nodes(b, *first, r->slopes[j].function);
    }
    while (changed) {
        changed = false;
        for (uint32_t f = 0; f < r->functions; f++)
            for (uint32_t g = f; r->parent[f] != NONE && g-- > 0;)
                if (r->parent[g] != NONE && first_function_of_node(b, f) == first_function_of_node(b, g))
                    changed = join_nodes(b, r->parent[f], r->parent[g]) || changed;
    }
}

/* Nodes by their first functions; false: too many of anything, or a node that hangs on
 * itself. */
static bool
number_nodes(builder *b)
{
    const qdot_residual *r = b->r;
    qdot_residual_tree *t = b->t;
    size_t c = 0;

    for (uint32_t f = 0; f < r->functions; f++) {
        const uint32_t first = first_function_of_node(b, f);
        size_t size = 1;

        t->node[f] = first == f ? (uint32_t)t->nodes++ : t->node[first];
        for (uint32_t g = 0; g < f; g++)
            size += t->node[g] == t->node[f];
        t->m = size > t->m ? size : t->m;
    }
    for (uint32_t f = 0; f < r->functions; f++)
        if (r->parent[f] != NONE && t->node[r->parent[f]] >= t->node[f])
            return false;
    for (size_t i = 0; i < b->n; i++) {
        size_t on = 0;

        if (b->first[i] == NONE)
            return false;
        for (size_t k = 0; k <= i; k++)
            on += t->node[b->first[k]] == t->node[b->first[i]];
        c = on > c ? on : c;
    }
    t->c = c;
    return t->m <= QDOT_ARTICULATED_COMPONENTS && c > 0 && c <= QDOT_ARTICULATED_UNKNOWNS;
}

/* The first component of a node to which no function has been assigned. */
static uint32_t
free_component(const qdot_residual_tree *t, uint32_t node)
{
    uint32_t place = 0;

    while (t->function[node * t->m + place] != NONE)
        place++;
    return place;
}

static void
assign_function(qdot_residual_tree *t, uint32_t f, uint32_t place)
{
    t->function[t->node[f] * t->m + place] = f;
    t->place[f] = place;
}

/* Assign each function to the same component as its parent has, if that is free in its node. */
static void
assign_functions(builder *b)
{
    const qdot_residual *r = b->r;
    qdot_residual_tree *t = b->t;

    for (size_t e = 0; e < t->nodes * t->m; e++)
        t->function[e] = t->parent[e] = NONE;
    for (uint32_t f = 0; f < r->functions; f++) {
        const uint32_t parent = r->parent[f];
        const uint32_t same = parent == NONE ? NONE : t->place[parent];

        assign_function(t, f,
                        same != NONE && t->function[t->node[f] * t->m + same] == NONE
                         ? same
                         : free_component(t, t->node[f]));
        if (parent != NONE)
            t->parent[t->node[f] * t->m + t->place[f]] =
                (uint32_t)(t->node[parent] * t->m + t->place[parent]);
    }
}

static void
assign_coordinates(builder *b)
{
    const qdot_residual *r = b->r;
    qdot_residual_tree *t = b->t;

    for (size_t e = 0; e < t->nodes * t->c; e++)
        t->coordinate[e] = NONE;
    for (size_t e = 0; e < t->nodes * t->c * t->m; e++)
        t->slope[e] = NONE;
    for (size_t i = 0; i < b->n; i++) {
        const uint32_t node = t->node[b->first[i]];

        t->coordinate[node * t->c + t->unknowns[node]++] = (uint32_t)i;
    }
    for (size_t j = 0; j < r->n_slopes; j++) {
        const qdot_residual_slope *s = r->slopes + j;
        const uint32_t node = t->node[s->function];
        size_t k = 0;

        while (t->coordinate[node * t->c + k] != s->coordinate)
            k++;
        t->slope[(node * t->c + k) * t->m + t->place[s->function]] = s->output;
    }
}

static qdot_status
tree_build(builder *b, bool *is_tree)
{
    const qdot_residual *r = b->r;
    qdot_residual_tree *t = b->t;

    *is_tree = false;
    b->group = qdot_calloc(r->functions + 1, sizeof *b->group);
    b->first = qdot_calloc(b->n + 1, sizeof *b->first);
    t->node = qdot_calloc(r->functions + 1, sizeof *t->node);
    t->place = qdot_calloc(r->functions + 1, sizeof *t->place);
    if (!b->group || !b->first || !t->node || !t->place)
        return QDOT_ENOMEM;
    join_functions(b);
    if (!number_nodes(b))
        return QDOT_OK;
    t->function = qdot_calloc(t->nodes * t->m, sizeof *t->function);
    t->parent = qdot_calloc(t->nodes * t->m, sizeof *t->parent);
    t->coordinate = qdot_calloc(t->nodes * t->c, sizeof *t->coordinate);
    t->slope = qdot_calloc(t->nodes * t->c * t->m, sizeof *t->slope);
    t->unknowns = qdot_calloc(t->nodes, sizeof *t->unknowns);
    if (!t->function || !t->parent || !t->coordinate || !t->slope || !t->unknowns)
        return QDOT_ENOMEM;
    assign_functions(b);
    assign_coordinates(b);
    *is_tree = true;
    return QDOT_OK;
}

qdot_status
qdot_residual_tree_new(const qdot_residual *r, size_t n, qdot_residual_tree **tree)
{
    builder b = {.r = r, .n = n};
    bool is_tree = false;
    qdot_status status;

    *tree = NULL;
    b.t = qdot_calloc(1, sizeof *b.t);
    status = b.t ? tree_build(&b, &is_tree) : QDOT_ENOMEM;
    qdot_free(b.group);
    qdot_free(b.first);
    if (status != QDOT_OK || !is_tree) {
        qdot_residual_tree_free(b.t);
        return status;
    }
    *tree = b.t;
    return QDOT_OK;
}

void
qdot_residual_tree_free(qdot_residual_tree *t)
{
    if (!t)
        return;
    qdot_free(t->function);
    qdot_free(t->coordinate);
    qdot_free(t->slope);
    qdot_free(t->node);
    qdot_free(t->place);
    qdot_free(t->parent);
    qdot_free(t->unknowns);
    qdot_free(t);
}

qdot_status
qdot_residual_tree_system(const qdot_residual_tree *t, const qdot_residual *r,
                          const double *w, qdot_articulated **system)
{
    double *weight = qdot_calloc(t->nodes * t->m * t->m, sizeof *weight);
    qdot_status status = QDOT_ENOMEM;

    *system = NULL;
    if (weight) {
        const qdot_articulated_tree of = {.nodes = t->nodes,
                                          .m = t->m,
                                          .c = t->c,
                                          .parent = t->parent,
                                          .weight = weight,
                                          .unknowns = t->unknowns};

        for (size_t k = 0; k < r->n_weights; k++) {
            const uint32_t to = r->weights[k].to, from = r->weights[k].from;

            weight[(t->node[to] * t->m + t->place[to]) * t->m + t->place[from]] += w[k];
        }
        status = qdot_articulated_new(&of, system);
    }
    qdot_free(weight);
    return status;
}
