/* function-facts.c -- the rows of function.def: the names of the elementary functions and their properties. */
#include "expr/elementary.h"

#include <math.h>
#include <string.h>

enum {
    ODD = QDOT_FUN_ODD,
    EVEN = QDOT_FUN_EVEN,
    RISING = QDOT_FUN_RISING,
    FALLING = QDOT_FUN_FALLING,
    ENTIRE = QDOT_FUN_ENTIRE,
    ARC = QDOT_FUN_ARC,
    AREA = QDOT_FUN_AREA,
    POLE = QDOT_FUN_POLE,
    QDOT_NONE = QDOT_FUNCTION_KINDS
};

#define NO {false, false, false, 0}
#define AT(c) {true, false, false, c}
#define TO(c) {true, true, false, c}
#define AT_RIGHT(k) {true, false, true, k}
#define TO_RIGHT(k) {true, true, true, k}

static const qdot_fun_facts table[QDOT_FUNCTION_KINDS] = {
#define X(ID, name, least, most, traits, lo, hi, inverse, ...)                           \
    [QDOT_##ID] = {name, least, most, traits, lo, hi, (qdot_fun_id)QDOT_##inverse},
#include "expr/function.def"
#undef X
    [QDOT_HOLD] = {"hold", 1, 1, 0, NO, NO, QDOT_FUNCTION_KINDS},
    [QDOT_LOOKUP] = {"data", 2, 2, 0, NO, NO, QDOT_FUNCTION_KINDS},
};

const qdot_fun_facts *
qdot_fun_facts_of(qdot_fun_id id)
{
    return table + id;
}

/* An end of a range as a double: k M_PI_2 is less than k pi/2 in magnitude, so the next double outward lies beyond it. */
static double
range_end_as_double(const qdot_fun_end *end, double none)
{
    if (!end->known)
        return none;
    return end->angle && end->number != 0 ? nextafter(end->number * M_PI_2, none) : end->number;
}

void
qdot_fun_ends(qdot_fun_id id, double *lo, double *hi)
{
    *lo = range_end_as_double(&table[id].lo, -INFINITY);
    *hi = range_end_as_double(&table[id].hi, INFINITY);
}

bool
qdot_fun_is(qdot_fun_id id, unsigned traits)
{
    return (table[id].traits & traits) == traits;
}

bool
qdot_fun_find(const char *name, qdot_fun_id *id)
{
    for (int i = 0; i < QDOT_FUNCTION_COUNT; i++)
        if (strcmp(table[i].name, name) == 0) {
            *id = (qdot_fun_id)i;
            return true;
        }
    return false;
}

const char *
qdot_fun_name(qdot_fun_id id)
{
    return table[id].name;
}
