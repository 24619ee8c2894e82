/* page.js -- answers of qdot as pages for a panel, which reach no network.
 *
 * What is written by qdot in HTML, an animation or a report, is a page of its own with scripts, which are
 * let run by a nonce. Everything else is one page without any script.
 */
"use strict";
const crypto = require("crypto");

const style = `
body { font-family: var(--vscode-font-family, sans-serif); font-size: var(--vscode-font-size, 13px);
    color: var(--vscode-foreground, #222); background: var(--vscode-editor-background, #fff); padding: 0 1em 2em; }
pre { font-family: var(--vscode-editor-font-family, monospace); white-space: pre-wrap; margin: 0.3em 0; }
h1 { font-size: 1.1em; font-weight: 600; }
h2 { font-size: 1em; font-weight: 600; margin: 1.2em 0 0.3em; opacity: 0.8; }
.formula { margin: 0.5em 0; overflow-x: auto; } math { font-size: 1.25em; }
.figure { background: #fff; padding: 4px; max-width: 100%; height: auto; }
.error { border-left: 3px solid var(--vscode-editorError-foreground, #c00); padding-left: 0.6em; }
.notice { border-left: 3px solid var(--vscode-editorWarning-foreground, #b80); padding-left: 0.6em; }
.hint { opacity: 0.8; }
table { border-collapse: collapse; } th, td { text-align: right; padding: 0.1em 0.7em; font-variant-numeric: tabular-nums; }`;

const signs = {"&": "&amp;", "<": "&lt;", ">": "&gt;", "\"": "&quot;", "'": "&#39;"};

function escaped(text) {
    return String(text).replace(/[&<>"']/g, (sign) => signs[sign]);
}

/* Markup that the program wrote, if it is nothing but MathML. */
function mathml(text) {
    return typeof text === "string" && /^\s*<math[\s>]/.test(text) &&
        !/<(?!\/?m[a-z]+[\s>/])|\son\w+\s*=|javascript:/i.test(text) ? text : null;
}

function number(value, error) {
    const digits = error > 0 && Number.isFinite(value) && value !== 0
        ? Math.min(15, Math.max(1, 2 + Math.floor(Math.log10(Math.abs(value))) - Math.floor(Math.log10(error))))
        : 12;

    return typeof value === "number" ? String(Number(value.toPrecision(digits))) +
        (error > 0 ? ` \u00B1 ${Number(error).toPrecision(1)}` : "") : String(value);
}

function formula(object) {
    const whole = mathml((object.typeset || {}).mathml || object.mathml);

    return whole === null ? `<pre>${escaped(object.name ? `${object.name} = ` : "")}${escaped(object.plain)}</pre>`
        : `<div class="formula" title="${escaped(object.plain || "")}">${whole}</div>`;
}

function image(object) {
    const data = /base64$/.test(object.encoding || "") ? object.data : Buffer.from(object.data).toString("base64");

    return `<p><img class="figure" alt="${escaped(object.name || "figure")}" ` +
        `src="data:${escaped(object.mime)};base64,${data}"></p>`;
}

/* Each kind of object as a part of the page. */
const parts = {
    expr: formula,
    figure: image,
    text: (object) => `<pre>${escaped(object.text)}</pre>`,
    number: (object) => `<pre>${escaped(object.name)} = ${escaped(number(object.value, object.error))}</pre>`,
    numbers: (object) => `<pre>${escaped(object.name)} = (${object.values.map((value, i) =>
        escaped(number(value, (object.errors || [])[i]))).join(", ")})</pre>`,
    check: (object) => `<pre>${escaped(object.verdict)}: ${
        escaped(object.claim || `${object.left} == ${object.right}`)}</pre>`,
    run: (object) => `<pre>run ${escaped(object.name || "")}: t = ${(object.t || []).map(escaped).join(" .. ")}, ` +
        `${escaped(object.method)}, ${escaped(object.steps)} steps, error ${
            object.error === null ? "unknown" : Number(object.error).toPrecision(2)}${
            object.status === "done" ? "" : `; ${escaped(object.status)}: ${escaped(object.reason)}`}</pre>`,
    file: (object) => `<pre>written: ${escaped(object.path)}</pre>`,
    notice: (object) => `<pre class="notice">notice: ${escaped(object.message)}</pre>`,
    failure: (object) => `<pre class="error">${escaped(object.text)}</pre>`,
    error: (object) => `<div class="error"><pre>${escaped(object.file || "")}:${escaped(object.line)}:${
        escaped(object.column)}: error: ${escaped(object.message)}</pre>${
        object.hint ? `<pre class="hint">hint: ${escaped(object.hint)}</pre>` : ""}</div>`
};

/* Rows that follow each other are one table, with the names of columns before them. */
function tables(objects) {
    const grouped = [];

    for (const object of objects) {
        const last = grouped[grouped.length - 1];

        if (object.kind === "row" && last && last.kind === "rows")
            last.rows.push(object);
        else if (object.kind === "row")
            grouped.push({kind: "rows", columns: [], rows: [object]});
        else
            grouped.push(object.kind === "columns" ? {kind: "rows", columns: object.columns, rows: []} : object);
    }
    return grouped;
}

function part(object) {
    if (object.kind === "rows")
        return `<table><tr>${object.columns.map((name) => `<th>${escaped(name)}</th>`).join("")}</tr>${object.rows.map((row) => `<tr>${row.values.map((value, i) =>
            `<td>${escaped(number(value, (row.errors || [])[i]))}</td>`).join("")}</tr>`).join("\n")}</table>`;
    return parts[object.kind] ? parts[object.kind](object) : `<pre>${escaped(JSON.stringify(object, null, 2))}</pre>`;
}

/* The answers as one page; those that are pages themselves are left out. */
function answersPage(title, objects) {
    const shown = tables(objects.filter((object) => object.kind !== "page"));

    return `<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; img-src data:">
<title>${escaped(title)}</title><style>${style}</style></head>
<body><h1>${escaped(title)}</h1>
${shown.map(part).join("\n")}
${shown.length > 0 ? "" : "<p>Done; it printed nothing.</p>"}
</body></html>
`;
}

/* A page that qdot wrote, with the policy that lets its own scripts run and nothing else. */
function wholePage(html) {
    const nonce = crypto.randomBytes(16).toString("base64");
    const policy = `<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'nonce-${nonce}'; ` +
          "style-src 'unsafe-inline'; img-src data: blob:; font-src data:; media-src data: blob:\">";
    const marked = html.replace(/<script(?=[\s>])/gi, `<script nonce="${nonce}"`);

    return /<head[^>]*>/i.test(marked) ? marked.replace(/<head[^>]*>/i, (head) => head + policy)
        : marked.replace(/^(\s*<!DOCTYPE[^>]*>)?(\s*<html[^>]*>)?/i, (start) => `${start}<head>${policy}</head>`);
}

module.exports = {answersPage, wholePage};
