/* names.c -- the names of a session: a hash table, the order of declaration, temporary bindings. */
#include "lang/session/names.h"

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/spelling.h"
#include "base/text.h"

typedef struct entry {
    qdot_name name; /* must be the first member: a pointer to the name is also one to its entry */
    unsigned uses;
    uint32_t hash;
    size_t order; /* its position in the order of declaration when it was entered or restored */
    struct entry *next;
} entry;

/* A family NAME[...], with the number of its members. */
typedef struct family {
    char *name;
    uint32_t hash;
    size_t members;
    struct family *next;
} family;

struct qdot_names {
    entry **slots;
    family **families;
    size_t n_slots; /* number of slots in each table, a power of 2 */
    size_t n_families;
    qdot_vec(entry *) order;
    qdot_vec(qdot_name) bound; /* temporary bindings, innermost last */
    size_t seen_from;          /* bindings before this index are hidden */
    size_t settled;            /* number of first entries of `order` unchanged since the last settle or restore */
};

static uint32_t
hash_of_text(const char *text, size_t length)
{
    uint32_t h = 2166136261u;

    for (size_t i = 0; i < length; i++)
        h = (h ^ (unsigned char)text[i]) * 16777619u;
    return h;
}

qdot_names *
qdot_names_new(void)
{
    qdot_names *names = qdot_calloc(1, sizeof *names);

    if (names == NULL)
        return NULL;
    names->n_slots = 64;
    names->slots = qdot_calloc(names->n_slots, sizeof *names->slots);
    names->families = qdot_calloc(names->n_slots, sizeof *names->families);
    if (names->slots == NULL || names->families == NULL) {
        qdot_names_free(names);
        return NULL;
    }
    return names;
}

static void
free_entry(entry *e)
{
    if (--e->uses > 0)
        return;
    qdot_free(e->name.name);
    qdot_free(e->name.file);
    qdot_function_body_release(e->name.body);
    qdot_free(e);
}

void
qdot_names_free(qdot_names *names)
{
    if (names == NULL)
        return;
    for (size_t i = 0; i < names->order.n; i++)
        free_entry(names->order.at[i]);
    while (names->bound.n > 0)
        qdot_names_pop(names);
    for (size_t i = 0; names->families != NULL && i < names->n_slots; i++)
        while (names->families[i] != NULL) {
            family *f = names->families[i];

            names->families[i] = f->next;
            qdot_free(f->name);
            qdot_free(f);
        }
    qdot_free(names->slots);
    qdot_free(names->families);
    qdot_free(names->order.at);
    qdot_free(names->bound.at);
    qdot_free(names);
}

/* --- finding names ------------------------------------------------------------------ */

static entry *
find_declared(const qdot_names *names, const char *name)
{
    uint32_t hash = hash_of_text(name, strlen(name));

    for (entry *e = names->slots[hash & (names->n_slots - 1)]; e != NULL; e = e->next)
        if (e->hash == hash && strcmp(e->name.name, name) == 0)
            return e;
    return NULL;
}

static family *
find_family(const qdot_names *names, const char *name, size_t length)
{
    uint32_t hash = hash_of_text(name, length);

    for (family *f = names->families[hash & (names->n_slots - 1)]; f != NULL; f = f->next)
        if (f->hash == hash && strlen(f->name) == length &&
            memcmp(f->name, name, length) == 0)
            return f;
    return NULL;
}

const qdot_name *
qdot_names_find(const qdot_names *names, const char *name)
{
    const entry *e;

    for (size_t i = names->bound.n; i > names->seen_from; i--)
        if (strcmp(names->bound.at[i - 1].name, name) == 0)
            return &names->bound.at[i - 1];
    e = find_declared(names, name);
    return e != NULL ? &e->name : NULL;
}

const qdot_name *
qdot_names_declared(const qdot_names *names, const char *name)
{
    const entry *e = find_declared(names, name);

    return e != NULL ? &e->name : NULL;
}

bool
qdot_names_is_family(const qdot_names *names, const char *name)
{
    const family *f = find_family(names, name, strlen(name));

    return f != NULL && f->members > 0;
}

const qdot_name *
qdot_names_first_member(const qdot_names *names, const char *family)
{
    const qdot_name *name;

    for (size_t i = 0; (name = qdot_names_at(names, i)) != NULL; i++)
        if (qdot_is_member_of(name->name, family))
            return name;
    return NULL;
}

const qdot_name *
qdot_names_at(const qdot_names *names, size_t i)
{
    return i < names->order.n ? &names->order.at[i]->name : NULL;
}

/* --- names that clash --------------------------------------------------------------- */

static const char *
kind_in_words(qdot_name_kind kind)
{
    static const char *const words[] = {
        [QDOT_NAME_PARAM] = "a parameter",   [QDOT_NAME_COORD] = "a coordinate",
        [QDOT_NAME_UFUN] = "a function",     [QDOT_NAME_VALUE] = "an expression",
        [QDOT_NAME_FUNCTION] = "a function", [QDOT_NAME_INDEX] = "an index",
        [QDOT_NAME_ARGUMENT] = "an argument", [QDOT_NAME_SPEED] = "a speed",
    };

    return words[kind];
}

static qdot_status
report_name_taken(const char *name, const qdot_name *before)
{
    if (before->file != NULL)
        return qdot_fail(QDOT_ENAME, "`%.200s` is already %s, declared at %.200s:%u",
                         name, kind_in_words(before->kind), before->file, before->line);
    return qdot_fail(QDOT_ENAME, "`%.200s` is already %s", name,
                     kind_in_words(before->kind));
}

/* Length of the family's name in "theta[1]"; 0 for a plain name. */
static size_t
length_of_family_name(const char *name)
{
    const char *bracket = strchr(name, '[');

    return bracket != NULL ? (size_t)(bracket - name) : 0;
}

static qdot_status
check_reserved(const char *name)
{
    static const char *const plain[] = {"pi", "t", "dt", "and", "or", "not"};
    static const char *const families[] = {"p", "Q", "lambda", "delta"};
    size_t length = length_of_family_name(name);

    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++)
        if (strcmp(name, plain[i]) == 0 ||
            (length == strlen(plain[i]) && memcmp(name, plain[i], length) == 0))
            return qdot_fail(QDOT_ENAME, "`%s` is reserved%s", plain[i],
                             i == 0   ? ": it is the number 3.14159..."
                             : i == 1 ? ": it is the time"
                             : i == 2 ? ": it is the differential of the time"
                                      : ": it joins conditions");
    for (size_t i = 0; i < sizeof families / sizeof *families; i++)
        if (length == strlen(families[i]) && memcmp(name, families[i], length) == 0)
            return qdot_fail(QDOT_ENAME, "`%s[ ]` is reserved", families[i]);
    return QDOT_OK;
}

/* Refuse a declaration of dNAME if NAME is a coordinate, since dNAME means its differential. */
static qdot_status
check_differential(const qdot_names *names, const qdot_name *entry)
{
    char differential[256];
    const qdot_name *other;

    if (entry->name[0] == 'd' && entry->name[1] != '\0') {
        const struct entry *e = find_declared(names, entry->name + 1);

        if (e != NULL && e->name.kind == QDOT_NAME_COORD)
            return qdot_fail(QDOT_ENAME,
                             "`%.200s` is reserved: it is the differential of "
                             "the coordinate `%.200s`",
                             entry->name, e->name.name);
    }
    if (entry->kind != QDOT_NAME_COORD || strlen(entry->name) > sizeof differential - 2)
        return QDOT_OK;
    snprintf(differential, sizeof differential, "d%s", entry->name);
    const struct entry *e = find_declared(names, differential);

    if (e == NULL)
        return QDOT_OK;
    other = &e->name;
    report_name_taken(differential, other);
    return qdot_hint("`%.100s` would be the differential of the coordinate `%.100s`",
                     differential, entry->name);
}

static bool
is_replaceable(qdot_name_kind kind)
{
    return kind == QDOT_NAME_VALUE || kind == QDOT_NAME_FUNCTION;
}

/* Whether the declaration `new` of a name may replace the declaration `old`. */
static bool
may_replace(const qdot_name *old, const qdot_name *new)
{
    if (is_replaceable(old->kind) && is_replaceable(new->kind))
        return true;
    if (old->kind != new->kind)
        return false;
    if (old->kind == QDOT_NAME_PARAM)
        return true;
    return old->kind == QDOT_NAME_UFUN && old->ufun == new->ufun &&
           old->value == new->value;
}

/* Fail if both x and a member x[1] would be declared. */
static qdot_status
check_family(const qdot_names *names, const char *name)
{
    size_t length = length_of_family_name(name);
    const struct entry *plain;
    char base[256];

    if (length == 0) {
        if (!qdot_names_is_family(names, name))
            return QDOT_OK;
        qdot_fail(QDOT_ENAME, "`%.200s` is already a family", name);
        return qdot_hint("its members are %.100s[1] and so on", name);
    }
    if (length >= sizeof base)
        return QDOT_OK;
    memcpy(base, name, length);
    base[length] = '\0';
    plain = find_declared(names, base);
    if (plain == NULL)
        return QDOT_OK;
    report_name_taken(base, &plain->name);
    return qdot_hint("a name is either plain or a family %.100s[k]", base);
}

/* --- adding and replacing names ----------------------------------------------------- */

/* Double the number of hash slots if both tables are full; on failure they stay unchanged. */
static qdot_status
enlarge_hash_tables(qdot_names *names)
{
    size_t wanted = 2 * names->n_slots;
    entry **slots;
    family **families;

    if (names->order.n < names->n_slots)
        return QDOT_OK;
    slots = qdot_calloc(wanted, sizeof *slots);
    families = qdot_calloc(wanted, sizeof *families);
    if (slots == NULL || families == NULL) {
        qdot_free(slots);
        qdot_free(families);
        return QDOT_ENOMEM;
    }
    for (size_t i = 0; i < names->n_slots; i++) {
        for (entry *e = names->slots[i], *next; e != NULL; e = next) {
            next = e->next;
            e->next = slots[e->hash & (wanted - 1)];
            slots[e->hash & (wanted - 1)] = e;
        }
        for (family *f = names->families[i], *next; f != NULL; f = next) {
            next = f->next;
            f->next = families[f->hash & (wanted - 1)];
            families[f->hash & (wanted - 1)] = f;
        }
    }
    qdot_free(names->slots);
    qdot_free(names->families);
    names->slots = slots;
    names->families = families;
    names->n_slots = wanted;
    return QDOT_OK;
}

/* Count one more member of the family to which `name` belongs, if any. */
static qdot_status
count_member(qdot_names *names, const char *name)
{
    size_t length = length_of_family_name(name);
    family *f;

    if (length == 0)
        return QDOT_OK;
    f = find_family(names, name, length);
    if (f == NULL) {
        f = qdot_calloc(1, sizeof *f);
        if (f == NULL)
            return QDOT_ENOMEM;
        f->name = qdot_strndup(name, length);
        if (f->name == NULL) {
            qdot_free(f);
            return QDOT_ENOMEM;
        }
        f->hash = hash_of_text(name, length);
        f->next = names->families[f->hash & (names->n_slots - 1)];
        names->families[f->hash & (names->n_slots - 1)] = f;
    }
    f->members++;
    return QDOT_OK;
}

/* Replace the texts in *name by copies that *name owns. */
static qdot_status
copy_texts(qdot_name *name)
{
    name->name = qdot_strdup(name->name);
    if (name->name == NULL)
        return QDOT_ENOMEM;
    if (name->file == NULL)
        return QDOT_OK;
    name->file = qdot_strdup(name->file);
    if (name->file == NULL) {
        qdot_free(name->name);
        return QDOT_ENOMEM;
    }
    return QDOT_OK;
}

/* Make an entry of the hash table with a copy of *name; NULL if memory runs out. */
static entry *
make_entry(const qdot_name *name)
{
    entry *e = qdot_calloc(1, sizeof *e);

    if (e == NULL)
        return NULL;
    e->uses = 1;
    e->name = *name;
    if (copy_texts(&e->name) != QDOT_OK) {
        qdot_free(e);
        return NULL;
    }
    e->name.body = qdot_function_body_keep(name->body);
    e->hash = hash_of_text(name->name, strlen(name->name));
    return e;
}

static void
insert_into_hash_table(qdot_names *names, entry *e)
{
    entry **slot = &names->slots[e->hash & (names->n_slots - 1)];

    e->next = *slot;
    *slot = e;
}

/* The pointer in the hash table that points to an entry. */
static entry **
pointer_to_entry(qdot_names *names, const entry *e)
{
    entry **link = &names->slots[e->hash & (names->n_slots - 1)];

    while (*link != e)
        link = &(*link)->next;
    return link;
}

/* The position of an entry in the order of declaration; positions only ever decrease. */
static size_t
position_of_entry(const qdot_names *names, const entry *e)
{
    size_t i = e->order < names->order.n ? e->order : names->order.n - 1;

    while (names->order.at[i] != e)
        i--;
    return i;
}

static qdot_status
insert_name(qdot_names *names, const qdot_name *name)
{
    entry *e;

    QDOT_TRY(enlarge_hash_tables(names));
    e = make_entry(name);
    if (e == NULL)
        return QDOT_ENOMEM;
    e->order = names->order.n;
    if (qdot_vec_push(&names->order, e) != QDOT_OK) {
        free_entry(e);
        return QDOT_ENOMEM;
    }
    if (count_member(names, name->name) != QDOT_OK) {
        names->order.n--;
        free_entry(e);
        return QDOT_ENOMEM;
    }
    insert_into_hash_table(names, e);
    return QDOT_OK;
}

/* Replace the entry `old`, which is released, by a new one. */
static qdot_status
replace_entry(qdot_names *names, entry *old, const qdot_name *name)
{
    entry *e = make_entry(name);

    if (e == NULL)
        return QDOT_ENOMEM;
    e->order = position_of_entry(names, old);
    *pointer_to_entry(names, old) = old->next;
    insert_into_hash_table(names, e);
    names->order.at[e->order] = e;
    names->settled = e->order < names->settled ? e->order : names->settled;
    free_entry(old);
    return QDOT_OK;
}

qdot_status
qdot_names_declare(qdot_names *names, const qdot_name *entry)
{
    struct entry *old;

    if (entry->kind != QDOT_NAME_COORD || strcmp(entry->name, "t") != 0) /* `coord t`: the time in line elements */
        QDOT_TRY(check_reserved(entry->name));
    old = find_declared(names, entry->name);
    if (old != NULL && !may_replace(&old->name, entry))
        return report_name_taken(entry->name, &old->name);
    if (old == NULL) {
        QDOT_TRY(check_family(names, entry->name));
        QDOT_TRY(check_differential(names, entry));
        return insert_name(names, entry);
    }
    return replace_entry(names, old, entry);
}

qdot_status
qdot_names_update(qdot_names *names, const char *name, qdot_expr value, qdot_expr formals)
{
    entry *e = find_declared(names, name);
    qdot_name changed;

    if (e == NULL || (e->name.value == value && e->name.formals == formals))
        return QDOT_OK;
    changed = e->name;
    changed.value = value;
    changed.formals = formals;
    return replace_entry(names, e, &changed);
}

void
qdot_names_remove(qdot_names *names, const char *name)
{
    entry *e = find_declared(names, name);
    size_t length = length_of_family_name(name), i;

    if (e == NULL)
        return;
    *pointer_to_entry(names, e) = e->next;
    if (length > 0)
        find_family(names, name, length)->members--;
    i = position_of_entry(names, e);
    names->settled = i < names->settled ? i : names->settled;
    memmove(names->order.at + i, names->order.at + i + 1,
            (names->order.n - i - 1) * sizeof *names->order.at);
    names->order.n--;
    free_entry(e);
}

/* --- saving and restoring all names ------------------------------------------------- */

const qdot_name *
qdot_names_keep(const qdot_name *declared)
{
    ((entry *)declared)->uses++;
    return declared;
}

void
qdot_names_release(const qdot_name *declared)
{
    free_entry((entry *)declared);
}

size_t
qdot_names_settled(const qdot_names *names)
{
    return names->settled;
}

void
qdot_names_settle(qdot_names *names)
{
    names->settled = names->order.n;
}

void
qdot_names_restore(qdot_names *names, size_t n, const qdot_name *const *list)
{
    for (size_t i = 0; i < n; i++)
        (void)qdot_names_keep(list[i]);
    for (size_t i = 0; i < names->order.n; i++)
        free_entry(names->order.at[i]);
    for (size_t i = 0; i < names->n_slots; i++) {
        names->slots[i] = NULL;
        for (family *f = names->families[i]; f != NULL; f = f->next)
            f->members = 0;
    }
    for (size_t i = 0; i < n; i++) {
        entry *e = (entry *)list[i];
        size_t length = length_of_family_name(e->name.name);

        e->order = i;
        names->order.at[i] = e; /* the saved state has at least as many names */
        insert_into_hash_table(names, e);
        if (length > 0)
            find_family(names, e->name.name, length)->members++;
    }
    names->order.n = n;
    qdot_names_settle(names);
}

/* --- temporary bindings ------------------------------------------------------------- */

static qdot_status
push_binding(qdot_names *names, qdot_name bound)
{
    QDOT_TRY(copy_texts(&bound));
    if (qdot_vec_push(&names->bound, bound) != QDOT_OK) {
        qdot_free(bound.name);
        return QDOT_ENOMEM;
    }
    return QDOT_OK;
}

qdot_status
qdot_names_push(qdot_names *names, const char *name, qdot_expr value)
{
    QDOT_TRY(check_reserved(name));
    return push_binding(names, (qdot_name){
                           .name = (char *)name, .kind = QDOT_NAME_INDEX, .value = value});
}

qdot_status
qdot_names_push_argument(qdot_names *names, const char *name, qdot_expr value,
                         const char *label)
{
    if (strcmp(name, "t") != 0) /* a function argument named t is allowed: it means the time */
        QDOT_TRY(check_reserved(name));
    return push_binding(names, (qdot_name){.name = (char *)name,
                                   .kind = QDOT_NAME_ARGUMENT,
                                   .value = value,
                                   .label = label});
}

size_t
qdot_names_enclose(qdot_names *names)
{
    const size_t outer = names->seen_from;

    names->seen_from = names->bound.n;
    return outer;
}

void
qdot_names_disclose(qdot_names *names, size_t outer)
{
    while (names->bound.n > names->seen_from)
        qdot_names_pop(names);
    names->seen_from = outer;
}

void
qdot_names_pop(qdot_names *names)
{
    if (names->bound.n > 0)
        qdot_free(names->bound.at[--names->bound.n].name);
}

const char *
qdot_names_nearest(const qdot_names *names, const char *name, size_t n,
                   const char *const *extra)
{
    qdot_spelling s;

    qdot_spelling_begin(&s, name);
    for (size_t i = names->bound.n; i > names->seen_from; i--)
        qdot_spelling_offer(&s, names->bound.at[i - 1].name);
    for (size_t i = 0; i < names->order.n; i++)
        qdot_spelling_offer(&s, names->order.at[i]->name.name);
    for (size_t i = 0; i < n; i++)
        qdot_spelling_offer(&s, extra[i]);
    return s.best;
}
