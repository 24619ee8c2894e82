/* freedom.h -- how many constraints are independent. Internal to mech/. */
#ifndef QDOT_MECH_FREEDOM_H
#define QDOT_MECH_FREEDOM_H

#include "mech/scene/scene.h"

/* Which constraints are independent of those before them: d->independent. */
bool qdot_freedom_independent(qdot_scene *s);

#endif
