/* extension.js -- scripts of qdot in VS Code: starts `qdot --lsp`, and shows what its commands answer. */
"use strict";
const vscode = require("vscode");
const {LanguageClient} = require("vscode-languageclient/node");
const {findProgram} = require("./program");
const {Panels} = require("./panels");

/* What a person runs, with the command of the server that does it, what is told meanwhile, and what a page
 * in the answer is. */
const commands = {
    "qdot.runFile": {server: "qdot.run", title: "Running", page: "page"},
    "qdot.showEquations": {server: "qdot.equations", title: "Deriving the equations of", page: "page"},
    "qdot.plotFile": {server: "qdot.plot", title: "Plotting", page: "page"},
    "qdot.animateFile": {server: "qdot.animate", title: "Animating", page: "animation"},
    "qdot.reportFile": {server: "qdot.report", title: "Writing the report of", page: "report"}
};

let panels, output, watcher, client = null, starting = null;

/* Say that there is no server, and offer what helps. */
async function complain(message) {
    const settings = "Open settings", again = "Try again";
    const chosen = await vscode.window.showErrorMessage(message, settings, again);

    if (chosen === settings)
        await vscode.commands.executeCommand("workbench.action.openSettings", "qdot.path");
    else if (chosen === again)
        await restart();
}

/* A command of the server: what it answers comes into a panel. Code lenses come here, too. */
function answer(command, [uri, ...more]) {
    const row = Object.values(commands).find((one) => one.server === command) || {title: command, page: "page"};
    const name = uri.split("/").pop();

    return vscode.window.withProgress({
        location: vscode.ProgressLocation.Notification,
        title: `${row.title} ${decodeURIComponent(name)}`,
        cancellable: true
    }, async (progress, token) => {
        try {
            const request = {command, arguments: [uri, ...more]};
            const result = await client.sendRequest("workspace/executeCommand", request, token);

            if (!token.isCancellationRequested)
                panels.show(uri, row, result);
            return result;
        } catch (error) {
            if (!token.isCancellationRequested)
                vscode.window.showErrorMessage(`qdot: ${error.message}`);
            return undefined;
        }
    });
}

function newClient(path) {
    const run = {command: path, args: ["--lsp"]};

    return new LanguageClient("qdot", "qdot", {run, debug: run}, {
        documentSelector: [{language: "qdot"}],
        outputChannel: output,
        synchronize: {fileEvents: watcher}, /* what scripts include, and data */
        middleware: {
            executeCommand: (command, args, next) =>
                command.startsWith("qdot.") && typeof args[0] === "string" ? answer(command, args) : next(command, args)
        }
    });
}

/* Start the server. Null: there is none, which was said. */
async function start() {
    const configuration = vscode.workspace.getConfiguration("qdot");
    const found = await findProgram(configuration.get("path", "qdot"));

    if (found.problem) {
        output.appendLine(found.problem);
        complain(found.problem); /* nobody waits for the answer */
        return null;
    }
    output.appendLine(`${found.path}: version ${found.version}`);
    const started = newClient(found.path);
    try {
        await started.start();
    } catch (error) {
        complain(`qdot: ${found.path} --lsp did not start: ${error.message}`);
        return null;
    }
    return started;
}

/* The running client, started where it is not. Null: it cannot be. */
async function running() {
    if (client === null) {
        starting = starting || start();
        client = await starting;
        starting = null;
    }
    return client;
}

async function stop() {
    const stopped = client;

    client = null;
    if (stopped !== null)
        await stopped.stop().catch((error) => output.appendLine(String(error)));
}

async function restart() {
    await stop();
    return running();
}

/* The uri of the script in front; undefined: there is none, which is said. */
function scriptInFront() {
    const editor = vscode.window.activeTextEditor;

    if (editor && editor.document.languageId === "qdot")
        return editor.document.uri.toString();
    vscode.window.showInformationMessage("qdot: open a script, a file *.lag, first");
    return undefined;
}

async function activate(context) {
    output = vscode.window.createOutputChannel("qdot");
    panels = new Panels(vscode);
    watcher = vscode.workspace.createFileSystemWatcher("**/*.{lag,csv,dat,txt,h5}");
    context.subscriptions.push(output, panels, watcher);
    for (const [name, row] of Object.entries(commands))
        context.subscriptions.push(vscode.commands.registerCommand(name, async () => {
            const uri = scriptInFront();

            return uri && await running() !== null ? answer(row.server, [uri]) : undefined;
        }));
    context.subscriptions.push(
        vscode.commands.registerCommand("qdot.restart", restart),
        vscode.workspace.onDidChangeConfiguration((event) => {
            if (event.affectsConfiguration("qdot.path"))
                restart();
        }));
    await running();
}

module.exports = {activate, deactivate: stop};
