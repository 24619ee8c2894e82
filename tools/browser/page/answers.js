/* answers.js -- the answers of a session, objects of QDOT_NOTATION_DISPLAY, as elements of the page. */

const GREEK = "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi omicron pi rho sigma tau upsilon phi chi psi omega"
    .split(" ");
const LETTERS = "αβγδεζηθικλμνξοπρστυφχψω";

/* A name of the language as one reads it: theta1' as θ1′. */
export function nameText(name) {
    return name.replace(/[A-Za-z]+/g, word => {
        const k = GREEK.indexOf(word.toLowerCase());
        return k < 0 ? word : word[0] < "a" ? LETTERS[k].toUpperCase() : LETTERS[k];
    }).replace(/''/g, "″").replace(/'/g, "′");
}

/* A number with as many digits as are right, and its error: 0 is exact, null unknown. */
export function numberText(value, error) {
    if (value === null || value === undefined)
        return "–";
    if (typeof value !== "number")
        return String(value);
    if (error === undefined || error === 0)
        return String(Number(value.toPrecision(12))).replace("-", "−");
    if (error === null)
        return String(Number(value.toPrecision(6))).replace("-", "−") + " ± unknown";
    const size = Math.max(Math.abs(value), error), digits = Math.ceil(Math.log10(size) - Math.log10(error)) + 1;
    return Number(value.toPrecision(Math.min(Math.max(digits, 1), 16))).toString().replace("-", "−") + " ± " + Number(roundedUp(error));
}

function roundedUp(x) {
    if (!(x > 0) || !isFinite(x))
        return String(x);
    const ten = Math.pow(10, Math.floor(Math.log10(x)));
    return (Math.ceil(x / ten - 1e-9) * ten).toPrecision(1);
}

function element(name, attributes = {}, ...children) {
    const e = document.createElement(name);
    for (const [key, value] of Object.entries(attributes))
        e.setAttribute(key, value);
    e.append(...children);
    return e;
}

function table(head, rows, {caption = "", left = []} = {}) {
    const MOST = 40, body = element("tbody"), t = element("table");
    const line = (tag, cells) => element("tr", {}, ...cells.map((cell, i) => element(tag, left.includes(i) ? {class: "words"} : {}, cell)));
    if (caption)
        t.append(element("caption", {}, caption));
    if (head.length > 0)
        t.append(element("thead", {}, line("th", head)));
    const shown = rows.length > MOST ? [...rows.slice(0, MOST / 2), head.map(() => "⋮"), ...rows.slice(-MOST / 2)] : rows;
    shown.forEach(row => body.append(line("td", row)));
    t.append(body);
    const all = element("div", {}, t);
    if (rows.length > MOST)
        all.append(element("div", {class: "asked"}, rows.length + " rows"));
    return all;
}

/* Answers that make one table together: columns and their rows, rows of one name, units. */
function grouped(answers) {
    const groups = [];
    for (const a of answers) {
        const last = groups.at(-1), b = last && last.at(-1);
        if (b && ((a.kind === "unit" && b.kind === "unit") ||
                  (a.kind === "row" && (b.kind === "columns" ? a.name == null || a.name === b.name :
                                        b.kind === "row" && a.name === b.name && a.values.length === b.values.length))))
            last.push(a);
        else
            groups.push([a]);
    }
    return groups;
}

function tableOf(group) {
    const columns = group[0].kind === "columns" ? group[0] : {}, rows = group.filter(a => a.kind === "row");
    const head = (columns.columns || []).map((c, i) => nameText(c) + ((columns.units || [])[i] ? ` [${columns.units[i]}]` : ""));
    const left = [], cells = rows.map(row => row.values.map((v, i) => numberText(v, (row.errors || [])[i])));
    for (const what of ["type", "stable", "status"]) {
        if (!rows.some(r => what in r) || (what === "status" && rows.every(r => (r.status || "done") === "done")))
            continue;
        left.push(cells[0].length);
        if (head.length > 0)
            head.push(what);
        rows.forEach((r, k) => cells[k].push(what === "stable" ? ({true: "stable", false: "unstable"})[r.stable] || "unknown" :
                                             String(r[what] ?? "") + (what === "status" && r.reason ? ": " + r.reason : "")));
    }
    (rows[0] ? rows[0].values : []).forEach((v, i) => { if (typeof v === "string") left.push(i); });
    return table(head, cells, {caption: columns.name && columns.name !== "table" ? columns.name : "", left});
}

const kinds = {
    expr(a) {
        const mathml = (a.typeset && a.typeset.mathml) || (a.mathml && `<math>${a.mathml}</math>`);
        if (!mathml)
            return element("pre", {}, a.name && a.name !== a.plain ? `${a.name} = ${a.plain}` : a.plain);
        const holder = element("div");
        holder.innerHTML = mathml.startsWith("<math") ? mathml : `<math display="block">${mathml}</math>`;
        const math = holder.querySelector("math");
        math.setAttribute("display", "block");
        math.setAttribute("title", (a.name ? a.name + " = " : "") + a.plain);
        return holder;
    },
    number: a => said(`${nameText(a.name)} = ${numberText(a.value, a.error)}${a.unit ? " " + a.unit : ""}`),
    numbers: a => said(`${nameText(a.name)} = ` + a.values.map((v, i) =>
        numberText(v, (a.errors || [])[i]) + ((a.units || [])[i] || a.unit ? " " + ((a.units || [])[i] || a.unit) : "")).join(", ")),
    text: a => element("pre", {}, a.name ? `${nameText(a.name)}: ${a.text.trimEnd()}` : a.text.trimEnd()),
    notice: a => element("pre", {class: "notice"}, "notice: " + a.message),
    done: () => null,
    check(a) {
        const expected = (a.claim || "").startsWith("not ") ? {proved: "refuted", refuted: "proved"}[a.verdict] || a.verdict : a.verdict;
        const mark = {proved: "✓", refuted: "✗", undecided: "?"}[expected];
        const out = element("div", {}, element("span", {class: expected}, `${mark} ${a.verdict}`), " ", element("code", {}, a.claim || ""));
        const point = Object.entries(a.at || {}).map(([n, v]) => `${nameText(n)} = ${numberText(v)}`);
        if (a.verdict === "refuted" && (a.values || []).length > 1)
            out.append(said(`at ${point.join(", ")}: left ${numberText(a.values[0])}, right ${numberText(a.values[1])}`));
        if (a.verdict === "undecided")
            out.append(said(a.digits ? `equal at random points to ${a.digits} digits, no proof` : "no proof, no counterexample"));
        return out;
    },
    run(a) {
        const scaled = "scaled_error" in a, error = scaled ? a.scaled_error : a.error;
        const rows = a.horizon != null ? [] : Object.entries(a.state).map(([n, v]) =>
            [nameText(n), v === null ? "unknown" : scaled || error == null ? numberText(v) :
                          numberText(v, Math.max(error * Math.max(1, Math.abs(v)), 2e-16 * Math.abs(v)))]);
        rows.push(["error of the end state", error == null ? "unknown" : `at most ${roundedUp(error)} of max(${scaled ? "scale" : "1"}, |value|)`]);
        if (a.horizon != null)
            rows.push(["horizon", `t = ${Number(a.horizon.toPrecision(3))}; no digit of the state beyond it is right`]);
        rows.push(["drift", Object.entries(a.drifts || {}).map(([n, d]) => `${nameText(n)} ${d === null ? "unknown" : roundedUp(Math.abs(d))}`)
            .join(", ") || "no conserved quantity is known"]);
        rows.push(["steps", `${a.steps}, ${a.rejected} rejected, ${a.evals} evaluations`]);
        return table([], rows, {caption: `${a.name}: t = ${a.t[0]}..${a.t[1]}, method ${a.method}, tol ${a.tol}, ` +
                                         a.status + (a.reason ? `: ${a.reason}` : ""), left: [0, 1]});
    },
    figure(a) {
        const holder = element("div", {class: "figure"});
        holder.innerHTML = a.data.slice(Math.max(a.data.indexOf("<svg"), 0));
        holder.append(download(a.name || "figure", ".svg", a.data, "image/svg+xml"));
        return holder;
    },
    page(a) {
        const frame = element("iframe", {title: a.name || "page", sandbox: "allow-scripts allow-downloads", srcdoc: a.data});
        return element("div", {}, frame, download(a.name || "page", ".html", a.data, "text/html"));
    },
    file: a => element("div", {}, said("wrote " + a.path + " "), element("button", {class: "save", "data-file": a.path}, "download")),
};

function said(text) {
    return element("div", {class: "said"}, text);
}

function download(name, ending, data, type) {
    const link = element("a", {class: "save", download: name.replace(/[^\w.-]+/g, "_") + ending, href: "#"}, "save");
    link.addEventListener("click", () => { link.href = URL.createObjectURL(new Blob([data], {type})); });
    return link;
}

/* The lines of an error: place and message, the line with a caret below, the hint. */
function errorOf(a, source) {
    const lines = source.split("\n"), out = element("div", {class: "error"});
    const place = a.file && a.file !== "ask" ? `${a.file}:${a.line}: ` : a.line ? `line ${a.line}: ` : "";
    let text = place + a.message;
    if (a.line && (!a.file || a.file === "ask") && a.line <= lines.length && a.column > 0) {
        const line = lines[a.line - 1];
        text += "\n  " + line + "\n  " + [...line].slice(0, a.column - 1).map(c => c === "\t" ? c : " ").join("") + "^";
    }
    out.append(element("pre", {}, text));
    if (a.hint)
        out.append(element("pre", {class: "hint"}, "hint: " + a.hint));
    return out;
}

/* The elements for answers; source: the script of which errors show a line. */
export function elementsOf(answers, source) {
    const out = [];
    for (const group of grouped(answers)) {
        const a = group[0];
        const e = a.kind === "error" ? errorOf(a, source)
            : a.kind === "columns" || a.kind === "row" ? tableOf(group)
            : a.kind === "unit" ? table(["name", "dimension", "unit"], group.map(u => [nameText(u.name), u.dimension || "–", u.unit || "–"]), {left: [0, 1, 2]})
            : (kinds[a.kind] || (x => element("pre", {}, JSON.stringify(x))))(a);
        if (e)
            out.push(e);
    }
    return out;
}
