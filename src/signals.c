/* signals.c -- Ctrl-C: stops a computation, clears a line, ends a script at the second
 * try. A write beyond the limit of file sizes is an error and does not end the program. */
#include "signals.h"

#include <signal.h>
#include <stddef.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/process.h"

static volatile sig_atomic_t computing = 1, patient;

static void
handle_interrupt(int signal_number)
{
    if (computing && qdot_interrupt_flag && patient) {
        static const char text[] = "stopping soon (Ctrl-\\ ends qdot)\n";

        if (write(STDERR_FILENO, text, sizeof text - 1) < 0)
            return; /* stderr is closed: nothing else to do */
        return;
    }
    if (computing && qdot_interrupt_flag) {
        /* a second Ctrl-C before the first one was handled ends the program */
        signal(signal_number, SIG_DFL);
        raise(signal_number);
        return;
    }
    qdot_interrupt_set();
}

void
qdot_signals_install(void)
{
    struct sigaction action = {.sa_handler = handle_interrupt};

    /* no SA_RESTART, so that calls that wait for input or for gnuplot return */
    sigemptyset(&action.sa_mask);
    if (qdot_rank() > 0)
        action.sa_handler = SIG_IGN; /* ignore Ctrl-C in other ranks, as rank 0 ends this process */
    sigaction(SIGINT, &action, NULL);
    signal(SIGXFSZ, SIG_IGN); /* writing too large a file then fails with EFBIG */
    if (qdot_rank() == 0 && qdot_ranks_count() > 1)
        sigaction(SIGTERM, &action, NULL); /* handle SIGTERM: mpirun sends it to end all ranks, then waits one second */
}

void
qdot_signals_computing(void)
{
    qdot_interrupt_clear();
    computing = 1;
}

void
qdot_signals_patient(bool on)
{
    patient = on;
}

void
qdot_signals_waiting(void)
{
    computing = 0;
}

bool
qdot_signals_take(void)
{
    bool came = qdot_interrupt_flag != 0;

    qdot_interrupt_clear();
    return came;
}
