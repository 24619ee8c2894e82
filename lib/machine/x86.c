/* x86.c -- encodes instructions of x86-64: SSE2, AVX2 with FMA, AVX-512. */
#include "machine/x86.h"

#include <string.h>

#include "num/kinds.h"

/* The opcode map and opcode of each operation; for scalars a fused operation has the next opcode. */
static const struct {
    unsigned char map, opcode;
} instructions[QDOT_X86_COUNT] = {
    [QDOT_ASM_LOAD] = {1, 0x10},   [QDOT_ASM_STORE] = {1, 0x11},
    [QDOT_ASM_ADD] = {1, 0x58},    [QDOT_ASM_SUB] = {1, 0x5c},
    [QDOT_ASM_MUL] = {1, 0x59},    [QDOT_ASM_DIV] = {1, 0x5e},
    [QDOT_ASM_ROOT] = {1, 0x51},   [QDOT_ASM_SPREAD] = {2, 0x19},
    [QDOT_ASM_MADD] = {2, 0xb8},   [QDOT_ASM_MADD_OVER] = {2, 0xa8},
    [QDOT_ASM_MSUB] = {2, 0xba},   [QDOT_ASM_MSUB_OVER] = {2, 0xaa},
    [QDOT_ASM_NMADD] = {2, 0xbc},  [QDOT_ASM_NMADD_OVER] = {2, 0xac},
    [QDOT_ASM_NMSUB] = {2, 0xbe},  [QDOT_ASM_NMSUB_OVER] = {2, 0xae},
    [QDOT_X86_XOR] = {1, 0xef},    [QDOT_X86_AND] = {1, 0xdb},
    [QDOT_X86_ALIGN] = {3, 0x03},  [QDOT_X86_PERMUTE] = {3, 0x01},
    [QDOT_X86_HALVES] = {3, 0x06}, [QDOT_X86_PAIRS] = {1, 0xc6},
};

enum { RAX, RCX, RDX, RBX, RSP, RBP, RSI, RDI, R8, R9, R10, R11, R12, R13, R14, R15 };

/* General registers; RCX counts loops. R12 is not used for addresses, as it makes instructions one
 * byte longer. */
static const unsigned char general[QDOT_ASM_BASES] = {
    [QDOT_ASM_ROWS] = RDI,          [QDOT_ASM_CONSTANTS] = RSI,
    [QDOT_ASM_WORK] = RDX,          [QDOT_ASM_ROWS_NOW] = R9,
    [QDOT_ASM_CONSTANTS_NOW] = RBX, [QDOT_ASM_WORK_NOW] = R10,
    [QDOT_ASM_ROWS_HALF] = RBP,     [QDOT_ASM_FACTOR] = RAX,
    [QDOT_ASM_PARTNER] = R8,        [QDOT_ASM_SECOND_PARTNER] = R13,
    [QDOT_ASM_TERMS] = R11,         [QDOT_ASM_TERMS_OF_PAIRS] = R14,
    [QDOT_ASM_TERMS_LEFT] = R12,    [QDOT_ASM_TERMS_OF_SQUARES] = R15,
};

static const unsigned char saved[] = {RBX, RBP, R12, R13, R14, R15};

enum { scratch = 15 }; /* SSE2: the register for intermediate results */

static bool
is_fused_operation(int name)
{
    return name >= QDOT_ASM_MADD && name <= QDOT_ASM_NMSUB_OVER;
}

/* The mandatory prefix of an instruction, by number: 1 is the byte 66, 3 the byte F2. */
static unsigned
mandatory_prefix(int name, bool wide)
{
    return wide || instructions[name].map > 1 ? 1 : 3;
}

static unsigned char
opcode_of(int name, bool wide)
{
    return (unsigned char)(instructions[name].opcode + (is_fused_operation(name) && !wide));
}

/* The length in bytes of the longest instruction. */
enum { longest = 16 };

/* The address at which to write one more instruction; after a failure, always the same unused place. */
static unsigned char *
reserve_instruction(qdot_asm *m)
{
    if (m->status == QDOT_OK && m->bytes.n + longest > m->bytes.capacity)
        m->status = qdot_grow(&m->bytes.at, &m->bytes.capacity, m->bytes.n + longest, 1);
    return m->status == QDOT_OK ? m->bytes.at + m->bytes.n : m->nowhere;
}

static void
count_written_bytes(qdot_asm *m, const unsigned char *from, const unsigned char *to)
{
    if (m->status == QDOT_OK)
        m->bytes.n += (size_t)(to - from);
}

static unsigned char *
put_little_endian(unsigned char *at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        *at++ = (unsigned char)(value >> 8 * i);
    return at;
}

static void
write_bytes(qdot_asm *m, size_t n, const unsigned char *bytes)
{
    unsigned char *from = reserve_instruction(m);

    memcpy(from, bytes, n);
    count_written_bytes(m, from, from + n);
}

#define BYTES(m, ...)                                                                    \
    write_bytes(m, sizeof(const unsigned char[]){__VA_ARGS__},                           \
                (const unsigned char[]){__VA_ARGS__})

static void
write_number_bytes(qdot_asm *m, uint32_t value)
{
    unsigned char bytes[4];

    put_little_endian(bytes, value);
    write_bytes(m, sizeof bytes, bytes);
}

/* Write a position in the code as its distance from the end of this number. */
static void
write_relative_position(qdot_asm *m, size_t place)
{
    write_number_bytes(m, (uint32_t)(place - (m->bytes.n + 4)));
}

/* `byte` with the low three bits of a register's number in its low three bits; _middle: in its next three bits. */
static unsigned char
low_bits_of(unsigned byte, int reg)
{
    return (unsigned char)(byte | (reg & 7));
}

static unsigned char
middle_bits_of(unsigned byte, int reg)
{
    return (unsigned char)(byte | (reg & 7) << 3);
}

/* The part of an instruction's prefix with the fourth bits of the numbers of its registers. */
static unsigned char
fourth_bits_of(unsigned byte, int reg, int base)
{
    return (unsigned char)(byte | reg >> 3 << 2 | base >> 3);
}

/* Bit `at` of a register's number, moved to bit `to` and inverted, as the EVEX prefix of AVX-512 needs it. */
static unsigned
inverted_bit_of(int reg, int at, int to)
{
    return (unsigned)(~reg >> at & 1) << to;
}

static unsigned char *
write_evex_prefix(const qdot_asm *m, unsigned char *at, int name, bool wide, int reg, int first,
                  qdot_operand b)
{
    const unsigned sixteens = b.memory ? 1 : inverted_bit_of(b.reg, 4, 0);
    const unsigned length = wide ? 2 : 0;

    *at++ = 0x62;
    *at++ = (unsigned char)(inverted_bit_of(reg, 3, 7) | sixteens << 6 | inverted_bit_of(b.reg, 3, 5) |
                            inverted_bit_of(reg, 4, 4) | instructions[name].map);
    *at++ = (unsigned char)(0x84 | (unsigned)(~first & 15) << 3 | mandatory_prefix(name, wide));
    *at++ = (unsigned char)((unsigned)m->zeroing << 7 | length << 5 |
                            (unsigned)b.spread << 4 | inverted_bit_of(first, 4, 3) |
                            (unsigned)m->mask);
    return at;
}

/* Write the VEX prefix of an AVX2 instruction, which cannot mask lanes; only a broadcast has another vector width. */
static unsigned char *
write_vex_prefix(unsigned char *at, int name, bool wide, int reg, int first, qdot_operand b)
{
    const unsigned doubles = name != QDOT_ASM_SPREAD && name != QDOT_X86_HALVES;

    *at++ = 0xc4;
    *at++ = (unsigned char)(inverted_bit_of(reg, 3, 7) | 1u << 6 | inverted_bit_of(b.reg, 3, 5) |
                            instructions[name].map);
    *at++ = (unsigned char)(doubles << 7 | (unsigned)(~first & 15) << 3 |
                            (unsigned)wide << 2 | mandatory_prefix(name, wide));
    return at;
}

/* Write the bytes for the operands; an offset that is a small multiple of the operand's size takes one byte. */
static unsigned char *
write_operands(const qdot_asm *m, unsigned char *at, int reg, qdot_operand b, int size)
{
    const unsigned char form = low_bits_of(middle_bits_of(0, reg), b.reg);

    if (!b.memory) {
        *at++ = 0xc0 | form;
    } else if (!m->far && b.offset % size == 0 && b.offset / size >= -128 &&
               b.offset / size < 128) {
        *at++ = 0x40 | form;
        *at++ = (unsigned char)(b.offset / size);
    } else {
        *at++ = 0x80 | form;
        at = put_little_endian(at, (uint32_t)b.offset);
    }
    return at;
}

/* Append an instruction of three operands, for AVX-512 or (`narrow`) AVX2. */
static void
emit_three_operands(qdot_asm *m, bool narrow, int name, bool wide, int reg, int first,
                    qdot_operand b)
{
    const bool whole = wide && name != QDOT_ASM_SPREAD && !b.spread;
    unsigned char *start = reserve_instruction(m), *at = start;

    at = narrow ? write_vex_prefix(at, name, wide, reg, first, b)
                : write_evex_prefix(m, at, name, wide, reg, first, b);
    *at++ = opcode_of(name, wide);
    count_written_bytes(m, start, write_operands(m, at, reg, b, narrow ? 1 : whole ? 64 : 8));
}

/* --- SSE2: reg <- f(reg, b) ------------------------------------------------------------- */

static void
emit_two_operands(qdot_asm *m, int name, bool wide, int reg, qdot_operand b)
{
    const unsigned char registers = fourth_bits_of(0x40, reg, b.reg);
    unsigned char *start = reserve_instruction(m), *at = start;

    *at++ = wide ? 0x66 : 0xf2;
    if (registers != 0x40)
        *at++ = registers;
    *at++ = 0x0f;
    *at++ = opcode_of(name, wide);
    count_written_bytes(m, start, write_operands(m, at, reg, b, 1));
}

/* Append a load of a whole register, or of as much memory as the instruction reads. */
static void
emit_load(qdot_asm *m, bool wide, int reg, qdot_operand b)
{
    emit_two_operands(m, QDOT_ASM_LOAD, wide || !b.memory, reg, b);
}

/* Append an SSE2 operation of two operands, none fused; vectors in memory may be unaligned. */
static void
emit_sse2_operation(qdot_asm *m, int name, bool wide, int reg, int first, qdot_operand b)
{
    if (b.memory ? wide : b.reg == reg && reg != first) {
        emit_load(m, wide, scratch, b);
        b = qdot_asm_in(scratch);
    }
    if (reg != first)
        emit_load(m, wide, reg, qdot_asm_in(first));
    emit_two_operands(m, name, wide, reg, b);
}

/* Append SSE2 instructions for a product and a sum, each rounded, which AVX2 has as one fused instruction. */
static void
emit_product_and_sum(qdot_asm *m, int name, bool wide, int reg, int first, qdot_operand b)
{
    const unsigned which = (unsigned)(name - QDOT_ASM_MADD);
    const bool over = which & 4, product = which & 2,
               other = which & 1; /* whether the product is negative; whether the other term is */
    const qdot_operand in_scratch = qdot_asm_in(scratch), term = over ? b : in_scratch;

    if (!over)
        emit_load(m, wide, scratch, b);
    emit_two_operands(m, QDOT_ASM_MUL, wide, over ? reg : scratch, qdot_asm_in(first));
    if (product != other && over == other) {
        emit_two_operands(m, QDOT_ASM_SUB, wide, reg, term);
        return;
    }
    if (product == other) {
        emit_two_operands(m, QDOT_ASM_ADD, wide, reg, term);
        if (!product)
            return;
        emit_two_operands(m, QDOT_X86_XOR, true, scratch, in_scratch);
    } else if (over) {
        emit_load(m, wide, scratch, b);
    }
    emit_two_operands(m, QDOT_ASM_SUB, wide, scratch, qdot_asm_in(reg));
    emit_load(m, wide, reg, in_scratch);
}

static void
emit_by_sse2(qdot_asm *m, int name, bool wide, int reg, int first, qdot_operand b)
{
    switch (name) {
    case QDOT_ASM_LOAD: emit_load(m, wide, reg, b); break;
    case QDOT_ASM_STORE:
    case QDOT_ASM_ROOT: emit_two_operands(m, name, wide, reg, b); break;
    case QDOT_ASM_SPREAD:
        emit_load(m, false, reg, b);
        qdot_x86_move_lanes(m, QDOT_X86_PAIRS, reg, reg, qdot_asm_in(reg), 0);
        break;
    default: (is_fused_operation(name) ? emit_product_and_sum : emit_sse2_operation)(m, name, wide, reg, first, b);
    }
}

/* --- instructions for every kind of vector -------------------------------------------- */

void
qdot_x86_emit(qdot_asm *m, int name, bool wide, int reg, int first, qdot_operand b)
{
    if (b.memory)
        b.reg = general[b.reg];
    if (m->kind == 0)
        emit_by_sse2(m, name, wide, reg, first, b);
    else
        emit_three_operands(m, m->kind == 1, name, wide, reg, first, b);
}

/* One number has no lanes to spread to; a register is copied whole, for nothing of it is waited
 * for then. */
void
qdot_asm_do(qdot_asm *m, qdot_asm_operation op, qdot_asm_width width, int reg, int first,
            qdot_operand b)
{
    const bool one = width == QDOT_ASM_ONE;

    if (op == QDOT_ASM_SPREAD && one)
        op = QDOT_ASM_LOAD;
    qdot_x86_emit(m, op, !one || (op == QDOT_ASM_LOAD && !b.memory), reg, first, b);
}

/* Clear a register by XOR with itself; the short form also clears lanes beyond its own width. */
void
qdot_asm_clear(qdot_asm *m, int reg)
{
    const qdot_operand itself = qdot_asm_in(reg);

    if (m->kind > 1 && reg < 16)
        emit_three_operands(m, true, QDOT_X86_XOR, true, reg, reg, itself);
    else
        qdot_x86_emit(m, QDOT_X86_XOR, true, reg, reg, itself);
}

void
qdot_x86_move_lanes(qdot_asm *m, int name, int reg, int first, qdot_operand b, int how)
{
    qdot_x86_emit(m, name, true, reg, first, b);
    BYTES(m, (unsigned char)how);
}

void
qdot_x86_set_mask(qdot_asm *m, int r, unsigned lanes)
{
    BYTES(m, 0xb8); /* the instruction mov eax, lanes */
    write_number_bytes(m, lanes);
    BYTES(m, 0xc5, 0xf8, 0x92, middle_bits_of(0xc0, r)); /* the instruction kmovw r, eax */
}

void
qdot_x86_join_masks(qdot_asm *m, int r, int more)
{
    BYTES(m, 0xc5, 0xc4 | (~r & 15) << 3, 0x45, middle_bits_of(low_bits_of(0xc0, more), r)); /* the instruction korw */
}

void
qdot_x86_raise_mask(qdot_asm *m, int r)
{
    BYTES(m, 0xc4, 0xe3, 0xf9, 0x32, middle_bits_of(low_bits_of(0xc0, r), r), 1); /* the instruction kshiftlw by 1 */
}

/* --- addresses, loops, calls ------------------------------------------------------------ */

void
qdot_asm_set(qdot_asm *m, qdot_asm_base to, qdot_asm_base from, int32_t offset)
{
    const int reg = general[to], base = general[from];

    BYTES(m, fourth_bits_of(0x48, reg, base), 0x8d, low_bits_of(middle_bits_of(0x80, reg), base)); /* the instruction lea */
    write_number_bytes(m, (uint32_t)offset);
}

void
qdot_asm_set_code(qdot_asm *m, qdot_asm_base to, size_t place)
{
    BYTES(m, fourth_bits_of(0x48, general[to], 0), 0x8d,
          middle_bits_of(0x05, general[to])); /* the instruction lea [rip + ...] */
    write_relative_position(m, place);
}

size_t
qdot_asm_repeat(qdot_asm *m, int times)
{
    BYTES(m, 0xb9); /* the instruction mov ecx, times */
    write_number_bytes(m, (uint32_t)times);
    return m->bytes.n;
}

size_t
qdot_asm_repeat_as(qdot_asm *m, qdot_operand times)
{
    BYTES(m, 0x8b, low_bits_of(0x88, general[times.reg])); /* the instruction mov ecx, times */
    write_number_bytes(m, (uint32_t)times.offset);
    return m->bytes.n;
}

void
qdot_asm_again(qdot_asm *m, size_t from)
{
    BYTES(m, 0xff, 0xc9, 0x0f, 0x85); /* the instructions dec ecx; jnz from */
    write_relative_position(m, from);
}

void
qdot_asm_return_if_none(qdot_asm *m)
{
    size_t behind;

    BYTES(m, 0x85, 0xc9, 0x75, 0); /* the instructions test ecx, ecx; jnz over the return */
    behind = m->bytes.n;
    qdot_asm_return(m);
    if (m->bytes.n > behind)
        m->bytes.at[behind - 1] = (unsigned char)(m->bytes.n - behind);
}

void
qdot_asm_enter(qdot_asm *m, size_t place)
{
    BYTES(m, 0xe8);
    write_relative_position(m, place);
}

void
qdot_asm_enter_at(qdot_asm *m, qdot_asm_base at)
{
    BYTES(m, fourth_bits_of(0x40, 0, general[at]), 0xff, low_bits_of(0xd0, general[at]));
}

void
qdot_asm_save(qdot_asm *m)
{
    for (size_t i = 0; i < sizeof saved; i++)
        BYTES(m, fourth_bits_of(0x40, 0, saved[i]), low_bits_of(0x50, saved[i])); /* the instruction push */
}

void
qdot_asm_restore(qdot_asm *m)
{
    for (size_t i = sizeof saved; i-- > 0;)
        BYTES(m, fourth_bits_of(0x40, 0, saved[i]), low_bits_of(0x58, saved[i])); /* the instruction pop */
}

void
qdot_asm_leave(qdot_asm *m)
{
    BYTES(m, 0xc3);
}

void
qdot_asm_return(qdot_asm *m)
{
    if (m->kind > 0)
        BYTES(m, 0xc5, 0xf8, 0x77); /* the instruction vzeroupper */
    qdot_asm_leave(m);
}

void
qdot_asm_frame(qdot_asm *m)
{
    /* save the three argument registers rdi, rsi, rdx; with the return address 32 bytes, the alignment that calls need */
    BYTES(m, 0x57, 0x56, 0x52);
}

void
qdot_asm_call(qdot_asm *m, void (*function)(void))
{
    const uint64_t address = (uint64_t)(uintptr_t)function;

    BYTES(m, 0x48, 0xb8); /* the instruction mov rax, address */
    write_number_bytes(m, (uint32_t)address);
    write_number_bytes(m, (uint32_t)(address >> 32));
    BYTES(m, 0xff, 0xd0);                   /* the instruction call rax */
    BYTES(m, 0x48, 0x8b, 0x7c, 0x24, 0x10); /* the instruction mov rdi, [rsp + 16] */
    BYTES(m, 0x48, 0x8b, 0x74, 0x24, 0x08); /* the instruction mov rsi, [rsp + 8] */
    BYTES(m, 0x48, 0x8b, 0x14, 0x24);       /* the instruction mov rdx, [rsp] */
}

void
qdot_asm_unframe(qdot_asm *m)
{
    BYTES(m, 0x48, 0x83, 0xc4, 0x18); /* the instruction add rsp, 24 */
}

/* --- kinds of vectors ----------------------------------------------------------------- */

bool
qdot_asm_is_here(void)
{
#if defined __x86_64__ && defined __GNUC__ && defined __LP64__
    return true;
#else
    return false;
#endif
}

size_t
qdot_asm_kind(void)
{
    if (!qdot_asm_is_here())
        return 0;
    return qdot_kind_is_here(2) ? 2 : qdot_kind_is_here(1);
}

int
qdot_asm_lanes(const qdot_asm *m)
{
    static const int lanes[] = {2, 4, 8};

    return lanes[m->kind];
}

int
qdot_asm_registers(const qdot_asm *m)
{
    static const int registers[] = {scratch, 16, QDOT_ASM_REGISTERS};

    return registers[m->kind];
}

int
qdot_asm_fresh(qdot_asm *m, int from, int end)
{
    int best = -1;

    for (int r = from; r < end; r++)
        if (!m->taken[r] && (best < 0 || m->used[r] < m->used[best]))
            best = r;
    qdot_asm_use(m, best);
    return best;
}
