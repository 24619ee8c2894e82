/* piece.h -- one piece of a course: its data while it is integrated.
 *
 * For course.c only, which has the loop over pieces. side-search.c and piece-sides.c find the
 * sides of the switches for a piece, piece-enter.c enters their mode, piece-massless.c lets coordinates
 * without mass follow, piece.c integrates from the
 * start and looks for roots in every step, piece-end.c carries out the event or switch at the
 * end.
 *
 * Tests  as course.h
 */
#ifndef QDOT_SIM_PIECE_H
#define QDOT_SIM_PIECE_H

#include "series/two.h"
#include "sim/course/course-state.h"

typedef enum {
    QDOT_PIECE_GOES_ON,
    QDOT_PIECE_RETRIED, /* stopped after the first step, for other sides to be tried; see x->well */
    QDOT_PIECE_ENDS     /* the piece ends at time t_act */
} qdot_piece_intent;

/* How often an event, bound or surface was met: used to detect accumulation. */
typedef struct {
    qdot_watched_kind kind;
    size_t index, n; /* index of the event, bound or surface; n: number of times met since the time `since` */
    double since;
    double last, interval, ratio; /* time of the last one; the interval before it; that over the
                                     interval before */
    size_t steady;                /* how many times in a row the ratio of successive intervals was the same */
    bool soon;                    /* its contact was about to last when last met (qdot_piece_rest) */
    size_t at_once;               /* how many times it was met at the same t */
} qdot_piece_repeat;

/* A surface for which other sides (values of its switch) may have to be tried. */
typedef struct {
    size_t surface, n;
    int64_t sides[4]; /* [n] candidate sides, the present one first */
} qdot_piece_doubt;

/* State of the integration of one piece; course.c owns the arrays and the cursor. */
typedef struct {
    qdot_course *c;
    const qdot_ode_options *options;
    const qdot_ode_method *method;
    const qdot_ode_method *now; /* the method of the present step; NULL: there was none */
    double t1, direction;
    size_t n;           /* number of components of y */
    size_t mode;        /* index of the mode of this piece */
    struct {
        double t, *y; /* time and state [n] at the start */
        /* The low part of the state (exact minus y) of components that still equal low_of; other
         * components are exact. */
        double *low, *low_of; /* [n] low parts of components; values of the components for which the low parts are valid */
        double t_low; /* time of the state minus t, if the start is at a root */
        bool on_root; /* y is the state at the root that ended the previous piece */
        double late;  /* time by which the state at that root was then advanced */
        size_t from;  /* index of the mode of the previous piece */
        bool jumped;  /* an event has changed the state at the start */
        bool anew;    /* a table of data jumped there: sides are decided anew */
        bool followed; /* massless coordinates jumped, because their equations changed */
        bool slipped; /* massless coordinates slipped against dry friction; `bare` is the state after that */
    } start;
    int64_t *side;         /* [surfaces] side of each surface in this piece */
    bool *functions_on; /* [functions] whether the function is 0 at the start of the piece */
    int *before;        /* [functions] sign of the function just before the start; 0: unknown */
    int *signs;         /* [functions] of the previous mode: sign of the function where its piece ended */
    int *left; /* [functions] sign of the function just after the start of the previous piece's last step */
    bool *touching; /* [functions] the function was 0 within rounding where the previous piece ended */
    bool *untouched;    /* [functions] what ended that piece left its value as it was; it did not end it, or an event
                           behind it changed the state once more */
    bool *jumps; /* [functions] a jump of massless coordinates at the start changes the function's value */
    bool *turned; /* [functions] an event that ended the previous piece reversed the function's rate of change */
    bool put_aside;     /* due to rounding the start may lie slightly off the surfaces */
    double *residual;   /* [functions] magnitude below which the function counts as 0 at the start */
    double *bare;  /* [n] start state before an attempt changed it; then its low parts, start.low and start.low_of */
    double *rim;   /* [n] part of dy/dt left out in the layer (layer.h) entered last, at its boundary */
    bool entered;  /* the layer to which `rim` belongs was entered in this piece; false: the piece began inside it */
    bool first_step;
    /* The search for the sides of switches: sides are being tried, compared with alternatives, or known. */
    enum { QDOT_SIDES_TRIED, QDOT_SIDES_COMPARED, QDOT_SIDES_KNOWN } search;
    char hindrance[120]; /* why the motion cannot slide along a surface in doubt; "": it can */
    bool well; /* if RETRIED: the sides agree with the first step, but other sides may agree, too */
    bool far; /* only bounds are watched, all far from this step: no roots were searched */

    /* Results of searching the present step for roots. */
    qdot_piece_intent intent;
    double t_act;
    double late, blur; /* the piece ends at t_act - late; uncertainty of this time */
    double *y_act;             /* [n] state at t_act, for methods without series */
    double *end_low;           /* [n] exact state minus y at the end of the piece */
    qdot_two *root; /* [n] state at the root that ends the piece; if there are constraints, state at t_act */
    bool has_root;             /* `root` has been computed, from a series */
    bool over;                 /* the piece is over before the step at hand, which is not taken */
    qdot_vec(qdot_root) roots; /* the roots of watched functions at t_act */
    qdot_vec(qdot_root) fired; /* the roots that ended the previous piece */
    qdot_vec(size_t) pushed; /* lasting contacts against which the event at the start has pushed the motion */
    qdot_vec(size_t) crossed;  /* surfaces among `fired`, if no event changed the state */
    /* numbers of occurrences and of time spans of hidden events that were recorded before this step */
    size_t noted, noted_faded;
    struct {
        double since; /* the start of the piece, or of a later step: start of the counting of parts */
        size_t parts; /* number of parts of steps that were searched since the time `since` */
    } searched;

    /* The data from which the state at any time within the step is read. */
    qdot_watch_reader reader;
    const qdot_ode_expanded *expanded;
    qdot_trajectory step; /* the stored ends of the present step */
    qdot_trajectory_cursor *cursor;
    double *y;      /* [n] scratch */
    size_t resting; /* index of the event whose contact persists in this piece; SIZE_MAX: none */
    int resting_way; /* sign of u on the side to which the motion would leave that contact */

    /* all sides tried so far from one start, [tries x surfaces]; surfaces for which others are possible */
    qdot_vec(int64_t) tried;
    qdot_vec(qdot_piece_doubt) doubts;
    qdot_tape_two **thens; /* [events] assignments `then` in double-double precision; NULL: not needed yet */
    double *largest;       /* [n] largest |y| at the ends of steps so far */
    /* How often each event, bound or surface was met recently. */
    qdot_vec(qdot_piece_repeat) repeats;
} qdot_piece;

static inline const qdot_mode *
qdot_piece_mode(const qdot_piece *x)
{
    return x->c->stage->modes.at[x->mode];
}

static inline qdot_watch *
qdot_piece_watch(const qdot_piece *x)
{
    return x->c->watches.at[x->mode];
}

/* Decide the sides at the start of a piece, in x->side; old [surfaces]: the sides before; NULL:
 * all are decided anew. Errors as qdot_stage_sides. */
QDOT_MUST_CHECK static inline qdot_status
qdot_piece_sides(qdot_piece *x, const int64_t *old)
{
    return qdot_stage_sides(x->c->stage, x->start.t, x->start.y, old, x->side);
}

/* Evaluate dy/dt [n] at the start of the piece, in the equations of a mode that has been entered. */
QDOT_MUST_CHECK static inline qdot_status
qdot_piece_rates(const qdot_piece *x, size_t mode, double *rates)
{
    const qdot_ode_system *system = x->c->systems.at + mode;

    return system->rhs(x->start.t, x->start.y, rates, system->user);
}

/* Whether u of a surface is a function of the time and of delayed values alone; what is said where such a one cannot be followed. */
bool qdot_piece_is_of_the_past(const qdot_piece *x, size_t surface);
#define QDOT_PIECE_PAST_SWITCHES ": the equations switch where what is delayed leaves 0, or comes to it ever faster"

/* Make the mode with the sides x->side, its equations and its root finder; it becomes the mode x->mode. */
QDOT_MUST_CHECK qdot_status qdot_piece_enter(qdot_piece *x);

/* Integrate one piece from its start, the last point, with sides towards which the motion leaves;
 * x->side are tried first. c->reason if there are none, or more than one. */
QDOT_MUST_CHECK qdot_status qdot_piece_search(qdot_piece *x);

/* Bring the start of the piece back onto the surfaces along which the mode slides; *near: it was as
 * near as rounding leaves it; NULL: not asked for. */
QDOT_MUST_CHECK qdot_status qdot_piece_keep(qdot_piece *x, bool *near);

/* Note that another side must be tried for the surface of w, whose function has the sign `first` just behind the
 * start. */
QDOT_MUST_CHECK qdot_status qdot_piece_doubt_side(qdot_piece *x, const qdot_watched *w, int first);

/* (piece-massless.c) Whether the mode has coordinates without mass; in a mode other than that of the piece before, bring
 * them to what its equations say at the start: x->start.followed. *can: not, and x->hindrance says so, where these have no
 * solution or positions would jump against a switch of velocities. */
bool qdot_piece_has_massless(const qdot_piece *x);
/* Whether the function u of a surface determines the position of a coordinate without mass. */
bool qdot_piece_holds_massless(const qdot_piece *x, size_t surface);
QDOT_MUST_CHECK qdot_status qdot_piece_follow_massless(qdot_piece *x, bool *can);

/* Where a run ends and time alone switches their equations it ends behind that, as behind an event:
 * x->start.jumped. */
QDOT_MUST_CHECK qdot_status qdot_piece_end_behind(qdot_piece *x);

/* Carry the signs and residuals at the end of the piece before over to the functions of the new
 * mode. */
void qdot_piece_carry(qdot_piece *x);

/* A start that rounding, or qdot_piece_make_up, has moved off its surfaces is on them still; one that a jump has put
 * elsewhere, by an event or by another switch inside u, is not. After x->reader is set. */
QDOT_MUST_CHECK qdot_status qdot_piece_widen_residuals(qdot_piece *x);

/* Whether an event was recorded at the end of the piece, or within about 16 doubles of t before it. */
bool qdot_piece_just_noted(const qdot_piece *x, size_t event);

/* Check a mode before it is integrated; if it cannot be entered, c->reason says why. */
QDOT_MUST_CHECK qdot_status qdot_piece_cross(qdot_piece *x);

/* Part of it: what the layers that are left have left out, and whether one is entered for good where
 * its power makes that one motion of many (sim/model/layer.h). */
QDOT_MUST_CHECK qdot_status qdot_piece_check_layers(qdot_piece *x);
/* Add to x->start.y what a layer of the time has left out where a piece ends at its middle, by the end of the
 * run or a jump; whether there is one. */
bool qdot_piece_end_in_layers(qdot_piece *x);
/* In x->side: surfaces of velocities in whose layers friction brings the motion to rest. Where a piece
 * starts it goes there, to a start of its own, with the events that it meets then in x->roots. */
QDOT_MUST_CHECK qdot_status qdot_piece_stop_in_layers(qdot_piece *x);
/* Whether the function u of a surface depends on positions only, and the surface has no layer (sim/model/layer.h). */
bool qdot_piece_is_of_places(const qdot_piece *x, size_t surface);
/* In x->side: surfaces of places about which the motion goes too fast to be followed (sim/course/chatter.h) where a
 * piece starts; not `anew`: only those that were crossed there. It slides along them, from a start on them. */
QDOT_MUST_CHECK qdot_status qdot_piece_stop_chatter(qdot_piece *x, bool anew);
/* (piece-fade.c) In the mode that was entered: events without an action are not sought where their function has decayed
 * below the rounding of the run (qdot_watch_may_fade). _take_faded: the step to t has been taken; note the stretches
 * where that is so in c->faded. */
void qdot_piece_let_fade(qdot_piece *x);
QDOT_MUST_CHECK qdot_status qdot_piece_take_faded(qdot_piece *x, double t);
/* A root that is no occurrence, for it only touches where the event is to rise or fall: it may be two crossings that a
 * tighter tolerance (c->passed_over), or nothing in this run (c->faded), tells from a touch. */
QDOT_MUST_CHECK qdot_status qdot_piece_pass_touch(qdot_piece *x, const qdot_root *root);
/* Record an occurrence so near others that rounding hides how many there are: in c->faded, its error unknown. */
QDOT_MUST_CHECK qdot_status qdot_piece_doubt_root(qdot_piece *x, const qdot_root *root);
/* (piece-start.c) A bound of a coordinate's domain that the motion passes at once at the start of the piece; NULL: none. */
const qdot_watched *qdot_piece_bound_at_start(qdot_piece *x);
/* Whether a contact persists where the piece starts, x->resting: an event with `then` that ended the piece before, occurs
 * again at once; or the motion has been on it from the start of the run or all through that piece, or where blows at one
 * instant have left it, and would leave it now in the way of its statement. */
bool qdot_piece_stays_in_contact(qdot_piece *x);
/* End the piece where it starts, by the events that occur there: first the contacts into which the motion has been pushed. */
QDOT_MUST_CHECK qdot_status qdot_piece_events_at_start(qdot_piece *x, double t0);
/* (piece.c) Whether a root of a watched function is what its statement asks for; record it, if it is one of an event. */
bool qdot_piece_is_occurrence(qdot_piece *x, const qdot_root *root);
QDOT_MUST_CHECK qdot_status qdot_piece_record(qdot_piece *x, const qdot_root *root);
/* Record an event that occurs at the start of a piece, if its direction fits; also in x->roots. */
QDOT_MUST_CHECK qdot_status qdot_piece_meet(qdot_piece *x, const qdot_root *root);

/* A piece ends at the first double after its root, x->late behind it. The motion goes on as if it
 * had ended there: over this time it undoes the motion in mode `before` and moves in mode `behind`
 * (SIZE_MAX: none), exact but for the square of a double of t. To show what is uncertain of it, one
 * companion takes the root for earlier by that, the other for later. If other switches are on other
 * sides then, nothing is done. */
QDOT_MUST_CHECK qdot_status qdot_piece_make_up(qdot_piece *x, size_t before, size_t behind);
/* If x->has_root, move the state to the root that ends the piece, projected onto the constraints. */
QDOT_MUST_CHECK qdot_status qdot_piece_go_to_root(qdot_piece *x);
/* Start the next piece at the last point of this one, with the low part of its double-double state. */
void qdot_piece_start_at_end(qdot_piece *x);
/* Find the low part of the double-double state at the start of the piece, low [n]. */
void qdot_piece_low(const qdot_piece *x, double *low);
/* (piece-end.c) Whether function i crosses 0 with slope 0 at the piece's start: motion goes on, not at rest. */
bool qdot_piece_has_crossed_flatly(const qdot_piece *x, size_t i);
/* Set x->late and x->blur, the delay with which the piece ends and its uncertainty, from the piece's roots. */
void qdot_piece_find_delay(qdot_piece *x);

/* Begin the watch of x->mode at the start of a piece, from x->before and x->residual; fills
 * x->functions_on. Errors as qdot_watch_begin. */
QDOT_MUST_CHECK qdot_status qdot_piece_begin(qdot_piece *x);

/* Integrate from the start, the last point of the trajectory, to x->t1 or to the end of the
 * piece: then x->intent, x->t_act and x->roots say where and why; c->reason for a persistent
 * contact. Errors as qdot_trajectory_record. */
QDOT_MUST_CHECK qdot_status qdot_piece_integrate(qdot_piece *x);

/* The run ends if, at the present rate, more events than this would still follow. */
extern const double qdot_piece_most_to_come;

/* The record of how often an event, bound or surface was met; NULL if not yet. */
qdot_piece_repeat *qdot_piece_repeat_of(const qdot_piece *x, qdot_watched_kind kind, size_t index);

/* Carry out all events at x->t_act, in order; x->start.y is the state before, then after. *over:
 * the run ends, for c->reason or by the event c->stopped_by; x->start.jumped: the state was
 * changed. QDOT_EDOMAIN if an event sets a value that is not finite. */
QDOT_MUST_CHECK qdot_status qdot_piece_act(qdot_piece *x, bool *over);

/* The new values of an event into y [n], all from the state old + low [n], what is left of them into
 * rest [n]: other components are not touched. low, rest NULL: 0, not asked for. Errors as
 * qdot_piece_act. */
QDOT_MUST_CHECK qdot_status qdot_piece_change(qdot_piece *x, const qdot_staged_event *e, double t,
                                              const double *old, const double *low, double *y,
                                              double *rest);

/* (piece-contact.c) The motion comes to rest, within the time `left`, on the event that it meets with the
 * sign `way`. *lasts: the contact lasts (sim/model/contact.h), from the start of the piece on: x->side
 * and x->start.y are those. *soon: it will, but the bounces to come are too high as yet. */
QDOT_MUST_CHECK qdot_status qdot_piece_rest(qdot_piece *x, size_t event, int way, double left,
                                            bool *lasts, bool *soon);
/* Whether the event that changed the state, met with the sign `way`, leaves it so slow that the next bounce might not be
 * told from rounding within a step; never by series in two doubles, which tell it. */
QDOT_MUST_CHECK qdot_status qdot_piece_may_be_low(qdot_piece *x, size_t event, int way, bool *may);
/* (piece-blows.c) Behind blows at one instant: whether those that follow never end, *endless. Then x->start.y is the state
 * to which they lead, and what touches there without speed lasts, as by qdot_piece_rest. Not *known: that was not found. */
QDOT_MUST_CHECK qdot_status qdot_piece_try_blows(qdot_piece *x, bool *endless, bool *known);
/* (piece-puck.c) Where a piece starts in the present mode: pucks that move, but are at rest, are given
 * the speed of their start. *can: friction slows those that are to rest. */
QDOT_MUST_CHECK qdot_status qdot_piece_pucks(qdot_piece *x, bool *can);
/* Mark the discs at rest at the start of a piece in x->side; unless `anew`, only those that have
 * been creeping. */
QDOT_MUST_CHECK qdot_status qdot_piece_stop_pucks(qdot_piece *x, bool anew);

/* (piece-contact.c) The way of its function, in the direction of the run, that event i asks for at the start; 0:
 * either. */
int qdot_piece_way_asked(const qdot_piece *x, size_t i);
/* Where a run starts: whether it has met event i, on whose zero it starts and which the motion goes on
 * to cross, the way that its statement says: an impact that turns it back. */
QDOT_MUST_CHECK qdot_status qdot_piece_meets_at_start(qdot_piece *x, size_t i, bool *meets);
/* Where a piece starts at a switch: whether the motion has left the zero of event i, which changes the state, by less
 * than rounding, and goes on to its other side. */
bool qdot_piece_meets_again(const qdot_piece *x, size_t i);

/* (piece-back.c) In a run back in time, of an event with a `then`: whether it has just occurred at a root of its function,
 * or may have; *way: that of its function before it, as t grows. */
bool qdot_piece_is_undone(qdot_piece *x, const qdot_root *root, int *way);
/* *acts: at the start of a run back in time event i has just occurred: the motion rests on it, or starts behind an
 * impact. */
QDOT_MUST_CHECK qdot_status qdot_piece_undone_at_start(qdot_piece *x, size_t i, bool *acts);
/* Call before undoing an event (backward run): c->reason says if the state before the event is unknown. */
QDOT_MUST_CHECK qdot_status qdot_piece_check_undone(qdot_piece *x, const qdot_root *root);
/* End the run where it starts, with c->reason, if there is an event of which not even the time can be known; whether there
 * is. */
bool qdot_piece_stop_nowhere(qdot_piece *x);

/* After an event has changed the state: contacts that it leaves end; x->pushed of those that it is pushed into;
 * c->reason if it is beyond one. */
QDOT_MUST_CHECK qdot_status qdot_piece_keep_contacts(qdot_piece *x);

/* The rate of function i where the piece starts, near its zero; *noise: what 4 roundings of velocities as large as they
 * have been make of it. */
QDOT_MUST_CHECK qdot_status qdot_piece_rate(qdot_piece *x, size_t i, double *rate, double *noise);
/* The sign to which function i leaves its zero where the piece starts, in the direction of the run, by its rate; 0: the
 * rate may be the rounding of velocities. */
QDOT_MUST_CHECK qdot_status qdot_piece_way(qdot_piece *x, size_t i, int *way);

/* End the run at this point, either as failed or as stopped by an event. */
void qdot_piece_stop(qdot_piece *x, bool failed);
/* End the run here as failed. c->reason becomes `before`, a description of the surface on that
 * side, `behind`. */
void qdot_piece_stop_at(qdot_piece *x, size_t surface, int64_t side, const char *before,
                        const char *behind);

/* After a first step: whether the motion leaves all surfaces towards the sides of its equations.
 * If not, x->side gets other sides and x->doubts the surfaces. */
QDOT_MUST_CHECK qdot_status qdot_piece_leaves_well(qdot_piece *x, bool *well);

/* Whether other sides than the assumed ones might agree equally well with the motion after the start. */
bool qdot_piece_is_open(const qdot_piece *x);
/* Set x->doubts to the surfaces that might also be on other sides. */
QDOT_MUST_CHECK qdot_status qdot_piece_doubt_open(qdot_piece *x);

#endif
