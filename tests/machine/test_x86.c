/* test_x86.c -- bytes of instructions as GNU as writes them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "machine/x86.h"

static void
one(qdot_asm *m, qdot_asm_operation op, int reg, int first, qdot_operand b)
{
    qdot_asm_do(m, op, QDOT_ASM_ONE, reg, first, b);
}

static void
all(qdot_asm *m, qdot_asm_operation op, int reg, int first, qdot_operand b)
{
    qdot_asm_do(m, op, QDOT_ASM_ALL, reg, first, b);
}

/* One instruction of each kind of operand; masks as the row says. */
static void
instructions_have_their_bytes(void **state)
{
    enum { DI = QDOT_ASM_ROWS, SI = QDOT_ASM_CONSTANTS, DX = QDOT_ASM_WORK };
    static const struct {
        int name;
        bool wide;
        int reg, first;
        qdot_operand rm;
        int mask, from; /* from: of an alignment, else -1 */
        bool zeroing;
        const char *text;
        size_t n;
        const char *bytes;
    } rows[] = {
        {QDOT_ASM_LOAD, false, 4, 0, {true, false, DI, 0x18}, 0, -1, false,
         "vmovsd 0x18(%rdi),%xmm4", 7, "\x62\xf1\xff\x08\x10\x67\x03"},
        {QDOT_ASM_STORE, false, 17, 0, {true, false, SI, 0x1000}, 0, -1, false,
         "vmovsd %xmm17,0x1000(%rsi)", 10, "\x62\xe1\xff\x08\x11\x8e\x00\x10\x00\x00"},
        {QDOT_ASM_ADD, false, 5, 10, {false, false, 19, 0}, 0, -1, false,
         "vaddsd %xmm19,%xmm10,%xmm5", 6, "\x62\xb1\xaf\x08\x58\xeb"},
        {QDOT_ASM_SUB, false, 16, 31, {true, false, DX, 8}, 0, -1, false,
         "vsubsd 0x8(%rdx),%xmm31,%xmm16", 7, "\x62\xe1\x87\x00\x5c\x42\x01"},
        {QDOT_ASM_MUL, false, 9, 1, {true, false, DI, -0x400}, 0, -1, false,
         "vmulsd -0x400(%rdi),%xmm1,%xmm9", 7, "\x62\x71\xf7\x08\x59\x4f\x80"},
        {QDOT_ASM_MADD, false, 24, 7, {false, false, 31, 0}, 0, -1, false,
         "vfmadd231sd %xmm31,%xmm7,%xmm24", 6, "\x62\x02\xc5\x08\xb9\xc7"},
        {QDOT_ASM_NMADD_OVER, false, 3, 20, {true, false, DX, 0x408}, 0, -1, false,
         "vfnmadd213sd 0x408(%rdx),%xmm20,%xmm3", 10,
         "\x62\xf2\xdd\x00\xad\x9a\x08\x04\x00\x00"},
        {QDOT_ASM_MADD, true, 18, 30, {true, true, DI, 0x123458}, 0, -1, false,
         "vfmadd231pd 0x123458(%rdi){1to8},%zmm30,%zmm18", 10,
         "\x62\xe2\x8d\x50\xb8\x97\x58\x34\x12\x00"},
        {QDOT_ASM_MADD, true, 0, 2, {true, false, DX, 0x40}, 2, -1, false,
         "vfmadd231pd 0x40(%rdx),%zmm2,%zmm0{%k2}", 7, "\x62\xf2\xed\x4a\xb8\x42\x01"},
        {QDOT_ASM_MUL, true, 0, 2, {true, false, DX, 0x88}, 0, -1, false,
         "vmulpd 0x88(%rdx),%zmm2,%zmm0", 10, "\x62\xf1\xed\x48\x59\x82\x88\x00\x00\x00"},
        {QDOT_ASM_SPREAD, true, 29, 0, {true, false, DI, 0x30}, 1, -1, false,
         "vbroadcastsd 0x30(%rdi),%zmm29{%k1}", 7, "\x62\x62\xfd\x49\x19\x6f\x06"},
        {QDOT_ASM_STORE, true, 0, 0, {true, false, DX, 0xc0}, 0, -1, false,
         "vmovupd %zmm0,0xc0(%rdx)", 7, "\x62\xf1\xfd\x48\x11\x42\x03"},
        {QDOT_ASM_DIV, false, 4, 18, {true, false, DX, 0x28}, 0, -1, false,
         "vdivsd 0x28(%rdx),%xmm18,%xmm4", 7, "\x62\xf1\xef\x00\x5e\x62\x05"},
        {QDOT_ASM_ROOT, false, 6, 20, {false, false, 20, 0}, 0, -1, false,
         "vsqrtsd %xmm20,%xmm20,%xmm6", 6, "\x62\xb1\xdf\x00\x51\xf4"},
        {QDOT_X86_XOR, true, 17, 17, {false, false, 17, 0}, 0, -1, false,
         "vpxorq %zmm17,%zmm17,%zmm17", 6, "\x62\xa1\xf5\x40\xef\xc9"},
        {QDOT_ASM_ADD, false, 1, 20, {true, false, QDOT_ASM_PARTNER, 0x10}, 0, -1, false,
         "vaddsd 0x10(%r8),%xmm20,%xmm1", 7, "\x62\xd1\xdf\x00\x58\x48\x02"},
        {QDOT_ASM_MUL, false, 19, 20, {true, false, QDOT_ASM_ROWS_NOW, -0x320}, 0, -1, false,
         "vmulsd -0x320(%r9),%xmm20,%xmm19", 7, "\x62\xc1\xdf\x00\x59\x59\x9c"},
        {QDOT_X86_ALIGN, true, 8, 8, {false, false, 8, 0}, 3, 1, true,
         "valignq $1,%zmm8,%zmm8,%zmm8{%k3}{z}", 7, "\x62\x53\xbd\xcb\x03\xc0\x01"},
        {QDOT_X86_ALIGN, true, 0, 23, {true, false, DX, 0x80}, 0, 1, false,
         "valignq $1,0x80(%rdx),%zmm23,%zmm0", 8, "\x62\xf3\xc5\x40\x03\x42\x02\x01"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        qdot_asm x = {.kind = 2, .mask = rows[i].mask, .zeroing = rows[i].zeroing};

        if (rows[i].from >= 0)
            qdot_x86_move_lanes(&x, rows[i].name, rows[i].reg, rows[i].first, rows[i].rm,
                                rows[i].from);
        else
            qdot_x86_emit(&x, rows[i].name, rows[i].wide, rows[i].reg, rows[i].first, rows[i].rm);
        assert_int_equal(x.status, QDOT_OK);
        if (x.bytes.n != rows[i].n || memcmp(x.bytes.at, rows[i].bytes, rows[i].n) != 0)
            fail_msg("%s is written otherwise", rows[i].text);
        qdot_free(x.bytes.at);
    }
}

static void
masks_and_the_end_have_theirs(void **state)
{
    static const unsigned char bytes[] = {0xb8, 0x7f, 0,    0,    0,    0xc5, 0xf8,
                                          0x92, 0xd8, 0xc5, 0xf8, 0x77, 0xc3};
    qdot_asm x = {.kind = 2};

    (void)state;
    qdot_x86_set_mask(&x, 3, 0x7f);
    qdot_asm_return(&x);
    assert_int_equal(x.bytes.n, sizeof bytes);
    assert_memory_equal(x.bytes.at, bytes, sizeof bytes);
    qdot_free(x.bytes.at);
}

static void
loops_have_theirs(void **state)
{
    static const unsigned char bytes[] = {
        0x4c, 0x8d, 0x87, 0x20, 0,    0,    0,    /* lea 0x20(%rdi),%r8 */
        0x4d, 0x8d, 0x89, 8,    0,    0,    0,    /* lea 8(%r9),%r9 */
        0x8b, 0x8a, 0x40, 1,    0,    0,          /* mov 0x140(%rdx),%ecx */
        0xb9, 7,    0,    0,    0,                /* mov $7,%ecx */
        0xc5, 0xec, 0x45, 0xd1,                   /* korw %k1,%k2,%k2 */
        0xc4, 0xe3, 0xf9, 0x32, 0xc9, 1,          /* kshiftlw $1,%k1,%k1 */
        0xff, 0xc9,                               /* dec %ecx */
        0x0f, 0x85, 0xee, 0xff, 0xff, 0xff        /* jne */
    };
    qdot_asm x = {.kind = 2};
    size_t from;

    (void)state;
    qdot_asm_set(&x, QDOT_ASM_PARTNER, QDOT_ASM_ROWS, 0x20);
    qdot_asm_set(&x, QDOT_ASM_ROWS_NOW, QDOT_ASM_ROWS_NOW, 8);
    qdot_asm_repeat_as(&x, qdot_asm_at(QDOT_ASM_WORK, 0x140));
    from = qdot_asm_repeat(&x, 7);
    qdot_x86_join_masks(&x, 2, 1);
    qdot_x86_raise_mask(&x, 1);
    qdot_asm_again(&x, from);
    assert_int_equal(x.bytes.n, sizeof bytes);
    assert_memory_equal(x.bytes.at, bytes, sizeof bytes);
    qdot_free(x.bytes.at);
}

/* Whole vectors, of eight doubles and of four. */
static void
vectors_of_both_widths_have_theirs(void **state)
{
    static const unsigned char bytes[] = {
        0x62, 0xe1, 0xe5, 0x48, 0x58, 0x67, 1,          /* vaddpd 0x40(%rdi),%zmm3,%zmm20 */
        0x62, 0x81, 0xe5, 0x48, 0x5c, 0xe7,             /* vsubpd %zmm31,%zmm3,%zmm20 */
        0x62, 0xf2, 0xb5, 0x48, 0xbc, 0x4d, 2,          /* vfnmadd231pd 0x80(%rbp),... */
        0x62, 0xf1, 0xfd, 0x48, 0x10, 0xa0, 0x40, 0, 0, 0, /* vmovupd 0x40(%rax),%zmm4 */
        0xc4, 0x61, 0xfd, 0x10, 0x4f, 0x20,             /* vmovupd 0x20(%rdi),%ymm9 */
        0xc4, 0xe1, 0xfd, 0x11, 0x42, 0x80,             /* vmovupd %ymm0,-0x80(%rdx) */
        0xc4, 0x41, 0xe5, 0x58, 0xd4,                   /* vaddpd %ymm12,%ymm3,%ymm10 */
        0xc4, 0xc1, 0xe5, 0x59, 0xad, 0, 1, 0, 0,       /* vmulpd 0x100(%r13),... */
        0xc4, 0x42, 0xc5, 0xb8, 0x40, 0x48,             /* vfmadd231pd 0x48(%r8),... */
        0xc4, 0x42, 0x8d, 0xbc, 0xef,                   /* vfnmadd231pd %ymm15,... */
        0xc4, 0x62, 0x7d, 0x19, 0x5b, 0x30,             /* vbroadcastsd 0x30(%rbx),%ymm11 */
        0xc4, 0xe1, 0xdd, 0xef, 0xe4                    /* vpxor %ymm4,%ymm4,%ymm4 */
    };
    const qdot_asm_base di = QDOT_ASM_ROWS;
    qdot_asm x = {.kind = 2};

    (void)state;
    all(&x, QDOT_ASM_ADD, 20, 3, qdot_asm_at(di, 0x40));
    all(&x, QDOT_ASM_SUB, 20, 3, qdot_asm_in(31));
    all(&x, QDOT_ASM_NMADD, 1, 9, qdot_asm_at(QDOT_ASM_ROWS_HALF, 0x80));
    x.far = true;
    all(&x, QDOT_ASM_LOAD, 4, 0, qdot_asm_at(QDOT_ASM_FACTOR, 0x40));
    x.far = false;
    x.kind = 1;
    all(&x, QDOT_ASM_LOAD, 9, 0, qdot_asm_at(di, 0x20));
    all(&x, QDOT_ASM_STORE, 0, 0, qdot_asm_at(QDOT_ASM_WORK, -0x80));
    all(&x, QDOT_ASM_ADD, 10, 3, qdot_asm_in(12));
    all(&x, QDOT_ASM_MUL, 5, 3, qdot_asm_at(QDOT_ASM_SECOND_PARTNER, 0x100));
    all(&x, QDOT_ASM_MADD, 8, 7, qdot_asm_at(QDOT_ASM_PARTNER, 0x48));
    all(&x, QDOT_ASM_NMADD, 13, 14, qdot_asm_in(15));
    all(&x, QDOT_ASM_SPREAD, 11, 0, qdot_asm_at(QDOT_ASM_CONSTANTS_NOW, 0x30));
    qdot_asm_clear(&x, 4);
    assert_int_equal(x.bytes.n, sizeof bytes);
    assert_memory_equal(x.bytes.at, bytes, sizeof bytes);
    qdot_free(x.bytes.at);
}

/* Single numbers and lanes, by AVX2. */
static void
narrow_instructions_have_theirs(void **state)
{
    static const unsigned char bytes[] = {
        0xc4, 0xe1, 0xfb, 0x10, 0x67, 0x18,          /* vmovsd 0x18(%rdi),%xmm4 */
        0xc4, 0x61, 0xfb, 0x11, 0x8e, 0, 0x10, 0, 0, /* vmovsd %xmm9,0x1000(%rsi) */
        0xc4, 0x42, 0xc1, 0xb9, 0x60, 0xf8,          /* vfmadd231sd -8(%r8),%xmm7,%xmm12 */
        0xc4, 0xc1, 0x8b, 0x51, 0xf6,                /* vsqrtsd %xmm14,%xmm14,%xmm6 */
        0xc4, 0xe1, 0xd5, 0xdb, 0x4f, 0x28,          /* vpand 0x28(%rdi),%ymm5,%ymm1 */
        0xc4, 0xe3, 0xfd, 0x01, 0xed, 0x90           /* vpermpd $0x90,%ymm5,%ymm5 */
    };
    qdot_asm x = {.kind = 1};

    (void)state;
    one(&x, QDOT_ASM_LOAD, 4, 0, qdot_asm_at(QDOT_ASM_ROWS, 0x18));
    one(&x, QDOT_ASM_STORE, 9, 0, qdot_asm_at(QDOT_ASM_CONSTANTS, 0x1000));
    one(&x, QDOT_ASM_MADD, 12, 7, qdot_asm_at(QDOT_ASM_PARTNER, -8));
    one(&x, QDOT_ASM_ROOT, 6, 14, qdot_asm_in(14));
    qdot_x86_emit(&x, QDOT_X86_AND, true, 1, 5, qdot_asm_at(QDOT_ASM_ROWS, 0x28));
    qdot_x86_move_lanes(&x, QDOT_X86_PERMUTE, 5, 0, qdot_asm_in(5), 0x90);
    assert_int_equal(x.bytes.n, sizeof bytes);
    assert_memory_equal(x.bytes.at, bytes, sizeof bytes);
    qdot_free(x.bytes.at);
}

/* By SSE2 one stands for up to four that write over what they read. */
static void
instructions_of_two_operands_have_theirs(void **state)
{
    static const unsigned char bytes[] = {
        0xf2, 0x0f, 0x10, 0x67, 0x18,                /* movsd 0x18(%rdi),%xmm4 */
        0xf2, 0x44, 0x0f, 0x11, 0x8e, 0, 0x10, 0, 0, /* movsd %xmm9,0x1000(%rsi) */
        0x66, 0x41, 0x0f, 0x10, 0xdc,                /* movupd %xmm12,%xmm3 */
        0xf2, 0x41, 0x0f, 0x58, 0x68, 0x08,          /* addsd 0x8(%r8),%xmm5 */
        0x66, 0x0f, 0x10, 0xee,                      /* movupd %xmm6,%xmm5 */
        0xf2, 0x0f, 0x59, 0xef,                      /* mulsd %xmm7,%xmm5 */
        0x66, 0x44, 0x0f, 0x10, 0xfe,                /* movupd %xmm6,%xmm15 */
        0x66, 0x0f, 0x10, 0xf5,                      /* movupd %xmm5,%xmm6 */
        0xf2, 0x41, 0x0f, 0x5c, 0xf7,                /* subsd %xmm15,%xmm6 */
        0xf2, 0x45, 0x0f, 0x10, 0x78, 0xf8,          /* movsd -0x8(%r8),%xmm15 */
        0xf2, 0x44, 0x0f, 0x59, 0xff,                /* mulsd %xmm7,%xmm15 */
        0xf2, 0x45, 0x0f, 0x58, 0xe7,                /* addsd %xmm15,%xmm12 */
        0x66, 0x45, 0x0f, 0x10, 0xf8,                /* movupd %xmm8,%xmm15 */
        0xf2, 0x44, 0x0f, 0x59, 0xff,                /* mulsd %xmm7,%xmm15 */
        0xf2, 0x45, 0x0f, 0x5c, 0xfc,                /* subsd %xmm12,%xmm15 */
        0x66, 0x45, 0x0f, 0x10, 0xe7,                /* movupd %xmm15,%xmm12 */
        0xf2, 0x0f, 0x59, 0xdc,                      /* mulsd %xmm4,%xmm3 */
        0x66, 0x44, 0x0f, 0x10, 0xfd,                /* movupd %xmm5,%xmm15 */
        0xf2, 0x44, 0x0f, 0x5c, 0xfb,                /* subsd %xmm3,%xmm15 */
        0x66, 0x41, 0x0f, 0x10, 0xdf,                /* movupd %xmm15,%xmm3 */
        0xf2, 0x0f, 0x59, 0xdc,                      /* mulsd %xmm4,%xmm3 */
        0xf2, 0x0f, 0x5c, 0xdd,                      /* subsd %xmm5,%xmm3 */
        0x66, 0x45, 0x0f, 0x10, 0xf8,                /* movupd %xmm8,%xmm15 */
        0xf2, 0x44, 0x0f, 0x59, 0xff,                /* mulsd %xmm7,%xmm15 */
        0xf2, 0x45, 0x0f, 0x58, 0xe7,                /* addsd %xmm15,%xmm12 */
        0x66, 0x45, 0x0f, 0xef, 0xff,                /* pxor %xmm15,%xmm15 */
        0xf2, 0x45, 0x0f, 0x5c, 0xfc,                /* subsd %xmm12,%xmm15 */
        0x66, 0x45, 0x0f, 0x10, 0xe7,                /* movupd %xmm15,%xmm12 */
        0x66, 0x44, 0x0f, 0x10, 0x7a, 0x28,          /* movupd 0x28(%rdx),%xmm15 */
        0x66, 0x44, 0x0f, 0x59, 0xfb,                /* mulpd %xmm3,%xmm15 */
        0x66, 0x41, 0x0f, 0x5c, 0xc7,                /* subpd %xmm15,%xmm0 */
        0xf2, 0x41, 0x0f, 0x51, 0xf6,                /* sqrtsd %xmm14,%xmm6 */
        0xf2, 0x44, 0x0f, 0x10, 0x5b, 0x30,          /* movsd 0x30(%rbx),%xmm11 */
        0x66, 0x45, 0x0f, 0xc6, 0xdb, 0,             /* shufpd $0,%xmm11,%xmm11 */
        0x66, 0x44, 0x0f, 0x10, 0x7f, 0x28,          /* movupd 0x28(%rdi),%xmm15 */
        0x66, 0x0f, 0x10, 0xcd,                      /* movupd %xmm5,%xmm1 */
        0x66, 0x41, 0x0f, 0xdb, 0xcf,                /* pand %xmm15,%xmm1 */
        0x66, 0x41, 0x0f, 0xc6, 0xc1, 0x01,          /* shufpd $1,%xmm9,%xmm0 */
        0xc3                                         /* ret */
    };
    const qdot_asm_base di = QDOT_ASM_ROWS, r8 = QDOT_ASM_PARTNER;
    qdot_asm x = {.kind = 0};

    (void)state;
    one(&x, QDOT_ASM_LOAD, 4, 0, qdot_asm_at(di, 0x18));
    one(&x, QDOT_ASM_STORE, 9, 0, qdot_asm_at(QDOT_ASM_CONSTANTS, 0x1000));
    one(&x, QDOT_ASM_LOAD, 3, 12, qdot_asm_in(12));
    one(&x, QDOT_ASM_ADD, 5, 5, qdot_asm_at(r8, 8));
    one(&x, QDOT_ASM_MUL, 5, 6, qdot_asm_in(7));
    one(&x, QDOT_ASM_SUB, 6, 5, qdot_asm_in(6));
    one(&x, QDOT_ASM_MADD, 12, 7, qdot_asm_at(r8, -8));
    one(&x, QDOT_ASM_MSUB, 12, 7, qdot_asm_in(8));
    one(&x, QDOT_ASM_NMADD_OVER, 3, 4, qdot_asm_in(5));
    one(&x, QDOT_ASM_MSUB_OVER, 3, 4, qdot_asm_in(5));
    one(&x, QDOT_ASM_NMSUB, 12, 7, qdot_asm_in(8));
    all(&x, QDOT_ASM_NMADD, 0, 3, qdot_asm_at(QDOT_ASM_WORK, 0x28));
    one(&x, QDOT_ASM_ROOT, 6, 14, qdot_asm_in(14));
    all(&x, QDOT_ASM_SPREAD, 11, 0, qdot_asm_at(QDOT_ASM_CONSTANTS_NOW, 0x30));
    qdot_x86_emit(&x, QDOT_X86_AND, true, 1, 5, qdot_asm_at(di, 0x28));
    qdot_x86_move_lanes(&x, QDOT_X86_PAIRS, 0, 0, qdot_asm_in(9), 1);
    qdot_asm_return(&x);
    assert_int_equal(x.bytes.n, sizeof bytes);
    assert_memory_equal(x.bytes.at, bytes, sizeof bytes);
    qdot_free(x.bytes.at);
}

static void
sequences_have_theirs(void **state)
{
    static const unsigned char bytes[] = {
        0xc3,                                     /* ret */
        0x40, 0x53, 0x40, 0x55, 0x41, 0x54,       /* push %rbx, %rbp, %r12, */
        0x41, 0x55, 0x41, 0x56, 0x41, 0x57,       /* %r13, %r14, %r15 */
        0x4c, 0x8d, 0x1d, 0xec, 0xff, 0xff, 0xff, /* lea -20(%rip),%r11 */
        0x41, 0xff, 0xd3,                         /* call *%r11 */
        0xe8, 0xe4, 0xff, 0xff, 0xff,             /* call -28 */
        0x41, 0x5f, 0x41, 0x5e, 0x41, 0x5d,       /* pop %r15, %r14, %r13, */
        0x41, 0x5c, 0x40, 0x5d, 0x40, 0x5b        /* %r12, %rbp, %rbx */
    };
    qdot_asm x = {.kind = 2};

    (void)state;
    qdot_asm_leave(&x);
    qdot_asm_save(&x);
    qdot_asm_set_code(&x, QDOT_ASM_TERMS, 0);
    qdot_asm_enter_at(&x, QDOT_ASM_TERMS);
    qdot_asm_enter(&x, 0);
    qdot_asm_restore(&x);
    assert_int_equal(x.bytes.n, sizeof bytes);
    assert_memory_equal(x.bytes.at, bytes, sizeof bytes);
    qdot_free(x.bytes.at);
}

/* Least recently used first, but none that is taken. */
static void
registers_go_by_their_last_use(void **state)
{
    qdot_asm m = {.kind = 2};

    (void)state;
    m.taken[6] = true;
    assert_int_equal(qdot_asm_fresh(&m, 4, 8), 4);
    assert_int_equal(qdot_asm_fresh(&m, 4, 8), 5);
    qdot_asm_use(&m, 4);
    assert_int_equal(qdot_asm_fresh(&m, 4, 8), 7);
    assert_int_equal(qdot_asm_fresh(&m, 4, 8), 5);
    m.taken[6] = false;
    assert_int_equal(qdot_asm_fresh(&m, 4, 8), 6);
    assert_int_equal(qdot_asm_fresh(&m, 4, 8), 4);
}

static void
nothing(void)
{
}

static void
calls_have_theirs(void **state)
{
    static const unsigned char before[] = {0x57, 0x56, 0x52, /* push %rdi, %rsi, %rdx */
                                           0x48, 0xb8 /* movabs $..., %rax */};
    static const unsigned char after[] = {
        0xff, 0xd0,                   /* call *%rax */
        0x48, 0x8b, 0x7c, 0x24, 0x10, /* mov 16(%rsp),%rdi */
        0x48, 0x8b, 0x74, 0x24, 0x08, /* mov 8(%rsp),%rsi */
        0x48, 0x8b, 0x14, 0x24,       /* mov (%rsp),%rdx */
        0x48, 0x83, 0xc4, 0x18        /* add $24,%rsp */
    };
    const uint64_t address = (uint64_t)(uintptr_t)nothing;
    qdot_asm x = {.kind = 2};

    (void)state;
    qdot_asm_frame(&x);
    qdot_asm_call(&x, nothing);
    qdot_asm_unframe(&x);
    assert_int_equal(x.bytes.n, sizeof before + sizeof address + sizeof after);
    assert_memory_equal(x.bytes.at, before, sizeof before);
    for (size_t i = 0; i < sizeof address; i++)
        assert_int_equal(x.bytes.at[sizeof before + i], address >> 8 * i & 0xff);
    assert_memory_equal(x.bytes.at + sizeof before + sizeof address, after, sizeof after);
    qdot_free(x.bytes.at);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(instructions_have_their_bytes),
        cmocka_unit_test(masks_and_the_end_have_theirs),
        cmocka_unit_test(loops_have_theirs),
        cmocka_unit_test(vectors_of_both_widths_have_theirs),
        cmocka_unit_test(narrow_instructions_have_theirs),
        cmocka_unit_test(instructions_of_two_operands_have_theirs),
        cmocka_unit_test(sequences_have_theirs),
        cmocka_unit_test(calls_have_theirs),
        cmocka_unit_test(registers_go_by_their_last_use),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
