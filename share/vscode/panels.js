/* panels.js -- the panels beside a script: one for its answers, one for each kind of page. */
"use strict";
const fs = require("fs");
const path = require("path");
const {answersPage, wholePage} = require("./page");

/* The files with that ending, each as {name, data}. */
function filesOf(answer, ending) {
    return (answer.files || []).filter((file) => path.extname(file) === ending)
        .map((file) => ({name: path.basename(file), data: fs.readFileSync(file, "utf8")}));
}

class Panels {
    constructor(vscode) {
        this.vscode = vscode;
        this.open = new Map(); /* by script and kind */
    }

    /* Show what a command answered for the script: `title`, what it did, and `page`, what its pages are. */
    show(uri, {title, page}, answer) {
        const name = decodeURIComponent(uri.split("/").pop());
        const pages = filesOf(answer, ".html"), figures = filesOf(answer, ".svg");

        if (pages.length === 0 || figures.length > 0 || answer.html || answer.text || answer.error)
            this.fill(`${uri} answers`, `${name}: answers`, answersPage(`${title} ${name}`, answer, figures), false);
        pages.forEach((file, i) => {
            const what = i > 0 ? `${page} ${i + 1}` : page;

            this.fill(`${uri} ${what}`, `${name}: ${what}`, wholePage(file.data), true);
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

module.exports = {Panels};
