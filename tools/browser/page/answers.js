/* answers.js -- the answers of a session, objects of QDOT_NOTATION_DISPLAY, as elements of the page. The library words and rounds
 * them (lib/qdot.h, qdot_system_ask); here they are placed. */

function element(name, attributes = {}, ...children) {
    const e = document.createElement(name);
    for (const [key, value] of Object.entries(attributes))
        e.setAttribute(key, value);
    e.append(...children);
    return e;
}

/* What the library has written as a part of a page. */
function written(html, name = "div", attributes = {}) {
    const e = element(name, attributes);
    e.innerHTML = html;
    return e;
}

function download(name, ending, data, type) {
    const link = element("a", {class: "save", download: name.replace(/[^\w.-]+/g, "_") + ending, href: "#"}, "save");
    link.addEventListener("click", () => { link.href = URL.createObjectURL(new Blob([data], {type})); });
    return link;
}

/* Answers that make one table: columns and their rows, rows of one name, units. */
function grouped(answers) {
    const groups = [];
    for (const a of answers) {
        const last = groups.at(-1), b = last && last.at(-1);
        if (b && ((a.kind === "unit" && b.kind === "unit") ||
                  (a.kind === "row" && (b.kind === "columns" || (b.kind === "row" && a.name === b.name)))))
            last.push(a);
        else
            groups.push([a]);
    }
    return groups;
}

/* Of a long table the first and last rows. */
function table(group) {
    const MOST = 40, head = group[0].kind === "columns" ? [group[0]] : [], rows = group.slice(head.length);
    const html = all => all.map(a => a.html).join("");
    const gap = `<tr>${"<td>⋮</td>".repeat((rows[0] || {cells: []}).cells.length)}</tr>`;
    const all = element("div", {}, written((html(head) && `<thead>${html(head)}</thead>`) + "<tbody>" + (rows.length <= MOST ? html(rows)
        : html(rows.slice(0, MOST / 2)) + gap + html(rows.slice(-MOST / 2))) + "</tbody>", "table"));
    if (rows.length > MOST)
        all.append(element("div", {class: "soft"}, `${rows.length} rows`));
    return all;
}

/* Browsers do not break formulas into lines. A formula becomes several that stand behind each other, each with a sum's or
 * relation's sign at its beginning: between them a line may end. */
function breakFormula(math) {
    const parts = [[]];
    for (const child of [...math.childNodes]) {
        const part = parts.at(-1), behindSign = part.length === 0 || part.at(-1).localName === "mo";
        if (child.localName === "mo" && /^[=<>≤≥≈+−±]$/.test(child.textContent) && !behindSign) {
            child.setAttribute("form", "infix");
            parts.push([child]);
        } else {
            part.push(child);
        }
    }
    math.replaceWith(...parts.map(part => {
        const own = math.cloneNode(false);
        own.setAttribute("displaystyle", "true");
        own.append(...part);
        return own;
    }));
}

function formula(a) {
    const e = written(a.typeset.mathml, "div", {class: "formula", title: a.text});
    e.querySelectorAll("math").forEach(breakFormula);
    return e;
}

/* What a page in a frame has besides: its scene is lower than the window, and it tells how high all of it is. */
const FITTING = `<style>html { overflow-y: hidden } .animation .stage > .hold { max-height: ${Math.round(screen.height * 0.45)}px }</style>
<script>const tell = () => parent.postMessage({height: document.documentElement.offsetHeight + 2}, "*");
tell(); new ResizeObserver(tell).observe(document.documentElement)</script>`;

const kinds = {
    expr: formula, number: formula, numbers: formula,
    columns: (a, group) => table(group),
    row: (a, group) => table(group),
    unit: (a, group) => table(group),
    done: () => null,
    figure(a) {
        const holder = written(a.data.slice(Math.max(a.data.indexOf("<svg"), 0)), "div", {class: "figure"});
        holder.append(download(a.name || "figure", ".svg", a.data, "image/svg+xml"));
        return holder;
    },
    page: a => element("div", {},
        element("iframe", {title: a.name || "page", sandbox: "allow-scripts allow-downloads", srcdoc: a.data + FITTING}),
        download(a.name || "page", ".html", a.data, "text/html")),
    error(a) { /* its line stands above it, its file is no file */
        const e = written(a.html), pre = e.querySelector("pre");
        pre.textContent = pre.textContent.replace(/^(script|prompt):\d+:\d+: /, "");
        return e;
    },
    file(a) {
        const e = written(a.html);
        e.append(element("button", {class: "save", "data-file": a.path}, "download"));
        return e;
    },
};

/* Whether an error shows the statement that was asked. */
export const showsStatement = a => a.kind === "error" && a.column > 0 && (!a.file || a.file === "script" || a.file === "prompt");

/* The elements for the answers of a piece; asked: the statement that stands above them, which no answer repeats. */
export function elementsOf(answers, asked) {
    return grouped(answers).flatMap(group => {
        const a = group[0], e = kinds[a.kind] ? kinds[a.kind](a, group) : written(a.html ?? "");
        if (a.kind === "check" && asked.replace(/\s+/g, "") === ("check" + a.claim).replace(/\s+/g, ""))
            e.querySelectorAll("code").forEach(code => code.remove());
        return e ? [e] : [];
    });
}
