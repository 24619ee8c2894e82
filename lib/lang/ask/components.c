/* components.c -- tensors answered by their components, named by coordinates. */
#include "lang/ask/components.h"

#include <string.h>

#include "expr/tensor.h"
#include "expr/walk.h"
#include "lang/answer/formula.h"
#include "lang/answer/sheet.h"

enum { MOST_RANK = 4 };

/* What a function's tensor is called in books. */
typedef struct {
    const char *call, *letter, *latex;
    uint32_t upper; /* indices above */
} letter;

static const letter letters[] = {{"christoffel(", "Γ", "\\Gamma", 1},
                                 {"riemann(", "R", "R", 1},
                                 {"ricci(", "R", "R", 0}};

typedef struct {
    qdot_session *session;
    const char *name;
    const letter *letter; /* NULL: it goes by its name */
    bool linear;          /* indices in brackets */
    qdot_expr value, over;
    uint32_t rank, n;
    int mirror; /* of the last two indices exchanged: 1 the same, -1 the opposite, 0 neither */
    bool zeros; /* not all components are listed */
    qdot_text text;
} tensor;

static uint32_t
rank_of(const qdot_pool *pool, qdot_expr value)
{
    uint32_t rank = 2;

    for (; qdot_expr_kind(pool, value) == QDOT_LIST; rank++) {
        if (qdot_expr_count(pool, value) == 0)
            return 0;
        value = qdot_expr_arg(pool, value, 0);
    }
    return qdot_expr_kind(pool, value) == QDOT_MAT ? rank : 0;
}

static const letter *
letter_of(const char *name)
{
    for (size_t i = 0; i < sizeof letters / sizeof *letters; i++)
        if (strncmp(name, letters[i].call, strlen(letters[i].call)) == 0 &&
            name[strlen(name) - 1] == ')')
            return &letters[i];
    return NULL;
}

bool
qdot_components_are(const qdot_session *session, const char *name, qdot_expr value,
                    qdot_expr over)
{
    const uint32_t rank = over == QDOT_NIL ? 0 : rank_of(session->pool, value);
    const letter *l = letter_of(name);

    if (rank > MOST_RANK || session->json)
        return false;
    return rank > 2 ? qdot_expr_count(session->pool, value) ==
                          qdot_expr_count(session->pool, over)
                    : rank == 2 && l != NULL && l->upper == 0;
}

/* The component at these indices, counted from 0. */
static qdot_expr
component(const tensor *t, const uint32_t *at)
{
    qdot_expr e = t->value;

    for (uint32_t k = 0; k + 2 < t->rank; k++)
        e = qdot_expr_arg(t->session->pool, e, at[k]);
    return qdot_entry2(t->session->pool, e, (long)at[t->rank - 2] + 1,
                       (long)at[t->rank - 1] + 1);
}

/* The next indices; false past the last. */
static bool
indices_step(const tensor *t, uint32_t *at)
{
    for (uint32_t k = t->rank; k-- > 0;) {
        if (++at[k] < t->n)
            return true;
        at[k] = 0;
    }
    return false;
}

static int
mirror_of(const tensor *t)
{
    uint32_t at[MOST_RANK] = {0}, turned[MOST_RANK];
    bool same = true, opposite = true;

    do {
        memcpy(turned, at, sizeof at);
        turned[t->rank - 1] = at[t->rank - 2];
        turned[t->rank - 2] = at[t->rank - 1];
        const qdot_expr a = component(t, at), b = component(t, turned);

        same = same && a == b;
        opposite = opposite && a == qdot_neg(t->session->pool, b);
    } while (indices_step(t, at));
    return same ? 1 : opposite ? -1 : 0;
}

/* Γ[r; θ, θ] */
static void
add_linear(const tensor *t, qdot_text *out, const qdot_text *indices)
{
    qdot_text_add(out, t->letter->letter);
    qdot_text_char(out, '[');
    for (uint32_t k = 0; k < t->rank; k++) {
        qdot_text_add(out, k == 0 ? "" : k == t->letter->upper ? "; " : ", ");
        qdot_text_add(out, qdot_text_str(&indices[k]));
    }
    qdot_text_char(out, ']');
}

/* The letter with its indices above and below. */
static void
add_raised(const tensor *t, qdot_text *out, const qdot_text *indices)
{
    const bool latex = t->session->style == QDOT_LATEX;
    const uint32_t upper = t->letter->upper;

    qdot_text_format(out,
                     latex   ? "%s"
                     : upper ? "<msubsup><mi>%s</mi><mrow>"
                             : "<msub><mi>%s</mi><mrow>",
                     latex ? t->letter->latex : t->letter->letter);
    if (latex && upper)
        qdot_text_format(out, "^{%s}{}", qdot_text_str(&indices[0]));
    qdot_text_add(out, latex ? "_{" : "");
    for (uint32_t k = upper; k < t->rank; k++) {
        qdot_text_add(out, latex && k > upper ? " " : "");
        qdot_text_add(out, qdot_text_str(&indices[k]));
    }
    qdot_text_add(out, latex ? "}" : "</mrow>");
    if (!latex && upper)
        qdot_text_format(out, "<mrow>%s</mrow>", qdot_text_str(&indices[0]));
    qdot_text_add(out, latex ? "" : upper ? "</msubsup>" : "</msub>");
}

/* The name that was typed, with the indices: christoffel(R)[r, theta, theta]. */
static qdot_status
add_typed(const tensor *t, qdot_text *out, const qdot_text *indices)
{
    qdot_text typed = {0};
    qdot_status status;

    qdot_text_add(&typed, t->name);
    for (uint32_t k = 0; k < t->rank; k++)
        qdot_text_format(&typed, "%s%s", k == 0 ? "[" : ", ", qdot_text_str(&indices[k]));
    qdot_text_char(&typed, ']');
    status = qdot_text_status(&typed);
    if (status == QDOT_OK)
        status = qdot_formula_name(t->session, qdot_text_str(&typed), out);
    qdot_text_clear(&typed);
    return status;
}

/* A component's name; indices [rank] as they are written in it. */
static qdot_status
component_add_name(const tensor *t, qdot_text *out, const qdot_text *indices)
{
    const bool tags = t->session->style == QDOT_MATHML;

    if (t->letter == NULL)
        return add_typed(t, out, indices);
    if (!t->linear) {
        add_raised(t, out, indices);
        return QDOT_OK;
    }
    qdot_text_add(out, tags ? "<mtext>" : "");
    add_linear(t, out, indices);
    qdot_text_add(out, tags ? "</mtext>" : "");
    return QDOT_OK;
}

/* The coordinates at these indices, in the style of the name that they stand in. */
static qdot_status
print_indices(const tensor *t, const uint32_t *at, qdot_text *indices)
{
    const qdot_style style = t->letter == NULL ? QDOT_PLAIN
                             : t->linear && t->session->style == QDOT_MATHML
                                 ? QDOT_UNICODE
                                 : t->session->style;

    for (uint32_t k = 0; k < t->rank; k++) {
        qdot_text_truncate(&indices[k], 0);
        QDOT_TRY(qdot_print(t->session->pool,
                            qdot_expr_arg(t->session->pool, t->over, at[k]), style,
                            &indices[k]));
        QDOT_TRY(qdot_text_status(&indices[k]));
    }
    return QDOT_OK;
}

static qdot_status
add_component(tensor *t, const uint32_t *at, qdot_expr value, qdot_text *indices)
{
    qdot_session *s = t->session;

    QDOT_TRY(print_indices(t, at, indices));
    qdot_formula_bracket(s, true, &t->text);
    QDOT_TRY(component_add_name(t, &t->text, indices));
    qdot_text_add(&t->text, qdot_formula_equals(s));
    QDOT_TRY(qdot_formula_print(s, value, s->style, &t->text));
    qdot_formula_bracket(s, false, &t->text);
    qdot_text_char(&t->text, '\n');
    return qdot_text_status(&t->text);
}

/* `Γ[i; k, j] = Γ[i; j, k]`, by letters for the indices. */
static qdot_status
add_mirror(tensor *t, qdot_text *indices)
{
    const char *const words = "ijkl";
    const bool tags = t->session->style == QDOT_MATHML && t->letter != NULL && !t->linear;
    qdot_text *out = &t->text;

    qdot_formula_bracket(t->session, true, out);
    for (int side = 0; side < 2; side++) {
        for (uint32_t k = 0; k < t->rank; k++) {
            const uint32_t turned =
                side == 0 && k + 2 >= t->rank ? 2 * t->rank - 3 - k : k;

            qdot_text_truncate(&indices[k], 0);
            qdot_text_format(&indices[k], tags ? "<mi>%c</mi>" : "%c", words[turned]);
        }
        if (side == 1) {
            qdot_text_add(out, qdot_formula_equals(t->session));
            qdot_text_add(out, t->mirror > 0                       ? ""
                               : t->session->style == QDOT_MATHML  ? "<mo>−</mo>"
                               : t->session->style == QDOT_UNICODE ? "−"
                                                                   : "-");
        }
        QDOT_TRY(component_add_name(t, out, indices));
    }
    qdot_formula_bracket(t->session, false, out);
    return QDOT_OK;
}

/* What the lines above leave out. */
static qdot_status
add_rest(tensor *t, bool none, qdot_text *indices)
{
    const bool comment = t->session->style == QDOT_PLAIN || t->session->flat;

    if (!none && !t->zeros && t->mirror == 0)
        return QDOT_OK;
    qdot_text_add(&t->text, comment ? "# " : "");
    if (none) {
        qdot_formula_bracket(t->session, true, &t->text);
        QDOT_TRY(qdot_formula_name(t->session, t->name, &t->text));
        qdot_formula_bracket(t->session, false, &t->text);
        qdot_text_add(&t->text, ": all components are 0\n");
        return QDOT_OK;
    }
    if (t->mirror != 0 && t->letter == NULL)
        qdot_text_format(&t->text, "%s in the last two indices",
                         t->mirror > 0 ? "symmetric" : "antisymmetric");
    else if (t->mirror != 0)
        QDOT_TRY(add_mirror(t, indices));
    qdot_text_format(&t->text, "%s%s\n", t->mirror != 0 && t->zeros ? "; " : "",
                     t->zeros ? "all others are 0" : "");
    return qdot_text_status(&t->text);
}

static qdot_status
add_all(tensor *t, qdot_text *indices)
{
    uint32_t at[MOST_RANK] = {0};
    bool none = true;

    do {
        const qdot_expr value = component(t, at);

        if (t->mirror != 0 && at[t->rank - 2] > at[t->rank - 1])
            continue;
        if (value == QDOT_ZERO) {
            t->zeros = t->zeros || t->mirror >= 0 || at[t->rank - 2] != at[t->rank - 1];
            continue;
        }
        none = false;
        QDOT_TRY(add_component(t, at, value, indices));
    } while (indices_step(t, at));
    QDOT_TRY(qdot_pool_check(t->session->pool));
    return add_rest(t, none, indices);
}

qdot_status
qdot_components_answer(qdot_session *session, const char *name, qdot_expr value,
                       qdot_expr over)
{
    const bool typed = session->style == QDOT_PLAIN || session->flat;
    const qdot_sheet sheet = qdot_sheet_begin(session);
    qdot_text indices[MOST_RANK] = {{0}};
    qdot_status status;
    tensor t = {.session = session,
                .name = name,
                .letter = typed ? NULL : letter_of(name),
                .linear = sheet.laid_out || session->style == QDOT_UNICODE,
                .value = value,
                .over = over,
                .rank = rank_of(session->pool, value),
                .n = qdot_expr_count(session->pool, over)};

    t.mirror = mirror_of(&t);
    status = qdot_pool_check(session->pool);
    if (status == QDOT_OK)
        status = add_all(&t, indices);
    for (uint32_t k = 0; k < MOST_RANK; k++)
        qdot_text_clear(&indices[k]);
    return qdot_sheet_end(session, &sheet, name, status, &t.text);
}
