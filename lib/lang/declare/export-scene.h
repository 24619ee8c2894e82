/* export-scene.h -- describes the motion of a scene, or an expression, for export to another language. */
#ifndef QDOT_LANG_EXPORT_SCENE_H
#define QDOT_LANG_EXPORT_SCENE_H

#include "lang/session/parts.h"
#include "show/export.h"

/* Append the equations of motion as source text. file: the name without folder and ending. Parameters
 * stay arguments, with the values of `set`; declared functions have those of `set`. Start, time span
 * and tolerance are those of the latest run of these coordinates, else of `start`, 0..10, 1e-12.
 * Errors: QDOT_EINVAL (no coordinate), QDOT_EUNSET (a function without a value), QDOT_ELIMIT. */
QDOT_MUST_CHECK qdot_status qdot_export_scene(qdot_session *session, const char *file,
                                              const qdot_export_language *language, qdot_text *out);

/* Append e as a function of its symbols; an equation as left minus right side. name: e as it was typed. */
QDOT_MUST_CHECK qdot_status qdot_export_value(qdot_session *session, const char *name, qdot_expr e,
                                              const char *file, const qdot_export_language *language,
                                              qdot_text *out);

#endif
