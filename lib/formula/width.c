/* width.c -- counts the letters of a formula. */
#include "formula/width.h"

#include <string.h>

#include "base/utf8.h"
#include "formula/walk.h"

/* The number of letters in the text of a sign, without the blanks around it. */
static size_t
sign_letters(unsigned sign)
{
    switch (sign) {
    case QDOT_SIGN_TIMES:
    case QDOT_SIGN_BESIDE:
    case QDOT_SIGN_BLANK: return 0;
    case QDOT_SIGN_VERSUS:
    case QDOT_SIGN_IN: return 2;
    case QDOT_SIGN_LEFT: return strlen("left");
    case QDOT_SIGN_RIGHT: return strlen("right");
    default: return 1;
    }
}

/* The width of the order of a derivative: n marks, or the digits of n in brackets. */
static size_t
order_letters(uint32_t n, uint32_t most)
{
    return n <= most ? n : n < 10 ? 3 : 4;
}

static qdot_status
width_enter(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    size_t *letters = walk->user;

    switch (node->kind) {
    case QDOT_FORMULA_TEXT: *letters += qdot_utf8_columns(walk->formula->text.at + node->child, node->n); break;
    case QDOT_FORMULA_SIGN: *letters += sign_letters(node->what); break;
    case QDOT_FORMULA_ACCENT: *letters += node->n > 3 ? order_letters(node->n, 0) : 0; break;
    case QDOT_FORMULA_PRIMES: *letters += order_letters(node->n, 3); break;
    case QDOT_FORMULA_BRACKET:
    case QDOT_FORMULA_TABLE: *letters += 2; break;
    case QDOT_FORMULA_CASES: *letters += 1 + strlen("otherwise"); break;
    default: break;
    }
    return QDOT_OK;
}

static qdot_status
width_between(qdot_formula_walk *walk, const qdot_formula_node *node, uint32_t k)
{
    size_t *letters = walk->user;

    if (node->kind == QDOT_FORMULA_CASES && k % 2 == 1)
        *letters += strlen("if ");
    return QDOT_OK;
}

static qdot_status
width_leave(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    (void)walk;
    (void)node;
    return QDOT_OK;
}

qdot_status
qdot_formula_width(const qdot_formula *f, qdot_formula_id id, size_t *letters)
{
    qdot_formula_walk walk = {
        .formula = f, .user = letters, .enter = width_enter, .between = width_between, .leave = width_leave};

    *letters = 0;
    return qdot_formula_pass(&walk, id);
}
