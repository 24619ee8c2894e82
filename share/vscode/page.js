/* page.js -- answers of qdot as pages for a panel, which reach no network.
 *
 * What is written by qdot in HTML, an animation or a report, is a page of its own with scripts, which are
 * let run by a nonce. Everything else is one page without any script.
 */
"use strict";
const crypto = require("crypto");

/* How the panel looks; what qdot writes has a style of its own. */
const style = `
body { font-family: var(--vscode-font-family, sans-serif); font-size: var(--vscode-font-size, 13px);
    color: var(--vscode-foreground, #222); background: var(--vscode-editor-background, #fff); padding: 0 1em 2em; }
pre { font-family: var(--vscode-editor-font-family, monospace); }
h1 { font-size: 1.1em; font-weight: 600; }
math { font-size: 1.25em; }
.figure { background: #fff; padding: 4px; max-width: 100%; height: auto; }
.error { border-left-color: var(--vscode-editorError-foreground, #c00); }
.notice { border-left-color: var(--vscode-editorWarning-foreground, #b80); }`;

const signs = {"&": "&amp;", "<": "&lt;", ">": "&gt;", "\"": "&quot;", "'": "&#39;"};

function escaped(text) {
    return String(text).replace(/[&<>"']/g, (sign) => signs[sign]);
}

function image(figure) {
    const data = Buffer.from(figure.data).toString("base64");

    return `<p><img class="figure" alt="${escaped(figure.name)}" src="data:image/svg+xml;base64,${data}"></p>`;
}

/* The answer of a command as one page: what qdot has written in HTML (its text where it is older than
 * that), and figures. */
function answersPage(title, answer, figures) {
    const said = answer.html === undefined ? `<pre>${escaped(answer.text || "")}</pre><pre class="error">${
        escaped(answer.error || "")}</pre>` : answer.html;
    const shown = `${said}${figures.map(image).join("\n")}`;

    return `<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; img-src data:">
<title>${escaped(title)}</title><style>${answer.style || ""}${style}</style></head>
<body class="qdot"><h1>${escaped(title)}</h1>
${shown || "<p>Done; it printed nothing.</p>"}
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
