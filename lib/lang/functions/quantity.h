/* quantity.h -- the table of quantities of a scene: T, V, L, eom, p[theta] ... */
#ifndef QDOT_LANG_QUANTITY_H
#define QDOT_LANG_QUANTITY_H

#include "lang/session/parts.h"

/* A value of the scene, `T`, `eom`, `mass_matrix` ...; `index`: for
 * eom[theta], p[theta], mass_matrix[a, b]; n = 0 for the bare name. */
typedef struct {
    const char *name;
    int least, most; /* least and largest number of indices */
    qdot_status (*get)(qdot_session *session, uint32_t n, const qdot_expr *index,
                       qdot_expr *value);
    const char *usage, *summary, *example;
    bool over_coordinates; /* the value is a list or matrix whose entries can also be indexed by coordinates */
    /* what a member of the list is called where the whole is asked, `p[theta] = ...`: a
     * symbol by its coordinate; NULL: `eom[theta]` */
    qdot_expr (*symbol)(struct qdot_scene *scene, qdot_expr coordinate);
} qdot_quantity;
const qdot_quantity *qdot_quantity_find(const char *name);
const qdot_quantity *qdot_quantity_at(size_t i);

#endif
