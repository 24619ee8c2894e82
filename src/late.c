/* late.c -- FLINT, Arb, MPFR and GMP, loaded when the first of their functions is called.
 *
 * To load them takes three times as long as a short script: they look up twelve thousand symbols
 * at once (they are linked so, whatever a program asks for). A script that only derives what is
 * seen at a glance needs none of them. So the program is not linked with them but with this file:
 * each of their functions is a jump through a slot, and an empty slot loads the libraries.
 *
 * late.def is made by tools/late of what libqdot.a calls. Data cannot be found late, and
 * none of theirs is used.
 */
#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

static const char *const libraries[] = {
#define LIBRARY(name) name,
#define FUNCTION(number, name)
#include "late.def"
#undef LIBRARY
#undef FUNCTION
};

/* Names of library functions as one text; pointers to them would have to be relocated at every start. */
static const char names[] =
#define LIBRARY(name)
#define FUNCTION(number, name) #name "\0"
#include "late.def"
#undef FUNCTION
    ;

enum {
#define FUNCTION(number, name) LATE_##name = number,
#include "late.def"
#undef FUNCTION
    LATE_COUNT
};

void *qdot_late_slot[LATE_COUNT];
void *qdot_late_find(size_t number);

enum { LIBRARIES = sizeof libraries / sizeof *libraries };
static void *handle[LIBRARIES];

/* End the program with the loader's message, as the system does when a library is missing at the start. */
static __attribute__((noreturn)) void
give_up(void)
{
    fprintf(stderr, "qdot: %s\n", dlerror());
    exit(127);
}

static void *
find_function(const char *name)
{
    for (size_t i = 0; i < LIBRARIES; i++) {
        void *symbol = dlsym(handle[i], name);

        if (symbol != NULL)
            return symbol;
    }
    give_up();
}

static void
load_libraries(void)
{
    const char *name = names;

    for (size_t i = 0; i < LIBRARIES; i++) {
        handle[i] = dlopen(libraries[i], RTLD_LAZY | RTLD_LOCAL);
        if (handle[i] == NULL)
            give_up();
    }
    for (size_t i = 0; i < LATE_COUNT; i++) {
        __atomic_store_n(&qdot_late_slot[i], find_function(name), __ATOMIC_RELEASE);
        while (*name++ != '\0')
            continue;
    }
}

/* Load the libraries; called by a function whose address is not known yet; any thread may be the first. */
__attribute__((used)) void *
qdot_late_find(size_t number)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;

    (void)pthread_once(&once, load_libraries);
    return qdot_late_slot[number];
}

/* What is empty goes on to `empty` with its number in r11, all arguments where they are: in
 * registers and on the stack. There they are kept while the libraries are loaded. */
#define FUNCTION(number, name)                                                           \
    __asm__(".text\n"                                                                    \
            ".p2align 4\n"                                                               \
            ".globl " #name "\n"                                                         \
            ".type " #name ", @function\n" #name ":\n"                                   \
            "    movq qdot_late_slot+8*" #number "(%rip), %r11\n"                        \
            "    testq %r11, %r11\n"                                                     \
            "    jz 1f\n"                                                                \
            "    jmp *%r11\n"                                                            \
            "1:  movl $" #number ", %r11d\n"                                             \
            "    jmp qdot_late_empty\n"                                                  \
            ".size " #name ", .-" #name "\n");
#include "late.def"

__asm__(".text\n"
        ".p2align 4\n"
        ".type qdot_late_empty, @function\n"
        "qdot_late_empty:\n"
        "    .cfi_startproc\n"
        "    pushq %rbp\n"
        "    .cfi_def_cfa_offset 16\n"
        "    .cfi_offset %rbp, -16\n"
        "    movq %rsp, %rbp\n"
        "    .cfi_def_cfa_register %rbp\n"
        "    subq $192, %rsp\n"
        "    andq $-16, %rsp\n"
        "    movq %rdi, 0(%rsp)\n"
        "    movq %rsi, 8(%rsp)\n"
        "    movq %rdx, 16(%rsp)\n"
        "    movq %rcx, 24(%rsp)\n"
        "    movq %r8, 32(%rsp)\n"
        "    movq %r9, 40(%rsp)\n"
        "    movq %rax, 48(%rsp)\n"
        "    movups %xmm0, 64(%rsp)\n"
        "    movups %xmm1, 80(%rsp)\n"
        "    movups %xmm2, 96(%rsp)\n"
        "    movups %xmm3, 112(%rsp)\n"
        "    movups %xmm4, 128(%rsp)\n"
        "    movups %xmm5, 144(%rsp)\n"
        "    movups %xmm6, 160(%rsp)\n"
        "    movups %xmm7, 176(%rsp)\n"
        "    movl %r11d, %edi\n"
        "    call qdot_late_find\n"
        "    movq %rax, %r11\n"
        "    movq 0(%rsp), %rdi\n"
        "    movq 8(%rsp), %rsi\n"
        "    movq 16(%rsp), %rdx\n"
        "    movq 24(%rsp), %rcx\n"
        "    movq 32(%rsp), %r8\n"
        "    movq 40(%rsp), %r9\n"
        "    movq 48(%rsp), %rax\n"
        "    movups 64(%rsp), %xmm0\n"
        "    movups 80(%rsp), %xmm1\n"
        "    movups 96(%rsp), %xmm2\n"
        "    movups 112(%rsp), %xmm3\n"
        "    movups 128(%rsp), %xmm4\n"
        "    movups 144(%rsp), %xmm5\n"
        "    movups 160(%rsp), %xmm6\n"
        "    movups 176(%rsp), %xmm7\n"
        "    leave\n"
        "    .cfi_def_cfa %rsp, 8\n"
        "    jmp *%r11\n"
        "    .cfi_endproc\n"
        ".size qdot_late_empty, .-qdot_late_empty\n");
