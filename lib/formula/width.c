/* width.c -- counts the letters of a formula, to estimate its width. */
#include "formula/width.h"

#include <string.h>

#include "base/utf8.h"
#include "formula/walk.h"

/* The number of letters in the text of a sign, without the blanks around it. */
static size_t
count_letters_of_sign(unsigned sign)
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
count_letters_of_order(uint32_t n, uint32_t most)
{
    return n <= most ? n : n < 10 ? 3 : 4;
}

static qdot_status
add_width_of_node_begin(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    size_t *letters = walk->user;

    switch (node->kind) {
    case QDOT_FORMULA_TEXT: *letters += qdot_utf8_columns(walk->formula->text.at + node->child, node->n); break;
    case QDOT_FORMULA_SIGN: *letters += count_letters_of_sign(node->what); break;
    case QDOT_FORMULA_ACCENT: *letters += node->n > 3 ? count_letters_of_order(node->n, 0) : 0; break;
    case QDOT_FORMULA_PRIMES: *letters += count_letters_of_order(node->n, 3); break;
    case QDOT_FORMULA_BRACKET:
    case QDOT_FORMULA_TABLE: *letters += 2; break;
    case QDOT_FORMULA_CASES: *letters += 1 + strlen("otherwise"); break;
    default: break;
    }
    return QDOT_OK;
}

static qdot_status
add_width_between_children(qdot_formula_walk *walk, const qdot_formula_node *node, uint32_t k)
{
    size_t *letters = walk->user;

    if (node->kind == QDOT_FORMULA_CASES && k % 2 == 1)
        *letters += strlen("if ");
    return QDOT_OK;
}

static qdot_status
add_width_of_node_end(qdot_formula_walk *walk, const qdot_formula_node *node)
{
    (void)walk;
    (void)node;
    return QDOT_OK;
}

qdot_status
qdot_formula_width(const qdot_formula *f, qdot_formula_id id, size_t *letters)
{
    qdot_formula_walk walk = {
        .formula = f, .user = letters, .enter = add_width_of_node_begin, .between = add_width_between_children, .leave = add_width_of_node_end};

    *letters = 0;
    return qdot_formula_pass(&walk, id);
}
