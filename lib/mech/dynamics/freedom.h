/* freedom.h -- how many constraints are independent. Internal to mech/. */
#ifndef QDOT_MECH_FREEDOM_H
#define QDOT_MECH_FREEDOM_H

#include "mech/scene/scene.h"

/* Fill d->independent: which constraints are independent of those before them. */
bool qdot_freedom_independent(qdot_scene *s);

#endif
