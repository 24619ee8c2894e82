/* mpi.c -- OpenMPI behind pointers. To load it and to begin takes a quarter of a second, which a program
 * that mpirun has not started need not pay. */
#include "parallel/mpi.h"

#include <stdlib.h>

#ifdef HAVE_MPI
#include <dlfcn.h>
#include <mpi.h>
#include <string.h>

#include "base/memory.h"

static const char library[] = "libmpi.so.40"; /* OpenMPI 3 to 5 */

#define FUNCTIONS(X)                                                                     \
    X(Abort)                                                                             \
    X(Allgather) X(Allreduce) X(Comm_rank) X(Comm_set_errhandler) X(Comm_size)           \
        X(Finalize) X(Get_count) X(Init) X(Iprobe) X(Isend) X(Recv) X(Test)

/* Addresses of MPI's functions: MPI_NAME is mpi.NAME. In OpenMPI the constants are addresses in the library, too. */
static struct {
#define X(name) __typeof__(&MPI_##name) name;
    FUNCTIONS(X)
#undef X
    MPI_Comm world;
    MPI_Datatype byte, integer;
    MPI_Op least;
    MPI_Errhandler errors_return;
} mpi;

/* A message that is still being sent to one or more ranks. */
typedef struct {
    size_t references;
    char at[];
} parcel;

typedef struct {
    MPI_Request request;
    parcel *parcel;
} sending;

static qdot_vec(sending) sendings;

/* --- loading the MPI library ------------------------------------------------------------ */

static void *
mpi_find_function(void *handle, const char *name, bool *all)
{
    void *symbol = dlsym(handle, name);

    *all = *all && symbol != NULL;
    return symbol;
}

static qdot_status
load_mpi_library(void)
{
    /* use RTLD_GLOBAL, because the parts that MPI loads later need its symbols */
    void *handle = dlopen(library, RTLD_NOW | RTLD_GLOBAL);
    bool all = true;

    if (handle == NULL) {
        (void)qdot_fail(QDOT_EIO, "MPI cannot be loaded: %.300s", dlerror());
        return qdot_hint("Debian: openmpi-bin");
    }
#define X(name) mpi.name = (__typeof__(mpi.name))mpi_find_function(handle, "MPI_" #name, &all);
    FUNCTIONS(X)
#undef X
    mpi.world = mpi_find_function(handle, "ompi_mpi_comm_world", &all);
    mpi.byte = mpi_find_function(handle, "ompi_mpi_byte", &all);
    mpi.integer = mpi_find_function(handle, "ompi_mpi_int", &all);
    mpi.least = mpi_find_function(handle, "ompi_mpi_op_min", &all);
    mpi.errors_return = mpi_find_function(handle, "ompi_mpi_errors_return", &all);
    return all ? QDOT_OK : qdot_fail(QDOT_EIO, "%s is not OpenMPI's", library);
}

qdot_status
qdot_mpi_begin(size_t *count, size_t *mine)
{
    int n = 1, rank = 0;

    QDOT_TRY(load_mpi_library());
    /* switch off a warning: workers are forked from a rank and send no messages */
    setenv("OMPI_MCA_mpi_warn_on_fork", "0", 0);
    if (mpi.Init(NULL, NULL) != MPI_SUCCESS)
        return qdot_fail(QDOT_EIO, "MPI does not begin");
    mpi.Comm_set_errhandler(mpi.world, mpi.errors_return);
    mpi.Comm_size(mpi.world, &n);
    mpi.Comm_rank(mpi.world, &rank);
    *count = (size_t)n;
    *mine = (size_t)rank;
    return QDOT_OK;
}

void
qdot_mpi_finalize(void)
{
    mpi.Finalize();
}

void
qdot_mpi_abort(int status)
{
    mpi.Abort(mpi.world, status);
    _Exit(status);
}

/* --- operations of all ranks together ---------------------------------------------------- */

void
qdot_mpi_least(int *x)
{
    int least = *x;

    if (mpi.Allreduce(x, &least, 1, mpi.integer, mpi.least, mpi.world) == MPI_SUCCESS)
        *x = least;
}

void
qdot_mpi_gather(const void *bytes, size_t n, void *all)
{
    mpi.Allgather(bytes, (int)n, mpi.byte, all, (int)n, mpi.byte, mpi.world);
}

/* --- sending and receiving messages ----------------------------------------------------- */

static void
free_message(parcel *p)
{
    if (--p->references == 0)
        qdot_free(p);
}

size_t
qdot_mpi_sending(void)
{
    size_t n = 0;

    for (size_t i = 0; i < sendings.n; i++) {
        sending *s = &sendings.at[i];
        int done = 0;

        if (mpi.Test(&s->request, &done, MPI_STATUS_IGNORE) == MPI_SUCCESS && !done)
            sendings.at[n++] = *s;
        else
            free_message(s->parcel);
    }
    return sendings.n = n;
}

void
qdot_mpi_send(size_t first, size_t end, int what, const void *bytes, size_t n)
{
    parcel *p = qdot_malloc(sizeof *p + n);

    if (p == NULL)
        return;
    p->references = 1;
    memcpy(p->at, bytes, n);
    for (size_t to = first; to < end; to++) {
        sending s = {.parcel = p};

        if (qdot_vec_push(&sendings, s) != QDOT_OK)
            break;
        if (mpi.Isend(p->at, (int)n, mpi.byte, (int)to, what, mpi.world, &s.request) ==
            MPI_SUCCESS) {
            sendings.at[sendings.n - 1] = s;
            p->references++;
        } else {
            sendings.n--;
        }
    }
    free_message(p);
    (void)qdot_mpi_sending();
}

static bool
message_has_arrived(int from, int what, MPI_Status *status)
{
    int come = 0;

    return mpi.Iprobe(from, what, mpi.world, &come, status) == MPI_SUCCESS && come;
}

bool
qdot_mpi_look(size_t *from, int *what)
{
    MPI_Status status;

    if (!message_has_arrived(MPI_ANY_SOURCE, MPI_ANY_TAG, &status))
        return false;
    *from = (size_t)status.MPI_SOURCE;
    *what = status.MPI_TAG;
    return true;
}

void
qdot_mpi_take(size_t from, int what, qdot_text *bytes)
{
    MPI_Status status;
    int n = 0;
    char *at;

    qdot_text_truncate(bytes, 0);
    if (!message_has_arrived((int)from, what, &status) ||
        mpi.Get_count(&status, mpi.byte, &n) != MPI_SUCCESS)
        return;
    at = qdot_malloc((size_t)n + 1);
    if (at == NULL) {
        bytes->failed = true;
        return;
    }
    if (mpi.Recv(at, n, mpi.byte, (int)from, what, mpi.world, MPI_STATUS_IGNORE) ==
        MPI_SUCCESS)
        qdot_text_add_n(bytes, at, (size_t)n);
    qdot_free(at);
}

#else /* built without MPI, which is then never started */

qdot_status
qdot_mpi_begin(size_t *count, size_t *mine)
{
    (void)count, (void)mine;
    (void)qdot_fail(QDOT_ENOTBUILT,
                    "this qdot was built without MPI: it cannot be one of several");
    return qdot_hint("configure it where OpenMPI is installed (Debian: libopenmpi-dev)");
}

void
qdot_mpi_finalize(void)
{
}

void
qdot_mpi_abort(int status)
{
    _Exit(status);
}

void
qdot_mpi_least(int *x)
{
    (void)x;
}

void
qdot_mpi_gather(const void *bytes, size_t n, void *all)
{
    (void)bytes, (void)n, (void)all;
}

size_t
qdot_mpi_sending(void)
{
    return 0;
}

void
qdot_mpi_send(size_t first, size_t end, int what, const void *bytes, size_t n)
{
    (void)first, (void)end, (void)what, (void)bytes, (void)n;
}

bool
qdot_mpi_look(size_t *from, int *what)
{
    (void)from, (void)what;
    return false;
}

void
qdot_mpi_take(size_t from, int what, qdot_text *bytes)
{
    (void)from, (void)what, (void)bytes;
}
#endif
