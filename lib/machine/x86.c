/* x86.c -- the encoding. */
#include "machine/x86.h"

#include <string.h>

#include "num/kinds.h"

static const struct {
    unsigned char map, prefix, opcode;
    bool wide;
} instructions[QDOT_X86_COUNT] = {
#define X(ID, map, prefix, opcode, wide) [QDOT_X86_##ID] = {map, prefix, opcode, wide},
    QDOT_X86_INSTRUCTIONS(X)
#undef X
};

/* No instruction is longer. */
enum { longest = 16 };

/* Room for one more. After a failure they are all written to the same place. */
static unsigned char *
room(qdot_x86 *x)
{
    if (x->status == QDOT_OK && x->bytes.n + longest > x->bytes.capacity)
        x->status = qdot_grow(&x->bytes.at, &x->bytes.capacity, x->bytes.n + longest, 1);
    return x->status == QDOT_OK ? x->bytes.at + x->bytes.n : x->nowhere;
}

static void
written(qdot_x86 *x, const unsigned char *from, const unsigned char *to)
{
    if (x->status == QDOT_OK)
        x->bytes.n += (size_t)(to - from);
}

static unsigned char *
little_endian(unsigned char *at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        *at++ = (unsigned char)(value >> 8 * i);
    return at;
}

/* Bit `at` of a register's number, at place `to` of a byte, inverted as EVEX has it. */
static unsigned
inverted(int reg, int at, int to)
{
    return (unsigned)(~reg >> at & 1) << to;
}

static unsigned char *
prefix(const qdot_x86 *x, unsigned char *at, qdot_x86_name name, int reg, int first,
       qdot_x86_rm rm)
{
    const unsigned sixteens = rm.memory ? 1 : inverted(rm.reg, 4, 0);
    const unsigned length = instructions[name].wide ? 2 : 0;

    *at++ = 0x62;
    *at++ = (unsigned char)(inverted(reg, 3, 7) | sixteens << 6 | inverted(rm.reg, 3, 5)
                            | inverted(reg, 4, 4) | instructions[name].map);
    *at++ = (unsigned char)(0x84 | (unsigned)(~first & 15) << 3
                            | instructions[name].prefix);
    *at++ = (unsigned char)((unsigned)x->zeroing << 7 | length << 5
                            | (unsigned)rm.spread << 4 | inverted(first, 4, 3)
                            | (unsigned)x->mask);
    return at;
}

/* VEX, by which no lane is masked; a broadcast alone is of the other width there. */
static unsigned char *
narrow_prefix(unsigned char *at, qdot_x86_name name, int reg, int first, qdot_x86_rm rm)
{
    const unsigned doubles = name != QDOT_X86_SPREAD && name != QDOT_X86_HALVES;
    const unsigned length = instructions[name].wide;

    *at++ = 0xc4;
    *at++ = (unsigned char)(inverted(reg, 3, 7) | 1u << 6 | inverted(rm.reg, 3, 5)
                            | instructions[name].map);
    *at++ = (unsigned char)(doubles << 7 | (unsigned)(~first & 15) << 3 | length << 2
                            | instructions[name].prefix);
    return at;
}

/* Offsets that are a multiple of what is read take a byte, if that multiple does. */
static unsigned char *
operands(const qdot_x86 *x, unsigned char *at, int reg, qdot_x86_rm rm, int size)
{
    const unsigned low = (unsigned)(reg & 7) << 3 | (unsigned)(rm.reg & 7);

    if (!rm.memory) {
        *at++ = (unsigned char)(0xc0 | low);
    } else if (!x->far && rm.offset % size == 0 && rm.offset / size >= -128
               && rm.offset / size < 128) {
        *at++ = (unsigned char)(0x40 | low);
        *at++ = (unsigned char)(rm.offset / size);
    } else {
        *at++ = (unsigned char)(0x80 | low);
        at = little_endian(at, (uint32_t)rm.offset);
    }
    return at;
}

static unsigned char *
encode(const qdot_x86 *x, unsigned char *at, qdot_x86_name name, int reg, int first,
       qdot_x86_rm rm)
{
    const bool whole = instructions[name].wide && name != QDOT_X86_SPREAD && !rm.spread;

    if (x->narrow) {
        at = narrow_prefix(at, name, reg, first, rm);
        *at++ = instructions[name].opcode;
        return operands(x, at, reg, rm, 1);
    }
    at = prefix(x, at, name, reg, first, rm);
    *at++ = instructions[name].opcode;
    return operands(x, at, reg, rm, whole ? 64 : 8);
}

static void
write_bytes(qdot_x86 *x, size_t n, const unsigned char *bytes)
{
    unsigned char *from = room(x);

    memcpy(from, bytes, n);
    written(x, from, from + n);
}

/* --- SSE2: reg <- f(reg, rm) ------------------------------------------------------------ */

static void
two_operands(qdot_x86 *x, qdot_x86_name name, int reg, qdot_x86_rm rm)
{
    static const unsigned char prefixes[] = {0, 0x66, 0xf3, 0xf2};
    const unsigned high = (unsigned)(reg >> 3) << 2 | (unsigned)rm.reg >> 3;
    unsigned char *start = room(x), *at = start;

    *at++ = prefixes[instructions[name].prefix];
    if (high)
        *at++ = (unsigned char)(0x40 | high);
    *at++ = 0x0f;
    *at++ = instructions[name].opcode;
    written(x, start, operands(x, at, reg, rm, 1));
}

/* All of a register, or as much of what is in memory as the instruction reads. */
static void
load(qdot_x86 *x, qdot_x86_name like, int reg, qdot_x86_rm rm)
{
    const bool wide = instructions[like].wide || !rm.memory;

    two_operands(x, wide ? QDOT_X86_LOAD_ALL : QDOT_X86_LOAD, reg, rm);
}

/* What is no sum of a product. Whole vectors in memory need not be aligned. */
static void
from_two(qdot_x86 *x, qdot_x86_name name, int reg, int first, qdot_x86_rm rm)
{
    if (rm.memory ? instructions[name].wide : rm.reg == reg && reg != first) {
        load(x, name, QDOT_X86_SCRATCH, rm);
        rm = qdot_x86_reg(QDOT_X86_SCRATCH);
    }
    if (reg != first)
        load(x, name, reg, qdot_x86_reg(first));
    two_operands(x, name, reg, rm);
}

/* What AVX2 rounds once: the bits of its opcodes say what is multiplied and what is negative. */
static void
product_then_sum(qdot_x86 *x, qdot_x86_name name, int reg, int first, qdot_x86_rm rm)
{
    const unsigned opcode = instructions[name].opcode;
    const bool over = opcode >> 4 == 0xa, product = opcode & 4, other = opcode & 2;
    const bool wide = instructions[name].wide;
    const qdot_x86_name sub = wide ? QDOT_X86_SUB_ALL : QDOT_X86_SUB;
    const qdot_x86_rm scratch = qdot_x86_reg(QDOT_X86_SCRATCH),
                      term = over ? rm : scratch;

    if (!over)
        load(x, name, QDOT_X86_SCRATCH, rm);
    two_operands(x, wide ? QDOT_X86_MUL_ALL : QDOT_X86_MUL, over ? reg : QDOT_X86_SCRATCH,
                 qdot_x86_reg(first));
    if (product != other && over == other) {
        two_operands(x, sub, reg, term);
        return;
    }
    if (product == other) {
        two_operands(x, wide ? QDOT_X86_ADD_ALL : QDOT_X86_ADD, reg, term);
        if (!product)
            return;
        two_operands(x, QDOT_X86_XOR_ALL, QDOT_X86_SCRATCH, scratch);
    } else if (over) {
        load(x, name, QDOT_X86_SCRATCH, rm);
    }
    two_operands(x, sub, QDOT_X86_SCRATCH, qdot_x86_reg(reg));
    load(x, name, reg, scratch);
}

static void
emit_sse2(qdot_x86 *x, qdot_x86_name name, int reg, int first, qdot_x86_rm rm)
{
    switch (name) {
    case QDOT_X86_LOAD:
    case QDOT_X86_LOAD_ALL: load(x, name, reg, rm); break;
    case QDOT_X86_STORE:
    case QDOT_X86_STORE_ALL:
    case QDOT_X86_ROOT: two_operands(x, name, reg, rm); break;
    case QDOT_X86_SPREAD:
        load(x, QDOT_X86_LOAD, reg, rm);
        qdot_x86_move_lanes(x, QDOT_X86_PAIRS, reg, reg, qdot_x86_reg(reg), 0);
        break;
    default:
        (instructions[name].map == 2 ? product_then_sum : from_two)(x, name, reg, first,
                                                                    rm);
    }
}

/* --- any ------------------------------------------------------------------------------ */

void
qdot_x86_emit(qdot_x86 *x, qdot_x86_name name, int reg, int first, qdot_x86_rm rm)
{
    unsigned char *from;

    if (x->sse2) {
        emit_sse2(x, name, reg, first, rm);
        return;
    }
    from = room(x);
    written(x, from, encode(x, from, name, reg, first, rm));
}

void
qdot_x86_move_lanes(qdot_x86 *x, qdot_x86_name name, int reg, int first, qdot_x86_rm rm,
                    int how)
{
    const unsigned char byte = (unsigned char)how;

    qdot_x86_emit(x, name, reg, first, rm);
    write_bytes(x, 1, &byte);
}

void
qdot_x86_set_mask(qdot_x86 *x, int m, unsigned lanes)
{
    unsigned char *from = room(x), *at = from;

    *at++ = 0xb8; /* mov eax, lanes */
    at = little_endian(at, lanes);
    *at++ = 0xc5; /* kmovw m, eax */
    *at++ = 0xf8;
    *at++ = 0x92;
    *at++ = (unsigned char)(0xc0 | (unsigned)m << 3);
    written(x, from, at);
}

void
qdot_x86_join_masks(qdot_x86 *x, int m, int more)
{
    const unsigned char korw[] = {0xc5, (unsigned char)(0xc4 | (unsigned)(~m & 15) << 3), 0x45,
                                  (unsigned char)(0xc0 | (unsigned)m << 3 | (unsigned)more)};

    write_bytes(x, sizeof korw, korw);
}

void
qdot_x86_raise_mask(qdot_x86 *x, int m)
{
    const unsigned char kshiftlw[] = {
        0xc4, 0xe3, 0xf9, 0x32, (unsigned char)(0xc0 | (unsigned)m << 3 | (unsigned)m), 1};

    write_bytes(x, sizeof kshiftlw, kshiftlw);
}

void
qdot_x86_address(qdot_x86 *x, qdot_x86_base to, qdot_x86_base from, int32_t offset)
{
    unsigned char *start = room(x), *at = start;

    *at++ = (unsigned char)(0x48 | (unsigned)(to >> 3) << 2 | (unsigned)(from >> 3));
    *at++ = 0x8d; /* lea */
    *at++ = (unsigned char)(0x80 | (unsigned)(to & 7) << 3 | (unsigned)(from & 7));
    at = little_endian(at, (uint32_t)offset);
    written(x, start, at);
}

size_t
qdot_x86_repeat(qdot_x86 *x, int times)
{
    unsigned char *start = room(x), *at = start;

    *at++ = 0xb9; /* mov ecx, times */
    at = little_endian(at, (uint32_t)times);
    written(x, start, at);
    return x->bytes.n;
}

size_t
qdot_x86_repeat_as(qdot_x86 *x, qdot_x86_rm times)
{
    unsigned char *start = room(x), *at = start;

    *at++ = 0x8b; /* mov ecx, times */
    *at++ = (unsigned char)(0x88 | times.reg);
    at = little_endian(at, (uint32_t)times.offset);
    written(x, start, at);
    return x->bytes.n;
}

void
qdot_x86_again(qdot_x86 *x, size_t from)
{
    unsigned char *start = room(x), *at = start;

    *at++ = 0xff; /* dec ecx */
    *at++ = 0xc9;
    *at++ = 0x0f; /* jnz from */
    *at++ = 0x85;
    at = little_endian(at, (uint32_t)(from - (x->bytes.n + 8)));
    written(x, start, at);
}

void
qdot_x86_return_if_none(qdot_x86 *x)
{
    static const unsigned char test[] = {0x85, 0xc9, 0x75, 0}; /* test ecx, ecx; jnz behind */
    size_t behind;

    write_bytes(x, sizeof test, test);
    behind = x->bytes.n;
    qdot_x86_return(x);
    if (x->bytes.n > behind)
        x->bytes.at[behind - 1] = (unsigned char)(x->bytes.n - behind);
}

void
qdot_x86_enter(qdot_x86 *x, size_t place)
{
    unsigned char *start = room(x), *at = start;

    *at++ = 0xe8;
    at = little_endian(at, (uint32_t)(place - (x->bytes.n + 5)));
    written(x, start, at);
}

void
qdot_x86_enter_at(qdot_x86 *x, qdot_x86_base at)
{
    const unsigned char call[] = {(unsigned char)(0x40 | (unsigned)at >> 3), 0xff,
                                  (unsigned char)(0xd0 | ((unsigned)at & 7))};

    write_bytes(x, sizeof call, call);
}

void
qdot_x86_place(qdot_x86 *x, qdot_x86_base to, size_t place)
{
    unsigned char *start = room(x), *at = start;

    *at++ = (unsigned char)(0x48 | (unsigned)to >> 3 << 2);
    *at++ = 0x8d; /* lea to, [rip + ...] */
    *at++ = (unsigned char)(0x05 | ((unsigned)to & 7) << 3);
    at = little_endian(at, (uint32_t)(place - (x->bytes.n + 7)));
    written(x, start, at);
}

void
qdot_x86_push(qdot_x86 *x, qdot_x86_base reg)
{
    const unsigned char push[] = {(unsigned char)(0x40 | (unsigned)reg >> 3),
                                  (unsigned char)(0x50 | ((unsigned)reg & 7))};

    write_bytes(x, sizeof push, push);
}

void
qdot_x86_pop(qdot_x86 *x, qdot_x86_base reg)
{
    const unsigned char pop[] = {(unsigned char)(0x40 | (unsigned)reg >> 3),
                                 (unsigned char)(0x58 | ((unsigned)reg & 7))};

    write_bytes(x, sizeof pop, pop);
}

void
qdot_x86_leave(qdot_x86 *x)
{
    static const unsigned char ret = 0xc3;

    write_bytes(x, 1, &ret);
}

void
qdot_x86_return(qdot_x86 *x)
{
    static const unsigned char vzeroupper[] = {0xc5, 0xf8, 0x77};

    if (!x->sse2)
        write_bytes(x, sizeof vzeroupper, vzeroupper);
    qdot_x86_leave(x);
}

void
qdot_x86_frame(qdot_x86 *x)
{
    /* push rdi, rsi, rdx: with the way back these are 32 bytes, as calls want it */
    static const unsigned char bytes[] = {0x57, 0x56, 0x52};

    write_bytes(x, sizeof bytes, bytes);
}

void
qdot_x86_call(qdot_x86 *x, void (*function)(void))
{
    static const unsigned char call_rax[] = {0xff, 0xd0};
    static const unsigned char restore[] = {
        0x48, 0x8b, 0x7c, 0x24, 0x10, /* mov rdi, [rsp + 16] */
        0x48, 0x8b, 0x74, 0x24, 0x08, /* mov rsi, [rsp + 8] */
        0x48, 0x8b, 0x14, 0x24        /* mov rdx, [rsp] */
    };
    const uint64_t address = (uint64_t)(uintptr_t)function;
    unsigned char *start = room(x), *at = start;

    *at++ = 0x48; /* mov rax, address */
    *at++ = 0xb8;
    at = little_endian(at, (uint32_t)address);
    at = little_endian(at, (uint32_t)(address >> 32));
    written(x, start, at);
    write_bytes(x, sizeof call_rax, call_rax);
    write_bytes(x, sizeof restore, restore);
}

void
qdot_x86_unframe(qdot_x86 *x)
{
    static const unsigned char bytes[] = {0x48, 0x83, 0xc4, 0x18}; /* add rsp, 24 */

    write_bytes(x, sizeof bytes, bytes);
}

bool
qdot_x86_is_here(void)
{
#if defined __x86_64__ && defined __GNUC__ && defined __LP64__
    return true;
#else
    return false;
#endif
}

size_t
qdot_x86_kind(void)
{
    if (!qdot_x86_is_here())
        return 0;
    return qdot_kind_is_here(2) ? 2 : qdot_kind_is_here(1);
}
