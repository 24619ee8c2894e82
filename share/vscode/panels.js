/* panels.js -- the panels beside a script: one for its answers, one for each kind of page. */
"use strict";
const fs = require("fs");
const path = require("path");
const {answersPage, wholePage} = require("./page");

/* A file that an answer names, as the object that it is. */
function fileObject(file) {
    const name = path.basename(file), ending = path.extname(file);

    if (ending === ".svg")
        return {kind: "figure", mime: "image/svg+xml", name, data: fs.readFileSync(file, "utf8")};
    if (ending === ".html")
        return {kind: "page", mime: "text/html", name, data: fs.readFileSync(file, "utf8")};
    return {kind: "file", path: file};
}

/* What a command of the server answered, as the objects that a panel shows: those in the answer, or its
 * text, formulas, files and error. */
function objectsOf(result) {
    const answer = result || {};

    if (answer.objects)
        return answer.objects;
    const formulas = (answer.mathml || []).map((line) => ({kind: "expr", mathml: line}));
    const objects = [...formulas, ...(answer.files || []).map(fileObject)];

    if (answer.text && formulas.length === 0)
        objects.unshift({kind: "text", text: answer.text});
    if (answer.error)
        objects.push({kind: "failure", text: answer.error});
    return objects;
}

class Panels {
    constructor(vscode) {
        this.vscode = vscode;
        this.open = new Map(); /* by script and kind */
    }

    /* Show what a command answered for the script: `title`, what it did, and `page`, what its pages are. */
    show(uri, {title, page}, result) {
        const objects = objectsOf(result), name = decodeURIComponent(uri.split("/").pop());
        const pages = objects.filter((object) => object.kind === "page");

        if (pages.length === 0 || objects.length > pages.length)
            this.fill(`${uri} answers`, `${name}: answers`, answersPage(`${title} ${name}`, objects), false);
        pages.forEach((object, i) => {
            const what = i > 0 ? `${page} ${i + 1}` : page;

            this.fill(`${uri} ${what}`, `${name}: ${what}`, wholePage(object.data), true);
        });
    }

    /* Fill the panel of this key, which is made where there is none. */
    fill(key, title, html, scripts) {
        let panel = this.open.get(key);

        if (panel === undefined) {
            panel = this.vscode.window.createWebviewPanel(
                "qdot", title, {viewColumn: this.vscode.ViewColumn.Beside, preserveFocus: true},
                {enableScripts: scripts, localResourceRoots: [], retainContextWhenHidden: scripts});
            panel.onDidDispose(() => this.open.delete(key));
            this.open.set(key, panel);
        } else {
            panel.reveal(undefined, true);
        }
        panel.webview.html = html;
    }

    dispose() {
        for (const panel of [...this.open.values()])
            panel.dispose();
    }
}

module.exports = {Panels, objectsOf};
