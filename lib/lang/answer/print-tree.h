/* print-tree.h -- expressions as JSON arrays in prefix form, exact, for programs that compute with them.
 *
 *   "3", ["/","1","3"]           numbers: strings of digits, with a minus in front
 *   "m", "theta[1]", "pi"        symbols by their names; also "t", "infinity", "true", "false"
 *   ["'","theta",1]              a time derivative of this order, also of a momentum
 *   ["+",a,b,...], ["*",a,b,...], ["^",a,b], ["sin",a], ["min",a,b,...]
 *   ["if",condition,a,condition,b,...,else]
 *   ["=",a,b], ["<",a,b], ["<=",a,b], ["and",a,...], ["or",a,...], ["not",a]
 *   ["list",...], ["vector",...], ["matrix",[a,b],[c,d]]
 *   ["integral",f,x,a,b]; ["integral",f,x] is a function of x with the derivative f
 *   ["apply","f",a,...]          an undefined function, which may be called as a word of the language
 *   ["diff",["apply","f","x"],"x"]    its derivative, one "diff" for each order
 *   ["D",[1,0],"f",a,b]          its derivative by the first argument, at arguments that are no symbols
 *   ["p","theta"], ["delta","theta"], ["d","theta"]    momentum, virtual displacement, differential of a coordinate
 *   ["wedge",["d","r"],["d","phi"]], ["unit","kg"]
 *
 * Tests  tests/lang/answer/test_print-tree.c
 */
#ifndef QDOT_LANG_PRINT_TREE_H
#define QDOT_LANG_PRINT_TREE_H

#include "base/text.h"
#include "expr/id.h"

/* Append e. The pool gets new nodes where e holds integrals. Errors: QDOT_ETYPE: a text, or a table of data; QDOT_ENOMEM;
 * QDOT_EINTR. The text has a length of the order of qdot_expr_size(e), whatever parts e has in common. */
QDOT_MUST_CHECK qdot_status qdot_print_tree(qdot_pool *pool, qdot_expr e, qdot_text *out);

#endif
