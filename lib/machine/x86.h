/* x86.h -- instructions of x86-64 with AVX-512, with AVX2 and FMA or with neither, as bytes: the
 * few that sums of products need.
 *
 * Every instruction is of the form
 *
 *     reg <- f(reg, first, rm),   rm a register or a place in memory
 *
 * with vector registers 0 ... 31 (AVX2: 0 ... 15), whose lowest double a scalar instruction
 * means. A store has what it stores in `reg` and its place in `rm`. The kinds differ in the
 * number and the width of registers, and in how lanes are masked; what is written for any by
 * the same calls does the same. SSE2, which every x86-64 has, writes over `reg` and rounds a product
 * before it is added: up to four instructions stand for one, and register 15 is theirs. Writing
 * never fails at once: a buffer that could not grow says so at the end.
 *
 * Source  Intel 64 and IA-32 Architectures Software Developer's Manual 2, 2.3 (VEX), 2.7 (EVEX).
 * Tests   tests/machine/test_x86.c
 */
#ifndef QDOT_MACHINE_X86_H
#define QDOT_MACHINE_X86_H

#include <stdint.h>

#include "base/memory.h"

/* X(ID, map, prefix, opcode, wide): opcode map, mandatory prefix (0 none, 1 66, 2 F3, 3 F2),
 * whether it is of whole vectors. */
#define QDOT_X86_INSTRUCTIONS(X)                                                         \
    X(LOAD, 1, 3, 0x10, false)        /* reg = rm, the rest 0 */                         \
    X(STORE, 1, 3, 0x11, false)       /* rm = reg */                                     \
    X(ADD, 1, 3, 0x58, false)         /* reg = first + rm */                             \
    X(MUL, 1, 3, 0x59, false)                                                            \
    X(SUB, 1, 3, 0x5c, false)                                                            \
    X(DIV, 1, 3, 0x5e, false)         /* reg = first / rm */                             \
    X(ROOT, 1, 3, 0x51, false)        /* reg = sqrt(rm) */                               \
    X(MADD_OVER, 2, 1, 0xa9, false)   /* reg = first reg + rm */                         \
    X(MSUB_OVER, 2, 1, 0xab, false)   /* reg = first reg - rm */                         \
    X(NMADD_OVER, 2, 1, 0xad, false)  /* reg = rm - first reg */                         \
    X(NMSUB_OVER, 2, 1, 0xaf, false)  /* reg = -first reg - rm */                        \
    X(MADD, 2, 1, 0xb9, false)        /* reg = first rm + reg */                         \
    X(MSUB, 2, 1, 0xbb, false)        /* reg = first rm - reg */                         \
    X(NMADD, 2, 1, 0xbd, false)       /* reg = reg - first rm */                         \
    X(NMSUB, 2, 1, 0xbf, false)       /* reg = -first rm - reg */                        \
    X(LOAD_ALL, 1, 1, 0x10, true)                                                        \
    X(STORE_ALL, 1, 1, 0x11, true)                                                       \
    X(MUL_ALL, 1, 1, 0x59, true)                                                         \
    X(ADD_ALL, 1, 1, 0x58, true)                                                         \
    X(SUB_ALL, 1, 1, 0x5c, true)                                                         \
    X(MADD_ALL, 2, 1, 0xb8, true)     /* reg = first rm + reg */                         \
    X(NMADD_ALL, 2, 1, 0xbc, true)    /* reg = reg - first rm */                         \
    X(SPREAD, 2, 1, 0x19, true)       /* reg = the double rm in every lane */            \
    X(XOR_ALL, 1, 1, 0xef, true)      /* reg = first xor rm: 0 of one with itself */       \
    X(AND_ALL, 1, 1, 0xdb, true)      /* reg = first and rm */                           \
    X(ALIGN, 3, 1, 0x03, true)        /* AVX-512: reg = the lanes of rm, then first, from  \
                                         the one that is said on */                      \
    X(PERMUTE, 3, 1, 0x01, true)      /* reg = the lanes of rm that two bits each name */  \
    X(HALVES, 3, 1, 0x06, true)       /* AVX2: reg = halves of first and rm, of 0 */      \
    X(PAIRS, 1, 1, 0xc6, true)        /* reg = of each pair of lanes one of first, then rm */

enum { QDOT_X86_SCRATCH = 15 }; /* of SSE2 */

typedef enum {
#define X(ID, map, prefix, opcode, wide) QDOT_X86_##ID,
    QDOT_X86_INSTRUCTIONS(X)
#undef X
        QDOT_X86_COUNT
} qdot_x86_name;

/* General registers that hold addresses. */
typedef enum {
    QDOT_X86_RAX = 0,
    QDOT_X86_RCX = 1,
    QDOT_X86_RDX = 2,
    QDOT_X86_RBX = 3,
    QDOT_X86_RBP = 5,
    QDOT_X86_RSI = 6,
    QDOT_X86_RDI = 7,
    QDOT_X86_R8 = 8,
    QDOT_X86_R9 = 9,
    QDOT_X86_R10 = 10,
    QDOT_X86_R11 = 11,
    QDOT_X86_R12 = 12, /* no address of an operand */
    QDOT_X86_R13 = 13,
    QDOT_X86_R14 = 14,
    QDOT_X86_R15 = 15
} qdot_x86_base;

/* A register, or a place in memory; of that one double may stand for every lane. */
typedef struct {
    bool memory, spread;
    int reg; /* or base */
    int32_t offset;
} qdot_x86_rm;

typedef struct {
    qdot_vec(unsigned char) bytes;
    qdot_status status;
    unsigned char nowhere[16]; /* what is written after a failure */
    int mask; /* of the instructions that follow; 0: none */
    bool zeroing; /* what it leaves out becomes 0, else stays */
    bool far;     /* every offset takes four bytes: like instructions are equally long */
    bool narrow;  /* by AVX2 and FMA: whole vectors are of 4 doubles, no masks */
    bool sse2;    /* narrow, and by neither: of 2 doubles */
} qdot_x86;

/* Whether code of any kind runs here at all; then what that of this processor has (num/kinds.h): 2
 * AVX-512, 1 AVX2 and FMA, 0 SSE2. */
bool qdot_x86_is_here(void);
size_t qdot_x86_kind(void);
/* Nothing is written yet, for a kind. Its vectors, in doubles, and their registers. */
static inline qdot_x86
qdot_x86_of(size_t kind)
{
    return (qdot_x86){.narrow = kind < 2, .sse2 = kind < 1};
}

static inline int
qdot_x86_lanes(const qdot_x86 *x)
{
    return x->sse2 ? 2 : x->narrow ? 4 : 8;
}

static inline int
qdot_x86_registers(const qdot_x86 *x)
{
    return x->sse2 ? QDOT_X86_SCRATCH : x->narrow ? 16 : 32;
}

static inline qdot_x86_rm
qdot_x86_reg(int reg)
{
    return (qdot_x86_rm){.reg = reg};
}

static inline qdot_x86_rm
qdot_x86_at(qdot_x86_base base, int32_t offset)
{
    return (qdot_x86_rm){.memory = true, .reg = base, .offset = offset};
}

void qdot_x86_emit(qdot_x86 *x, qdot_x86_name name, int reg, int first, qdot_x86_rm rm);
/* One that is told by a byte more how lanes go. */
void qdot_x86_move_lanes(qdot_x86 *x, qdot_x86_name name, int reg, int first, qdot_x86_rm rm,
                         int how);
/* Mask register m (1 ... 7) = lanes, a bit each. */
void qdot_x86_set_mask(qdot_x86 *x, int m, unsigned lanes);
/* Mask register m takes on the lanes of `more`; it moves up by a lane. */
void qdot_x86_join_masks(qdot_x86 *x, int m, int more);
void qdot_x86_raise_mask(qdot_x86 *x, int m);
/* to = from + offset */
void qdot_x86_address(qdot_x86 *x, qdot_x86_base to, qdot_x86_base from, int32_t offset);
/* What stands between the two is run `times`, at least once; returns its place. Not one in
 * another. _repeat_as: as often as the 32 bits at that place say, when it is run. */
size_t qdot_x86_repeat(qdot_x86 *x, int times);
size_t qdot_x86_repeat_as(qdot_x86 *x, qdot_x86_rm times);
/* Right behind _repeat_as: return if that number is 0. The loop begins behind it. */
void qdot_x86_return_if_none(qdot_x86 *x);
void qdot_x86_again(qdot_x86 *x, size_t from);
/* What begins at that place, or at an address, is run up to its end, _leave. A place as an
 * address. Registers that a caller wants back (rbx, rbp, r12 ... r15) are kept and restored,
 * last in, first out. */
void qdot_x86_enter(qdot_x86 *x, size_t place);
void qdot_x86_enter_at(qdot_x86 *x, qdot_x86_base at);
void qdot_x86_leave(qdot_x86 *x);
void qdot_x86_place(qdot_x86 *x, qdot_x86_base to, size_t place);
void qdot_x86_push(qdot_x86 *x, qdot_x86_base reg);
void qdot_x86_pop(qdot_x86 *x, qdot_x86_base reg);
void qdot_x86_return(qdot_x86 *x);
/* A C function is called; what the code was run with (rdi, rsi, rdx) is there again after it,
 * vector registers are not. Between _frame and _unframe, the latter before the return. */
void qdot_x86_frame(qdot_x86 *x);
void qdot_x86_call(qdot_x86 *x, void (*function)(void));
void qdot_x86_unframe(qdot_x86 *x);

#endif
