/* statement.c -- the table of statements. Adding one is adding a row. */
#include "lang/commands/statement.h"

#include <string.h>

#define DECLARE "declaring a scene"
#define ASK "asking"
#define NUMBERS "numbers"
#define WORKBENCH "workbench"

static const qdot_statement table[] = {
    /* --- section 2 ------------------------------------------------------------------ */
    {"param", DECLARE, "param NAME [> 0] [= VALUE], ...",
     "declare parameters; a sign spreads back over the bare names before it",
     "param m, L > 0, g = 9.81", qdot_declare_param, false},
    {"coord", DECLARE, "coord NAME, LO < NAME < HI, ...",
     "declare generalized coordinates, each with its own domain",
     "coord r > 0, 0 < theta < pi, phi", qdot_declare_coord, false},
    {"function", DECLARE, "function NAME(ARGUMENTS), ...",
     "declare undefined functions; the bare name means the function at these arguments",
     "function x(s), y(s, t)", qdot_declare_function, false},
    {"assume", DECLARE, "assume RELATION", "a relation that the engine may use",
     "assume diff(x(s), s)^2 + diff(y(s), s)^2 = 1", qdot_declare_assume, false},
    {"particle", DECLARE, "particle NAME mass M at R",
     "a mass point at r(q, t), in 1, 2 or 3 dimensions", "particle bob mass m at (x, y)",
     qdot_object_particle, false},
    {"body", DECLARE,
     "body NAME mass M inertia I [about P] at R angle A | euler(PHI, THETA, PSI) | "
     "rotation MATRIX",
     "a rigid body, planar (angle) or spatial (euler, rotation); R is its centre of mass",
     "body plate mass m inertia I at (x, y) angle theta", qdot_object_body, false},
    {"gravity", DECLARE, "gravity [NAME:] VECTOR",
     "a uniform field that acts on every particle and body; said again it replaces the one "
     "before, those with labels add up", "gravity (0, -g)",
     qdot_object_gravity, false},
    {"potential", DECLARE, "potential [NAME:] V", "a term of the potential energy",
     "potential k*r^2/2", qdot_object_potential, false},
    {"spring", DECLARE, "spring [NAME] between A, B stiffness K [rest L]",
     "V = K/2 (d - L)^2, d the distance of A and B (particles, points, vectors)",
     "spring s1 between bob, (0, 0) stiffness k rest L0", qdot_object_spring, false},
    {"damper", DECLARE, "damper [NAME] between A, B coefficient C",
     "pulls with -C d' along the line from A to B",
     "damper d1 between bob, (0, 0) coefficient c", qdot_object_damper, false},
    {"dissipation", DECLARE, "dissipation [NAME:] D",
     "a term of the Rayleigh function: Q has -dD/dq'", "dissipation c*theta'^2/2",
     qdot_object_dissipation, false},
    {"force", DECLARE,
     "force [NAME:] F on PARTICLE | on COORDINATE | at POINT | on BODY at material POINT",
     "an applied force; it enters through virtual work; `at material`: on what is there of the "
     "body, as friction at a contact",
     "force (0, -m*g) on bob",
     qdot_object_force, false},
    {"torque", DECLARE, "torque [NAME:] TAU on COORDINATE | on BODY",
     "a generalized force on a coordinate, or a torque on a body through its spin",
     "torque tau on theta", qdot_object_torque, false},
    {"lagrangian", DECLARE, "lagrangian L",
     "state the Lagrangian itself, in place of particles and bodies",
     "lagrangian m*x'^2/2 - k*x^2/2", qdot_object_lagrangian, false},
    {"constraint", DECLARE, "constraint [NAME:] A = B",
     "a constraint; its kind is the highest derivative it holds; lambda[NAME] is its "
     "multiplier",
     "constraint rod: x^2 + y^2 = L^2", qdot_object_constraint, false},
    {"remove", DECLARE, "remove NAME | remove KIND [K]",
     "take a thing out of the scene again: by its label; the only one of its kind (gravity, "
     "potential, spring, damper, dissipation, force, torque), or the K-th", "remove d1",
     qdot_remove, false},
    {"event", DECLARE,
     "event NAME: A = B [rising|falling] [stop] [then NAME = VALUE, ...]",
     "a moment of a run: noted, its end, or a change there of coordinates, velocities and, for "
     "the rest of the run, parameters", "event cross: theta = 0 rising stop", qdot_event_declare, false},
    {"reset", DECLARE, "reset | reset scene | reset start",
     "forget everything, or the scene, or the initial state", "reset scene",
     qdot_reset, false},

    /* --- section 3 ------------------------------------------------------------------ */
    {"check", ASK,
     "check [not] A == B [when C, D] [within E] | check [not] conserved E | "
     "check [not] integrable LABEL",
     "decide an identity, an inequality, a conservation, or whether a velocity constraint "
     "is holonomic in disguise: proved, refuted or undecided",
     "check sin(x)^2 + cos(x)^2 == 1", qdot_check, false},
    {"scene", ASK, "scene [to \"FILE.lag\"]",
     "print what is declared; to a .lag file: the statements that give the same scene again, with "
     "definitions, values, start and events", "scene to \"x.lag\"", qdot_ask_scene, true},
    {"dof", ASK, "dof", "coordinates, independent constraints, degrees of freedom", "dof",
     qdot_ask_dof, true},
    {"forces", ASK, "forces", "the generalized forces, part by part", "forces",
     qdot_ask_forces, true},
    {"cyclic", ASK, "cyclic", "the coordinates absent from L, each with its momentum",
     "cyclic", qdot_ask_cyclic, true},
    {"equilibria", ASK, "equilibria", "where the scene can rest, with stability",
     "equilibria", qdot_equilibria_all, true},
    {"modes", ASK, "modes [at EQUILIBRIUM]",
     "normal modes about an equilibrium: frequencies and amplitudes",
     "modes at equilibria[2]", qdot_equilibria_modes, true},
    {"reactions", ASK, "reactions",
     "the constraints' forces on each particle and body, by their multipliers",
     "reactions", qdot_ask_reactions, true},
    {"derive", ASK, "derive", "the derivation from r(q) to the equations, step by step",
     "derive", qdot_derive_all, true},

    /* --- section 4 ------------------------------------------------------------------ */
    {"set", NUMBERS, "set NAME = VALUE, ... | set F(ARGUMENTS) = EXPR",
     "values of parameters and of declared functions, for numbers", "set m = 1, L = 1",
     qdot_set_values, false},
    {"start", NUMBERS, "start Q = VALUE, Q' = VALUE, ... [exactly] | start RUN",
     "the initial state; changes only what it names; what constraints determine of the rest "
     "is solved for, unless `exactly`",
     "start theta = 2, theta' = 0",
     qdot_set_start, false},
    {"run", NUMBERS,
     "run T0..T1 [tol E | digits N] [method NAME] [with NAME = VALUE, ...] "
     "[constraints project|baumgarte|none] [as NAME]",
     "integrate, and say how well it went", "run 0..20 tol 1e-12", qdot_run_statement,
     false},
    {"plan", NUMBERS,
     "plan [tol E] [method NAME] [with NAME = VALUE, ...] [constraints project|baumgarte|none]",
     "what the numerical side would do with this scene and why", "plan",
     qdot_run_plan_statement, false},
    {"table", NUMBERS, "table EXPR, ... every DT [to \"FILE.csv\"]",
     "a table along the latest run", "table theta, theta', energy every 0.1",
     qdot_table_statement, false},
    {"plot", NUMBERS,
     "plot EXPR, ... [vs EXPR | vs NAME = A..B [for ...]] [to \"FILE.svg\"]",
     "a figure along the latest run, or of an expression over a variable",
     "plot theta, theta' to \"fig.svg\"", qdot_plot_statement, false},
    {"save", NUMBERS, "save RUN to \"FILE.csv\" | save session to \"FILE.lag\"",
     "a run whole: t, q, q', multipliers; or the scene with the style and the runs made, as "
     "statements",
     "save a to \"run.csv\"", qdot_table_save, false},
    {"race", NUMBERS, "race T0..T1 [to \"FILE.svg\"]",
     "one scene as given (projected, Baumgarte, none) and in minimal coordinates: errors, "
     "drifts and times at a ladder of tolerances, and their figure",
     "race 0..20", qdot_race_statement, false},
    {"events", NUMBERS, "events", "what occurred in the latest run, and when", "events",
     qdot_event_list, true},
    {"workprecision", NUMBERS, "workprecision T0..T1 [to \"FILE\"]",
     "error against time: every method over a ladder of tolerances",
     "workprecision 0..20", qdot_workprecision_statement, false},
    {"poincare", NUMBERS, "poincare A = B : EXPR, ...", "a section",
     "poincare theta = 0 rising : theta2, theta2'", NULL, false},
    {"lyapunov", NUMBERS, "lyapunov T0..T1", "the growth of nearby trajectories",
     "lyapunov 0..1000", NULL, false},
    {"sweep", NUMBERS, "sweep NAME = A..B step H run T0..T1 : EXPR [as NAME]",
     "a run for each value", "sweep omega = 0..5 step 0.1 run 0..20 : value(theta, 20)",
     NULL, false},
    {"animate", NUMBERS, "animate to \"FILE\"", "a moving picture of a run",
     "animate to \"double.html\"", NULL, false},

    /* --- section 5 ------------------------------------------------------------------ */
    {"help", WORKBENCH, "help [WORD]", "this list, or what a word means", "help particle",
     qdot_help, false},
    {"show", WORKBENCH, "show NAME", "what a name means and where it was declared",
     "show m", qdot_ask_show, false},
    {"vars", WORKBENCH, "vars", "every declared name", "vars", qdot_ask_vars, true},
    {"print", WORKBENCH, "print EXPR, \"text\", ...", "expressions and texts in one line",
     "print \"T is\", T", qdot_ask_print, false},
    {"include", WORKBENCH, "include \"FILE.lag\"",
     "carry out another script, found beside this one", "include \"other.lag\"",
     qdot_settings_include, false},
    {"undo", WORKBENCH, "undo [N]",
     "take back the last statement that changed the session, or the last N: declarations, "
     "definitions, values, runs, resets; a whole `for`, block or `include` is one",
     "undo", qdot_undo_back, false},
    {"redo", WORKBENCH, "redo [N]",
     "do again what `undo` took back, until another statement changes the session", "redo",
     qdot_undo_again, false},
    {"style", WORKBENCH, "style plain | unicode | latex | mathml", "how expressions are written",
     "style latex", qdot_settings_style, false},
    {"timing", WORKBENCH, "timing on | off", "tell the CPU time of every statement",
     "timing on", qdot_settings_timing, false},
    {"report", WORKBENCH, "report to \"FILE\"", "everything as one page",
     "report to \"x.html\"", NULL, false},
    {"export", WORKBENCH, "export c|python|julia|latex EXPR to \"FILE\"",
     "an expression as code", "export c eom to \"eom.c\"", NULL, false},
    {"quit", WORKBENCH, "quit", "leave", "quit", qdot_settings_quit, true},
};

bool
qdot_statement_declares(const qdot_statement *row)
{
    return strcmp(row->group, DECLARE) == 0;
}

const qdot_statement *
qdot_statement_at(size_t i)
{
    return i < sizeof table / sizeof *table ? &table[i] : NULL;
}

const qdot_statement *
qdot_statement_find(const char *word)
{
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (strcmp(table[i].word, word) == 0)
            return &table[i];
    return NULL;
}
