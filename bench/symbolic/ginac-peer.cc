/* ginac-peer -- the scenes of bench/symbolic by GiNaC.
 *
 *   ginac-peer lagrange|direct SCENE N     the equations M q'' = f
 *   ginac-peer simplify SCENE              an expression in a form for people
 *   ginac-peer decide LEFT RIGHT           whether they are equal
 *
 * Prints lines `word value`, as sympy-peer does. The methods:
 *
 *   lagrange   T and V, then M = d2T/dq'dq', f = dL/dq - sum d2T/dq'dq q'
 *   direct     with J = dr/dq and J' its rate, M = sum m J^T J,
 *              f = -sum m J^T J' q' - dV/dq, nothing expanded
 */
#include <ctime>
#include <iomanip>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <ginac/ginac.h>

using namespace GiNaC;
using std::string;
using std::vector;

static double
seconds()
{
    return double(clock()) / CLOCKS_PER_SEC;
}

static symbol
named(const string &name, int k)
{
    return symbol(name + std::to_string(k + 1));
}

/* Symbols of an expression, by their place among the coordinates. */
using places = std::map<symbol, size_t, ex_is_less>;

static void
coordinates_of(const ex &e, const places &number, std::set<size_t> &found)
{
    for (const_preorder_iterator i = e.preorder_begin(); i != e.preorder_end(); ++i)
        if (is_a<symbol>(*i)) {
            auto at = number.find(ex_to<symbol>(*i));
            if (at != number.end())
                found.insert(at->second);
        }
}

/* --- scenes ------------------------------------------------------------------------- */

struct scene {
    vector<symbol> q, v;
    vector<vector<ex>> points;
    vector<ex> masses, potential;
    exmap numbers; /* a value for every symbol, to compare programs with */
    symbol g{"g"};

    scene(const string &name, int n)
    {
        numbers[g] = 9.81;
        if (name == "net")
            net(n);
        else
            rods(name, n);
        for (size_t i = 0; i < q.size(); i++) {
            v.push_back(named("v", int(i)));
            numbers[q[i]] = numeric(int(3 + i + 1), 10);
            numbers[v[i]] = numeric(int(50 - 7 * (i + 1)), 100);
        }
    }

    void
    rods(const string &name, int n)
    {
        vector<symbol> l;

        for (int k = 0; k < n; k++) {
            symbol m = named("m", k);
            masses.push_back(m);
            l.push_back(named("l", k));
            q.push_back(named("theta", k));
            numbers[m] = numeric(10 + k + 1, 10);
            numbers[l[k]] = numeric(400 - k - 1, 200);
        }
        for (int k = 0; name == "spatial" && k < n; k++)
            q.push_back(named("phi", k));
        for (int k = 0; k < n; k++) {
            int parent = name == "tree" ? (k + 1) / 2 - 1 : k - 1;
            vector<ex> step;
            if (name == "spatial")
                step = {l[k] * sin(q[k]) * cos(q[n + k]), l[k] * sin(q[k]) * sin(q[n + k]),
                        -l[k] * cos(q[k])};
            else
                step = {l[k] * sin(q[k]), -l[k] * cos(q[k])};
            for (size_t c = 0; parent >= 0 && c < step.size(); c++)
                step[c] += points[parent][c];
            points.push_back(step);
            potential.push_back(masses[k] * g * step.back());
        }
    }

    void
    net(int n)
    {
        symbol m("m"), k("k"), a("a");
        auto spring = [&](const vector<ex> &p, const vector<ex> &r) {
            ex length = sqrt(pow(p[0] - r[0], 2) + pow(p[1] - r[1], 2));
            potential.push_back(k * pow(length - a, 2) / 2);
        };

        numbers[m] = 1.1;
        numbers[k] = 3;
        numbers[a] = 0.7;
        for (int i = 0; i < n * n; i++)
            q.push_back(named("x", i));
        for (int i = 0; i < n * n; i++)
            q.push_back(named("y", i));
        for (int i = 0; i < n * n; i++) {
            points.push_back({q[i], q[n * n + i]});
            masses.push_back(m);
            potential.push_back(m * g * q[n * n + i]);
        }
        for (int i = 0; i < n; i++) {
            for (int j = 0; j < n; j++) {
                if (i + 1 < n)
                    spring(points[i * n + j], points[(i + 1) * n + j]);
                if (j + 1 < n)
                    spring(points[i * n + j], points[i * n + j + 1]);
            }
            spring(points[i * n], {(i + 1) * a, 0});
        }
    }
};

/* --- methods ------------------------------------------------------------------------ */

struct equations {
    vector<vector<ex>> M;
    vector<ex> f;
};

static equations
by_lagrange(const scene &s)
{
    size_t n = s.q.size();
    equations out{vector<vector<ex>>(n, vector<ex>(n)), vector<ex>(n)};
    ex T = 0, V = 0;

    for (size_t k = 0; k < s.points.size(); k++) {
        ex square = 0;
        for (const ex &c : s.points[k]) {
            ex speed = 0;
            for (size_t i = 0; i < n; i++)
                speed += c.diff(s.q[i]) * s.v[i];
            square += pow(speed, 2);
        }
        T += s.masses[k] * square / 2;
    }
    for (const ex &term : s.potential)
        V += term;
    ex L = T - V;
    for (size_t i = 0; i < n; i++) {
        ex p = T.diff(s.v[i]), sum = L.diff(s.q[i]);
        for (size_t j = 0; j < n; j++) {
            out.M[i][j] = p.diff(s.v[j]);
            sum -= p.diff(s.q[j]) * s.v[j];
        }
        out.f[i] = sum;
    }
    return out;
}

static equations
by_hand(const scene &s)
{
    size_t n = s.q.size();
    vector<vector<exvector>> M(n, vector<exvector>(n));
    vector<exvector> f(n);
    equations out{vector<vector<ex>>(n, vector<ex>(n)), vector<ex>(n)};
    places number;

    for (size_t i = 0; i < n; i++)
        number[s.q[i]] = i;
    for (size_t k = 0; k < s.points.size(); k++)
        for (const ex &c : s.points[k]) {
            std::set<size_t> held;
            coordinates_of(c, number, held);
            std::map<size_t, ex> J;
            exvector parts;
            for (size_t i : held) {
                std::set<size_t> inner;
                J[i] = c.diff(s.q[i]);
                coordinates_of(J[i], number, inner);
                for (size_t j : inner)
                    parts.push_back(J[i].diff(s.q[j]) * s.v[i] * s.v[j]);
            }
            ex turn = add(parts);
            for (const auto &[i, a] : J) {
                for (const auto &[j, b] : J)
                    if (j <= i)
                        M[i][j].push_back(s.masses[k] * a * b);
                if (!turn.is_zero())
                    f[i].push_back(-s.masses[k] * a * turn);
            }
        }
    for (const ex &term : s.potential) {
        std::set<size_t> held;
        coordinates_of(term, number, held);
        for (size_t i : held)
            f[i].push_back(-term.diff(s.q[i]));
    }
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j <= i; j++)
            out.M[i][j] = out.M[j][i] = add(M[i][j]);
        out.f[i] = add(f[i]);
    }
    return out;
}

/* --- operations, counted as SymPy's count_ops does ---------------------------------- */

static size_t
operations(const ex &e, bool in_sum = false, bool in_product = false)
{
    size_t count = 0;

    if (is_a<numeric>(e))
        return !e.info(info_flags::integer) ||
               (!in_product && e.info(info_flags::negative));
    if (is_a<add>(e) || is_a<mul>(e)) {
        bool sum = is_a<add>(e);
        count = e.nops() - 1;
        for (const ex &part : e) {
            if (!sum && in_sum && part.is_equal(-1))
                count--; /* a subtraction: counted by the sum */
            count += operations(part, sum, !sum);
        }
        return count;
    }
    if (is_a<power>(e)) {
        const ex &exponent = e.op(1);
        if (exponent.is_equal(-1))
            return operations(e.op(0)) + !in_product;
        return 1 + operations(e.op(0)) + (is_a<numeric>(exponent) ? 0 : operations(exponent));
    }
    if (is_a<function>(e))
        count = 1;
    for (const ex &part : e)
        count += operations(part);
    return count;
}

/* --- forms for people --------------------------------------------------------------- */

static exvector
to_simplify(const string &name)
{
    symbol u("u"), v("v"), phi("phi"), a("a");
    vector<ex> r;

    if (name == "double") {
        symbol m1("m1"), m2("m2"), L1("L1"), L2("L2"), va("v1"), vb("v2");
        ex x1 = L1 * sin(u), y1 = -L1 * cos(u);
        ex x2 = x1 + L2 * sin(v), y2 = y1 - L2 * cos(v);
        auto square = [&](const ex &c) { return pow(c.diff(u) * va + c.diff(v) * vb, 2); };
        return {m1 * (square(x1) + square(y1)) / 2 + m2 * (square(x2) + square(y2)) / 2};
    }
    if (name == "toroidal")
        r = {sinh(v) * cos(phi), sinh(v) * sin(phi), sin(u)};
    else if (name == "bispherical")
        r = {sin(u) * cos(phi), sin(u) * sin(phi), sinh(v)};
    else
        r = {sinh(v) * sin(u) * cos(phi), sinh(v) * sin(u) * sin(phi), cosh(v) * cos(u)};
    ex scale = name == "prolate" ? ex(a) : a / (cosh(v) - cos(u));
    vector<symbol> q = {u, v, phi};
    exvector entries;
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++) {
            ex sum = 0;
            for (const ex &x : r)
                sum += (scale * x).diff(q[i]) * (scale * x).diff(q[j]);
            entries.push_back(sum);
        }
    return entries;
}

static void
simplify(const string &name)
{
    exvector entries = to_simplify(name);
    ex (*ways[])(const ex &) = {
        [](const ex &e) { return e.normal(); },
        [](const ex &e) { return factor(e.normal()); },
        [](const ex &e) { return e.expand(); },
        [](const ex &e) { return factor(e.expand()); },
    };
    size_t best = SIZE_MAX;

    for (auto way : ways) {
        double start = seconds();
        exvector out;
        size_t count = 0;
        for (const ex &e : entries)
            out.push_back(way(e));
        double spent = seconds() - start;
        for (const ex &e : out)
            count += operations(e);
        if (count >= best)
            continue;
        best = count;
        std::cout << "seconds " << std::fixed << spent << "\noperations " << count
                  << std::endl;
        for (const ex &e : out)
            std::cout << "form " << e << std::endl;
    }
}

/* --- verdicts ----------------------------------------------------------------------- */

static void
decide(const string &left, const string &right)
{
    symtab table;

    for (const char *name : {"m", "m1", "m2", "M", "a", "b", "c", "g", "k", "L", "L1", "L2",
                             "r"})
        table[name] = possymbol(name);
    for (const char *name : {"x", "y", "z", "u", "v", "theta", "phi", "psi", "theta1",
                             "theta2", "w", "w1", "w2", "omega"})
        table[name] = realsymbol(name);
    table["pi"] = Pi;
    parser reader(table, true);
    double start = seconds();
    ex difference = reader(left) - reader(right);
    bool zero = difference.expand().is_zero() || difference.normal().is_zero();
    /* what is no number cannot be refuted by what it offers */
    bool refuted = !zero && is_a<numeric>(difference);
    std::cout << "seconds " << std::fixed << seconds() - start << "\nverdict "
              << (zero ? "proved" : refuted ? "refuted" : "undecided") << std::endl;
}

int
main(int argc, char **argv)
{
    const string method = argc > 1 ? argv[1] : "";

    std::cout.precision(6);
    if (method == "decide" && argc == 4) {
        decide(argv[2], argv[3]);
        return 0;
    }
    if (method == "simplify" && argc == 3) {
        simplify(argv[2]);
        return 0;
    }
    if (argc != 4 || (method != "lagrange" && method != "direct")) {
        std::cerr << "usage: ginac-peer lagrange|direct SCENE N" << std::endl;
        return 2;
    }

    /* what is short is done again and again: clocks are coarse */
    double start = seconds(), spent;
    int turns = 0;
    equations out;
    exmap numbers;
    do {
        scene s(argv[2], std::stoi(argv[3]));
        out = method == "direct" ? by_hand(s) : by_lagrange(s);
        numbers = s.numbers;
        turns++;
        spent = seconds() - start;
    } while (spent < 0.2 && turns < 1000);
    std::cout << "seconds " << std::fixed << spent / turns << std::endl;

    size_t count = 0;
    ex total = 0;
    for (size_t i = 0; i < out.f.size(); i++) {
        count += operations(out.f[i]);
        total += out.f[i].subs(numbers).evalf();
        for (const ex &e : out.M[i]) {
            count += operations(e);
            total += e.subs(numbers).evalf();
        }
    }
    std::cout << "operations " << count << "\nvalue " << std::setprecision(15)
              << ex_to<numeric>(total).to_double() << std::endl;
}
