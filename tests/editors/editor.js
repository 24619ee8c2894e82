/* editor.js -- an editor without a screen: a text and a cursor, kept the same at `qdot --lsp` by incremental
 * changes, with what VS Code's client library asks of it. */
"use strict";
const {spawn} = require("child_process");
const rpc = require("vscode-jsonrpc/node");

/* What an editor says that it can do, as far as it matters to the server. */
const capabilities = {
    general: {positionEncodings: ["utf-16"]},
    window: {workDoneProgress: true},
    workspace: {applyEdit: true, executeCommand: {}, configuration: true, workspaceEdit: {documentChanges: true}},
    textDocument: {
        synchronization: {didSave: true}, publishDiagnostics: {versionSupport: true, relatedInformation: true},
        completion: {completionItem: {snippetSupport: true, documentationFormat: ["markdown", "plaintext"]}},
        hover: {contentFormat: ["markdown", "plaintext"]},
        signatureHelp: {signatureInformation: {documentationFormat: ["markdown"],
                                               parameterInformation: {labelOffsetSupport: true}}},
        definition: {}, references: {}, rename: {prepareSupport: true}, formatting: {}, foldingRange: {}, codeLens: {},
        codeAction: {codeActionLiteralSupport: {codeActionKind: {valueSet: ["quickfix"]}}},
        documentSymbol: {hierarchicalDocumentSymbolSupport: true}, documentHighlight: {}
    }
};

/* A message to a server that has ended; its end is told otherwise. */
process.on("unhandledRejection", (error) => {
    if (!["EPIPE", "ERR_STREAM_DESTROYED"].includes(error.code))
        throw error;
});

/* In the place of vscode-languageclient's class, which wants VS Code itself: the same messages. */
class LanguageClient {
    constructor(id, name, server, options) {
        Object.assign(this, {id, name, server, options, diagnostics: new Map(), waiting: [], progress: 0});
    }

    async start() {
        this.process = spawn(this.server.run.command, this.server.run.args, {stdio: ["pipe", "pipe", "inherit"]});
        this.ended = new Promise((resolve) => this.process.on("exit", (code) => resolve(code)));
        this.connection = rpc.createMessageConnection(new rpc.StreamMessageReader(this.process.stdout),
                                                      new rpc.StreamMessageWriter(this.process.stdin));
        this.connection.onNotification("textDocument/publishDiagnostics", (told) => {
            this.diagnostics.set(told.uri, told);
            this.waiting = this.waiting.filter((wait) => !wait(told));
        });
        this.connection.onNotification("$/progress", () => this.progress++);
        this.connection.onRequest("window/workDoneProgress/create", () => null);
        this.connection.onRequest("client/registerCapability", () => null);
        this.connection.onError(() => {}); /* the process ended, which `ended` tells */
        this.process.stdin.on("error", () => {});
        this.connection.listen();
        this.answer = await new Promise((resolve, reject) => {
            this.ended.then((code) => reject(new Error(`it ended with ${code}`)));
            this.connection.sendRequest("initialize", {processId: process.pid, rootUri: null, capabilities})
                .then(resolve, () => {});
        });
        await this.connection.sendNotification("initialized", {});
    }

    sendRequest(method, params, token) {
        return this.connection.sendRequest(method, params, ...(token ? [token] : []));
    }

    sendNotification(method, params) {
        return this.connection.sendNotification(method, params);
    }

    async stop() {
        await this.connection.sendRequest("shutdown");
        await this.connection.sendNotification("exit");
        return this.ended;
    }
}

/* A script that is open, with a cursor. */
class Editor {
    constructor(client, uri, text) {
        Object.assign(this, {client, uri, text: "", version: 0, cursor: 0});
        this.text = text;
        client.sendNotification("textDocument/didOpen",
                                {textDocument: {uri, languageId: "qdot", version: this.version, text}});
        this.cursor = text.length;
    }

    /* Where the byte is, as the protocol says it: code units of UTF-16 are those of JavaScript. */
    position(at) {
        const before = this.text.slice(0, at).split("\n");

        return {line: before.length - 1, character: before[before.length - 1].length};
    }

    offset({line, character}) {
        const lines = this.text.split("\n");

        return lines.slice(0, line).reduce((sum, text) => sum + text.length + 1, 0) + character;
    }

    /* Replace [from, to) and put the cursor behind it. */
    replace(from, to, text) {
        const range = {start: this.position(from), end: this.position(to)};

        this.text = this.text.slice(0, from) + text + this.text.slice(to);
        this.cursor = from + text.length;
        this.version++;
        this.client.sendNotification("textDocument/didChange", {
            textDocument: {uri: this.uri, version: this.version}, contentChanges: [{range, text}]});
    }

    /* A person types at the cursor, a key after the other. */
    type(text) {
        for (const key of text)
            this.replace(this.cursor, this.cursor, key);
    }

    /* Put the cursor behind the n-th occurrence of a text. */
    behind(part, n = 1) {
        let at = -1;

        for (let i = 0; i < n; i++)
            at = this.text.indexOf(part, at + 1);
        if (at < 0)
            throw new Error(`the script lacks ${part}`);
        this.cursor = at + part.length;
        return this;
    }

    /* Replace the first occurrence of a text. */
    correct(wrong, right) {
        this.behind(wrong);
        this.replace(this.cursor - wrong.length, this.cursor, right);
    }

    /* What the server says of the text as it is now. */
    async diagnostics() {
        const told = this.client.diagnostics.get(this.uri);

        if (told && told.version === this.version)
            return told.diagnostics;
        return new Promise((resolve, reject) => {
            const timer = setTimeout(() => reject(new Error("no diagnostics within 20 s")), 20000);

            this.client.waiting.push((newer) => {
                if (newer.uri !== this.uri || newer.version !== this.version)
                    return false;
                clearTimeout(timer);
                resolve(newer.diagnostics);
                return true;
            });
        });
    }

    at(extra) {
        return {textDocument: {uri: this.uri}, position: this.position(this.cursor), ...extra};
    }

    ask(method, extra) {
        return this.client.sendRequest(`textDocument/${method}`, this.at(extra));
    }

    async completions() {
        const answer = await this.ask("completion", {context: {triggerKind: 1}});

        return Array.isArray(answer) ? answer : answer.items;
    }

    /* Accept a completion; snippets with what stands in their places. */
    async accept(label) {
        const item = (await this.completions()).find((one) => one.label === label);

        if (item === undefined)
            throw new Error(`${label} is not offered`);
        const plain = (text) => text.replace(/\$\{\d+:([^}]*)\}/g, "$1").replace(/\$\d/g, "");
        if (item.textEdit) {
            const range = item.textEdit.range || item.textEdit.insert;
            this.replace(this.offset(range.start), this.offset(range.end), plain(item.textEdit.newText));
        } else {
            const word = /[\p{L}\p{N}_]*$/u.exec(this.text.slice(0, this.cursor))[0];
            this.replace(this.cursor - word.length, this.cursor, plain(item.insertText || label));
        }
        return item;
    }

    /* Carry out edits of this script, the last one first. */
    apply(edits) {
        const sorted = [...edits].sort((a, b) => this.offset(b.range.start) - this.offset(a.range.start));

        for (const edit of sorted)
            this.replace(this.offset(edit.range.start), this.offset(edit.range.end), edit.newText);
        return edits.length;
    }

    applyWorkspace(edit) {
        const own = edit.changes ? edit.changes[this.uri]
            : edit.documentChanges.filter((change) => change.textDocument.uri === this.uri)
                .flatMap((change) => change.edits);

        return this.apply(own || []);
    }
}

module.exports = {LanguageClient, Editor};
