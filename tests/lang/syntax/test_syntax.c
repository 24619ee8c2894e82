/* test_syntax.c -- statements read by the usages of their rows. */
#include "expr/exact.h"
#include "lang/reading.h"

#include "base/memory.h"
#include "lang/source/source.h"
#include "lang/syntax/match.h"
#include "lang/syntax/statement.h"

typedef struct {
    char word[32];
    qdot_session *session;
    qdot_source *source;
    qdot_usage usage;
    qdot_statement row;
    qdot_record record;
    qdot_status status;
} statement;

static void
statement_open(statement *s, qdot_session *session, const char *usage, const char *text)
{
    size_t at;

    snprintf(s->word, sizeof s->word, "%.*s", (int)strcspn(usage, " "), usage);
    s->row = (qdot_statement){.word = s->word, .usage = usage};
    s->session = session;
    assert_true(qdot_usage_compile(&s->usage, s->word, usage));
    assert_int_equal(qdot_source_new("a test", text, strlen(text), &s->source, &at), QDOT_OK);
}

static void
statement_match(statement *s)
{
    const qdot_cursor c = {
        .session = s->session, .source = s->source, .at = s->source->tokens.at};

    s->status = qdot_match(&c, &s->row, &s->usage, &s->record);
}

/* Read the text by the usage. */
static void
statement_read(statement *s, qdot_session *session, const char *usage, const char *text)
{
    statement_open(s, session, usage, text);
    statement_match(s);
}

static void
statement_free(statement *s)
{
    qdot_record_free(&s->record);
    qdot_source_free(s->source);
}

/* "word HOLE=text ..." of what was read. */
static const char *
statement_parts(const statement *s)
{
    static char text[1024];

    text[0] = '\0';
    for (size_t i = 0; i < s->record.parts.n; i++) {
        const qdot_filled *part = &s->record.parts.at[i];
        const qdot_token *last = part->to - 1;

        if (i > 0)
            strcat(text, " ");
        strcat(text, part->node->text);
        if (part->node->kind != QDOT_USAGE_HOLE)
            continue;
        strcat(text, "=");
        strncat(text, s->source->text + part->from->start,
                last->start + last->length - part->from->start);
    }
    return text;
}

static void
a_statement_is_its_words_and_holes(void **state)
{
    static const char *const cases[][3] = {
        {"particle NAME mass M at R", "particle bob mass m at (x, y)", "particle NAME=bob mass M=m at R=(x, y)"},
        {"particle NAME mass M at R", "particle b[1] at x mass 2*m", "particle NAME=b[1] at R=x mass M=2*m"},
        {"gravity [NAME:] VECTOR", "gravity up: (0, g)", "gravity NAME=up : VECTOR=(0, g)"},
        {"gravity [NAME:] VECTOR", "gravity up", "gravity VECTOR=up"},
        {"spring [NAME] between A, B stiffness K [rest L]", "spring rest 1 between p, q stiffness k",
         "spring rest L=1 between A=p , B=q stiffness K=k"},
        {"spring [NAME] between A, B stiffness K [rest L]", "spring rest between p, q stiffness k",
         "spring NAME=rest between A=p , B=q stiffness K=k"},
        {"spring [NAME] between A, B stiffness K [rest L]", "spring s stiffness k rest 1 between p, q",
         "spring NAME=s stiffness K=k rest L=1 between A=p , B=q"},
        {"constraint [NAME:] A = B", "constraint c: x = y", "constraint NAME=c : A=x = y"},
        {"constraint [NAME:] A = B", "constraint c", "constraint A=c"},
        {"force [NAME:] F on PARTICLE | on COORDINATE | at POINT | on BODY at material POINT",
         "force F on disk at material x", "force F=F on BODY=disk at material POINT=x"},
        {"force [NAME:] F on PARTICLE | on COORDINATE | at POINT | on BODY at material POINT",
         "force F on x", "force F=F on PARTICLE=x"},
        {"body NAME mass M inertia I [about P] at R angle A | euler(PHI, THETA, PSI) | rotation MATRIX",
         "body b mass 1 inertia 2 at x euler(1, 2, 3) about y",
         "body NAME=b mass M=1 inertia I=2 at R=x euler (PHI, THETA, PSI)=(1, 2, 3) about P=y"},
        {"event NAME: A = B [rising|falling] [stop] [then NAME = VALUE, ...]",
         "event e: x = 0 stop falling then x' = 0, y'' = 1",
         "event NAME=e : A=x = 0 stop falling then NAME=x' = VALUE=0 , NAME=y'' = VALUE=1"},
        {"print EXPR, \"text\", ...", "print \"a\", x = 0, \"b\"",
         "print \"text\"=\"a\" , EXPR=x = 0 , \"text\"=\"b\""},
        {"remove NAME | remove KIND [K]", "remove spring 2", "remove KIND=spring K=2"},
        {"remove NAME | remove KIND [K]", "remove spring", "remove NAME=spring"},
        {"param NAME [> 0] [= VALUE], ...", "param a, 2 < b[1] <= c = 3, d > 0",
         "param NAME=a , NAME=2 < b[1] <= c = VALUE=3 , NAME=d > 0"},
        {"set NAME = VALUE, F(ARGUMENTS) = EXPR, ...", "set f(u, v) = u*(v), p[x] = 2",
         "set F(ARGUMENTS)=f(u, v) = EXPR=u*(v) , NAME=p[x] = VALUE=2"},
        {"function NAME(ARGUMENTS), ...", "function f[1](s), g(s, t)",
         "function NAME(ARGUMENTS)=f[1](s) , NAME(ARGUMENTS)=g(s, t)"},
        {"check [not] A == B [when C, D, ...] [within E] | check [not] conserved E", "check not x <= y when eom, x > 0",
         "check not A=x <= y when C=eom , C=x > 0"},
        {"check [not] A == B [when C, D, ...] [within E] | check [not] conserved E", "check conserved -x",
         "check conserved E=-x"},
        {"check [not] A == B [when C, D, ...] [within E] | check [not] conserved E", "check conserved[1] == x within 1",
         "check A=conserved[1] == x within E=1"},
        {"help [WORD] | help search WORD ...", "help search", "help WORD=search"},
        {"help [WORD] | help search WORD ...", "help search a \"b c\"", "help search WORD=a ...=\"b c\""},
        {"export c|python EXPR to \"FILE\"", "export python eom to \"x.py\"", "export python EXPR=eom to \"FILE\"=\"x.py\""},
        {"report [RUN, ...] [title TEXT] [work] to \"FILE\"|\"PAGE\"", "report a, b to \"x\" work title \"t\"",
         "report RUN=a , RUN=b to \"FILE\"=\"x\" work title TEXT=\"t\""},
        {"scale Q = VALUE, t = VALUE, ...", "scale t = 2, x' = 1, t = 3",
         "scale t = VALUE=2 , Q=x' = VALUE=1 , t = VALUE=3"},
        {"start Q = VALUE, ... [exactly] | start RUN [exactly]", "start a exactly", "start RUN=a exactly"},
        {"sweep NAME = A..B [step H] [count N], ... run T0..T1 : EXPR, ...",
         "sweep k = [1, 2], m = 0..1 count 3 run 0..2 : x, y",
         "sweep NAME=k = A..B=[1, 2] , NAME=m = A..B=0..1 count N=3 run T0..T1=0..2 : EXPR=x , EXPR=y"},
        {"find NAME = GUESS such that CONDITION, ... [as NAME]",
         "find T = 1 such that x = 1 and returns after T, y = 2 as a",
         "find NAME=T = GUESS=1 such that CONDITION=x = 1 and returns after T , CONDITION=y = 2 as NAME=a"},
        {"run T0..T1 [tol E | digits N] [with NAME = VALUE, ...]", "run 0..2*T with x' = 1, p[x] = 2 digits 30",
         "run T0..T1=0..2*T with NAME=x' = VALUE=1 , NAME=p[x] = VALUE=2 digits N=30"},
    };
    reading *r = *state;

    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        statement s;

        statement_read(&s, r->session, cases[i][0], cases[i][1]);
        if (s.status != QDOT_OK)
            fail_msg("%s: %s", cases[i][1], qdot_last_error()->message);
        assert_string_equal(statement_parts(&s), cases[i][2]);
        statement_free(&s);
    }
}

/* What is said of a token that does not fit, and at which byte. */
static void
what_belongs_there_is_said_by_the_usage(void **state)
{
    static const struct {
        const char *usage, *text, *message;
        size_t at;
    } cases[] = {
        {"timing on | off", "timing foo", "expected `on` or `off`, found `foo`", 7},
        {"timing on | off", "timing on off", "expected the end of the statement, found `off`", 10},
        {"damper [NAME] between A, B coefficient C", "damper between p, q foo",
         "expected `between` or `coefficient`, found `foo`", 20},
        {"damper [NAME] between A, B coefficient C", "damper between p, q between p, q",
         "`between` is given twice", 20},
        {"damper [NAME] between A, B coefficient C", "damper d between p, q", "a damper needs `coefficient`", 7},
        {"body NAME mass M inertia I [about P] at R angle A | rotation MATRIX",
         "body b mass 1 inertia 1 at 0", "a body needs `angle`", 5},
        {"event NAME: A = B [stop]", "event x stop", "expected `:`, found `stop`", 8},
        {"event NAME: A = B [stop]", "event e: x go", "expected `=` and the other side, found `go`", 11},
        {"include \"FILE.lag\"", "include x", "expected the name of a script in quotes, found `x`", 8},
        {"start Q = VALUE, ... [exactly] | start RUN [exactly]", "start x \"a\"", "expected `=`, found a text in quotes", 8},
        {"start Q = VALUE, ... [exactly] | start RUN [exactly]", "start x = 1, y", "expected `=`, found the end of the statement", 14},
        {"coord NAME, LO < NAME < HI, ...", "coord u[1] = 2", "a coordinate is declared without a value", 11},
        {"help [WORD] | help search WORD ...", "help a b", "`help` takes one word of the language", 7},
        {"export c|python EXPR to \"FILE\"", "export c to \"x.c\"", "expected `eom` or an expression, found `to`", 9},
        {"report [RUN, ...] [title TEXT] to \"FILE\"", "report a", "a report needs `to`", 7},
        {"check A == B [within E]", "check x foo", "expected `==` and the other side, found `foo`", 8},
        {"coord NAME, LO < NAME < HI, ...", "coord u w", "expected `,` or the end of the statement, found `w`", 8},
        {"start Q = VALUE, ... [exactly]", "start = 1", "expected a coordinate, found `=`", 6},
        {"run T0..T1 [tol E | digits N]", "run 0..1 tol 1 digits 2",
         "`digits` sets the tolerance itself: no `tol` beside it", 15},
        {"run T0..T1 [tol E | digits N]", "run 0..1 tol 1 tol 2", "`tol` is given twice", 15},
        {"race T0..T1 [keep]", "race 0..1 tol 1",
         "a race takes no `tol`: it compares tolerances and formulations by itself", 10},
        {"find NAME = GUESS such that CONDITION, ...", "find T = 1 such that x",
         "expected `=`: a condition is an equation, found the end of the statement", 22},
        {"lyapunov [spectrum] T0..T1", "lyapunov all 0..10", "unknown name `all`", 9},
    };
    reading *r = *state;

    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        statement s;

        statement_read(&s, r->session, cases[i].usage, cases[i].text);
        assert_int_not_equal(s.status, QDOT_OK);
        assert_string_equal(qdot_last_error()->message, cases[i].message);
        assert_int_equal(s.record.cursor.error_at, cases[i].at);
        statement_free(&s);
    }
}

/* A hole is compiled once; a name has the meaning of the moment each time. */
static void
a_hole_is_evaluated_as_often_as_one_likes(void **state)
{
    reading *r = *state;
    qdot_session *session = r->session;
    const qdot_filled *hole;
    statement s;

    statement_read(&s, session, "table EXPR", "table k^2 + 1");
    assert_int_equal(s.status, QDOT_OK);
    hole = qdot_record_hole(&s.record, NULL, "EXPR");
    for (int64_t k = 1; k <= 3; k++) {
        qdot_expr value;

        assert_int_equal(qdot_names_push(session->names, "k", qdot_expr_int(session->pool, k)), QDOT_OK);
        assert_int_equal(qdot_record_scalar(&s.record, hole, &value), QDOT_OK);
        assert_true(value == qdot_expr_int(session->pool, k * k + 1));
        qdot_names_pop(session->names);
    }
    statement_free(&s);
}

/* The operands alone, which end where the caller says; what an option asks for is evaluated behind that. */
static void
operands_are_read_without_their_word(void **state)
{
    const qdot_statement row = {.word = "run", .usage = "run T0..T1 [tol E]"};
    reading *r = *state;
    qdot_cursor c = {.session = r->session};
    qdot_record record;
    qdot_source *source;
    qdot_expr from, to;
    qdot_expr values[2];
    double tol;
    bool is;

    assert_int_equal(qdot_source_new("a test", "0..3 tol normal(1/4, 2) for k", 29, &source, &c.error_at), QDOT_OK);
    c.source = source;
    c.at = source->tokens.at;
    assert_int_equal(qdot_match_operands(&c, &row, &record), QDOT_ESYNTAX);
    qdot_record_free(&record);
    assert_int_equal(qdot_match_operands_to(&c, source->tokens.at + source->tokens.n - 3, &row, &record), QDOT_OK);
    assert_int_equal(source->tokens.at[source->tokens.n - 3].kind, QDOT_TOKEN_NAME);
    assert_int_equal(qdot_record_range(&record, qdot_record_hole(&record, NULL, "T0..T1"), &from, &to), QDOT_OK);
    assert_true(to == qdot_expr_int(r->session->pool, 3));
    assert_int_equal(qdot_record_call_of_two(&record, qdot_record_hole(&record, "tol", "E"), "normal", values, &is),
                     QDOT_OK);
    assert_true(is && values[0] == qdot_expr_ratio(r->session->pool, 1, 4) && values[1] == qdot_expr_int(r->session->pool, 2));
    assert_int_equal(qdot_record_number(&record, qdot_record_hole(&record, "tol", "E"), &tol), QDOT_ENAME);
    qdot_record_free(&record);
    qdot_source_free(source);
}

/* Which clauses must be there: those of eight statements are in any order. */
static void
clauses_of_things_come_in_any_order(void **state)
{
    const qdot_statement *row;
    int loose = 0;

    (void)state;
    for (size_t i = 0; (row = qdot_statement_at(i)) != NULL; i++) {
        qdot_usage u;
        bool needs = false;

        assert_true(qdot_usage_compile(&u, row->word, row->usage));
        for (int k = 0; k < u.n; k++)
            needs = needs || u.node[k].needs != 0;
        if (needs != (strcmp(row->word, "particle") == 0 || strcmp(row->word, "body") == 0 ||
                      strcmp(row->word, "spring") == 0 || strcmp(row->word, "damper") == 0 ||
                      strcmp(row->word, "report") == 0 || strcmp(row->word, "animate") == 0 ||
                      strcmp(row->word, "table") == 0 || strcmp(row->word, "linearize") == 0))
            fail_msg("the clauses of `%s`", row->word);
        loose += needs;
    }
    assert_int_equal(loose, 8);
}

/* Whatever allocation fails, nothing is lost and a status tells it. */
static void
memory_may_run_out_while_reading(void **state)
{
    const char *text = "body b[1] mass 1 inertia 2 at (0, 0) euler(1, 2, 3)";
    const char *usage = "body NAME mass M inertia I at R euler(A, B, C)";
    reading *r = *state;
    qdot_status status = QDOT_ENOMEM;

    for (int64_t n = 0; status != QDOT_OK; n++) {
        statement s;

        assert_true(n < 1000);
        statement_open(&s, r->session, usage, text);
        qdot_memory_fail_at(n);
        statement_match(&s);
        qdot_memory_fail_at(-1);
        status = s.status;
        assert_true(status == QDOT_OK || status == QDOT_ENOMEM);
        statement_free(&s);
    }
}

static int
begin(void **state)
{
    static reading r;

    reading_open(&r);
    *state = &r;
    return 0;
}

static int
end(void **state)
{
    reading_close(*state);
    return 0;
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_statement_is_its_words_and_holes, begin, end),
        cmocka_unit_test_setup_teardown(what_belongs_there_is_said_by_the_usage, begin, end),
        cmocka_unit_test_setup_teardown(a_hole_is_evaluated_as_often_as_one_likes, begin, end),
        cmocka_unit_test_setup_teardown(operands_are_read_without_their_word, begin, end),
        cmocka_unit_test(clauses_of_things_come_in_any_order),
        cmocka_unit_test_setup_teardown(memory_may_run_out_while_reading, begin, end),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
