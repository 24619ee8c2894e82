/* status.h -- how everything in qdot fails.
 *
 * Every function that can fail returns a qdot_status; every failure passes through
 * qdot_fail(), which records the message for the calling thread, so one breakpoint
 * catches them all. A caller passes a status on with QDOT_TRY. Nothing in lib/ exits,
 * prints or jumps.
 *
 * Undefined (log 0), undecided (no proof) and failed (no memory, interrupted) are three
 * different things: QDOT_EDOMAIN; a verdict, never a status; QDOT_ENOMEM, QDOT_EINTR.
 */
#ifndef QDOT_BASE_STATUS_H
#define QDOT_BASE_STATUS_H

#include <stdbool.h>
#include <stddef.h>

typedef enum {
    QDOT_OK = 0,
    QDOT_EINVAL,    /* an argument that makes no sense */
    QDOT_ESYNTAX,   /* text that is not in the language */
    QDOT_ENAME,     /* a name that is unknown, or taken */
    QDOT_ETYPE,     /* a value of the wrong kind: a vector instead of a number, wrong dimensions */
    QDOT_EDOMAIN,   /* a value that is undefined: 1/0, log 0, outside a declared domain */
    QDOT_EUNSET,    /* a parameter or function without a value */
    QDOT_ESINGULAR, /* a matrix without an inverse */
    QDOT_ELIMIT,    /* something exceeds a limit of work or size that the message states */
    QDOT_EFAILED,   /* a numerical method gave up; the message says where and why */
    QDOT_ENOTBUILT, /* a word of the language that this version does not have */
    QDOT_EIO,       /* a file or pipe cannot be read or written */
    QDOT_ENOMEM,    /* out of memory */
    QDOT_EINTR      /* the user interrupted the computation by Ctrl-C */
} qdot_status;

#define QDOT_MUST_CHECK __attribute__((warn_unused_result))
#define QDOT_PRINTF(f, a) __attribute__((format(printf, f, a)))
#define QDOT_API __attribute__((visibility("default")))

/* Return from the enclosing function with the status of `call`, unless it is QDOT_OK. */
#define QDOT_TRY(call)                                                                   \
    do {                                                                                 \
        qdot_status try_status_ = (call);                                                \
        if (try_status_ != QDOT_OK)                                                      \
            return try_status_;                                                          \
    } while (0)

/* The status if it is a failure after which no other method should be tried (QDOT_ENOMEM,
 * QDOT_EINTR); else QDOT_OK. */
static inline qdot_status
qdot_grave(qdot_status status)
{
    return status == QDOT_ENOMEM || status == QDOT_EINTR ? status : QDOT_OK;
}

/* The last failure of this thread. */
typedef struct {
    qdot_status status;
    char message[512];
    char hint[1024]; /* a hint at what to do about the failure; "" if there is none */
} qdot_error;

/* Record a failure with its message (printf) and no hint; returns `status`. */
qdot_status qdot_fail(qdot_status status, const char *format, ...) QDOT_PRINTF(2, 3);

/* Add a hint (printf) to the failure just recorded; returns that failure's status. */
qdot_status qdot_hint(const char *format, ...) QDOT_PRINTF(1, 2);

/* The last failure of this thread; owned by the thread, valid until the next failure. */
const qdot_error *qdot_last_error(void);

/* Restore a saved failure as the last one; returns its status. */
qdot_status qdot_fail_again(const qdot_error *saved);

#endif
