/* components.c -- answers a tensor by listing its components, with coordinates as indices. */
#include "lang/ask/components.h"

#include <string.h>

#include "expr/build.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "lang/answer/sheet.h"
#include "lang/session/output.h"

enum { MOST_RANK = 4 };

/* The letter and the positions of the indices that textbooks use for a tensor-valued function. */
typedef struct {
    const char *call, *letter;
    uint32_t upper; /* number of upper indices, 0 or 1 */
} letter;

static const letter letters[] = {{"christoffel(", "Γ", 1}, {"riemann(", "R", 1}, {"ricci(", "R", 0}};

typedef struct {
    qdot_session *session;
    const char *name;
    const letter *letter; /* letter and index positions as in textbooks; NULL: use the name */
    bool linear;          /* write indices in brackets, on one line */
    qdot_expr value, over;
    uint32_t rank, n;
    int mirror; /* symmetry in the last two indices: 1 symmetric, -1 antisymmetric, 0 neither */
    bool zeros; /* components that are zero are not listed */
    qdot_sheet sheet;
} tensor;

/* An index of a component: a coordinate, or (nil) a letter. */
typedef struct {
    qdot_expr coordinate;
    char letter;
} place;

static uint32_t
tensor_rank(const qdot_pool *pool, qdot_expr value)
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
textbook_letter(const char *name)
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
    const uint32_t rank = over == QDOT_NIL ? 0 : tensor_rank(session->pool, value);
    const letter *l = textbook_letter(name);

    if (rank > MOST_RANK || session->output->json)
        return false;
    return rank > 2 ? qdot_expr_count(session->pool, value) ==
                          qdot_expr_count(session->pool, over)
                    : rank == 2 && l != NULL && l->upper == 0;
}

/* The component of the tensor at the given indices, counted from 0. */
static qdot_expr
get_component(const tensor *t, const uint32_t *at)
{
    qdot_expr e = t->value;

    for (uint32_t k = 0; k + 2 < t->rank; k++)
        e = qdot_expr_arg(t->session->pool, e, at[k]);
    return qdot_entry2(t->session->pool, e, (int64_t)at[t->rank - 2] + 1,
                       (int64_t)at[t->rank - 1] + 1);
}

/* Advance to the next set of indices; false after the last one. */
static bool
advance_indices(const tensor *t, uint32_t *at)
{
    for (uint32_t k = t->rank; k-- > 0;) {
        if (++at[k] < t->n)
            return true;
        at[k] = 0;
    }
    return false;
}

static int
find_index_symmetry(const tensor *t)
{
    uint32_t at[MOST_RANK] = {0}, turned[MOST_RANK];
    bool same = true, opposite = true;

    do {
        memcpy(turned, at, sizeof at);
        turned[t->rank - 1] = at[t->rank - 2];
        turned[t->rank - 2] = at[t->rank - 1];
        const qdot_expr a = get_component(t, at), b = get_component(t, turned);

        same = same && a == b;
        opposite = opposite && a == qdot_neg(t->session->pool, b);
    } while (advance_indices(t, at));
    return same ? 1 : opposite ? -1 : 0;
}

/* Append one index as text in the given style. */
static qdot_status
print_index(const tensor *t, const place *p, qdot_style style, qdot_text *out)
{
    if (p->coordinate != QDOT_NIL)
        return qdot_print(t->session->pool, p->coordinate, style, out);
    qdot_text_char(out, p->letter);
    return QDOT_OK;
}

/* Append the name of a component in one line: Γ[r; θ, θ]. */
static qdot_status
add_flat_name(tensor *t, const place *indices)
{
    qdot_text text = {0};
    qdot_status status = QDOT_OK;

    qdot_text_add(&text, t->letter->letter);
    for (uint32_t k = 0; k < t->rank && status == QDOT_OK; k++) {
        qdot_text_add(&text, k == 0 ? "[" : k == t->letter->upper ? "; " : ", ");
        status = print_index(t, &indices[k], QDOT_UNICODE, &text);
    }
    qdot_text_char(&text, ']');
    if (status == QDOT_OK)
        qdot_formula_add_text(&t->sheet.formula, t->sheet.at, QDOT_TEXT_WORDS, qdot_text_str(&text), text.n);
    t->sheet.formula.failed = t->sheet.formula.failed || text.failed;
    qdot_text_clear(&text);
    return status;
}

/* Append indices from ... to - 1 of the component as a row of `parent`. */
static qdot_status
add_indices(tensor *t, qdot_formula_id parent, const place *indices, uint32_t from, uint32_t to)
{
    const qdot_formula_id outer = t->sheet.at;

    t->sheet.at = qdot_formula_add(&t->sheet.formula, parent, QDOT_FORMULA_ROW, 0, 0);
    for (uint32_t k = from; k < to; k++) {
        if (k > from)
            qdot_sheet_sign(&t->sheet, QDOT_SIGN_BLANK);
        if (indices[k].coordinate != QDOT_NIL)
            QDOT_TRY(qdot_sheet_expr(&t->sheet, indices[k].coordinate));
        else
            qdot_formula_add_text(&t->sheet.formula, t->sheet.at, QDOT_TEXT_NAME, &indices[k].letter, 1);
    }
    t->sheet.at = outer;
    return QDOT_OK;
}

/* Append the tensor's letter with its upper and lower indices. */
static qdot_status
add_raised_name(tensor *t, const place *indices)
{
    const uint32_t upper = t->letter->upper;
    const qdot_formula_id node = qdot_formula_add(&t->sheet.formula, t->sheet.at,
                                                  upper > 0 ? QDOT_FORMULA_TENSOR : QDOT_FORMULA_INDEX, 0, 0);

    qdot_formula_add_text(&t->sheet.formula, node, QDOT_TEXT_NAME, t->letter->letter, strlen(t->letter->letter));
    if (upper > 0)
        QDOT_TRY(add_indices(t, node, indices, 0, upper));
    return add_indices(t, node, indices, upper, t->rank);
}

/* Append the name as typed, with the indices: christoffel(R)[r, theta, theta]. */
static qdot_status
add_typed_name(tensor *t, const place *indices)
{
    qdot_text typed = {0};
    qdot_status status = QDOT_OK;

    qdot_text_add(&typed, t->name);
    for (uint32_t k = 0; k < t->rank && status == QDOT_OK; k++) {
        qdot_text_add(&typed, k == 0 ? "[" : ", ");
        status = print_index(t, &indices[k], QDOT_PLAIN, &typed);
    }
    qdot_text_char(&typed, ']');
    if (status == QDOT_OK)
        status = qdot_text_status(&typed);
    if (status == QDOT_OK)
        status = qdot_sheet_name(&t->sheet, qdot_text_str(&typed), 0);
    qdot_text_clear(&typed);
    return status;
}

/* Append the name of a component, in the form chosen for this tensor. */
static qdot_status
append_component_name(tensor *t, const place *indices)
{
    return t->letter == NULL ? add_typed_name(t, indices) : t->linear ? add_flat_name(t, indices) : add_raised_name(t, indices);
}

static qdot_status
add_component(tensor *t, const uint32_t *at, qdot_expr value)
{
    place indices[MOST_RANK] = {0};

    for (uint32_t k = 0; k < t->rank; k++)
        indices[k].coordinate = qdot_expr_arg(t->session->pool, t->over, at[k]);
    qdot_sheet_open(&t->sheet);
    QDOT_TRY(append_component_name(t, indices));
    qdot_sheet_sign(&t->sheet, QDOT_SIGN_EQUALS);
    QDOT_TRY(qdot_sheet_expr(&t->sheet, value));
    qdot_sheet_close(&t->sheet);
    qdot_sheet_words(&t->sheet, "\n");
    return QDOT_OK;
}

/* Append the symmetry of a tensor, `Γ[i; k, j] = Γ[i; j, k]`, with letters for the indices. */
static qdot_status
append_symmetry(tensor *t)
{
    const char *const words = "ijkl";

    qdot_sheet_open(&t->sheet);
    for (int side = 0; side < 2; side++) {
        place indices[MOST_RANK] = {0};

        for (uint32_t k = 0; k < t->rank; k++)
            indices[k].letter = words[side == 0 && k + 2 >= t->rank ? 2 * t->rank - 3 - k : k];
        if (side == 1)
            qdot_sheet_sign(&t->sheet, QDOT_SIGN_EQUALS);
        if (side == 1 && t->mirror < 0)
            qdot_sheet_sign(&t->sheet, QDOT_SIGN_NEGATIVE);
        QDOT_TRY(append_component_name(t, indices));
    }
    qdot_sheet_close(&t->sheet);
    return QDOT_OK;
}

/* Add a line about the components that are not listed: zeros, and those equal to others by symmetry. */
static qdot_status
append_omitted_components(tensor *t, bool none)
{
    qdot_sheet *s = &t->sheet;
    const bool comment = t->session->output->style == QDOT_PLAIN || t->session->output->flat;

    if (!none && !t->zeros && t->mirror == 0)
        return QDOT_OK;
    qdot_sheet_words(s, comment ? "# " : "");
    if (none) {
        qdot_sheet_open(s);
        QDOT_TRY(qdot_sheet_name(s, t->name, 0));
        qdot_sheet_close(s);
        qdot_sheet_words(s, ": all components are 0\n");
        return QDOT_OK;
    }
    if (t->mirror != 0 && t->letter == NULL)
        qdot_sheet_format(s, "%s in the last two indices", t->mirror > 0 ? "symmetric" : "antisymmetric");
    else if (t->mirror != 0)
        QDOT_TRY(append_symmetry(t));
    qdot_sheet_format(s, "%s%s\n", t->mirror != 0 && t->zeros ? "; " : "", t->zeros ? "all others are 0" : "");
    return QDOT_OK;
}

static qdot_status
append_all_components(tensor *t)
{
    uint32_t at[MOST_RANK] = {0};
    bool none = true;

    do {
        const qdot_expr value = get_component(t, at);

        if (t->mirror != 0 && at[t->rank - 2] > at[t->rank - 1])
            continue;
        if (value == QDOT_ZERO) {
            t->zeros = t->zeros || t->mirror >= 0 || at[t->rank - 2] != at[t->rank - 1];
            continue;
        }
        none = false;
        QDOT_TRY(add_component(t, at, value));
    } while (advance_indices(t, at));
    QDOT_TRY(qdot_pool_check(t->session->pool));
    return append_omitted_components(t, none);
}

qdot_status
qdot_components_answer(qdot_session *session, const char *name, qdot_expr value,
                       qdot_expr over)
{
    const bool typed = session->output->style == QDOT_PLAIN || session->output->flat;
    qdot_status status;
    tensor t = {.session = session,
                .name = name,
                .letter = typed ? NULL : textbook_letter(name),
                .sheet = qdot_sheet_begin(session),
                .linear = session->output->style == QDOT_UNICODE,
                .value = value,
                .over = over,
                .rank = tensor_rank(session->pool, value),
                .n = qdot_expr_count(session->pool, over)};

    t.mirror = find_index_symmetry(&t);
    status = qdot_pool_check(session->pool);
    if (status == QDOT_OK)
        status = append_all_components(&t);
    return qdot_sheet_end(&t.sheet, name, status);
}
