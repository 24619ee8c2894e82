/* expr.h -- all of expr/ at once, for tests. Within lib/ each file includes the parts that it uses. */
#ifndef QDOT_EXPR_EXPR_H
#define QDOT_EXPR_EXPR_H

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/id.h"
#include "expr/node.h"
#include "expr/symbol.h"

#endif
