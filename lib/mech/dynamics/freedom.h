/* freedom.h -- finds how many constraints of a scene are independent. Internal to mech/. */
#ifndef QDOT_MECH_FREEDOM_H
#define QDOT_MECH_FREEDOM_H

#include "mech/scene/scene.h"

/* Fill d->independent of the stored results: whether each constraint is independent of those before it. */
bool qdot_freedom_independent(qdot_scene *s);

#endif
